# SPDX-License-Identifier: MIT
"""Writes scenes that resemble most pictures: a small mesh or a heap of balls on a large mirror floor
under much sky, the floor alone, and the sky alone. These scenes show the fixed cost of a ray."""

import pathlib
import random

from benchmark import shapes

SIZES = {"6k": 6000, "100k": 100_000, "1m": 1_000_000}  # triangles
FLOOR = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
-20 -20 0
20 -20 0
20 20 0
-20 20 0
3 0 1 2
3 0 2 3
"""
SCENE = """size 1024 1024
max_level 5
sides two
background 0.66 0.80 0.90
ambient 0.1
light 5 -4.5 9 0.9
define floor matte diffuse 0.9 0.85 0.75 kd 0.9 reflectivity 0.25
define body matte diffuse 0.58 0.65 0.76 kd 0.9 reflectivity 0.25
camera %s
material floor
ply_file floor.ply
"""
ON_FLOOR = "3.6 -3.0 2.0  0 0 0.3  36"
TO_SKY = "3.6 -3.0 2.0  7.2 -6.0 5.0  36"
BALLS = {"balls-10": 10, "balls-100": 100, "balls-1k": 1000, "balls-10k": 10_000}
NAMES = ["floor", "sky", *BALLS, *(f"{shape}-{size}" for size in SIZES for shape in shapes.SHAPES)]


def balls(count):
    """Yields the statements of random balls in a box on the floor. The more balls, the smaller."""
    chance = random.Random(count)
    largest = 0.6 * count ** (-1 / 3)
    for _ in range(count):
        radius = largest * chance.uniform(0.3, 1)
        x, y = chance.uniform(-0.8, 0.8), chance.uniform(-0.8, 0.8)
        yield f"sphere {x:.6f} {y:.6f} {chance.uniform(radius, 1.2):.6f} {radius:.6f}\n"


def write(folder, names):
    """Writes the named scenes, or all if there are no names. Returns their paths."""
    folder = pathlib.Path(folder)
    (folder / "floor.ply").write_text(FLOOR)
    paths = []
    for name in names or NAMES:
        text = SCENE % (TO_SKY if name == "sky" else ON_FLOOR)
        shape, _, size = name.partition("-")
        if name in BALLS:
            text += "material body\n" + "".join(balls(BALLS[name]))
        elif size:
            shapes.write(folder / f"{name}.ply", shape, SIZES[size])
            text += f"material body\nply_file {name}.ply\n"
        paths.append(folder / f"{name}.scn")
        paths[-1].write_text(text)
    return paths
