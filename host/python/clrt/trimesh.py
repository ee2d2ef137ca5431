# SPDX-License-Identifier: MIT
"""Rays for trimesh: mesh.ray = clrt.trimesh.RayMeshIntersector(mesh)."""

import numpy as np

from .renderer import NOTHING, default_renderer
from .scene import Scene


class RayMeshIntersector:
    """Has the methods and results of trimesh.ray's intersectors, by exact rays.

    A ray through an edge or vertex hits one face: the first hit has the lowest number, and of all
    hits each crossing of the surface counts once. Hits of one ray are ordered by distance.
    """

    def __init__(self, geometry, renderer=None):
        self.mesh = geometry
        self._renderer = renderer
        self._scene, self._state = None, None

    def _parts(self):
        """The renderer, and the scene of the mesh as it is now."""
        state = hash(self.mesh)
        if self._state != state:
            self._scene = Scene()
            self._scene.mesh(self.mesh.vertices, self.mesh.faces)
            self._state = state
        return self._renderer or default_renderer(), self._scene

    def _cast(self, kind, origins, directions, **settings):
        renderer, scene = self._parts()
        origins = np.asarray(origins, np.float64).reshape(-1, 3)
        directions = np.asarray(directions, np.float64).reshape(-1, 3)
        if origins.shape != directions.shape:
            raise ValueError("Ray origin and direction don't match!")
        return getattr(renderer, kind)(scene, origins, directions, **settings)

    def intersects_id(self, ray_origins, ray_directions, multiple_hits=True, max_hits=None,
                      return_locations=False, **_):
        """The faces and the rays that hit them: index_tri, index_ray and, if asked, locations."""
        results = ("primitive", "face", "distance")
        kind = "trace_all" if multiple_hits else "trace"
        hits = self._cast(kind, ray_origins, ray_directions, results=results)
        if multiple_hits:
            ray, keep = hits.ray, _first_of_each(hits.ray, max_hits)
        else:
            ray, keep = np.arange(len(hits.face)), hits.hit
        face, ray = hits.face[keep].astype(np.int64), ray[keep]
        if not return_locations:
            return face, ray
        origins = np.asarray(ray_origins, np.float64).reshape(-1, 3)[ray]
        directions = np.asarray(ray_directions, np.float64).reshape(-1, 3)[ray]
        return face, ray, origins + directions * hits.distance[keep, None]

    def intersects_location(self, ray_origins, ray_directions, **settings):
        """The points that rays hit, the rays and the faces: locations, index_ray, index_tri."""
        face, ray, locations = self.intersects_id(ray_origins, ray_directions,
                                                  return_locations=True, **settings)
        return locations, ray, face

    def intersects_first(self, ray_origins, ray_directions):
        """The first face that each ray hits, or -1."""
        face = self._cast("trace", ray_origins, ray_directions, results=("primitive", "face")).face
        return np.where(face == NOTHING, -1, face.astype(np.int64))

    def intersects_any(self, ray_origins, ray_directions):
        """Whether each ray hits the mesh."""
        return self._cast("occluded", ray_origins, ray_directions)

    def contains_points(self, points):
        """Whether each point is inside of the mesh, which must be closed."""
        renderer, scene = self._parts()
        return renderer.contains(scene, np.asarray(points, np.float64).reshape(-1, 3))


def _first_of_each(ray, most):
    """Which hits, ordered by ray, are among the first `most` of their ray."""
    if most is None or len(ray) == 0:
        return np.ones(len(ray), bool)
    starts = np.searchsorted(ray, ray)
    return np.arange(len(ray)) - starts < most
