#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests meshes that are rendered without a scene: the up axis, exact turns, computed normals, samples,
# and the cameras, floor and lights of the generated scene. Every run makes new random meshes.
# Usage: test_lone_mesh.py CLRT 1|0, with 0 for a build without Assimp
import math
import random
import sys
import unittest

import models
from work import Work, main

ASSIMP = sys.argv[2] == "1"
# TURNS[axis] turns a point so that z points up if `axis` pointed up before.
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
    """Returns a body on three feet, with z up. The body falls over in any other position."""
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
    points.append((1.75, 1.5, 3.5))  # the only point on three sides of the bounding box
    triangles.append((tip, tip - 1, tip - 2))
    points.append((-1.75, -1.625, 2.75))
    triangles.append((tip + 1, tip - 7, tip - 8))
    return points, triangles


class Meshes(Work):
    def mesh_of(self, *words):
        self.clrt("convert", *words, "out.ply", "-q")
        return self.bytes_of("out.ply")


class Random(Meshes):
    def setUp(self):
        super().setUp()
        self.seed = random.SystemRandom().randrange(1 << 32)
        self.random = random.Random(self.seed)


class Upright(Random):
    def points(self):
        """Returns the knot's points, moved at random. One coordinate is zero."""
        shift = lambda value: models.rounded(value + self.random.uniform(-0.05, 0.05))
        return [(0.0, 0.5, 0.25)] + [tuple(map(shift, point)) for point in KNOT[1:]]

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
        self.write(a_ply=models.ply(points, TRIANGLES, NORMALS))
        self.assertEqual(self.mesh_of("a.ply"), self.bytes_of("a.ply"), self.seed)

    def test_a_mesh_that_stands_only_with_y_up_has_y_up(self):
        """A mesh that lies on its side, with y up, is turned to z up. An upright mesh stays as it is."""
        points, triangles = tripod(self.random.uniform(0.9, 1.1))
        points = [tuple(map(models.rounded, point)) for point in points]
        upright = models.ply(points, triangles, [(0.0, 0.0, 1.0)] * len(points))
        lying = [(x, z, -y) for x, y, z in points]  # y is up
        self.write(a_ply=models.ply(lying, triangles, [(0.0, 1.0, -0.0)] * len(points)), b_ply=upright)
        self.assertEqual(self.mesh_of("a.ply"), upright, self.seed)
        self.assertEqual(self.mesh_of("b.ply"), upright, self.seed)
        self.assertEqual(self.mesh_of("a.ply", "--up", "z"), self.bytes_of("a.ply"))

    @unittest.skipUnless(ASSIMP, "this build is without Assimp")
    def test_collada_files_name_their_axis(self):
        points = self.points()
        for up in "x", "y", "z":
            self.write(a_dae=models.collada(points, TRIANGLES, up), b_ply=models.ply(points, TRIANGLES))
            self.assertEqual(self.picture("a.dae"), self.picture("b.ply", "--up", up), (up, self.seed))

    def test_parts_of_another_axis_do_not_merge(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES))
        words = "-s", "32x32", "--tune", "tile=16x16", "-q"
        self.clrt("a.ply", *words, "--part", "1/2", "--up", "x", "-o", "1.exr")
        self.clrt("a.ply", *words, "--part", "2/2", "--up", "y", "-o", "2.exr")
        self.assertIn("another scene", self.clrt("merge", "1.exr", "2.exr", "-o", "3.exr", code=3))

    def test_wrong_axes_and_scenes_get_one_message(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES), a_scn="mesh a.ply\n", b_scn="mesh a.ply up w\n",
                   c_scn="mesh a.ply up\n")
        self.refuses(2, "--up wants auto, x, y, z, -x, -y or -z, not 'up'", "a.ply", "--up", "up", "-o", "a.png")
        self.refuses(3, "a.scn: an up axis can be chosen only for a lone mesh file; in a scene, write "
                     "'up -y' after the path",
                     "a.scn", "--up", "-y", "-o", "a.png")
        usage = "the statement is 'mesh PATH [up AXIS] [scale S] [rotate AX AY AZ DEGREES] [translate X Y Z]'"
        self.fails(f"b.scn:1:15: expected x, y, z, -x, -y or -z: found 'w'; {usage}", "b.scn")
        self.fails(f"c.scn:1:14: expected x, y, z, -x, -y or -z: found the end of the line; {usage}", "c.scn")

    @unittest.skipUnless(ASSIMP, "this build is without Assimp")
    def test_formats_have_their_axes(self):
        # Whichever axis is up, the octahedron stands on a point, so its shape suggests no up axis.
        points = [(1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 3.0), (-1.0, 0.0, 0.0), (0.0, -2.0, 0.0), (0.0, 0.0, -3.0)]
        triangles = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
        files = {
            "a.obj": (models.obj(points, triangles), "y"),
            "a.glb": (models.glb(points, triangles), "y"),
            "a.stl": (models.stl(points, triangles), "z"),
            "a.off": (models.off(points, triangles), "z"),
        }
        for name, (content, up) in files.items():
            (self.work / name).write_bytes(content)
            self.assertEqual(self.mesh_of(name), self.mesh_of(name, "--up", up), name)
            self.assertNotEqual(self.mesh_of(name), self.mesh_of(name, "--up", "x"), name)

    @unittest.skipUnless(ASSIMP, "this build is without Assimp")
    def test_an_obj_file_that_stands_only_with_z_up_has_z_up(self):
        points, triangles = tripod()
        lying = [(x, z, -y) for x, y, z in points]
        self.write(a_obj=models.obj(points, triangles), b_obj=models.obj(lying, triangles))
        for name, up in ("a.obj", "z"), ("b.obj", "y"):
            self.assertEqual(self.mesh_of(name), self.mesh_of(name, "--up", up), name)

    @unittest.skipUnless(ASSIMP, "this build is without Assimp")
    def test_the_shape_counts_in_every_format_without_an_axis(self):
        points, triangles = tripod()
        lying = [(x, z, -y) for x, y, z in points]
        self.write(a_stl=models.stl(lying, triangles), a_OFF=models.off(lying, triangles))
        for name in "a.stl", "a.OFF":
            self.assertEqual(self.mesh_of(name), self.mesh_of(name, "--up", "y"), name)


