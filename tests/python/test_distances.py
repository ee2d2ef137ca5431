#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the distances of hits with the bound that clrt.h states, in rational arithmetic."""
import sys
import unittest
from fractions import Fraction

try:
    import cffi  # pylint: disable=unused-import
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup python installs it")
    sys.exit(77)

import clrt
import exact

RAYS = 10
CORNER_SHIFT, DISTANCE_ERROR = 6, 18  # in units of 2^-24 of the distance to the farthest corner
SCALE = 0.5  # of the normalization of a box with sides of 2
CUBE = 2  # far starts move to the cube from -2 to 2


def rows(random, count, *range_of_exponents):
    """Returns a column of powers of ten with random exponents."""
    return 10 ** random.uniform(*range_of_exponents, (count, 1))


class Triangles:
    """Random triangles in a box with sides of 2 around `center`."""

    def __init__(self, random, kind, count=200):
        self.center = np.rint(random.uniform(-2**20, 2**20, 3)) * random.integers(2)
        corners = random.uniform(-1, 1, (count, 1, 3)) + random.uniform(-0.3, 0.3, (count, 3, 3))
        if kind == "thin":
            sides = random.normal(size=(count, 1, 3)) * np.array((0, 0.5, 1))[:, None]
            corners = corners[:, :1] + sides
            corners += rows(random, count, -7, -1)[:, None] * random.normal(size=corners.shape)
        elif kind == "tiny":
            corners *= rows(random, count, -30, 0)[:, None]
        corners = np.clip(corners, -1, 1)
        corners[0] = (-1, -1, -1), (1, -1, -1), (-1, 1, -1)
        corners[1] = (1, 1, 1), (-1, 1, 1), (1, -1, 1)
        corners += self.center
        self.traced = ((corners - self.center) * SCALE).astype(np.float32)
        self.scene = clrt.Scene()
        self.scene.mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))

    def aims(self, random, kind):
        """Returns the origins and directions of rays to points of triangles."""
        corners = self.traced[random.integers(len(self.traced), size=RAYS)] / SCALE
        weights = random.dirichlet((1, 1, 1), RAYS) * (1, 1, kind != "edges")
        points = (corners * weights[:, :, None]).sum(1) / weights.sum(1)[:, None]
        origins = random.uniform(-1.5, 1.5, (RAYS, 3))
        if kind == "grazing":
            sides = corners[:, 1:] - corners[:, :1]
            origins = points + (sides * random.normal(size=(RAYS, 2, 1))).sum(1)
            origins += np.cross(sides[:, 0], sides[:, 1]) * rows(random, RAYS, -6, -1)
        elif kind == "far":
            origins *= rows(random, RAYS, 0, 9)
        return origins + self.center, (points - origins) * rows(random, RAYS, -3, 3)

    def traced_rays(self, origins, directions, near):
        """Returns starts and ways of the traced rays, then `first` and `units`. A traced ray's t is the
        distance (first + t) * unit of the caller's ray."""
        powers = np.ldexp(1.0, 1 - np.frexp(np.abs(directions).max(1))[1])
        units, ways = powers / SCALE, directions * powers[:, None]
        starts = (origins - self.center) * SCALE
        with np.errstate(divide="ignore"):
            entries = np.where(ways == 0, -np.inf, (-np.copysign(CUBE, ways) - starts) / ways).max(1)
        first = near / units
        is_far = np.abs(starts + ways * first[:, None]).max(1) > 2 * CUBE
        first = np.where(is_far, np.maximum(first, entries), first)
        return (starts + ways * first[:, None]).astype(np.float32), ways.astype(np.float32), first, units


class Distances(unittest.TestCase):
    def judge(self, corners, start, way, t):
        """Fails if clrt.h does not permit the distance t of a hit on the triangle."""
        radius = np.linalg.norm(corners.astype(np.longdouble) - start, axis=1).max()
        unit = Fraction(float(radius)) * (1 + Fraction(1, 2**40)) / 2**24
        reached = exact.reach(corners, start, way, CORNER_SHIFT * unit)
        self.assertIsNotNone(reached)
        slack = DISTANCE_ERROR * unit / Fraction(float(np.abs(way).max()))
        self.assertTrue(reached[0] - slack <= t <= reached[1] + slack, (reached, t))

    def test_distances_are_as_exact_as_clrt_h_states(self):
        random, judged, renderer = np.random.default_rng(31), 0, clrt.Renderer()
        for triangles in ("large", "thin", "tiny") * 2:
            mesh = Triangles(random, triangles)
            for aims in ("faces", "edges", "grazing", "far"):
                origins, directions = mesh.aims(random, aims)
                near = random.uniform(-1, 0.2, RAYS) * random.integers(2, size=RAYS)
                hits = renderer.trace(mesh.scene, origins, directions, near=near)
                starts, ways, first, units = mesh.traced_rays(origins, directions, near)
                for i in np.nonzero(hits.hit)[0]:
                    t = Fraction(hits.distance[i]) / Fraction(units[i]) - Fraction(first[i])
                    with self.subTest(triangles=triangles, aims=aims, ray=i):
                        self.judge(mesh.traced[hits.face[i]], starts[i], ways[i], t)
                judged += hits.hit.sum()
        self.assertGreater(judged, 12 * RAYS)


unittest.main(argv=sys.argv[:1])
