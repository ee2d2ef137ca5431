# SPDX-License-Identifier: MIT
"""A private display for tests. Reads its pixels, and controls clrt's window on it by real events."""

import ctypes
import inspect
import mmap
import os
import pathlib
import queue
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.append(str(ROOT / "tests" / "cli"))

from pictures import read_pfm  # noqa: E402
from skips import leave  # noqa: E402

SCENE = ROOT / "scenes" / "reflections.scn"
COURSE = pathlib.Path(os.environ.get("CLRT_COURSE", ROOT / ".." / "shared" / "course"))
PATIENCE = 60  # seconds for any step, because clrt may have to compile kernels
TICK = 0.02  # loops count waits of this many seconds, so that pauses of the machine do not count


def require_tools():
    for tool in ("Xvfb", "xdotool"):
        if shutil.which(tool) is None:
            leave(f"{tool} is not installed")


class Screen:
    """An X server that stores its screen in a file."""

    def __init__(self, width=1024, height=768):
        require_tools()
        self.windows = []
        self.folder = tempfile.TemporaryDirectory()
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-fbdir", self.folder.name, "-nolisten", "tcp", "-noreset",
             "-screen", "0", f"{width}x{height}x24"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()
        with open(f"{self.folder.name}/Xvfb_screen0", "rb") as file:
            self.memory = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        header = struct.unpack(">25I", self.memory[:100])
        self.stride, colors = header[12], header[19]
        self.start = header[0] + 12 * colors

    def environment(self):
        return {**os.environ, "DISPLAY": self.name, "LIBGL_ALWAYS_SOFTWARE": "1"}

    def read(self, width, height):
        """Returns the pixels of the upper left corner as bytes: blue, green, red and an unused
        byte."""
        rows = (self.start + row * self.stride for row in range(height))
        return b"".join(self.memory[row:row + 4 * width] for row in rows)

    def set_density(self, density):
        """Sets the density for windows that open later, in multiples of 96 pixels per inch."""
        x = ctypes.CDLL("libX11.so.6")
        x.XOpenDisplay.restype = ctypes.c_void_p
        x.XDefaultRootWindow.restype = ctypes.c_ulong
        display = ctypes.c_void_p(x.XOpenDisplay(self.name.encode()))
        text = f"Xft.dpi:\t{96 * density}\n".encode()
        resource_manager, string = 23, 31  # predefined atoms
        x.XChangeProperty(display, ctypes.c_ulong(x.XDefaultRootWindow(display)),
                          ctypes.c_ulong(resource_manager), ctypes.c_ulong(string), 8, 0, text,
                          len(text))
        x.XCloseDisplay(display)

    def do(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment(), check=True,
                       stdout=subprocess.DEVNULL)

    def clear(self):
        """Closes windows that a failed test has left open."""
        for window in self.windows:
            window.process.kill()
            window.process.wait()
        self.windows.clear()

    def close(self):
        self.clear()
        self.memory.close()
        self.server.terminate()
        self.server.wait()
        self.folder.cleanup()


