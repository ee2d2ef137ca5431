# SPDX-License-Identifier: MIT
"""Writes a scene file and its meshes, for tests of --error on unseen scenes. A scene depends only
on a seed and its number, so any scene can be regenerated alone."""

import array
import math
import pathlib
import random
import struct
import sys

# Only one scene in DENSE_EVERY has the dense mesh, because writing its million triangles takes
# seconds.
DENSE_EVERY = 20


def write_ply(path, vertices, triangles):
    """Writes a binary PLY file from flat lists of positions and corner indices."""
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices) // 3}\n"
              "property float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles) // 3}\n"
              "property list uchar int vertex_indices\nend_header\n")
    faces = bytearray()
    pack = struct.Struct("<Biii").pack
    for first in range(0, len(triangles), 3):
        faces += pack(3, *triangles[first:first + 3])
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(array.array("f", vertices).tobytes())
        file.write(faces)


def grid_triangles(columns, rows):
    """Returns two triangles for every cell of a grid of columns x rows vertices, numbered row by
    row."""
    triangles = []
    for row in range(rows - 1):
        for column in range(columns - 1):
            a = row * columns + column
            triangles += [a, a + 1, a + columns + 1, a, a + columns + 1, a + columns]
    return triangles


def add_quad(vertices, triangles, corners):
    """Adds two triangles with four vertices of their own."""
    first = len(vertices) // 3
    for corner in corners:
        vertices += corner
    triangles += [first, first + 1, first + 2, first, first + 2, first + 3]


