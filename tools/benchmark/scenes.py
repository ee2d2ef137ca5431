# SPDX-License-Identifier: MIT
"""The scenes for comparisons of renderers, as text: creature, figure and coral of tests/bench, the two
meshes of the course (docs/scenes.md) if they exist, and the variants of each."""

import pathlib

from benchmark import common

FOLDER = common.ROOT / "tests" / "bench"
OWN = ["creature", "figure", "coral"]

# The course's meshes, each with a camera like those of the scenes in tests/bench.
FROM_COURSE = {"cow": "2.0 -0.7 0.9  0.16 0.18 0.29  24", "buddha": "1.9 -1.1 1.0  -0.02 0 0.47  25"}

VARIANTS = ["mirrors", "shadows", "lights"]
SECOND_LIGHT = "light -7 2 8 0.4"


def with_absolute_paths(scene):
    """Returns the scene's text with absolute paths of meshes."""
    lines = []
    for line in scene.read_text().splitlines():
        words = line.split()
        if words and words[0] in ("ply_file", "mesh"):
            words[1] = str((scene.parent / words[1]).resolve())
            line = " ".join(words)
        lines.append(line)
    return "\n".join(lines) + "\n"


def with_mesh(text, mesh, camera):
    """Returns the scene with its last mesh and its camera replaced."""
    lines = text.splitlines()
    last = max(i for i, line in enumerate(lines) if line.startswith("ply_file"))
    lines[last] = f"ply_file {mesh}"
    return "\n".join(f"camera {camera}" if line.startswith("camera") else line
                     for line in lines) + "\n"


def variant_of(text, variant):
    """Returns a variant of the scene. mirrors: unchanged; shadows: without reflections; lights:
    with a second light."""
    if variant == "shadows":
        return text.replace("reflectivity 0.25", "reflectivity 0")
    if variant == "lights":
        return text.replace("\nlight ", f"\n{SECOND_LIGHT}\nlight ", 1)
    return text


def texts(names):
    """Returns {name: text} of the requested scenes, or of all available scenes."""
    if names:
        return {pathlib.Path(name).stem: with_absolute_paths(pathlib.Path(name).resolve())
                for name in names}
    found = {}
    for name in OWN:
        found[name] = with_absolute_paths(FOLDER / f"{name}.scn")
    for name, camera in FROM_COURSE.items():
        mesh = common.COURSE / f"{name}.ply"
        if mesh.exists():
            found[name] = with_mesh(found["creature"], mesh, camera)
        else:
            print(f"The course's {name} is missing and is skipped.")
    return found


def write(text, name, variant, folder):
    path = pathlib.Path(folder) / f"{name}-{variant}.scn"
    path.write_text(variant_of(text, variant))
    return path
