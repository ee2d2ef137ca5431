# SPDX-License-Identifier: MIT
"""Drags files over a window and drops them there, as file managers do, by XDND version 5 and libX11."""

import ctypes
import pathlib
import time

Atom = Handle = Moment = ctypes.c_ulong
SELECTION_NOTIFY, SELECTION_REQUEST, CLIENT_MESSAGE = 31, 30, 33
VERSION = 5
COPY = "XdndActionCopy"
HEAD = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("is_sent", ctypes.c_int),
        ("display", ctypes.c_void_p)]


class Message(ctypes.Structure):
    _fields_ = HEAD + [("window", Handle), ("kind", Atom), ("format", ctypes.c_int),
                       ("data", ctypes.c_long * 5)]


class Request(ctypes.Structure):
    _fields_ = HEAD + [("owner", Handle), ("requestor", Handle), ("selection", Atom),
                       ("target", Atom), ("property", Atom), ("time", Moment)]


class Answer(ctypes.Structure):
    _fields_ = HEAD + [("requestor", Handle), ("selection", Atom), ("target", Atom),
                       ("property", Atom), ("time", Moment)]


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("message", Message), ("request", Request),
                ("answer", Answer), ("room", ctypes.c_long * 24)]


class Drag:
    """A window of another client. Files are dragged from this window."""

    def __init__(self, screen_name):
        self.x = ctypes.CDLL("libX11.so.6")
        for name in "XOpenDisplay", "XInternAtom", "XDefaultRootWindow", "XCreateSimpleWindow":
            getattr(self.x, name).restype = ctypes.c_void_p if name == "XOpenDisplay" else Handle
        self.display = ctypes.c_void_p(self.x.XOpenDisplay(screen_name.encode()))
        root = Handle(self.x.XDefaultRootWindow(self.display))
        self.own = self.x.XCreateSimpleWindow(self.display, root, 0, 0, 1, 1, 0, Handle(0), Handle(0))
        self.atoms = {}

    def atom(self, name):
        if name not in self.atoms:
            self.atoms[name] = self.x.XInternAtom(self.display, name.encode(), 0)
        return self.atoms[name]

    def send(self, window, event):
        event.display = self.display
        self.x.XSendEvent(self.display, Handle(window), 0, ctypes.c_long(0), ctypes.byref(event))
        self.x.XFlush(self.display)

    def tell(self, window, kind, *data):
        message = Message(type=CLIENT_MESSAGE, window=window, kind=self.atom(kind), format=32)
        message.data[:1 + len(data)] = [self.own, *data]
        self.send(window, Event(message=message))

    def give(self, request, content):
        """Sends the dragged content to the requestor."""
        self.x.XChangeProperty(self.display, Handle(request.requestor), Atom(request.property),
                               Atom(request.target), 8, 0, content, len(content))
        answer = Answer(type=SELECTION_NOTIFY, requestor=request.requestor,
                        selection=request.selection, target=request.target,
                        property=request.property, time=request.time)
        self.send(request.requestor, Event(answer=answer))

    def await_message(self, kind, content):
        event = Event()
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if self.x.XPending(self.display) == 0:
                time.sleep(0.01)
                continue
            self.x.XNextEvent(self.display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                self.give(event.request, content)
            if event.type == CLIENT_MESSAGE and event.message.kind == self.atom(kind):
                return
        raise AssertionError(f"the window sends no {kind}")

    def drop(self, window, *paths):
        content = "".join(pathlib.Path(path).as_uri() + "\r\n" for path in paths).encode()
        self.x.XSetSelectionOwner(self.display, Atom(self.atom("XdndSelection")), Handle(self.own),
                                  Moment(0))
        self.tell(window, "XdndEnter", VERSION << 24, self.atom("text/uri-list"))
        self.tell(window, "XdndPosition", 0, 10 << 16 | 10, 0, self.atom(COPY))
        self.await_message("XdndStatus", content)
        self.tell(window, "XdndDrop", 0, 0)
        self.await_message("XdndFinished", content)

    def close(self):
        self.x.XCloseDisplay(self.display)