def rough_ball(rings=40, sides=40):
    """Returns a ball whose points are moved toward its center. Larger moves are rarer."""
    source, points = random.Random(5), [(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)]
    for ring in range(rings):
        for side in range(sides):
            tilt, turn = math.pi * (ring + 1) / (rings + 1), 2 * math.pi * side / sides
            scale = 1 - source.expovariate(150)
            points.append(tuple(round(64 * 64 * scale * value) / (64 * 64) for value in
                                (math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), -math.cos(tilt))))
    place = lambda ring, side: 2 + ring * sides + side % sides
    triangles = [(0, place(0, side + 1), place(0, side)) for side in range(sides)]
    triangles += [(1, place(rings - 1, side), place(rings - 1, side + 1)) for side in range(sides)]
    for ring in range(rings - 1):
        for side in range(sides):
            a, b, c, d = place(ring, side), place(ring, side + 1), place(ring + 1, side + 1), place(ring + 1, side)
            triangles += [(a, b, c), (a, c, d)]
    return points, triangles


class Normals(Meshes):
    def test_the_shape_chooses_the_crease(self):
        """A rough ball is round everywhere. A tripod has too few edges for statistics."""
        self.write(a_ply=models.ply(*rough_ball()), b_ply=models.ply(*tripod()))
        for name, crease in ("a.ply", "70"), ("b.ply", "33"):
            chosen = self.mesh_of(name)
            self.assertEqual(chosen, self.mesh_of(name, "--normals", f"smooth={crease}"), name)
            self.assertEqual(chosen, self.mesh_of(name, "--normals", "smooth"), name)
        self.assertNotEqual(self.mesh_of("a.ply"), self.mesh_of("a.ply", "--normals", "smooth=33"))

    @unittest.skipUnless(ASSIMP, "this build is without Assimp")
    def test_all_parts_of_a_file_choose_one_crease(self):
        points, triangles = rough_ball()
        cap = [("usemtl red", 0), ("usemtl blue", 300)]  # the first part has too few edges for statistics
        self.write(a_obj=models.obj(points, triangles, "mtllib a.mtl", cap),
                   a_mtl="newmtl red\nKd 0.7 0.1 0.3\nnewmtl blue\nKd 0.1 0.1 0.7\n")
        self.assertEqual(self.mesh_of("a.obj"), self.mesh_of("a.obj", "--normals", "smooth=70"))

    def test_normals_can_be_chosen(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES, NORMALS), b_ply=models.ply(KNOT, TRIANGLES))
        self.assertEqual(self.mesh_of("a.ply", "--normals", "flat"), self.bytes_of("b.ply"))
        self.assertEqual(self.mesh_of("a.ply", "--normals=smooth=180"), self.bytes_of("a.ply"))
        flat = self.picture("b.ply", "--normals", "flat")
        self.assertEqual(flat, self.picture("a.ply", "--normals=flat"))
        self.assertNotEqual(flat, self.picture("b.ply", "--normals=smooth=180"))

    def test_parts_with_other_normals_do_not_merge(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES))
        words = "-s", "32x32", "--tune", "tile=16x16", "-q"
        self.clrt("a.ply", *words, "--part", "1/2", "--normals", "flat", "-o", "1.exr")
        self.clrt("a.ply", *words, "--part", "2/2", "-o", "2.exr")
        self.assertIn("another scene", self.clrt("merge", "1.exr", "2.exr", "-o", "3.exr", code=3))

    def test_wrong_normals_get_one_message(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES), a_scn="mesh a.ply\n")
        for word in "round", "flat=3":
            self.refuses(2, f"--normals wants flat or smooth, not '{word}'", "a.ply", "--normals", word, "-o", "a.png")
        for degrees in "", "181", "-1":
            self.refuses(2, f"--normals smooth= wants degrees from 0 to 180, not '{degrees}'", "a.ply",
                         f"--normals=smooth={degrees}", "-o", "a.png")
        for words, statement in ("flat", "flat"), ("smooth=50", "smooth"):
            self.refuses(3, "a.scn: normals can be chosen only for a lone mesh file; in a scene, write "
                         f"'normals {statement}' before the mesh", "a.scn", "--normals", words, "-o", "a.png")


