# SPDX-License-Identifier: MIT
"""Pictures, rays and hits as numpy arrays."""

import functools
import struct as binary
import zlib
from dataclasses import dataclass, field, fields
from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike

from .library import (NOTHING, ArgumentError, choices, ffi, fractions, lib, numbers, result_of,
                      struct, threes)


class Picture(np.ndarray):
    """A picture: a float32 array of shape (height, width, 3), R G B in [0, 1], top row first.

    `channels` maps the names of the requested channels to arrays of shape (height, width) or
    (height, width, components). `result` has the members of ClrtResult in clrt.h.
    """

    channels: Mapping[str, np.ndarray] = {}
    result: Mapping[str, Any] = {}

    def __array_wrap__(self, array, *_):
        return array.view(Picture) if array.ndim else array[()]

    def _repr_png_(self) -> bytes | None:
        """PNG bytes for notebooks, with the pixels of `clrt SCENE -o picture.png`."""
        if self.ndim != 3 or self.shape[2] != 3:
            return None
        height, width, _ = self.shape
        lines = np.zeros((height, 1 + 3 * width), np.uint8)
        # Rounds as framebuffer_encode in host/image/framebuffer.c does. fmin turns NaN into 1.
        shown = np.fmax(np.fmin(self, 1), 0).astype(np.float64)
        lines[:, 1:] = (shown * 255 + 0.5).reshape(height, -1)
        header = binary.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
        parts = ((b"IHDR", header), (b"IDAT", zlib.compress(lines.tobytes())), (b"IEND", b""))
        return b"\x89PNG\r\n\x1a\n" + b"".join(
            binary.pack(">I", len(data)) + kind + data + binary.pack(">I", zlib.crc32(kind + data))
            for kind, data in parts)


@functools.cache
def channel_kinds() -> dict[str, tuple[int, type, str]]:
    """The channels that Renderer.render can draw: name -> (components, dtype, help)."""
    kinds = [result_of("channel_get", i) for i in range(lib.clrt_channel_count())]
    return {kind["name"]: (kind["components"], np.uint32 if kind["is_integer"] else np.float32,
                           kind["help"]) for kind in kinds}


def channel_array(name, shape):
    """Zeros for a channel of a picture of this shape."""
    components, dtype, _ = channel_kinds()[name]
    return np.zeros(shape if components == 1 else (*shape, components), dtype)


def _pixels(picture, what="the picture"):
    return threes(np.ascontiguousarray(fractions(picture)), what, "height", "width")


def hash(picture: ArrayLike) -> str:  # pylint: disable=redefined-builtin
    """The 32 digits that `clrt SCENE --hash` prints for this picture."""
    pixels = _pixels(picture).astype(np.float32, copy=False)
    text = ffi.new("char[33]")
    lib.clrt_hash(ffi.from_buffer("float[]", pixels), *pixels.shape[1::-1], text)
    return ffi.string(text).decode()


def compare(picture: ArrayLike, other: ArrayLike) -> dict[str, float]:
    """The differences of two pictures of one size, as a dict: rmse, psnr, largest, pixels.

    Pictures have the shape (height, width, 3). Values of uint8 or uint16 become numbers in [0, 1].
    """
    a, b = _pixels(picture), _pixels(other, "the other picture")
    if a.shape != b.shape:
        raise ArgumentError(f"the pictures have the shapes {a.shape} and {b.shape}")
    for y, x, color in np.argwhere(~(np.isfinite(a) & np.isfinite(b)))[:1]:
        raise ArgumentError(f"{'RGB'[color]} of pixel {x},{y} is not finite")
    apart = np.abs(a.astype(np.float64) - b)
    rmse = np.sqrt(np.mean(apart**2)) if apart.size else 0.0
    psnr = -20 * np.log10(rmse) if rmse > 0 else np.inf
    return {"rmse": float(rmse), "psnr": float(psnr), "largest": float(apart.max(initial=0)),
            "pixels": int((apart > 0).any(-1).sum())}


