#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares certain rays with rational arithmetic. CLRT_TEST_TIER=1 casts more rays."""
import math
import os
import sys
import unittest

try:
    import cffi  # pylint: disable=unused-import
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup python installs it")
    sys.exit(77)

import clrt
import exact

RAYS = (40, 3000)[int(os.environ.get("CLRT_TEST_TIER", 0)) > 0]


class Soup:
    """Random triangles of floats. Their bounding box is [-1, 1]^3, so normalizing does not round."""

    def __init__(self, random, count, size, spheres=()):
        centers = random.uniform(-1, 1, (count, 1, 3))
        corners = np.clip(centers + random.uniform(-size, size, (count, 3, 3)), -1, 1)
        corners[0] = (-1, -1, -1), (1, -1, -1), (-1, 1, -1)
        corners[1] = (1, 1, 1), (-1, 1, 1), (1, -1, 1)
        self.corners = corners.astype(np.float32).astype(np.float64)
        self.random, self.count, self.spheres = random, count, spheres
        self.scene = clrt.Scene()
        self.scene.mesh(self.corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
        for sphere in spheres:
            self.scene.sphere(*sphere)

    def origins(self):
        return self.random.uniform(-1.5, 1.5, (RAYS, 3))

    def steps(self, smallest, largest):
        """Returns random numbers of both signs, with decimal exponents from `smallest` to `largest`."""
        sign = self.random.choice((-1, 1), (RAYS, 1))
        return sign * 10 ** self.random.uniform(smallest, largest, (RAYS, 1))

    def points(self, kind):
        """Returns random triangles, and a random point in each triangle or on its edge."""
        chosen = self.random.integers(self.count, size=RAYS)
        weights = self.random.dirichlet((1, 1, 1), RAYS)
        if kind == "edges":
            weights[:, 2] = 0
            weights /= weights.sum(1)[:, None]
        return chosen, (self.corners[chosen] * weights[:, :, None]).sum(1)


def soups():
    random = np.random.default_rng(11)
    for count, size in ((60, 0.5), (300, 0.2), (1000, 0.05), (200, 1e-3)):
        yield Soup(random, count, size)


class Certain(unittest.TestCase):
    def compare(self, soup, origins, directions, least, far=None, starts=None):
        """Fails if a certain ray differs from exact arithmetic. Returns the number of wrong rays."""
        hits = clrt.Renderer().trace(soup.scene, origins, directions, far=far, starts=starts,
                                     results=("primitive", "certain"))
        wrong = 0
        for i in range(RAYS):
            own = None if starts is None else starts[i]
            end = math.inf if far is None else exact.Fraction(far[i])
            primitive, clear = exact.nearest(soup.corners, origins[i], directions[i], own, end,
                                             soup.spheres)
            same = hits.primitive[i] == (clrt.NOTHING if primitive is None else primitive)
            if hits.certain[i]:
                self.assertTrue(same and clear, (i, hits.primitive[i], primitive))
            wrong += not same
        self.assertGreaterEqual(hits.certain.mean(), least)
        return wrong

    def test_random_rays_are_certain(self):
        for soup in soups():
            self.compare(soup, soup.origins(), soup.random.normal(size=(RAYS, 3)), 0.95)

    def test_rays_beside_edges(self):
        wrong = 0
        for soup in soups():
            for far in (0, 6):
                _, points = soup.points("edges")
                points += soup.random.normal(size=(RAYS, 3)) * soup.steps(-9, -4)
                origins = soup.origins() * abs(soup.steps(0, far))
                wrong += self.compare(soup, origins, points - origins, 0.2)
        self.assertGreater(wrong, 0)  # otherwise, the rays are not hard enough

    def test_rays_that_start_beside_triangles(self):
        for soup in soups():
            directions = soup.random.normal(size=(RAYS, 3))
            origins = soup.points("faces")[1] + directions * soup.steps(-9, -3)
            self.compare(soup, origins, directions, 0.2)

    def test_rays_that_start_on_triangles(self):
        for soup in soups():
            chosen, points = soup.points("faces")
            self.compare(soup, points, soup.random.normal(size=(RAYS, 3)), 0.9,
                         starts=chosen.astype(np.uint32))

    def test_rays_that_end_beside_triangles(self):
        for soup in soups():
            origins, directions = soup.origins(), soup.random.normal(size=(RAYS, 3))
            found = clrt.Renderer().trace(soup.scene, origins, directions).distance
            far = np.where(np.isfinite(found), found, 1) * (1 + soup.steps(-9, -2)[:, 0])
            self.compare(soup, origins, directions, 0.5, far=far)

    def test_spheres(self):
        random = np.random.default_rng(12)
        spheres = [(tuple(np.rint(random.uniform(-1, 1, 3) * 2**20) / 2**20), radius)
                   for radius in (0.5, 0.25, 2**-6, 2**-12, 4)]
        soup = Soup(random, 100, 0.2, spheres)
        origins, directions = soup.origins(), random.normal(size=(RAYS, 3))
        self.compare(soup, origins, directions, 0.9)
        for center, radius in spheres:
            aside = np.cross(directions, center - origins)
            aside *= radius / np.linalg.norm(aside, axis=1)[:, None] * (1 + soup.steps(-9, -3))
            self.compare(soup, origins, center + aside - origins, 0)

    def test_rays_through_edges_and_corners_are_uncertain(self):
        scene = clrt.Scene()
        scene.mesh([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2), (0, 2, 3)])
        ends = np.array([(0, 0, 0), (0.5, 0.5, 0), (1, 0, 0), (1, 1, 0), (1 + 2**-24, 0.5, 0),
                         (0.5, 0, 0), (1.5, 0.5, 0)])
        eye = np.array((0.25, -0.5, 4))
        hits = clrt.Renderer().trace(scene, eye, ends - eye, results=("certain",))
        self.assertEqual(hits.certain.tolist(), [False] * 5 + [True] * 2)

    def test_coincident_triangles_have_a_certain_lowest_id(self):
        scene = clrt.Scene()
        corners = [(-1, -1, 0), (1, -1, 0), (1, 1, 0)]
        scene.mesh(corners, [(0, 1, 2), (2, 1, 0)])
        hits = clrt.Renderer().trace(scene, (0.5, 0, 3), [(0, 0, -1)],
                                     results=("certain", "primitive"))
        self.assertEqual((hits.certain[0], hits.primitive[0]), (True, 0))

    def test_all_crossings_have_no_certainty(self):
        scene = clrt.Scene()
        scene.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        with self.assertRaisesRegex(clrt.ArgumentError, "a result is 'certain'"):
            clrt.Renderer().trace_all(scene, (0.1, 0.1, 1), [(0, 0, -1)], results=("certain",))


unittest.main(argv=sys.argv[:1])
