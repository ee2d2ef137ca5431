#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that every key and mouse movement has the effect that the help describes, in the picture or
in the printed state. Usage: CLRT=path/to/clrt test_keys.py"""

import os
import pathlib
import subprocess
import tempfile

from screen import ROOT, Screen, Window, count_pixels, is_blue, is_red, run_tests

SCENE = ROOT / "scenes" / "reflections.scn"


def opened(screen, *options, **more):
    """Returns a window without text over its picture."""
    window = Window(screen, SCENE, *options, **more)
    window.wait("OpenGL, view 1")
    window.press("t", "text off")
    return window


def r_switches_between_opengl_and_rays(screen):
    window = opened(screen)
    drawn = window.read()
    window.press("r", "ray traced, view 1")
    traced = window.read()
    assert traced != drawn, "both views look the same"
    window.press("r", "OpenGL, view 1")
    window.until(lambda shown: shown == drawn, "shows the OpenGL view again")
    window.close()


def a_smooths_the_edges_of_both_views(screen):
    window = opened(screen)
    for view in ("OpenGL", "ray traced"):
        rough = window.read()
        window.press("a", view, "AA 2x2")
        smooth = window.read()
        apart = sum(one != other for one, other in zip(*map(lambda shown: shown[1::4],
                                                            (rough, smooth))))
        assert 200 < apart < 20000, f"{apart} pixels of the {view} view changed"
        window.press("a", view, "AA off")
        window.until(lambda shown: shown == rough, "goes back")
        window.press("r")
        window.wait("AA off")
    window.close()


def digits_choose_the_scenes_cameras(screen):
    window = opened(screen)
    for mode in ("OpenGL", "ray traced"):
        shown = set()
        for view in "234561":
            window.press(view, mode, f"view {view},")
            shown.add(window.read())
        assert len(shown) == 6, f"{len(shown)} different pictures of six cameras"
        window.press("r")
        window.wait("view 1")
    window.close()


def b_turns_the_tree_off_and_draws_the_same_picture(screen):
    window = opened(screen)
    window.press("r", "ray traced", "BVH on")
    before = window.read()
    window.press("b", "BVH off")
    assert window.read() == before, "brute force draws another picture"
    window.press("b", "BVH on")
    window.close()


def boxes_are_blue_at_the_leaves_and_red_above(screen):
    window = opened(screen)
    for mode in ("OpenGL", "ray traced"):
        plain = window.read()
        window.press("B", mode, "boxes of leaves: ")
        shown = window.read()
        assert count_pixels(shown, is_blue) > 200 and count_pixels(shown, is_red) == 0, "leaves"
        window.press("bracketright", "boxes at level 1: 1")
        root = window.read()
        assert count_pixels(root, is_red) > 200 and count_pixels(root, is_blue) == 0, "root"
        window.press("bracketright", "boxes at level 2: 2")
        assert window.read() != root, "level 2 looks like level 1"
        window.press("bracketleft", "boxes at level 1: 1")
        assert window.read() == root, "level 1 looks different the second time"
        window.press("B", mode, "BVH on, help")
        assert window.read() == plain, "boxes stay"
        window.press("r")
        window.wait("BVH on, help")
    window.close()


def n_shows_normals_in_red(screen):
    window = opened(screen)
    for mode in ("OpenGL", "ray traced"):
        assert count_pixels(window.read(), is_red) == 0
        window.press("n", mode, "normals")
        assert count_pixels(window.read(), is_red) > 50, "no red lines"
        window.press("n", mode, "BVH on, help")
        window.press("r")
        window.wait("BVH on, help")
    window.close()


def plus_and_minus_change_the_exposure(screen):
    window = opened(screen)
    for mode in ("OpenGL", "ray traced"):
        plain = sum(window.read()[1::4])
        window.press("minus", mode, "exposure -0.5")
        assert sum(window.read()[1::4]) < plain, "it is not darker"
        window.press("plus", mode, "BVH on, help")
        window.press("plus", mode, "exposure +0.5")
        assert sum(window.read()[1::4]) > plain, "it is not brighter"
        window.press("minus", "BVH on, help")
        assert sum(window.read()[1::4]) == plain, "it is not as before"
        window.press("r")
        window.wait("BVH on, help")
    window.close()


def h_and_t_show_and_hide_text(screen):
    window = Window(screen, SCENE)
    window.wait("help off, text on")
    line = window.read()
    window.press("h", "help on")
    help_text = window.read()
    window.press("h", "help off")
    window.press("t", "text off")
    plain = window.read()
    assert len({line, help_text, plain}) == 3, "texts look alike"
    lower = 4 * 320 * 120
    assert line[lower:] == plain[lower:], "the line covers more than the top"
    assert help_text[lower:] != plain[lower:], "the help is only a line"
    window.close()


def o_turns_the_camera_by_itself(screen):
    window = opened(screen)
    for mode in ("OpenGL", "ray traced"):
        before = window.read()
        window.press("o")
        first = window.until(lambda shown: shown != before, "turns")
        window.until(lambda shown: shown not in (before, first), "turns on")
        window.press("o", mode, "view 1 moved")
        window.press("r")
        window.wait("view 1 moved")
    window.close()


def the_mouse_turns_and_zooms(screen):
    window = opened(screen)
    for mode in ("OpenGL", "ray traced"):
        window.drag(1, 40, -20)
        window.wait(mode, "moved", "azimuth -35.00, rotation 15.00, distance 6.5")
        turned = window.read()
        window.drag(3, 0, 10)
        window.wait(mode, "azimuth -35.00, rotation 15.00, distance 8")
        assert window.read() != turned, "zooming shows nothing"
        screen.do("click", 4)
        window.wait(mode, "distance 7.2")
        window.press("Left", mode, "rotation 20.00")
        window.press("Up", mode, "azimuth -30.00")
        window.press("1", mode, "view 1,")
        window.press("r")
        window.wait("view 1,")
    window.close()


def the_middle_button_or_shift_moves_sideways(screen):
    window = opened(screen)
    place = ("moved", "azimuth -40.00, rotation 25.00, distance 6.5")
    for mode in ("OpenGL", "ray traced"):
        before = window.read()
        window.drag(2, 40, 10)
        window.wait(mode, *place)
        aside = window.read()
        assert aside != before, "nothing has moved"
        window.press("1", mode, "view 1,")
        screen.do("keydown", "shift")
        window.drag(1, 40, 10)
        screen.do("keyup", "shift")
        window.wait(mode, *place)
        assert window.read() == aside, "Shift does something else"
        window.press("1", mode, "view 1,")
        window.press("r")
        window.wait("view 1,")
    window.close()


def c_prints_the_camera(screen):
    window = opened(screen)
    window.press("c")
    assert window.process.stdout.readline() == "azimuth -40.00, rotation 25.00, distance 6.5\n"
    line = window.process.stdout.readline()
    assert line.startswith("camera 4.5127682"), line
    window.close()


def s_saves_the_picture(screen):
    with tempfile.TemporaryDirectory() as folder:
        window = opened(screen, folder=folder)
        window.press("s", "saved reflections-1.")
        window.press("s", "saved reflections-2.")
        window.close()
        endings = {file.suffix for file in pathlib.Path(folder).glob("reflections-2.*")}
    assert endings in ({".png", ".exr"}, {".png", ".pfm"}, {".pfm"}), endings


def s_holds_a_turning_camera_still(screen):
    with tempfile.TemporaryDirectory() as folder:
        window = opened(screen, folder=folder)
        window.press("r", "ray traced")
        window.press("o")
        window.press("s", "saved reflections-1.")
        window.press("o", "moved")
        window.close()


def r_in_capitals_reads_everything_again(screen):
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "one.scn"
        scene.write_text("material 0\nsphere 0 0 0.5 1\n")
        before = scene.stat()
        window = Window(screen, scene)
        window.wait("OpenGL")
        window.press("t", "text off")
        large = window.read()
        # Changes the file invisibly: in place, with the same size and time.
        scene.write_text("material 0\nsphere 0 0 0.5 2\n")
        os.utime(scene, ns=(before.st_atime_ns, before.st_mtime_ns))
        window.press("R")
        window.until(lambda shown: shown != large, "shows the scene read again")
        window.close()


def q_and_escape_quit(screen):
    for key in ("q", "Escape"):
        window = opened(screen)
        screen.do("key", key)
        window.end()


def keys_are_played_in_order_and_frames_counted(screen):
    window = Window(screen, SCENE, "--keys", "raB]", "--quit-after", "3")
    for part in ("OpenGL, view 1", "ray traced, view 1, AA off", "AA 2x2", "boxes of leaves",
                 "boxes at level 1"):
        window.wait(part)
    window.end()


def stats_tell_the_times_of_frames(screen):
    window = Window(screen, SCENE, "--keys", "ro", "--quit-after", "30", "--stats")
    window.wait("29 moving frames: median")
    window.wait("traced while moving")
    window.end()


def options_choose_what_the_window_opens_with(screen):
    window = Window(screen, SCENE, "--aa=3", "--no-bvh", "--view", "4", "--bvh", "midpoint", "--exposure", "1",
                    "--keys", "h")
    window.wait("view 4, AA 3x3, BVH off", "exposure +1.0", "320x240")
    window.wait("help on")
    window.close()


def without_a_display_it_says_so(screen):
    words = [os.environ["CLRT"], str(SCENE)]
    done = subprocess.run(words, env={**screen.environment(), "DISPLAY": ":12345"}, text=True,
                          capture_output=True, check=False)
    assert done.returncode == 2, done.returncode
    assert done.stderr.startswith("clrt: no window can be opened ("), done.stderr
    assert done.stderr.endswith("): write the picture with -o FILE\n"), done.stderr


if __name__ == "__main__":
    run_tests([r_switches_between_opengl_and_rays, a_smooths_the_edges_of_both_views,
               digits_choose_the_scenes_cameras, b_turns_the_tree_off_and_draws_the_same_picture,
               boxes_are_blue_at_the_leaves_and_red_above, n_shows_normals_in_red,
               plus_and_minus_change_the_exposure, h_and_t_show_and_hide_text,
               o_turns_the_camera_by_itself, the_mouse_turns_and_zooms,
               the_middle_button_or_shift_moves_sideways, c_prints_the_camera, s_saves_the_picture,
               s_holds_a_turning_camera_still, r_in_capitals_reads_everything_again, q_and_escape_quit,
               keys_are_played_in_order_and_frames_counted, stats_tell_the_times_of_frames,
               options_choose_what_the_window_opens_with, without_a_display_it_says_so],
              Screen())
