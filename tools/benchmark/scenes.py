# SPDX-License-Identifier: MIT
"""The scenes that renderers are compared on, as text: those of tests/bench, the same with two of
the course's meshes where they are, and their variants."""

import pathlib

from benchmark import common

FOLDER = common.ROOT / "tests" / "bench"
OWN = ["creature", "figure", "coral"]

# The course's meshes, and a camera that frames each as tests/bench frames its own.
FROM_COURSE = {"cow": "2.0 -0.7 0.9  0.16 0.18 0.29  24", "buddha": "1.9 -1.1 1.0  -0.02 0 0.47  25"}

VARIANTS = ["mirrors", "shadows", "lights"]
SECOND_LIGHT = "light -7 2 8 0.4"


def with_absolute_paths(scene):
    """The scene's text, its meshes found from anywhere."""
    lines = []
    for line in scene.read_text().splitlines():
        words = line.split()
        if words and words[0] in ("ply_file", "mesh"):
            words[1] = str((scene.parent / words[1]).resolve())
            line = " ".join(words)
        lines.append(line)
    return "\n".join(lines) + "\n"


def with_mesh(text, mesh, camera):
    """The scene with another mesh in place of its last one, and another camera."""
    lines = text.splitlines()
    last = max(i for i, line in enumerate(lines) if line.startswith("ply_file"))
    lines[last] = f"ply_file {mesh}"
    return "\n".join(f"camera {camera}" if line.startswith("camera") else line
                     for line in lines) + "\n"


def variant_of(text, variant):
    """mirrors: as it is; shadows: nothing reflects; lights: a second light."""
    if variant == "shadows":
        return text.replace("reflectivity 0.25", "reflectivity 0")
    if variant == "lights":
        return text.replace("\nlight ", f"\n{SECOND_LIGHT}\nlight ", 1)
    return text


def texts(names):
    """Name and text of each scene asked for, or of all there are."""
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
