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
    (height, width, components). `result` has the members of ClrtResult in clrt.h. Copies and pickles
    keep both. Slices and results of arithmetic have neither. copy.copy() and copy() share channels.
    """

    channels: Mapping[str, np.ndarray] = {}
    result: Mapping[str, Any] = {}

    def __array_wrap__(self, array, *_):
        return array.view(Picture) if array.ndim else array[()]

    def __reduce__(self):
        return picture_of, (np.asarray(self), self.__dict__)

    def copy(self, order="C"):
        return picture_of(np.array(self, order=order), self.__dict__)

    __copy__, __deepcopy__ = copy, None  # copy.deepcopy calls __reduce__

    def _repr_png_(self) -> bytes | None:
        """PNG bytes for notebooks, with the pixels of `clrt SCENE -o picture.png`."""
        if self.ndim != 3 or self.shape[2] != 3 or self.size == 0:
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


def picture_of(pixels, members):
    """Returns the array `pixels` as a Picture with these members."""
    made = pixels.view(Picture)
    made.__dict__.update(members)
    return made


@functools.cache
def channel_kinds() -> dict[str, tuple[int, type, str]]:
    """The channels that Renderer.render can draw: name -> (components, dtype, help)."""
    kinds = [result_of("channel_get", i) for i in range(lib.clrt_channel_count())]
    return {kind["name"]: (kind["components"], np.uint32 if kind["is_integer"] else np.float32,
                           kind["help"]) for kind in kinds}


def _pixels(picture, dtype, what="the picture"):
    return threes(fractions(picture), dtype, what, "height", "width")


def hash(picture: ArrayLike) -> str:  # pylint: disable=redefined-builtin
    """The 32 digits that `clrt SCENE --hash` prints for this picture."""
    pixels = np.ascontiguousarray(_pixels(picture, np.float32))
    text = ffi.new("char[33]")
    lib.clrt_hash(ffi.from_buffer("float[]", pixels), *pixels.shape[1::-1], text)
    return ffi.string(text).decode()


def compare(picture: ArrayLike, other: ArrayLike) -> dict[str, float]:
    """The differences of two pictures of one size, as a dict: rmse, psnr, largest, pixels.

    Pictures have the shape (height, width, 3). Values of uint8 or uint16 become numbers in [0, 1].
    """
    a, b = _pixels(picture, np.float64), _pixels(other, np.float64, "the other picture")
    if a.shape != b.shape:
        raise ArgumentError(f"the pictures have the shapes {a.shape} and {b.shape}")
    for y, x, color in np.argwhere(~(np.isfinite(a) & np.isfinite(b)))[:1]:
        raise ArgumentError(f"{'RGB'[color]} of pixel {x},{y} is not finite")
    apart = np.abs(a - b)
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
        if self.primitive is None:
            return np.isfinite(self._given("distance"))
        return self.primitive != NOTHING

    def _given(self, name):
        if getattr(self, name) is None:
            raise ArgumentError(f"'{name}' was not requested")
        return getattr(self, name)

    u = property(lambda self: self._given("weights")[:, 0])
    v = property(lambda self: self._given("weights")[:, 1])


_ARRAYS = {array.name: item for array in fields(Hits) for item in array.metadata.items()}
RESULTS = tuple(name for name in _ARRAYS if name != "certain")


def rays(origins, directions, *, near=None, far=None, starts=None, one_sided=None):
    """The members of a ClrtRays as a dict. Renderer.trace describes the arguments."""
    given = {"origins": numbers(origins, np.float64, "origins"),
             "directions": numbers(directions, np.float64, "directions")}
    axis = next((array.shape[:1] for array in given.values() if array.shape != (3,)), ())
    for what, array in given.items():
        is_one = array.shape == (3,)
        given[what] = strided(np.broadcast_to(array, (*axis, 3)) if is_one else array, what)
    count, other = map(len, given.values())
    if count != other:
        raise ArgumentError(f"there are {count} origins, but {other} directions")
    limits = (("nears", near, "near", np.float64), ("fars", far, "far", np.float64),
              ("starts", starts, "starts", np.uint32))
    return given | {"one_sided": one_sided} | {
        member: np.ascontiguousarray(numbers(values, dtype, what, count))
        for member, values, what, dtype in limits if values is not None}


def rays_struct(given, part=slice(None)):
    """A ClrtRays for a slice of the rays with these members."""
    members = {name: value[part] if isinstance(value, np.ndarray) else value
               for name, value in given.items()}
    strides = {f"{name[:-1]}_stride": members[name].strides[0]
               for name in ("origins", "directions") if name in members}
    return struct("ClrtRays", count=len(members["origins"]), **members, **strides)


def strided(values, what):
    """An array of the shape (n, 3) for ClrtRays. Copies only if its rows are not contiguous."""
    made = threes(values, np.float64, what, "n")
    row, column = made.strides
    return made if column == 8 and row >= 24 and made.flags.aligned else made.copy()


def hit_arrays(results, count, room=1):
    """A ClrtHits for `count` rays with `room` hits each, and a dict of its arrays."""
    arrays = {name: np.empty(count * room, _ARRAYS[name][1])
              for name in choices(_ARRAYS, results, "a result")}
    members = {_ARRAYS[name][0]: array for name, array in arrays.items()}
    return struct("ClrtHits", room=room, **members), arrays