class Antialiasing(Work):
    def test_files_of_lone_meshes_get_nine_samples(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES))
        self.clrt("convert", "a.ply", "b.scn")
        pixels = 24 * 16
        for words, samples in ((), 9), (("--aa=1",), 1), (("--aa",), 4), (("--aa=3",), 9):
            found = self.statistics("a.ply", "-s", "24x16", "-o", "a.pfm", *words)["samples"]["total"]
            self.assertEqual(found, samples * pixels, words)
        found = self.statistics("b.scn", "-s", "24x16", "-o", "b.pfm")["samples"]["total"]
        self.assertEqual(found, pixels)

    def test_adaptive_settings_and_goals_replace_the_default(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES))
        self.clrt("convert", "a.ply", "b.scn")
        for words in "--aa-adaptive", "--error=2%":
            self.expect_same("a.ply", "b.scn", words)


def unit(v):
    return [x / math.hypot(*v) for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cameras(scene):
    """Returns the eye, target, up vector, and vertical and horizontal angle of each camera of a scene."""
    up, found = [0, 0, 1], []
    for words in map(str.split, scene.splitlines()):
        if words[:1] == ["up"]:
            up = [float(word) for word in words[1:]]
        if words[:1] == ["camera"]:
            numbers = [float(word) for word in words[1:]]
            found.append((numbers[:3], numbers[3:6], up, numbers[6], numbers[7]))
    return found


def extents(camera, points, width, height):
    """Returns the ranges of the points' horizontal and vertical positions. The picture's edges are at
    -1 and 1."""
    eye, point, up, tall, wide = camera
    forward = unit([b - a for a, b in zip(eye, point)])
    right = unit(cross(forward, up))
    top = cross(right, forward)
    half = max(math.tan(math.radians(tall / 2)), math.tan(math.radians(wide / 2)) * height / width)
    rays = [[b - a for a, b in zip(eye, p)] for p in points]
    across = [dot(ray, right) / dot(ray, forward) / (half * width / height) for ray in rays]
    along = [dot(ray, top) / dot(ray, forward) / half for ray in rays]
    return (min(across), max(across)), (min(along), max(along))


class Studio(Random):
    def mesh(self):
        """Returns the points and triangles of a box or a tube of random size and position."""
        points, triangles = models.knot(self.random.randrange(3, 30), self.random.randrange(3, 9))
        if self.random.random() < 0.5:
            points = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
            triangles = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
                         (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
        stretch = [10 ** self.random.uniform(-3, 1) for _ in range(3)]
        size = 10 ** self.random.uniform(-8, 8)
        place = [size * self.random.uniform(-3, 3) for _ in range(3)]
        move = lambda p: tuple(models.rounded(x * s * size + t) for x, s, t in zip(p, stretch, place))
        return [move(p) for p in points], triangles

    def test_the_mesh_fills_four_fifths_of_any_picture(self):
        for _ in range(20):
            points, triangles = self.mesh()
            width, height = self.random.randrange(100, 2000), self.random.randrange(100, 2000)
            stray = points + [tuple(1e6 * x for x in points[0])]  # no triangle uses it
            self.write(a_ply=models.ply(stray, triangles))
            self.clrt("convert", "a.ply", "a.scn", "--up", "z")
            found = cameras((self.work / "a.scn").read_text())
            self.assertEqual(len(found), 6)
            for view, camera in enumerate(found):
                ranges = extents(camera, [points[i] for t in triangles for i in t], width, height)
                filled = [(high - low) / 2 for low, high in ranges]
                told = self.seed, view, width, height, ranges
                self.assertGreater(max(filled), 0.78, told)
                self.assertLess(max(filled), 0.82, told)
                for low, high in ranges:
                    self.assertLess(abs(low + high), 0.02, told)

    def test_its_scene_gives_the_same_pictures(self):
        self.write(a_ply=models.ply(*self.mesh()), b_obj=models.obj(models.coarse(KNOT), TRIANGLES, "mtllib b.mtl",
                   [("usemtl red", 0)]), b_mtl="newmtl red\nKd 0.7 0.1 0.3\n")
        for name in ["a.ply", "b.obj"] if ASSIMP else ["a.ply"]:
            self.clrt("convert", name, "c.scn")
            for view in range(1, 7):
                size = f"{self.random.randrange(8, 80)}x{self.random.randrange(8, 80)}"
                for scene in name, "c.scn":
                    self.clrt(scene, "-s", size, "--view", str(view), "-o", f"{scene}.pfm", "--aa=2")
                self.assert_same_bytes(f"{name}.pfm", "c.scn.pfm", (self.seed, size, view))

    def test_it_stands_on_a_floor_in_three_lights(self):
        points, triangles = self.mesh()
        self.write(a_ply=models.ply(points, triangles))
        self.clrt("convert", "a.ply", "a.scn", "--up", "z")
        statements = [line.split() for line in (self.work / "a.scn").read_text().splitlines()]
        (floor,) = [words for words in statements if words[0] == "sphere"]
        top, bottom = float(floor[3]) + float(floor[4]), min(points[i][2] for t in triangles for i in t)
        self.assertLess(abs(top - bottom), 1e-9 * float(floor[4]), self.seed)
        self.assertEqual(len([words for words in statements if words[0] == "light"]), 3)

    def test_its_studio_may_have_soft_shadows(self):
        points, triangles = self.mesh()
        self.write(a_ply=models.ply(points, triangles))
        self.clrt("convert", "a.ply", "a.scn", "--studio", "soft")
        lights = [line for line in (self.work / "a.scn").read_text().splitlines() if line.startswith("light")]
        self.assertEqual([" area " in line for line in lights], 3 * [True])
        hashes = [self.clrt(*scene, "-s", "40x30", "--hash", "--aa=1")
                  for scene in (["a.ply"], ["a.ply", "--studio", "soft"], ["a.scn"])]
        self.assertEqual(hashes[1], hashes[2], self.seed)
        self.assertNotEqual(hashes[0], hashes[1], self.seed)
        self.refuses(3, "a studio can be chosen only for a lone mesh file", "a.scn", "--studio", "soft", "--hash")

    def test_its_materials_are_no_findings(self):
        self.write(a_ply=models.ply(KNOT, TRIANGLES))
        self.assertNotIn("defined and not used", self.clrt("check", "a.ply", "-q"))


if __name__ == "__main__":
    main(2)
