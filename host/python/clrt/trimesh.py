# SPDX-License-Identifier: MIT
"""Rays for trimesh: mesh.ray = clrt.trimesh.RayMeshIntersector(mesh)."""

import numpy as np

from .library import NOTHING
from .renderer import default_renderer
from .scene import Scene


class RayMeshIntersector:
    """Has the methods and results of trimesh.ray's intersectors, but casts exact rays.

    If several faces have the same corners, the face with the lowest number is hit first. If a ray
    crosses a closed surface at an edge or vertex, it hits an odd number of faces there, usually
    one. The hits of a ray are ordered by distance.
    """

    def __init__(self, geometry, renderer=None):
        self.mesh = geometry
        self._renderer = renderer
        self._scene, self._state = None, None

    def _cast(self, kind, *arrays, **settings):
        """The result of the renderer's method `kind`. The arrays become rows of three numbers."""
        if self._state != hash(self.mesh):
            self._scene, self._state = Scene(), hash(self.mesh)
            self._scene.mesh(self.mesh.vertices, self.mesh.faces)
        method = getattr(self._renderer or default_renderer(), kind)
        return method(self._scene, *(np.reshape(array, (-1, 3)) for array in arrays), **settings)

    def intersects_id(self, ray_origins, ray_directions, multiple_hits=True, max_hits=None,
                      return_locations=False, **_):
        """The hits as arrays: index_tri, index_ray and, with return_locations, locations."""
        kind = "trace_all" if multiple_hits else "trace"
        hits = self._cast(kind, ray_origins, ray_directions, results=("face", "distance"))
        ray = hits.ray if multiple_hits else np.arange(len(hits.face))
        limit = np.inf if max_hits is None else max_hits
        keep = hits.hit & (np.arange(len(ray)) - np.searchsorted(ray, ray) < limit)
        face, ray = hits.face[keep].astype(np.int64), ray[keep]
        if not return_locations:
            return face, ray
        paths = np.asarray(ray_directions).reshape(-1, 3)[ray] * hits.distance[keep, None]
        return face, ray, np.asarray(ray_origins).reshape(-1, 3)[ray] + paths

    def intersects_location(self, ray_origins, ray_directions, **settings):
        """The hits as arrays: locations, index_ray, index_tri."""
        face, ray, locations = self.intersects_id(ray_origins, ray_directions,
                                                  return_locations=True, **settings)
        return locations, ray, face

    def intersects_first(self, ray_origins, ray_directions):
        """The first face that each ray hits, or -1."""
        face = self._cast("trace", ray_origins, ray_directions, results=("face",)).face
        return np.where(face == NOTHING, -1, face.astype(np.int64))

    def intersects_any(self, ray_origins, ray_directions):
        """Whether each ray hits the mesh."""
        return self._cast("occluded", ray_origins, ray_directions)

    def contains_points(self, points):
        """Whether each point is inside the mesh, which must be closed."""
        return self._cast("contains", points)
