# SPDX-License-Identifier: MIT
"""Arrays of rays, and of their hits, as libclrt takes and fills them."""

import dataclasses

import numpy as np

from .library import NOTHING, ArgumentError, numbers, rows, stride_of, struct


def _array(member, dtype, *shape):
    """A field of Hits: the member of ClrtHits, the type of its values and the shape of each."""
    return dataclasses.field(default=None, metadata={"made": (member, dtype, shape)})


@dataclasses.dataclass
class Hits:
    """What rays hit. Arrays have one element per ray, or per crossing of trace_all.

    distance: float64, in lengths of the ray's direction; infinity without a hit. primitive, mesh,
    face: uint32. primitive is the number that `starts` and the channel of this name take: first
    all spheres, then all faces but those with two corners at one place. mesh and face count from 0,
    as the meshes and their faces were given. Without a hit, and for the mesh and face of spheres,
    they are clrt.NOTHING. weights: float64, of shape (n, 2), those of the face's second and third
    corner; u and v are its columns. normal: float64, of shape (n, 3), the unit normal of the front.
    front: bool, whether the ray comes from the front. certain: bool, whether rounding cannot have
    changed the primitive; only on request, and not of trace_all. ray: the rays' numbers, of
    trace_all only. Arrays that were not requested are None.
    """

    distance: np.ndarray | None = _array("distances", np.float64)
    primitive: np.ndarray | None = _array("primitives", np.uint32)
    mesh: np.ndarray | None = _array("meshes", np.uint32)
    face: np.ndarray | None = _array("triangles", np.uint32)
    weights: np.ndarray | None = _array("weights", np.float64, 2)
    normal: np.ndarray | None = _array("normals", np.float64, 3)
    front: np.ndarray | None = _array("fronts", np.bool_)
    certain: np.ndarray | None = _array("certain", np.bool_)
    ray: np.ndarray | None = None

    @property
    def hit(self) -> np.ndarray:
        """Which rays hit something, as bools, from distance or primitive."""
        if self.primitive is None and self.distance is None:
            raise ArgumentError("neither 'distance' nor 'primitive' was requested")
        return np.isfinite(self.distance) if self.primitive is None else self.primitive != NOTHING

    u = property(lambda self: self.weights[:, 0])
    v = property(lambda self: self.weights[:, 1])


_ARRAYS = {field.name: field.metadata["made"] for field in dataclasses.fields(Hits)
           if field.metadata}
RESULTS = tuple(name for name in _ARRAYS if name != "certain")


def rays(origins, directions, *, near=None, far=None, starts=None, one_sided=False):
    """A ClrtRays. Renderer.trace describes the arguments."""
    origins, directions = np.asarray(origins), np.asarray(directions)
    shape = max(origins.shape, directions.shape, key=len)
    origins, directions = (
        rows(np.broadcast_to(array, shape) if array.ndim == 1 else array, np.float64, what)
        for array, what in ((origins, "origins"), (directions, "directions")))
    count = len(origins)
    if len(directions) != count:
        raise ArgumentError(f"there are {count} origins, but {len(directions)} directions")
    limits = {"nears": (near, np.float64), "fars": (far, np.float64), "starts": (starts, np.uint32)}
    limits = {name: np.ascontiguousarray(np.broadcast_to(numbers(values, dtype, name), count))
              for name, (values, dtype) in limits.items() if values is not None}
    return struct("ClrtRays", count=count, origins=origins, origin_stride=stride_of(origins),
                  directions=directions, direction_stride=stride_of(directions),
                  one_sided=one_sided, **limits)


def hit_arrays(results, count, room=1):
    """Arrays for the results of `count` rays with `room` hits each: ClrtHits, name -> array."""
    for unknown in set(results) - set(_ARRAYS):
        raise ArgumentError(f"{unknown!r} is not one of {', '.join(_ARRAYS)}")
    made = {name: (member, np.empty((count * room, *shape), dtype))
            for name, (member, dtype, shape) in _ARRAYS.items() if name in results}
    return struct("ClrtHits", room=room, **dict(made.values())), {
        name: array for name, (_, array) in made.items()}