@dataclass
class Hits:
    """The hits of rays. Arrays have one element per ray, or per crossing of trace_all.

    distance: float64, in lengths of the ray's direction; infinity without a hit. primitive, mesh,
    face: uint32, clrt.NOTHING without a hit. `primitive` is an id, as in `starts` and in the
    channel "primitive": first all spheres, then all faces except those with two corners at one
    place. `mesh` and `face` count from 0, in the given order, and are clrt.NOTHING for spheres.
    weights: float64 (n, 2), barycentric, of the face's second and third corner; u and v are the
    columns. normal: float64 (n, 3), the unit normal of the front side. front: bool, whether the ray
    hits the front side. certain: bool, whether rounding cannot have changed the primitive; only on
    request, and not from trace_all. ray: the number of the ray, only from trace_all. Arrays that
    were not requested are None.
    """

    distance: np.ndarray | None = field(default=None, metadata={"distances": "f8"})
    primitive: np.ndarray | None = field(default=None, metadata={"primitives": "u4"})
    mesh: np.ndarray | None = field(default=None, metadata={"meshes": "u4"})
    face: np.ndarray | None = field(default=None, metadata={"triangles": "u4"})
    weights: np.ndarray | None = field(default=None, metadata={"weights": np.dtype("2f8")})
    normal: np.ndarray | None = field(default=None, metadata={"normals": np.dtype("3f8")})
    front: np.ndarray | None = field(default=None, metadata={"fronts": "?"})
    certain: np.ndarray | None = field(default=None, metadata={"certain": "?"})
    ray: np.ndarray | None = None

    @property
    def hit(self) -> np.ndarray:
        """Whether each ray hits something, as bools."""
        if self.primitive is None and self.distance is None:
            raise ArgumentError("neither 'distance' nor 'primitive' was requested")
        return np.isfinite(self.distance) if self.primitive is None else self.primitive != NOTHING

    def _weight(self, column):
        if self.weights is None:
            raise ArgumentError("'weights' was not requested")
        return self.weights[:, column]

    u = property(lambda self: self._weight(0))
    v = property(lambda self: self._weight(1))


_ARRAYS = {array.name: item for array in fields(Hits) for item in array.metadata.items()}
RESULTS = tuple(name for name in _ARRAYS if name != "certain")


def rays(origins, directions, *, near=None, far=None, starts=None, **settings):
    """A ClrtRays. Renderer.trace describes the arguments. `settings` are more of its members."""
    origins = numbers(origins, np.float64, "origins")
    directions = numbers(directions, np.float64, "directions")
    axis = next((array.shape[:1] for array in (origins, directions) if array.shape != (3,)), ())
    origins, directions = (
        rows(np.broadcast_to(array, (*axis, 3)) if array.shape == (3,) else array, np.float64, what)
        for array, what in ((origins, "origins"), (directions, "directions")))
    count = len(origins)
    if len(directions) != count:
        raise ArgumentError(f"there are {count} origins, but {len(directions)} directions")
    limits = (("nears", near, "near", np.float64), ("fars", far, "far", np.float64),
              ("starts", starts, "starts", np.uint32))
    settings |= {member: np.ascontiguousarray(numbers(values, dtype, what, count))
                 for member, values, what, dtype in limits if values is not None}
    return struct("ClrtRays", count=count, origins=origins, origin_stride=origins.strides[0],
                  directions=directions, direction_stride=directions.strides[0], **settings)


def rays_from(given, first, count):
    """A ClrtRays for `count` of the given rays. Its arrays live as long as the given ClrtRays."""
    made = ffi.new("ClrtRays *", given[0])
    made.count = count
    sizes = {"origins": given.origin_stride, "directions": given.direction_stride, "nears": 8,
             "fars": 8, "starts": 4}
    for name, size in sizes.items():
        if array := getattr(given, name):
            start = ffi.cast("char *", array) + first * size
            setattr(made, name, ffi.cast(ffi.typeof(array), start))
    return made


def hit_arrays(results, count, room=1):
    """A ClrtHits for `count` rays with `room` hits each, and a dict of its arrays."""
    arrays = {name: np.empty(count * room, _ARRAYS[name][1])
              for name in choices([*_ARRAYS], results, "a result")}
    members = {_ARRAYS[name][0]: array for name, array in arrays.items()}
    return struct("ClrtHits", room=room, **members), arrays


def rows(values, dtype, what, is_dense=False):
    """An array of the shape (n, 3) with contiguous rows. Copies `values` only if necessary."""
    made = threes(numbers(values, dtype, what), what, "n")
    size, (row, column) = made.itemsize, made.strides
    is_in_rows = column == size and row >= 3 * size and made.flags.aligned
    return made if is_in_rows and (row == 3 * size or not is_dense) else made.copy()
