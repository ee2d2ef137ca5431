# SPDX-License-Identifier: MIT
"""Writes scene files of small parts that no pixel's center shows, for tests of --error. A scene
depends only on a seed, its number and the size of the pictures. In every third scene, the parts are
behind the eye, and only a mirror shows them."""

import math
import random

from generate import Scene, add_quad, write_ply


def dot(one, other):
    return sum(a * b for a, b in zip(one, other))


def unit(vector):
    length = math.sqrt(dot(vector, vector))
    return [value / length for value in vector]


class View:
    """A camera at a random place, and points given by pixel coordinates and depths."""

    def __init__(self, rng, size):
        self.size, self.fov = size, rng.uniform(20, 70)
        self.eye = [rng.uniform(-3, 3) for _ in range(3)]
        azimuth, height = rng.uniform(0, 2 * math.pi), rng.uniform(-1, 1)
        self.forward = unit([math.cos(azimuth), math.sin(azimuth), height])
        self.right = unit([self.forward[1], -self.forward[0], 0])
        self.down = [self.right[2] * self.forward[1] - self.right[1] * self.forward[2],
                     self.right[0] * self.forward[2] - self.right[2] * self.forward[0],
                     self.right[1] * self.forward[0] - self.right[0] * self.forward[1]]
        self.pixel = 2 * math.tan(math.radians(self.fov) / 2) / size[1]  # a pixel's side at depth 1

    def point(self, x, y, depth):
        across, along = ((place - side / 2) * self.pixel for place, side in zip((x, y), self.size))
        return [eye + depth * (forward + across * right + along * down)
                for eye, forward, right, down in zip(self.eye, self.forward, self.right, self.down)]

    def statement(self):
        target = [eye + forward for eye, forward in zip(self.eye, self.forward)]
        return ["camera", *self.eye, *target, self.fov]


def add_mirror(scene, rng, view):
    """Adds a mirror that fills the view, at a depth of 1. Returns a function that reflects a point in
    the mirror. Points deeper than about 2 move behind the eye."""
    point = view.point(view.size[0] / 2, view.size[1] / 2, 1)
    normal = unit([forward + rng.uniform(-0.05, 0.05) for forward in view.forward])

    def on_mirror(x, y):
        ray = [a - b for a, b in zip(view.point(x, y, 1), view.eye)]
        depth = (dot(point, normal) - dot(view.eye, normal)) / dot(ray, normal)
        return view.point(x, y, depth)

    def reflected(place):
        distance = dot(place, normal) - dot(point, normal)
        return [a - 2 * distance * b for a, b in zip(place, normal)]

    width, height = view.size
    path, vertices, triangles = scene.mesh_path(), [], []
    add_quad(vertices, triangles, [on_mirror(-width, -height), on_mirror(2 * width, -height),
                                   on_mirror(2 * width, 2 * height), on_mirror(-width, 2 * height)])
    write_ply(path, vertices, triangles)
    scene.say("define mirror matte diffuse 0 0 0 reflectivity", rng.uniform(0.3, 0.9))
    scene.say("material mirror")
    scene.mesh(path)
    return reflected


def off_center(rng, width):
    """Returns the coordinate of a part of this width between two pixel centers, whose coordinates
    are -0.5 and 0.5."""
    return rng.uniform(-1, 1) * (0.49 - width / 2)


def draw_dots(scene, rng, view, place):
    """Adds spheres around corners of pixels."""
    least, most = sorted(rng.uniform(0.1, 0.9) for _ in range(2))
    for _ in range(round(10 ** rng.uniform(0.7, 2.6))):
        width, depth = rng.uniform(least, most), 10 ** rng.uniform(0.5, 1.5)
        x, y = (rng.randrange(1, side) + off_center(rng, width) for side in view.size)
        scene.say("sphere", *place(view.point(x, y, depth)), depth * view.pixel * width / 2)


def draw_lines(scene, rng, view, place):
    """Adds thin quadrilaterals and triangles between two rows or two columns of pixels."""
    vertices, triangles = [], []
    longest = 10 ** rng.uniform(0, 2)
    for _ in range(round(10 ** rng.uniform(0.7, 2) * 10 / (3 + longest))):
        width, length = rng.uniform(0.05, 0.9), longest * rng.uniform(0.2, 1)
        depth, axis = 10 ** rng.uniform(0.5, 1.5), rng.randrange(2)
        along = rng.uniform(0, view.size[1 - axis])
        across = rng.randrange(1, view.size[axis]) + off_center(rng, width)
        end = width / 2 if rng.random() < 0.5 else 0  # 0: a triangle
        corners = [(across - width / 2, along), (across + width / 2, along),
                   (across + end, along + length), (across - end, along + length)]
        add_quad(vertices, triangles,
                 [place(view.point(*(corner if axis == 0 else corner[::-1]), depth))
                  for corner in corners])
    path = scene.mesh_path()
    write_ply(path, vertices, triangles)
    scene.mesh(path)


def generate(seed, number, folder, size):
    """Writes scene `number` of the seed, for pictures of this size, into the folder. Returns its
    path."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = random.Random(f"hidden/{seed}/{number}")
    kind = [draw_dots, draw_lines][number % 2]
    is_mirrored = number % 3 == 2
    name = f"{number:03}-{'mirrored_' * is_mirrored}{kind.__name__[len('draw_'):]}"
    scene, view = Scene(rng, folder, name), View(rng, size)
    shade = rng.choice([0, 0, rng.uniform(0, 1)])
    scene.say("background", shade, shade, shade)
    scene.say("ambient", rng.uniform(0.3, 0.9))
    scene.say("light", *view.eye, rng.uniform(0, 1))
    place = add_mirror(scene, rng, view) if is_mirrored else list
    if rng.random() < 0.5:
        scene.any_material("ball")
        scene.say("sphere", *place(view.point(*(rng.uniform(0, side) for side in size), 60)),
                  60 * view.pixel * size[1] * rng.uniform(0.1, 0.3))
    scene.say("define part matte diffuse", *scene.color(0.5), "kd 1")
    scene.say("material part")
    kind(scene, rng, view, place)
    scene.say(*view.statement())
    path = folder / f"{name}.scn"
    path.write_text("\n".join(scene.lines) + "\n")
    return path