class Window:
    """Runs clrt with a scene in a window. Because of -v, clrt prints the state after each picture. If
    `refines` is false, the window opens without anti-aliasing."""

    def __init__(self, screen, scene, *options, size=(320, 240), folder=None, refines=False):
        self.screen, self.size = screen, size
        if not refines and not any(option.startswith("--aa") for option in options):
            options += ("--aa=1",)
        command = [os.environ["CLRT"], str(scene), "-v", "-s", f"{size[0]}x{size[1]}", *options]
        self.process = subprocess.Popen(command, env=screen.environment(), cwd=folder, text=True,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE)
        screen.windows.append(self)
        self.lines = queue.Queue()
        self.printed = []
        threading.Thread(target=self._listen, daemon=True).start()
        screen.do("mousemove", size[0] // 2, size[1] // 2)

    def _listen(self):
        for line in self.process.stderr:
            self.lines.put(line.rstrip("\n"))
        self.lines.put(None)

    def wait(self, *parts):
        """Returns the next printed line that contains all the parts."""
        for _ in range(int(PATIENCE / TICK)):
            try:
                line = self.lines.get(timeout=TICK)
            except queue.Empty:
                continue
            if line is None:
                break
            self.printed.append(line)
            if all(part in line for part in parts):
                return line
        raise AssertionError(f"no line with {parts} after {self.printed[-3:]}")

    def press(self, key, *parts):
        """Presses a key and waits for a state with these parts."""
        self.screen.do("key", key)
        return self.wait(*parts) if parts else None

    def drag(self, button, right, down, key=None):
        x, y = self.size[0] // 2, self.size[1] // 2
        before, after = (["keydown", key], ["keyup", key]) if key else ([], [])
        self.screen.do("mousemove", x, y, *before, "mousedown", button, "mousemove", x + right,
                       y + down, "mouseup", button, *after)

    def read(self):
        """Returns the window's content once it no longer changes."""
        shown = None
        while True:
            before, shown = shown, self.screen.read(*self.size)
            if before == shown:
                return shown
            time.sleep(0.05)

    def until(self, condition, what):
        """Waits until the window's content meets the condition. Returns the content."""
        for _ in range(int(PATIENCE / TICK)):
            shown = self.screen.read(*self.size)
            if condition(shown):
                return shown
            time.sleep(TICK)
        raise AssertionError(f"the window never {what}")

    def close(self, code=0):
        self.screen.do("key", "q")
        self.end(code)

    def end(self, code=0):
        found = self.process.wait(PATIENCE)
        assert found == code, f"exit {found} instead of {code}: {self.printed[-3:]}"


def render(scene, *options, size=(320, 240)):
    """Returns the planes of blue, green and red bytes of the picture that -o writes. The default is one
    sample per pixel."""
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/picture.pfm"
        subprocess.run([os.environ["CLRT"], str(scene), "-q", "-s", f"{size[0]}x{size[1]}",
                        "--aa=1", "-o", path, *options], check=True)
        pixels = bytes(int(value * 255 + 0.5) for row in read_pfm(path) for value in row)
        return pixels[2::3], pixels[1::3], pixels[0::3]


def opened(screen, scene, *options, **more):
    """Returns a window that shows the ray-traced scene without text."""
    window = Window(screen, scene, *options, **more)
    window.wait("ray traced, view 1", "text on")
    window.press("t", "text off")
    return window


def expect(window, scene, what):
    """Waits until the window shows the picture that -o writes."""
    picture = render(scene)
    window.until(lambda shown: planes_of(shown) == picture, what)


def planes_of(shown):
    """Returns the planes of blue, green and red bytes of a window's content."""
    return shown[0::4], shown[1::4], shown[2::4]


def count_pixels(shown, wanted):
    """Returns the number of pixels with wanted(red, green, blue)."""
    blue, green, red = planes_of(shown)
    return sum(1 for color in zip(red, green, blue) if wanted(*color))


def is_red(red, green, blue):
    return red == 255 and green == 26 and blue == 13


def is_blue(red, green, blue):
    return red == 26 and green == 77 and blue == 255


def is_test(function):
    """Returns whether the function is a test. Its arguments must be a screen, a window or both, and
    may include a temporary folder."""
    taken = set(inspect.signature(function).parameters)
    return taken - {"folder"} in ({"screen"}, {"window"}, {"screen", "window"})


def run_test(test, screen):
    """Calls a test with its arguments, and closes the windows that the test leaves open. The argument
    `window` shows SCENE, and runs in the test's folder."""
    with tempfile.TemporaryDirectory() as name:
        given = {"screen": lambda: screen, "folder": lambda: pathlib.Path(name),
                 "window": lambda: opened(screen, SCENE, folder=name)}
        test(**{taken: given[taken]() for taken in inspect.signature(test).parameters})
        for window in screen.windows:
            if window.process.poll() is None:
                window.close()


def run_tests(module):
    """Runs the module's tests, or only the tests that the command line names. A function's name
    states what the function tests."""
    screen, failures = Screen(), 0
    tests = [test for test in module.values()
             if inspect.isfunction(test) and test.__module__ == "__main__" and is_test(test)]
    named = [test for test in tests if test.__name__ in sys.argv[1:]]
    for test in named or tests:
        start = time.monotonic()
        try:
            run_test(test, screen)
            print(f"{time.monotonic() - start:6.2f} s  {test.__name__}", flush=True)
        except AssertionError as fault:
            failures += 1
            print(f"FAILED   {test.__name__}: {fault}", flush=True)
        screen.clear()
    screen.close()
    sys.exit(1 if failures else 0)
