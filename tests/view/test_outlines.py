#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that OpenGL and rays show the same outlines in all views of scenes of the course and of
clrt. Each object gets its own color, and the two pictures may differ only within two pixels of an
edge. Both must also show the same lit sides of a coarse convex mesh with smooth normals, the same light of
large lights, the same colors of vertices, and the same checks. Usage: CLRT=path/to/clrt test_outlines.py"""

import pathlib
import tempfile

from screen import COURSE, ROOT, opened, run_tests

SIZE = (512, 512)
NAMES = ("silhouette", "matte", "blinn_phong", "reflections", "simple", "cow", "buddha")
OWN = ("simple", "reflections", "creature")
FARTHEST = 2  # the largest distance from an edge, in pixels
ALL_ONES = int.from_bytes(b"\1" * (SIZE[0] * SIZE[1]), "little")


def colored(path):
    """Returns the scene's text with a constant color for each object. Lights have no effect, and
    there are no mirrors."""
    lines, objects = ["background 0 0 0"], 0
    for line in path.read_text().splitlines():
        words = line.split()
        if not words or words[0] in ("material", "define", "background"):
            continue
        if words[0] in ("sphere", "ply_file", "mesh"):
            objects += 1
            red = (objects * 37 % 251 + 4) / 255
            lines.append(f"define own{objects} silhouette diffuse {red:.9f} 0 0")
            lines.append(f"material own{objects}")
        if words[0] in ("ply_file", "mesh"):
            words[1] = str((path.parent / words[1]).resolve())
        lines.append(" ".join(words))
    return "\n".join(lines) + "\n"


def flags(number):
    """Returns the number with each nonzero byte replaced by 1."""
    content = number.to_bytes(SIZE[0] * SIZE[1], "little")
    return int.from_bytes(content.translate(b"\0" + b"\1" * 255), "little")


def moved(number, right, down):
    """Returns the picture shifted by these numbers of pixels. The pixels that enter at the sides do
    not matter."""
    places = 8 * (right + down * SIZE[0])
    return (number << places if places >= 0 else number >> -places) & ALL_ONES


def edges_of(labels):
    """Returns a flag for each pixel: whether its right or lower neighbor belongs to another object."""
    return flags(labels ^ (labels >> 8)) | flags(labels ^ (labels >> 8 * SIZE[0]))


def near(edges):
    grown = 0
    for right in range(-FARTHEST, FARTHEST + 1):
        for down in range(-FARTHEST, FARTHEST + 1):
            grown |= moved(edges, right, down)
    return grown


def compare(name, view, drawn, traced):
    """Returns how many pixels differ. Fails if a differing pixel is far from an edge."""
    drawn, traced = (int.from_bytes(shown[2::4], "little") for shown in (drawn, traced))
    assert traced != 0 or view == "4", f"{name}, view {view}: nothing is seen"
    apart = flags(drawn ^ traced)
    far = apart & ~near(edges_of(traced))
    assert far == 0, f"{name}, view {view}: {far.bit_count()} pixels far from any edge differ"
    return apart.bit_count()


def both_pictures(screen, scene):
    """Returns the traced picture and the OpenGL picture of the scene."""
    window = opened(screen, scene, size=SIZE)
    traced = window.read()
    window.press("r", "OpenGL")
    drawn = window.read()
    window.close()
    return traced, drawn


def count_views(text):
    return text.count("\ncamera ") or 6


def agree(screen, path):
    text = colored(path)
    apart = []
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / path.name
        scene.write_text(text)
        window = opened(screen, scene, size=SIZE)
        for view in "123456"[:count_views(text)]:
            if view != "1":
                window.press(view, "ray traced", f"view {view},")
            traced = window.read()
            window.press("r", "OpenGL")
            drawn = window.read()
            window.press("r", "ray traced")
            apart.append(compare(path.stem, view, drawn, traced))
        window.close()
    print(f"         {path.stem}: {apart} of {SIZE[0] * SIZE[1]} pixels differ, all at edges")


def outlines_agree_in_the_courses_scenes(screen):
    if not COURSE.is_dir():
        print("skipped: the course's scenes are missing (CLRT_COURSE names their folder)")
        return
    # Scenes that differ only in their materials are compared once.
    scenes = [COURSE / "scenes" / f"{name}.scn" for name in NAMES]
    for path in {colored(path): path for path in scenes}.values():
        agree(screen, path)


def outlines_agree_in_own_scenes(screen):
    for name in OWN:
        path = ROOT / "scenes" / f"{name}.scn"
        if name == "creature" and not (ROOT / "scenes" / "models" / "creature.ply").exists():
            print("skipped: scenes/models/creature.ply has not been made")
            continue
        agree(screen, path)


def light_falls_on_the_same_side_of_a_convex_mesh(screen, folder):
    """The light or sun is so bright that every lit pixel is white."""
    scene = folder / "ball.scn"
    for light in "light", "sun":
        scene.write_text(f"background 0 0 0\nambient 0\nmaterial 1\n{light} -3 1 -2 1e6\n"
                         f"ply_file {ROOT}/tests/image/ball.ply\ncamera 0.4 -2.1 0.6 0 0 0 60\n")
        traced, drawn = both_pictures(screen, scene)
        apart = compare(f"ball, {light}", "1", drawn, traced)
        print(f"         {light}: {apart} of {SIZE[0] * SIZE[1]} pixels differ, all at edges")


def expect_similar(traced, drawn, most):
    """Expects that fewer than 300 pixels, such as those at edges, differ by more than `most` of 255."""
    apart = [sum(abs(a - b) > most for a, b in zip(traced[channel::4], drawn[channel::4]))
             for channel in range(3)]
    print(f"         {apart} of {SIZE[0] * SIZE[1]} pixels differ by more than {most} of 255")
    assert max(apart) < 300, apart


def all_points_of_large_lights_shine(screen, folder):
    """OpenGL joins the 257 lights. The red one comes last. A joined light is between its lights, which
    changes some pixels by 3 or 4 of 255."""
    scene = folder / "area.scn"
    scene.write_text("background 0 0 0\nambient 0.1\nmaterial 1\nlight -3 -4 2 0.6 area 0.2 0 0 0 0 0.2 16\n"
                     "light 5 -4 1 0.4 1 0 0\nsphere 0 0 0 1\ncamera 0 -5 0 0 0 0 30\n")
    traced, drawn = both_pictures(screen, scene)
    expect_similar(traced, drawn, 4)


def colors_of_vertices_agree(screen, folder):
    """A ball has colors of vertices, and a cube has the color of its material."""
    scene = folder / "painted.scn"
    scene.write_text("background 0 0 0\ndefine paper silhouette diffuse 0 1 0.5\nmaterial own paper\n"
                     f"mesh {ROOT}/tests/image/painted.ply\nmesh {ROOT}/scenes/cube.ply translate 2.5 0 0\n"
                     "camera 1.2 -6 2 1.2 0 0.3 50\n")
    traced, drawn = both_pictures(screen, scene)
    expect_similar(traced, drawn, 2)
    assert len(set(traced[2::4])) > 100, "the ball has few colors"


def checks_agree(screen, folder):
    """The floor lies between two layers of cubes. Only edges of checks and objects may differ."""
    scene = folder / "checks.scn"
    scene.write_text("background 0 0 0\ndefine floor silhouette checker 0.5 0.2 0 0 0.8 0 0\n"
                     "define ball silhouette checker 0.3 0.4 0 0 1 0 0\nmaterial floor\n"
                     f"mesh {ROOT}/scenes/square.ply scale 2 translate 7 8 3\nmaterial ball\n"
                     f"sphere 6.3 8 3.6 0.6\nmesh {ROOT}/scenes/box.ply scale 0.9 translate 7.2 7.5 3\n"
                     "camera 6 2 6 7 7.8 3.2 40\n")
    traced, drawn = both_pictures(screen, scene)
    apart = compare("checks", "1", drawn, traced)
    print(f"         checks: {apart} of {SIZE[0] * SIZE[1]} pixels differ, all at edges")
    assert len(set(traced[2::4])) > 4, "the objects have no checks"


if __name__ == "__main__":
    run_tests(globals())
