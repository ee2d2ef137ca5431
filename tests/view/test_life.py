#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that large scenes open, move and close. A window closed during tracing must disappear at
once. clrt must report a lost display, and -o must never connect to a display.
Usage: CLRT=path/to/clrt test_life.py"""

import os
import socket
import subprocess
import time

from screen import ROOT, SCENE, Window, opened, planes_of, render, run_tests

LARGE = ROOT / "scenes" / "models" / "coral.ply"
GONE_SECONDS = 0.1  # the allowed time beyond the time for closing an idle window


def a_display_that_dies_is_named(screen):
    other = type(screen)()
    window = Window(other, SCENE)
    window.wait("ray traced, view 1")
    other.server.kill()
    window.wait("clrt: the display is gone, or a driver ended the program")
    window.end(4)
    other.close()


def write_large(folder):
    scene = folder / "large.scn"
    scene.write_text(f"material 1\nlight 9 -4 10 0.7\nsides two\nmesh {LARGE.resolve()}\n"
                     "camera 2 -3 1.5  0 0 0.4  30\n")
    return scene


def a_million_triangles_open_orbit_and_close(screen, folder):
    if not LARGE.exists():
        print("skipped: scenes/models/coral.ply has not been made")
        return
    scene = write_large(folder)
    start = time.monotonic()
    window = opened(screen, scene, size=(400, 300))
    print(f"         opened after {time.monotonic() - start:.2f} s")
    for mode in ("ray traced", "OpenGL"):
        before = window.read()
        window.drag(1, 30, 10)
        window.wait(mode, "moved")
        assert window.read() != before, f"{mode}: nothing moves"
        window.press("1", mode, "view 1,")
        window.press("r", "view 1,")
    expected = render(scene, size=(400, 300))
    window.until(lambda shown: planes_of(shown) == expected, "shows what -o writes")


def is_picture(shown):
    return len(set(shown[1::4])) > 100


def seconds_to_close(screen, scene, *options, is_tracing):
    """Returns the seconds from the key press to the end of the process."""
    keys = [] if is_tracing else ["--keys", ""]
    window = Window(screen, scene, *options, *keys, size=(500, 400))
    if is_tracing:
        window.until(is_picture, "shows a picture")
        time.sleep(1.5)
        assert not any("ray traced" in line for line in list(window.lines.queue)), \
            "the picture was complete too early"
    else:
        window.wait("OpenGL, view 1")
    screen.do("key", "q")
    start = time.monotonic()
    window.end()
    return time.monotonic() - start


def a_window_closed_while_it_traces_is_gone_at_once(screen, folder):
    cases = [(SCENE, ["--aa=64"])]
    if LARGE.exists():
        cases.append((write_large(folder), ["--tune=bvh=none"]))
    for scene, options in cases:
        rest = seconds_to_close(screen, scene, *options, is_tracing=False)
        # A busy machine only adds time, so the shortest of at most three times decides.
        for _ in range(3):
            seconds = seconds_to_close(screen, scene, *options, is_tracing=True)
            if seconds < rest + GONE_SECONDS:
                break
        print(f"         {scene.stem} {options}: closes in {1e3 * seconds:.0f} ms while "
              f"tracing, in {1e3 * rest:.0f} ms when idle")
        assert seconds < rest + GONE_SECONDS, f"{scene.stem}: gone after {seconds:.3f} s"


def camera_moves_while_a_picture_is_traced(screen):
    """Coarse pictures of a moved camera appear long before the full picture would be finished."""
    window = Window(screen, SCENE, "--aa=64", size=(500, 400))
    before = window.until(is_picture, "shows a picture")
    for step in range(5):
        start = time.monotonic()
        window.drag(1, 20, 3)
        before = window.until(lambda shown, last=before: shown != last, "follows the mouse")
        seconds = time.monotonic() - start
        assert seconds < 1, f"drag {step} is seen after {seconds:.2f} s"
    screen.do("key", "q")
    window.end()


def the_camera_moves_and_q_quits_while_kernels_are_built(screen, folder):
    library, wait = os.environ["CLRT_FAIL_DEVICE"], folder / "wait"
    if not library:
        print("skipped: a build with sanitizers preloads no library")
        return
    os.environ.update(LD_PRELOAD=library, CLRT_BUILD_WAITS=str(wait))
    window = opened(screen, SCENE)
    del os.environ["LD_PRELOAD"], os.environ["CLRT_BUILD_WAITS"]
    before = window.read()
    wait.touch()  # from now on, no kernel is built
    screen.do("key", "R")
    window.drag(1, 60, 10)
    window.until(lambda shown: shown != before, "follows the mouse")
    time.sleep(0.5)
    assert not any("moved" in line for line in list(window.lines.queue)), "a kernel was built"
    wait.unlink()
    window.wait("ray traced, view 1 moved")
    wait.touch()
    screen.do("key", "R", "q")
    window.end()


def a_minimised_and_a_tiny_window_go_on(screen, window):
    before = window.read()
    screen.do("search", "--name", "clrt", "windowunmap", "--sync")
    screen.do("search", "--name", "clrt", "windowmap", "--sync")
    window.until(lambda shown: shown == before, "comes back")
    window.size = (7, 3)
    screen.do("search", "--name", "clrt", "windowsize", *window.size)
    window.wait("7x3")
    screen.do("mousemove", 1, 1)
    window.press("t", "text on", "7x3")
    window.press("h", "help on", "7x3")


def o_never_touches_the_display(screen, folder):
    """The display is only a socket that detects connections."""
    with socket.socket(socket.AF_INET) as door:
        door.bind(("127.0.0.1", 0))
        door.listen()
        door.setblocking(False)
        port = door.getsockname()[1]
        if port < 6000:
            print("skipped: no port that a display could have")
            return
        there = {**os.environ, "DISPLAY": f"127.0.0.1:{port - 6000}"}
        words = [os.environ["CLRT"], str(ROOT / "scenes" / "simple.scn"), "-s", "8x8"]
        subprocess.run([*words, "-q", "-o", f"{folder}/a.pfm"], env=there, check=True)
        try:
            door.accept()
            raise AssertionError("-o connects to the display")
        except BlockingIOError:
            pass
        with subprocess.Popen(words, env=there, stderr=subprocess.DEVNULL) as window:
            door.settimeout(20)
            try:
                door.accept()[0].close()  # the window connects, so the socket works
            except TimeoutError as silence:
                raise AssertionError("a window does not connect to this display") from silence
            finally:
                window.kill()


if __name__ == "__main__":
    run_tests(globals())
