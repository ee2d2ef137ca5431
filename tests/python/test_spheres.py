#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the crossings of rays and spheres with exact arithmetic.

All coordinates are multiples of 1/STEPS, so that clrt stores them exactly."""
import math
import sys
import unittest

try:
    import cffi  # pylint: disable=unused-import
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup python installs it")
    sys.exit(77)

import clrt

STEPS = 256


def whole(random, shape, most=2.0):
    """Returns random coordinates as multiples of 1/STEPS."""
    return np.rint(random.uniform(-most, most, shape) * STEPS).astype(np.int64)


def exact_crossings(spheres, origin, direction):
    """Returns the (t, number) of all walls ahead, in order. Coordinates are integers."""
    found = []
    for number, (center, radius) in enumerate(spheres):
        apart = [int(o) - int(c) for o, c in zip(origin, center)]
        way = [int(d) for d in direction]
        a = sum(d * d for d in way)
        b = sum(f * d for f, d in zip(apart, way))
        c = sum(f * f for f in apart) - int(radius)**2
        assert c != 0 and b * b != a * c, "the ray starts on a sphere or touches one"
        if c < 0 or (b < 0 and b * b > a * c):
            root = math.sqrt(b * b - a * c)
            found += [((-b + sign * root) / a, number) for sign in (-1, 1)[c < 0:]]
    return sorted(found)


class Spheres(unittest.TestCase):
    def setUp(self):
        self.random, self.renderer = np.random.default_rng(11), clrt.Renderer()

    def scene_of(self, count):
        """Returns a scene of spheres, some of which overlap, and the spheres as integers."""
        scene = clrt.Scene()
        spheres = [(whole(self.random, 3), int(radius))
                   for radius in self.random.integers(STEPS // 8, STEPS, count)]
        for center, radius in spheres:
            scene.sphere(center / STEPS, radius / STEPS)
        return scene, spheres

    def rays(self, spheres, count):
        """Returns rays that neither start on a sphere nor touch one."""
        rays = []
        while len(rays) < count:
            origin, direction = whole(self.random, 3, 3), whole(self.random, 3, 1)
            try:
                exact_crossings(spheres, origin, direction)
            except (AssertionError, ZeroDivisionError):
                continue
            rays.append((origin, direction))
        return [np.array(ends) for ends in zip(*rays)]

    def test_rays_cross_both_walls_in_order(self):
        for count in (1, 5, 60):  # many spheres have a tree
            scene, spheres = self.scene_of(count)
            origins, directions = self.rays(spheres, 400)
            hits = self.renderer.trace_all(scene, origins / STEPS, directions / STEPS)
            for ray, (origin, direction) in enumerate(zip(origins, directions)):
                expected = exact_crossings(spheres, origin, direction)
                distance = hits.distance[hits.ray == ray]
                self.assertEqual(len(distance), len(expected))
                self.assertEqual(sorted(hits.primitive[hits.ray == ray]),
                                 sorted(number for _, number in expected))
                self.assertTrue(np.allclose(distance, [t for t, _ in expected], atol=1e-5))
                self.assertTrue((np.diff(distance) >= 0).all())
            self.assertTrue((hits.face == clrt.NOTHING).all())

    def test_points_in_an_odd_number_of_spheres_are_inside(self):
        for count in (1, 60):
            scene, spheres = self.scene_of(count)
            points = whole(self.random, (20000, 3))
            powers = np.array([((points - center)**2).sum(1) - radius**2
                               for center, radius in spheres])
            clear = (powers != 0).all(0)
            inside = self.renderer.contains(scene, points[clear] / STEPS)
            expected = (powers < 0).sum(0) % 2 == 1
            self.assertTrue((inside == expected[clear]).all())

    def test_spheres_and_meshes_are_crossed_in_one_order(self):
        scene = clrt.Scene()
        corners = np.array([(x, y, z) for x in (-2, 2) for y in (-2, 2) for z in (-2, 2)], float)
        scene.mesh(corners, [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
                             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])
        scene.sphere((0, 0, 0), 1)
        scene.sphere((2, 0, 0), 1)
        hits = self.renderer.trace_all(scene, [(-5, 0.25, 0.125)], (1, 0, 0))
        self.assertEqual((hits.mesh != clrt.NOTHING).tolist(),
                         [True, False, False, False, True, False])
        self.assertEqual(hits.primitive[[1, 2, 3, 5]].tolist(), [0, 0, 1, 1])
        points = [(0, 0, 0), (1.5, 0, 0), (-1.5, 0, 0), (2.5, 0, 0), (9, 0, 0)]
        self.assertEqual(self.renderer.contains(scene, points).tolist(),
                         [False, False, True, True, False])

    def test_rays_cross_the_far_wall_of_the_sphere_on_which_they_start(self):
        scene = clrt.Scene()
        scene.sphere((0, 0, 0), 1)
        starts = self.renderer.trace(scene, whole(self.random, (500, 3)) / STEPS + 3, (-1, -1, -1))
        count = starts.hit.sum()
        points = starts.normal[starts.hit]
        ways = self.random.normal(size=points.shape)
        ways += np.sign((ways * points).sum(1))[:, None] * points  # not along the surface
        for near, inward in ((0, (ways * points).sum(1) < 0), (1e-3, np.zeros(count, bool))):
            given = {"starts": np.zeros(count, np.uint32), "near": near}
            hits = self.renderer.trace_all(scene, points, ways, **given)
            self.assertEqual(hits.ray.tolist(), np.flatnonzero(inward).tolist())
            nearest = self.renderer.trace(scene, points, ways, **given)
            self.assertEqual(nearest.distance[inward].tolist(), hits.distance.tolist())

    def test_a_renderer_takes_scenes_with_and_without_spheres_in_turn(self):
        for has_sphere in (False, True, False):
            scene = clrt.Scene()
            scene.mesh([(-9, -9, 0), (9, -9, 0), (0, 9, 0)], [(0, 1, 2)])
            if has_sphere:
                scene.sphere((0, 0, 3), 1)
            for cast in (self.renderer.trace, self.renderer.trace_all):
                hits = cast(scene, [(0, 0, 9)], (0, 0, -1), results=("distance",))
                self.assertEqual(hits.distance[0], 5 if has_sphere else 9)

    def test_cameras_change_no_ray(self):
        hits = []
        for cameras in (0, 1):
            scene = clrt.Scene()
            scene.sphere((0, 0, 1), 1)
            scene.sphere((1e7, 0.3, 0.2), 1e3)
            for _ in range(cameras):
                scene.camera((3, -6, 3), (0, 0, 1))
            origins = np.random.default_rng(1).normal(size=(1000, 3)) + (0, -4, 0)
            found = self.renderer.trace(scene, origins, (0, 0, 1) - origins)
            self.assertGreater(found.hit.mean(), 0.5)
            hits.append(np.column_stack([found.distance, found.normal]))
        self.assertTrue((hits[0] == hits[1]).all())


if __name__ == "__main__":
    unittest.main()
