#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that the ray-traced window shows exactly the pixels that -o writes for the same camera.
Usage: CLRT=path/to/clrt test_pixels.py"""

import subprocess
import os

from screen import COURSE, SCENE, opened, planes_of, render, run_tests
from pictures import read_png

SIZE = (512, 512)


def expect_same(window, scene, *options):
    expected = render(scene, *options, size=window.size)
    window.until(lambda shown: planes_of(shown) == expected, f"shows what -o {options} writes")


def every_view_of_the_courses_scenes_is_the_same(screen):
    if not COURSE.is_dir():
        print("skipped: the course's scenes are missing (CLRT_COURSE names their folder)")
        return
    for name in ("blinn_phong", "reflections", "cow", "buddha"):
        scene = COURSE / "scenes" / f"{name}.scn"
        window = opened(screen, scene, size=SIZE)
        for view in "123456":
            window.press(view)
            expect_same(window, scene, "--view", view)
        window.close()


def anti_aliased_pictures_are_the_same(window):
    window.press("a", "AA 2x2")
    expect_same(window, SCENE, "--aa")


def a_resting_picture_is_anti_aliased_by_itself(screen):
    window = opened(screen, SCENE, refines=True)
    expect_same(window, SCENE, "--aa")
    window.press("2", "ray traced, view 2, AA 2x2")
    expect_same(window, SCENE, "--aa", "--view", "2")
    window.press("a", "AA off")
    expect_same(window, SCENE, "--view", "2")
    window.press("a", "AA 2x2")
    rested = [window.press("r", "OpenGL") and window.read()]
    for view in "12":
        window.press(view, f"OpenGL, view {view}")
    rested.append(window.read())
    window.press("a", "AA off")
    rested.append(window.read())
    assert rested[0] == rested[1] != rested[2], "OpenGL's picture is not anti-aliased after a motion"


def pictures_of_any_size_are_the_same(screen):
    window = opened(screen, SCENE, size=(301, 207))
    expect_same(window, SCENE)
    window.size = (407, 333)
    screen.do("search", "--name", "clrt", "windowsize", *window.size)
    window.wait("407x333")
    expect_same(window, SCENE)


def the_printed_camera_draws_the_same_picture(screen, folder):
    scene = folder / "own.scn"
    scene.write_text("material 3\nsphere 0 0 0.5 1\nsphere 1 1 0.5 0.6\nlight 9 -4 10 0.7\n")
    window = opened(screen, scene)
    window.drag(1, 33, -21)
    window.wait("moved", "rotation 16.75")
    window.press("c")
    window.process.stdout.readline()
    camera = window.process.stdout.readline()
    printed = folder / "printed.scn"
    printed.write_text(scene.read_text() + camera)
    expect_same(window, printed)


def options_that_change_the_picture_do_so_here(screen):
    for options in (["--max-level", "1"], ["--encode", "srgb"]):
        plain = render(SCENE)
        window = opened(screen, SCENE, *options)
        window.until(lambda shown: planes_of(shown) != plain, f"is changed by {options}")
        if "--max-level" in options:
            expect_same(window, SCENE, *options)
        window.close()


def planes_of_png(content):
    pixels = bytes(value for row in read_png(content) for value in row)
    return pixels[2::3], pixels[1::3], pixels[0::3]


def common_end(one, other):
    length = 0
    while length < min(len(one), len(other)) and one[-1 - length] == other[-1 - length]:
        length += 1
    return length


def saved_pictures_equal_the_picture_in_the_window(screen, folder):
    size = (160, 120)
    window = opened(screen, SCENE, size=size, folder=folder)
    window.press("s", "saved")
    window.close()
    png = (folder / "reflections-1.png").read_bytes()
    assert planes_of_png(png) == render(SCENE, size=size), "the PNG differs"
    subprocess.run([os.environ["CLRT"], str(SCENE), "-q", "-s", "160x120", "-o", str(folder / "a.exr")],
                   check=True)
    # The texts at the start contain different settings. The pixels after the texts must be equal.
    written, found = (folder / "a.exr").read_bytes(), (folder / "reflections-1.exr").read_bytes()
    same = common_end(written, found)
    assert same > 0.9 * len(written), f"the EXR file differs: {same} bytes are equal"


if __name__ == "__main__":
    run_tests(globals())
