#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that the window shows a dropped file instead of its scene. Usage: CLRT=path/to/clrt
test_drop.py"""

import os
import subprocess

from drag import Drag
from screen import ROOT, expect, run_tests


def drop(screen, *paths):
    found = subprocess.run(["xdotool", "search", "--name", "clrt"], env=screen.environment(),
                           capture_output=True, text=True, check=True)
    drag = Drag(screen.name)
    drag.drop(int(found.stdout.split()[-1]), *paths)
    drag.close()


def a_dropped_scene_or_mesh_is_shown_through_its_first_camera(screen, window, folder):
    window.press("3", "view 3")
    window.drag(1, 20, 0)
    window.wait("moved")
    mesh = folder / "a cube's mesh.ply"
    mesh.write_bytes((ROOT / "scenes" / "cube.ply").read_bytes())
    drop(screen, mesh)
    expect(window, mesh, "shows the mesh")
    mesh.write_bytes((ROOT / "scenes" / "cone.ply").read_bytes())
    expect(window, mesh, "follows the mesh's file")
    drop(screen, ROOT / "scenes" / "simple.scn", mesh)
    expect(window, ROOT / "scenes" / "simple.scn", "shows the first of two files")


def a_dropped_file_that_is_no_scene_is_reported_over_the_last_picture(screen, window, folder):
    before = window.read()
    other = folder / "notes.scn"
    other.write_text("spheer 0 0 0 1\n")
    drop(screen, other)
    window.wait("notes.scn:1:1: unknown statement (did you mean 'sphere'?)")
    assert window.read() == before, "the last picture is gone"
    other.write_text("light 9 -4 10 0.7\nsphere 0 0 0 1\n")
    expect(window, other, "shows it once it is a scene")


if __name__ == "__main__":
    assert "CLRT" in os.environ
    run_tests(globals())
