#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests meshes that are rendered without a scene: which way is up, and that turning is exact. Every
# run makes new meshes. Usage: test_lone_mesh.py CLRT 1|0, with 0 for a build without Assimp
import random
import sys
import unittest

import models
from work import Work, main

ASSIMP = sys.argv[2] == "1"
# The turned point for each axis that points up.
TURNS = {
    "x": lambda x, y, z: (-z, y, x),
    "y": lambda x, y, z: (x, -z, y),
    "z": lambda x, y, z: (x, y, z),
    "-x": lambda x, y, z: (z, y, -x),
    "-y": lambda x, y, z: (x, z, -y),
    "-z": lambda x, y, z: (-x, y, -z),
}
KNOT, TRIANGLES = models.knot()
NORMALS = models.normals_of(KNOT)


def turned(points, up):
    return [TURNS[up](*point) for point in points]


def tripod(splay=1.0):
    """Returns a body on three feet, with z up. It falls over in any other position."""
    points, triangles = [], []

    def block(low, high):
        first = len(points)
        points.extend((x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2]))
        faces = (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)
        triangles.extend((first + a, first + b, first + c) for q in faces for a, b, c in
                         ((q[0], q[1], q[2]), (q[0], q[2], q[3])))

    for x, y in (-1, -1), (1, -1), (0, 1):
        x, y = splay * x, splay * y
        block((x - 0.125, y - 0.125, 0), (x + 0.125, y + 0.125, 2))
    block((-0.5, -0.5, 2), (0.5, 0.5, 3))
    tip = len(points)
    points.append((1.75, 1.5, 3.5))  # a single point on three sides
    triangles.append((tip, tip - 1, tip - 2))
    points.append((-1.75, -1.625, 2.75))
    triangles.append((tip + 1, tip - 7, tip - 8))
    return points, triangles


class Upright(Work):
    def setUp(self):
        super().setUp()
        self.seed = random.SystemRandom().randrange(1 << 32)
        self.random = random.Random(self.seed)

    def points(self):
        """Returns the knot's points, moved at random. One coordinate is zero."""
        shift = lambda value: models.rounded(value + self.random.uniform(-0.05, 0.05))
        return [(0.0, 0.5, 0.25)] + [tuple(map(shift, point)) for point in KNOT[1:]]

    def mesh_of(self, *words):
        self.clrt("convert", *words, "out.ply", "-q")
        return self.bytes_of("out.ply")

    def test_turning_is_exact(self):
        points = self.points()
        self.write(a_ply=models.ply(points, TRIANGLES, NORMALS))
        for up in TURNS:
            permuted = models.ply(turned(points, up), TRIANGLES, turned(NORMALS, up))
            self.write(b_ply=permuted, a_scn=f"mesh a.ply up {up}\n")
            self.assertEqual(self.mesh_of("a.ply", "--up", up), permuted, (up, self.seed))
            self.assertEqual(self.mesh_of("a.scn"), permuted, (up, self.seed))
            self.assertTrue(self.picture("a.ply", "--up", up) == self.picture("b.ply", "--up", "z"), up)

    def test_transforms_apply_to_the_turned_mesh_in_the_order_written(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES), b_ply=models.ply(turned(KNOT, "y"), TRIANGLES),
                   a_scn="mesh a.ply up y translate 1 2 3\n", b_scn="mesh b.ply translate 1 2 3\n",
                   c_scn="mesh a.ply translate 1 3 -2 up y\n")
        self.assertEqual(self.mesh_of("a.scn"), self.mesh_of("b.scn"))
        self.assertEqual(self.mesh_of("c.scn"), self.mesh_of("b.scn"))

    def test_meshes_without_an_axis_have_z_up(self):
        points = self.points()
        self.write(a_ply=models.ply(points, TRIANGLES))
        self.assertEqual(self.mesh_of("a.ply"), models.ply(points, TRIANGLES), self.seed)

    def test_a_mesh_that_stands_only_with_y_up_has_y_up(self):
        """Returns to y up from z up, and stays once it is upright."""
        points, triangles = tripod(self.random.uniform(0.9, 1.1))
        points = [tuple(map(models.rounded, point)) for point in points]
        upright = models.ply(points, triangles)
        lying = [(x, z, -y) for x, y, z in points]  # y is up
        self.write(a_ply=models.ply(lying, triangles), b_ply=upright)
        self.assertEqual(self.mesh_of("a.ply"), upright, self.seed)
        self.assertEqual(self.mesh_of("b.ply"), upright, self.seed)
        self.assertEqual(self.mesh_of("a.ply", "--up", "z"), self.bytes_of("a.ply"))

    def test_parts_of_another_axis_do_not_merge(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES))
        words = "-s", "32x32", "--tile", "16x16", "-q"
        self.clrt("a.ply", *words, "--part", "1/2", "--up", "x", "-o", "1.exr")
        self.clrt("a.ply", *words, "--part", "2/2", "--up", "y", "-o", "2.exr")
        self.assertIn("another scene", self.clrt("merge", "1.exr", "2.exr", "-o", "3.exr", code=3))

    def test_wrong_axes_and_scenes_get_one_message(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES), a_scn="mesh a.ply\n", b_scn="mesh a.ply up w\n",
                   c_scn="mesh a.ply up\n")
        self.refuses(2, "--up wants auto, x, y, z, -x, -y or -z, not 'up'", "a.ply", "--up", "up", "-o", "a.png")
        self.refuses(3, "a.scn: only a mesh without a scene can be turned: write 'up -y' in its mesh statement",
                     "a.scn", "--up", "-y", "-o", "a.png")
        usage = "the statement is 'mesh PATH [up AXIS] [scale S] [rotate AX AY AZ DEGREES] [translate X Y Z]'"
        self.fails(f"b.scn:1:15: expected x, y, z, -x, -y or -z: found 'w'; {usage}", "b.scn")
        self.fails(f"c.scn:1:14: expected x, y, z, -x, -y or -z: found the end of the line; {usage}", "c.scn")

    @unittest.skipUnless(ASSIMP, "this build is without Assimp")
    def test_formats_have_their_axes(self):
        coarse = models.coarse(KNOT)
        files = {
            "a.obj": (models.obj(coarse, TRIANGLES), "y"),
            "a.glb": (models.glb(coarse, TRIANGLES), "y"),
            "a.stl": (models.stl(coarse, TRIANGLES), "z"),
            "a.off": (models.off(coarse, TRIANGLES), "z"),
        }
        for name, (content, up) in files.items():
            (self.work / name).write_bytes(content)
            self.assertEqual(self.mesh_of(name), self.mesh_of(name, "--up", up), name)
            self.assertNotEqual(self.mesh_of(name), self.mesh_of(name, "--up", "x"), name)

    @unittest.skipUnless(ASSIMP, "this build is without Assimp")
    def test_the_shape_counts_in_every_format_without_an_axis(self):
        points, triangles = tripod()
        lying = [(x, z, -y) for x, y, z in points]
        self.write(a_stl=models.stl(lying, triangles), a_OFF=models.off(lying, triangles))
        for name in "a.stl", "a.OFF":
            self.assertEqual(self.mesh_of(name), self.mesh_of(name, "--up", "y"), name)


if __name__ == "__main__":
    main(2)
