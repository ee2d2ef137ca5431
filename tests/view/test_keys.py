#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that every key and mouse movement has the effect that the help describes, in the picture or
in the printed state. Usage: CLRT=path/to/clrt test_keys.py"""

import os
import time

from screen import ROOT, SCENE, Window, count_pixels, is_blue, is_red, opened, planes_of, run_tests


def in_both_views(test):
    """Runs the test with a window without text, first in the ray-traced and then in the OpenGL
    view. The test must leave the state as it was."""
    def run(window):
        for mode in ("ray traced", "OpenGL"):
            test(window, mode)
            window.press("r", "view 1, AA off, BVH on, help")
    run.__name__ = test.__name__
    return run


def it_opens_with_rays_and_r_switches_to_opengl(window):
    traced = window.read()
    window.press("r", "OpenGL, view 1")
    assert window.read() != traced, "both views look the same"
    window.press("r", "ray traced, view 1")
    window.until(lambda shown: shown == traced, "shows the rays again")


@in_both_views
def a_smooths_the_edges(window, mode):
    rough = window.read()
    window.press("a", mode, "AA 2x2")
    apart = sum(one != other for one, other in zip(window.read()[1::4], rough[1::4]))
    assert 200 < apart < 20000, f"{apart} pixels of the {mode} view changed"
    window.press("a", mode, "AA off")
    window.until(lambda shown: shown == rough, "goes back")


@in_both_views
def digits_choose_the_scenes_cameras(window, mode):
    shown = set()
    for view in "234561":
        window.press(view, mode, f"view {view},")
        shown.add(window.read())
    assert len(shown) == 6, f"{len(shown)} different pictures of six cameras"


def b_turns_the_tree_off_and_draws_the_same_picture(window):
    before = window.read()
    window.press("b", "BVH off")
    assert window.read() == before, "brute force draws another picture"


@in_both_views
def boxes_are_blue_at_the_leaves_and_red_above(window, mode):
    plain = window.read()
    window.press("bracketright", mode, "boxes at level 1: 1")
    root = window.read()
    assert count_pixels(root, is_red) > 200 and count_pixels(root, is_blue) == 0, "root"
    window.press("bracketright", "boxes at level 2: 2")
    assert window.read() != root, "level 2 looks like level 1"
    window.press("bracketleft", "boxes at level 1: 1")
    assert window.read() == root, "level 1 looks different the second time"
    window.press("bracketleft", mode, "boxes of leaves: ")
    shown = window.read()
    assert count_pixels(shown, is_blue) > 200 and count_pixels(shown, is_red) == 0, "leaves"
    window.press("B", mode, "BVH on, help")
    assert window.read() == plain, "boxes stay"
    window.press("B", mode, "boxes of leaves: ")
    assert window.read() == shown, "B shows something other than leaves"
    window.press("B", mode, "BVH on, help")


@in_both_views
def n_shows_normals_in_red(window, mode):
    assert count_pixels(window.read(), is_red) == 0
    window.press("n", mode, "normals")
    assert count_pixels(window.read(), is_red) > 50, "no red lines"
    window.press("n", mode, "BVH on, help")


@in_both_views
def plus_and_minus_change_the_exposure(window, mode):
    plain = sum(window.read()[1::4])
    window.press("minus", mode, "exposure -0.5")
    assert sum(window.read()[1::4]) < plain, "it is not darker"
    window.press("plus", mode, "BVH on, help")
    window.press("plus", mode, "exposure +0.5")
    assert sum(window.read()[1::4]) > plain, "it is not brighter"
    window.press("minus", "BVH on, help")
    assert sum(window.read()[1::4]) == plain, "it is not as before"


@in_both_views
def o_turns_the_camera_by_itself(window, mode):
    before = window.read()
    window.press("o")
    first = window.until(lambda shown: shown != before, "turns")
    window.until(lambda shown: shown not in (before, first), "turns on")
    window.press("o", mode, "view 1 moved")
    window.press("1", mode, "view 1,")


@in_both_views
def p_switches_perspective(window, mode):
    before = window.read()
    window.press("p", mode, "view 1 moved, orthographic")
    flat = window.read()
    apart = sum(one != other for one, other in zip(flat[1::4], before[1::4]))
    assert 500 < apart < 200000, f"{apart} pixels changed"
    window.press("p", mode, "view 1 moved, AA")
    window.press("1", mode, "view 1,")


@in_both_views
def the_mouse_turns_and_zooms(window, mode):
    window.drag(1, 40, -20)
    window.wait(mode, "moved", "azimuth -35.00, rotation 15.00, distance 6.5")
    turned = window.read()
    window.drag(3, 0, 10)
    window.wait(mode, "azimuth -35.00, rotation 15.00, distance 8.19")
    assert window.read() != turned, "zooming shows nothing"
    window.screen.do("click", 4)
    window.wait(mode, "distance 7.37")
    window.drag(2, 0, -8, "ctrl")
    window.wait(mode, "azimuth -35.00, rotation 15.00, distance 6.13,")
    window.press("Left", mode, "rotation 20.00")
    window.press("Up", mode, "azimuth -30.00")
    window.press("1", mode, "view 1,")


@in_both_views
def the_middle_button_or_shift_moves_sideways(window, mode):
    shown = set()
    for button, key in ((2, None), (1, "shift"), (2, "shift")):
        before = window.read()
        window.drag(button, 40, 10, key)
        window.wait(mode, "moved", "azimuth -40.00, rotation 25.00, distance 6.5")
        shown.add(window.read())
        window.press("1", mode, "view 1,")
        assert before not in shown, "nothing has moved"
    assert len(shown) == 1, "Shift does something else"


@in_both_views
def a_click_explains_the_pixel_until_the_next_key(window, mode):
    window.press("Right", mode, "moved")
    before = window.read()
    window.screen.do("mousemove", 150, 130, "click", 1)
    assert window.wait("pixel ") == "pixel 150,130 of 320 x 240"
    material = window.wait("meets").split()
    assert material[1] in ("sphere", "triangle") and "material" in material, material
    color = window.wait("the pixel's color").split("8 bits ")[1]
    place = 130 * 320 + 150
    if mode == "ray traced":
        seen = " ".join(str(plane[place]) for plane in reversed(planes_of(before)))
        assert color == seen, f"the pixel is {seen}, but {color} is explained"
    window.until(lambda shown: shown != before, "shows the explanation")
    window.drag(1, 1, 1)  # a click with a shaking hand
    assert window.wait("pixel ") == "pixel 160,120 of 320 x 240"
    window.press("F1", "help on")
    window.press("F1", "help off")
    window.until(lambda shown: shown == before, "hides the explanation")
    window.press("1", mode, "view 1,")


def u_turns_the_up_axis_of_a_mesh_without_a_scene(screen):
    window = opened(screen, ROOT / "scenes" / "cone.ply")
    first, shown = window.read(), set()
    for up in ("-x", "-y", "-z", "x", "y", "z"):
        window.press("u", f"BVH on, up {up}, help")
        shown.add(window.read())
    assert len(shown) == 6 and first in shown, "axes show the wrong pictures"
    window.close()
    window = opened(screen, SCENE)
    window.press("u")
    window.press("a", "AA 2x2, BVH on, help")


def keys_for_the_help_agree(window):
    plain, shown = window.read(), set()
    for key in ("h", "question", "F1"):
        window.press(key, "help on")
        shown.add(window.read())
        window.press(key, "help off")
    assert len(shown) == 1 and plain not in shown, "the help looks different"


def f11_fills_the_screen_and_escape_goes_back(screen, window):
    before = window.read()
    window.press("F11", "full screen", "1024x768")
    window.press("Escape", "BVH on, help", "320x240")
    window.press("F11", "full screen", "1024x768")
    window.press("F11", "BVH on, help", "320x240")
    window.until(lambda shown: shown == before, "is as before")


def c_prints_the_camera(window):
    window.press("c")
    assert window.process.stdout.readline() == "azimuth -40.00, rotation 25.00, distance 6.5\n"
    line = window.process.stdout.readline()
    assert line.startswith("camera 4.5127682"), line


def s_f12_and_ctrl_s_save_the_picture(screen, folder):
    window = opened(screen, SCENE, folder=folder)
    for number, key in enumerate(("s", "F12", "ctrl+s"), start=1):
        window.press(key, f"saved reflections-{number}.png and .exr")
    window.press("s")
    window.close()  # clrt completes the file first
    endings = {file.suffix for file in folder.glob("reflections-2.*")}
    assert endings == {".png", ".exr"}, endings


def a_failed_save_says_why(screen, folder):
    folder = folder / "gone"
    folder.mkdir()
    window = opened(screen, SCENE, folder=folder)
    folder.rmdir()
    window.press("s", "clrt: reflections-1.png: ")


def s_holds_a_turning_camera_still(window, folder):
    window.press("o")
    window.press("s", "saved reflections-1.")
    window.press("o", "moved")


def r_in_capitals_reads_everything_again(screen, folder):
    scene = folder / "one.scn"
    scene.write_text("material 0\nsphere 0 0 0.5 1\n")
    before = scene.stat()
    window = opened(screen, scene)
    large = window.read()
    # The file changes in place, with the same size and time. The window cannot detect this.
    scene.write_text("material 0\nsphere 0 0 0.5 2\n")
    os.utime(scene, ns=(before.st_atime_ns, before.st_mtime_ns))
    window.press("R")
    window.until(lambda shown: shown != large, "shows the scene read again")


def q_ctrl_q_and_escape_quit(screen):
    for key in ("q", "ctrl+q", "Escape"):
        window = opened(screen, SCENE)
        screen.do("key", key)
        window.end()


def keys_are_played_in_order_from_opengl_and_frames_counted(screen):
    window = Window(screen, SCENE, "--keys", "raB]q")
    for part in ("OpenGL, view 1", "ray traced, view 1, AA off", "AA 2x2", "boxes of leaves",
                 "boxes at level 1"):
        window.wait(part)
    window.end()


def stats_print_the_times_of_frames(screen):
    window = Window(screen, SCENE, "--keys", "ro" + 60 * " " + "q", "--stats")
    window.wait("moving frames: median")
    window.wait("traced while moving")
    window.end()


def held_letters_do_not_repeat(screen):
    """The X server repeats a held key after 0.7 s, 25 times a second."""
    window = Window(screen, SCENE, "--keys", "")
    window.wait("OpenGL, view 1")
    screen.do("keydown", "a")
    window.wait("AA 2x2")
    before = len(window.printed)
    time.sleep(1.5)
    screen.do("keyup", "a")
    window.press("n", "normals")
    assert not any("AA off" in line for line in window.printed[before:]), window.printed[before:]
    screen.do("keydown", "bracketright")
    window.wait("boxes at level 3")
    screen.do("keyup", "bracketright")
    window.close()


def options_set_the_windows_first_state(screen):
    window = Window(screen, SCENE, "--aa=3", "--tune=bvh=none", "--view", "4", "--exposure", "1", "--keys", "h")
    window.wait("view 4, AA 3x3, BVH off", "exposure +1.0", "320x240")
    window.wait("help on")


if __name__ == "__main__":
    run_tests(globals())
