#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that the window reloads changed scenes, meshes and kernels, shows errors over the last
valid picture, and stores new kernels while it is open. Usage: CLRT=path/to/clrt test_reload.py"""

import os
import pathlib
import shutil
import unittest.mock

from screen import ROOT, expect, opened, run_tests


def make_scene(folder):
    shutil.copy(ROOT / "scenes" / "cone.ply", folder / "mesh.ply")
    scene = folder / "one.scn"
    scene.write_text("light 9 -4 10 0.7\nmaterial 1\nply_file mesh.ply\nsphere 0 0 0 1\n")
    return scene


def a_changed_scene_is_shown_in_both_views(screen, folder):
    scene = make_scene(folder)
    window = opened(screen, scene)
    expect(window, scene, "shows the first scene")
    scene.write_text(scene.read_text() + "sphere 1 1 1 0.5\n")
    expect(window, scene, "shows the second scene")
    window.press("r", "OpenGL")
    drawn = window.read()
    scene.write_text(scene.read_text() + "sphere -1 -1 1 0.5\n")
    window.until(lambda shown: shown != drawn, "shows the third scene by OpenGL")


def a_scene_that_an_editor_replaces_is_shown(screen, folder):
    scene = make_scene(folder)
    window = opened(screen, scene)
    other = folder / "other.scn"
    other.write_text(scene.read_text() + "sphere 1 1 1 0.5\n")
    other.rename(scene)
    expect(window, scene, "shows the scene put in its place")


def a_changed_mesh_is_shown(screen, folder):
    scene = make_scene(folder)
    window = opened(screen, scene)
    shutil.copy(ROOT / "scenes" / "tetrahedron.ply", folder / "mesh.ply")
    expect(window, scene, "shows the other mesh")


def a_changed_material_library_is_shown(screen, folder):
    if b"lacks Assimp" in (pathlib.Path(os.environ["CLRT"]).parent / "clrt-foreign").read_bytes():
        print("skipped: this build has no Assimp, so a model's materials are not tested")
        return
    (folder / "mesh.obj").write_text(
        "mtllib mesh.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 1\nusemtl a\nf 1 2 3\n"
    )
    (folder / "mesh.mtl").write_text("newmtl a\nKd 1 0 0\n")
    scene = folder / "one.scn"
    scene.write_text("light 9 -4 10 0.7\nsides two\nmesh mesh.obj\n")
    window = opened(screen, scene)
    expect(window, scene, "shows the first color")
    (folder / "mesh.mtl").write_text("newmtl a\nKd 0 0.5 1\n")
    expect(window, scene, "shows the second color")


def a_fault_is_reported_over_the_last_good_picture(screen, folder):
    scene = make_scene(folder)
    window = opened(screen, scene)
    before = window.read()
    text = scene.read_text()
    window.press("t", "text on")
    line = window.read()
    scene.write_text("spheer 0 0 0 1\n" + text)
    window.wait("one.scn:1:1: unknown statement (did you mean 'sphere'?)")
    told = window.until(lambda shown: shown != line, "reports the fault")
    below = 4 * 320 * 100
    assert told[below:] == before[below:], "the picture is gone"
    window.press("t", "text off")
    assert window.read() == before, "the last good picture is gone"
    window.drag(1, 20, 0)
    window.wait("moved")
    assert window.read() != before, "the camera does not move any more"
    window.press("1", "view 1,")
    scene.write_text(text + "sphere 1 1 1 0.5\n")
    expect(window, scene, "shows the repaired scene")


def a_mesh_that_was_missing_is_found_when_it_comes(screen, folder):
    scene = make_scene(folder)
    window = opened(screen, scene)
    window.press("t", "text on")
    line = window.read()
    scene.write_text(scene.read_text() + "ply_file late.ply\n")
    window.wait("late.ply: cannot be opened")
    window.until(lambda shown: shown != line, "reports a missing mesh")
    window.press("t", "text off")
    shutil.copy(ROOT / "scenes" / "tetrahedron.ply", folder / "late.ply")
    expect(window, scene, "shows the mesh that came late")


def changed_kernels_trace_the_next_picture(screen, folder):
    kernels = folder / "kernels"
    shutil.copytree(ROOT / "kernels", kernels)
    scene = make_scene(folder)
    os.environ["CLRT_KERNEL_DIR"] = str(kernels)
    try:
        window = opened(screen, scene, "--tune=kernel=pair")  # compiles fastest
        before = window.read()
        shade = kernels / "trace.cl"
        text = shade.read_text()
        window.press("t", "text on")
        line = window.read()
        shade.write_text(text + "this is no kernel\n")
        window.wait("clrt: the kernels")
        window.until(lambda shown: shown != line, "reports that the kernels do not compile")
        window.press("t", "text off")
        assert window.read() == before, "the last good picture is gone"
        dark = text.replace("clamp_to_one(color) *", "clamp_to_one(0.5f * color) *")
        assert dark != text
        shade.write_text(dark)
        window.until(lambda shown: sum(shown[1::4]) < 0.6 * sum(before[1::4]), "is darker")
        window.close()
    finally:
        del os.environ["CLRT_KERNEL_DIR"]


def new_kernels_are_stored_before_the_window_closes(screen, folder):
    with unittest.mock.patch.dict(os.environ, POCL_CACHE_DIR=str(folder)):
        window = opened(screen, ROOT / "scenes" / "ball.scn", "--tune=kernel=pair")  # compiles fastest
    window.until(lambda _: list(folder.glob("clrt/*.bin")), "stores its kernels")


if __name__ == "__main__":
    run_tests(globals())