def bumpy_ball(rng, path, triangle_count):
    """Writes a wavy ball of radius about 1. More triangles allow shorter waves."""
    rows = max(4, round(math.sqrt(triangle_count / 4)))
    columns = 2 * rows
    waves = [(p, rng.randint(1, 1 + rows // 8), rng.uniform(0, 7), rng.uniform(0.1, 0.4) / (3 + p))
             for p in (rng.randint(1, 1 + rows // 8) for _ in range(6))]
    vertices = []
    for row in range(rows):
        latitude = math.pi * row / (rows - 1)
        for column in range(columns):
            longitude = 2 * math.pi * column / (columns - 1)
            ring = math.sin(latitude)
            radius = 1 + ring * sum(
                size * math.sin(p * latitude + phase) * math.cos(q * longitude)
                for p, q, phase, size in waves)
            vertices += [radius * ring * math.cos(longitude), radius * ring * math.sin(longitude),
                         radius * math.cos(latitude)]
    write_ply(path, vertices, grid_triangles(columns, rows))


def terrain(rng, path, side, height):
    """Writes a square of 8 x 8 units whose height is a sum of waves."""
    waves = [(rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(0, 7), rng.uniform(0.1, 1))
             for _ in range(8)]
    vertices = []
    for row in range(side):
        for column in range(side):
            x, y = 8 * column / (side - 1) - 4, 8 * row / (side - 1) - 4
            z = sum(size * math.sin(p * x + q * y + phase) for p, q, phase, size in waves)
            vertices += [x, y, height * z / 8]
    write_ply(path, vertices, grid_triangles(side, side))


def boxes(rng, path, count, size):
    """Writes boxes of random sizes at random places near the origin. They may overlap."""
    vertices, triangles = [], []
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    for _ in range(count):
        first = len(vertices) // 3
        middle = [rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(0, 2.5)]
        half = [size * rng.uniform(0.1, 1) for _ in range(3)]
        for corner in range(8):
            vertices += [middle[axis] + (half[axis] if corner >> axis & 1 else -half[axis])
                         for axis in range(3)]
        for a, b, c, d in faces:
            triangles += [first + i for i in (a, b, c, a, c, d)]
    write_ply(path, vertices, triangles)


def strips(path, count, width, length, step):
    """Writes thin, parallel, upright strips along x."""
    vertices, triangles = [], []
    for i in range(count):
        y = (i - count / 2) * step
        add_quad(vertices, triangles, [(-length, y, 0.3), (length, y, 0.3), (length, y, 0.3 + width),
                                       (-length, y, 0.3 + width)])
    write_ply(path, vertices, triangles)


def tiles(path, side, parity):
    """Writes every other square of a checkered floor of 60 x 60 units."""
    size = 60 / side
    vertices, triangles = [], []
    for row in range(side):
        for column in range(row % 2 ^ parity, side, 2):
            x, y = column * size - 30, row * size - 30
            add_quad(vertices, triangles, [(x, y, 0), (x + size, y, 0), (x + size, y + size, 0),
                                           (x, y + size, 0)])
    write_ply(path, vertices, triangles)


class Scene:
    """The statements of a scene file, and the folder for its meshes."""

    def __init__(self, rng, folder, name):
        self.rng, self.folder, self.name = rng, folder, name
        self.lines, self.meshes = [], 0

    def say(self, *words):
        self.lines.append(" ".join(f"{word:.6g}" if isinstance(word, float) else str(word)
                                   for word in words))

    def color(self, low=0.0, high=1.0):
        return [self.rng.uniform(low, high) for _ in range(3)]

    def mesh_path(self):
        self.meshes += 1
        return self.folder / f"{self.name}-{self.meshes}.ply"

    def mesh(self, path, *words):
        self.say("sides two")
        self.say("mesh", path.name, *words)

    def material(self, name, kind="matte", reflectivity=0.0, shininess=None):
        words = ["define", name, kind, "diffuse", *self.color(0.1), "kd",
                 self.rng.uniform(0.5, 1.0)]
        if kind == "blinn_phong":
            words += ["ks", self.rng.uniform(0.3, 1.0), "shininess", shininess or
                      round(self.rng.uniform(5, 300))]
        if reflectivity:
            words += ["reflectivity", reflectivity]
        self.say(*words)

    def any_material(self, name):
        kind = self.rng.choice(["matte", "blinn_phong"])
        self.material(name, kind, self.rng.choice([0.0, 0.0, 0.25, self.rng.uniform(0.1, 0.9)]))
        self.say("material", name)

    def lights(self, count):
        for _ in range(count):
            self.say("light", self.rng.uniform(-12, 12), self.rng.uniform(-12, 12),
                     self.rng.uniform(3, 15), self.rng.uniform(0.5, 1.4) / count)

    def spheres(self, count, across, heights, radii):
        for _ in range(count):
            self.say("sphere", *(self.rng.uniform(-across, across) for _ in range(2)),
                     self.rng.uniform(*heights), self.rng.uniform(*radii))

    def camera(self, near, far, aim=0.5):
        angle, tilt = self.rng.uniform(0, 2 * math.pi), self.rng.uniform(0.1, 1.2)
        distance = self.rng.uniform(near, far)
        self.say("camera", distance * math.cos(angle) * math.cos(tilt),
                 distance * math.sin(angle) * math.cos(tilt), distance * math.sin(tilt),
                 self.rng.uniform(-0.3, 0.3), self.rng.uniform(-0.3, 0.3), aim,
                 self.rng.uniform(30, 60))

    def floor(self):
        path = self.mesh_path()
        write_ply(path, [-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0], [0, 1, 2, 0, 2, 3])
        self.mesh(path)


def draw_spheres(scene, rng):
    scene.lights(rng.randint(1, 3))
    for number in range(rng.randint(1, 4)):
        scene.any_material(f"stuff{number}")
        scene.spheres(rng.randint(2, 40), 2.5, (0, 2.5), (0.05, 0.6))


def draw_dust(scene, rng):
    scene.lights(rng.randint(1, 2))
    scene.any_material("dust")
    for _ in range(rng.randint(100, 1000)):
        scene.say("sphere", *(rng.gauss(0, 1.2) for _ in range(2)), rng.gauss(1.2, 0.6),
                  rng.uniform(0.003, 0.03))


def draw_ball(scene, rng, triangles=None):
    scene.lights(rng.randint(1, 3))
    scene.any_material("skin")
    path = scene.mesh_path()
    bumpy_ball(rng, path, triangles or round(10 ** rng.uniform(2.5, 5.2)))
    scene.mesh(path, "translate", 0, 0, 1.1)


def draw_dense(scene, rng):
    draw_ball(scene, rng, 1_000_000)


def draw_terrain(scene, rng):
    scene.lights(rng.randint(1, 3))
    scene.any_material("ground")
    path = scene.mesh_path()
    terrain(rng, path, rng.randint(20, 250), rng.uniform(0.5, 3))
    scene.mesh(path)
    scene.any_material("balls")
    scene.spheres(rng.randint(0, 12), 3, (0.5, 2), (0.1, 0.5))


def draw_boxes(scene, rng):
    scene.lights(rng.randint(1, 4))
    for number in range(rng.randint(1, 3)):
        scene.any_material(f"stuff{number}")
        path = scene.mesh_path()
        boxes(rng, path, rng.randint(5, 400), rng.uniform(0.02, 0.4))
        scene.mesh(path)


def draw_strips(scene, rng):
    scene.lights(rng.randint(1, 3))
    scene.any_material("strips")
    path = scene.mesh_path()
    count = rng.randint(20, 120)
    strips(path, count, rng.uniform(0.005, 0.15), 4, rng.uniform(3, 7) / count)
    scene.mesh(path)
    scene.material("mirror", "matte", rng.uniform(0.2, 0.9))
    scene.say("material", "mirror")
    scene.floor()


def draw_tiles(scene, rng):
    scene.lights(rng.randint(1, 2))
    side = rng.randint(30, 180)
    for parity, name in enumerate(["white", "black"]):
        shade = [0.9 - 0.85 * parity] * 3
        scene.say("define", name, "matte", "diffuse", *shade, "kd", 0.9, "reflectivity",
                  rng.choice([0.0, 0.0, 0.3]))
        scene.say("material", name)
        path = scene.mesh_path()
        tiles(path, side, parity)
        scene.mesh(path)
    scene.any_material("balls")
    scene.spheres(rng.randint(0, 6), 3, (0.3, 1.5), (0.2, 0.8))


def draw_mirrors(scene, rng):
    scene.lights(rng.randint(1, 3))
    scene.material("mirror", "blinn_phong", rng.uniform(0.3, 0.9),
                   round(10 ** rng.uniform(2, 3.7)))
    scene.say("material", "mirror")
    side = rng.randint(4, 14)
    for row in range(side):
        for column in range(side):
            scene.say("sphere", 6 * (column + 0.5) / side - 3, 6 * (row + 0.5) / side - 3,
                      3 / side, rng.uniform(0.6, 1) * 3 / side)
    scene.any_material("ground")
    scene.floor()
    scene.say("max_level", rng.randint(2, 6))


def draw_lamps(scene, rng):
    scene.lights(rng.randint(8, 32))
    scene.any_material("stuff")
    path = scene.mesh_path()
    boxes(rng, path, rng.randint(10, 100), rng.uniform(0.1, 0.4))
    scene.mesh(path)


# The kinds of scenes. Each has the function that draws its objects, whether a floor is added, and
# the arguments of Scene.camera.
KINDS = [(draw_spheres, True, (5, 9)), (draw_tiles, False, (4, 8, 0.8)), (draw_ball, True, (3.5, 8, 0.9)),
         (draw_strips, False, (4, 9)), (draw_mirrors, False, (5, 9)), (draw_boxes, True, (5, 10)),
         (draw_lamps, True, (5, 10)), (draw_dust, True, (5, 9)), (draw_terrain, False, (5, 9))]
DENSE = draw_dense, True, (3.5, 8, 0.9)


def generate(seed, number, folder):
    """Writes scene `number` of the seed into the folder. Returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = random.Random(f"{seed}/{number}")
    is_dense = number % DENSE_EVERY == DENSE_EVERY - 1
    kind, has_floor, view = DENSE if is_dense else KINDS[number % len(KINDS)]
    scene = Scene(rng, folder, f"{number:03}-{kind.__name__[len('draw_'):]}")
    scene.say("background", *scene.color())
    scene.say("ambient", rng.uniform(0.0, 0.2))
    kind(scene, rng)
    if has_floor:
        scene.any_material("ground")
        scene.floor()
    scene.camera(*view)
    path = folder / f"{scene.name}.scn"
    path.write_text("\n".join(scene.lines) + "\n")
    return path


if __name__ == "__main__":
    for index in range(int(sys.argv[2])):
        print(generate(sys.argv[1], index, pathlib.Path(sys.argv[3])))
