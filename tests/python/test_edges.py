#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Casts rays exactly through the edges and vertices of boxes and a roof.

Other ray tracers were reported to miss hits of such rays, or to count hits twice."""
import sys
import unittest

try:
    import cffi  # pylint: disable=unused-import
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup python installs it")
    sys.exit(77)

import clrt
import clrt.trimesh

QUADS = ((0, 2, 1), (1, 2, 3)), ((0, 1, 2), (2, 1, 3))


class Box:
    """A closed box from -size to size, with `cells` squares along each side. It has the attributes of
    a trimesh."""

    def __init__(self, cells, size=1.0):
        steps = np.linspace(-1, 1, cells + 1)
        self.vertices, self.faces = [], []
        for axis in range(3):
            for side in (0, 1):
                for i in range(cells):
                    for j in range(cells):
                        self._add_square(axis, side, steps[i:i + 2], steps[j:j + 2])
        corners, index = np.unique(np.array(self.vertices), axis=0, return_inverse=True)
        self.vertices = corners * size
        self.faces = index.reshape(-1)[np.array(self.faces)]

    def _add_square(self, axis, side, across, along):
        first = len(self.vertices)
        for y in along:
            for x in across:
                self.vertices.append(np.roll((2 * side - 1, x, y), axis))
        self.faces += [[first + corner for corner in half] for half in QUADS[side]]

    def edges(self):
        """Returns the midpoints of all edges."""
        ends = self.vertices[self.faces]
        return ((ends + np.roll(ends, 1, axis=1)) / 2).reshape(-1, 3)

    def scene(self):
        scene = clrt.Scene()
        scene.mesh(self.vertices, self.faces)
        return scene


class Edges(unittest.TestCase):
    def setUp(self):
        self.renderer = clrt.Renderer()

    def test_rays_from_inside_hit_vertices_and_edges_once(self):
        for cells in (1, 2, 3, 8):
            box = Box(cells, 20)
            targets = np.vstack([box.vertices, box.edges()])
            for eye in ((0, 0, 0), (1, 2, 3), (-19, 0, 7)):
                away = targets - eye
                hits = self.renderer.trace(box.scene(), eye, away)
                self.assertTrue(np.allclose(hits.distance, 1, atol=1e-5))
                crossings = self.renderer.trace_all(box.scene(), eye, away)
                self.assertEqual(crossings.ray.tolist(), list(range(len(targets))))

    def test_trimesh_methods_agree_at_vertices_and_edges(self):
        inner, outer = Box(2, 20), Box(3, 30)
        ray = clrt.trimesh.RayMeshIntersector(inner)
        for away in (outer.vertices, inner.vertices, inner.edges()):
            start = np.zeros_like(away)
            self.assertTrue(ray.intersects_any(start, away).all())
            self.assertTrue((ray.intersects_first(start, away) >= 0).all())
            for multiple in (False, True):
                _, index = ray.intersects_id(start, away, multiple_hits=multiple)
                self.assertEqual(index.tolist(), list(range(len(away))))

    def test_other_meshes_hide_no_vertex(self):
        for count in range(1, 11):
            scene = clrt.Scene()
            for number in range(count):
                shell = Box(3, 1 + number)
                scene.mesh(shell.vertices, shell.faces)
            corners = Box(3, 1).vertices
            crossings = self.renderer.trace_all(scene, (0, 0, 0), corners)
            self.assertEqual(crossings.mesh.tolist(), list(range(count)) * len(corners))

    def test_points_below_edges_and_vertices_are_inside_or_outside(self):
        grid = np.linspace(-2, 2, 17)
        points = np.stack(np.meshgrid(grid, grid, grid), -1).reshape(-1, 3)
        distances = np.abs(points).max(1)
        points, distances = points[distances != 1], distances[distances != 1]
        for cells in (1, 2, 4, 8):
            inside = self.renderer.contains(Box(cells).scene(), points)
            self.assertEqual(inside.tolist(), (distances < 1).tolist())

    def test_rays_in_the_plane_of_a_face_hit_the_sides(self):
        box, starts = Box(4), np.array([(-3, y, 1) for y in (-1.5, -0.75, -0.5, 0.25, 1.5)])
        hits = self.renderer.trace(box.scene(), starts, (1, 0, 0))
        self.assertEqual(hits.distance.tolist(), [np.inf, 2, 2, 2, np.inf])
        self.assertEqual(hits.normal[1:4].tolist(), [[-1, 0, 0]] * 3)
        self.assertTrue(hits.front[1:4].all())
        crossings = self.renderer.trace_all(box.scene(), starts, (1, 0, 0))
        self.assertTrue((np.bincount(crossings.ray, minlength=5) % 2 == 0).all())

    def test_rays_from_a_face_cross_but_do_not_hit_it(self):
        for start in ((0.25, 0.5, 1), (0.5, 0.5, 1), (1, 1, 1)):  # in a face, at an edge, at a corner
            hits = self.renderer.trace(Box(4).scene(), [start], (-0.25, -0.5, -1))
            self.assertEqual(hits.distance.tolist(), [2])
            crossings = self.renderer.trace_all(Box(4).scene(), [start], (-0.25, -0.5, -1))
            self.assertEqual(crossings.distance.tolist(), [0, 2])

    def test_rays_over_a_ridge_touch_it_from_outside_or_not(self):
        scene = clrt.Scene()
        scene.mesh([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, -1, 1), (0, 1, 1)],
                   [(0, 2, 1), (0, 3, 2), (0, 1, 4), (2, 3, 5), (1, 2, 5), (1, 5, 4), (3, 0, 4),
                    (3, 4, 5)])
        starts = np.array([(-3, y, z) for y in np.linspace(-0.9, 0.9, 13) for z in (1, 1.5, -0.5)])
        crossings = self.renderer.trace_all(scene, starts, (1, 0, 0))
        counts = np.bincount(crossings.ray, minlength=len(starts))
        self.assertTrue(np.isin(counts, (0, 2)).all())
        nearest = self.renderer.trace(scene, starts, (1, 0, 0))
        self.assertTrue(nearest.front[nearest.hit].all())
        self.assertFalse(self.renderer.contains(scene, starts).any())


if __name__ == "__main__":
    unittest.main()
