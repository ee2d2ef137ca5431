# SPDX-License-Identifier: MIT
"""Pictures as arrays: their settings, channels, hashes and differences."""

import functools
import struct as binary
import zlib
from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike

from .library import ArgumentError, described, ffi, lib


class Picture(np.ndarray):
    """A picture: a float32 array of shape (height, width, 3), R G B in [0, 1], top row first.

    channels maps the names of the requested channels to arrays of shape (height, width) or
    (height, width, components). result is a dict of ClrtResult in clrt.h.
    """

    channels: Mapping[str, np.ndarray] = {}
    result: Mapping[str, Any] = {}

    def __array_wrap__(self, array, *_):
        return array.view(Picture) if array.ndim else array[()]

    def _repr_png_(self) -> bytes | None:
        """PNG bytes for notebooks, with the values that `clrt -o FILE.png` writes."""
        if self.ndim != 3 or self.shape[2] != 3:
            return None
        height, width, _ = self.shape
        lines = np.zeros((height, 1 + 3 * width), np.uint8)
        lines[:, 1:] = np.rint(np.clip(self, 0, 1) * 255).reshape(height, -1)
        header = binary.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
        parts = ((b"IHDR", header), (b"IDAT", zlib.compress(lines.tobytes())), (b"IEND", b""))
        return b"\x89PNG\r\n\x1a\n" + b"".join(
            binary.pack(">I", len(data)) + kind + data + binary.pack(">I", zlib.crc32(kind + data))
            for kind, data in parts)


@functools.cache
def channel_kinds() -> dict[str, tuple[int, type, str]]:
    """The channels that render can make: name -> (components, dtype, help)."""
    kinds = [described("ClrtChannelInfo", "channel_get", i)
             for i in range(lib.clrt_channel_count())]
    return {kind["name"]: (kind["components"], np.uint32 if kind["is_integer"] else np.float32,
                           kind["help"]) for kind in kinds}


def channel_array(name, shape):
    """Zeros for a channel of a picture of this shape. The library rejects unknown names."""
    components, dtype, _ = channel_kinds().get(name, (1, np.float32, ""))
    return np.zeros(shape if components == 1 else (*shape, components), dtype)


def hash(picture: ArrayLike) -> str:  # pylint: disable=redefined-builtin
    """The 32 digits that `clrt SCENE --hash` prints for this picture."""
    pixels = np.ascontiguousarray(picture, np.float32)
    if pixels.ndim != 3 or pixels.shape[2] != 3:
        raise ArgumentError(f"the picture has the shape {pixels.shape}, not (height, width, 3)")
    text = ffi.new("char[33]")
    lib.clrt_hash(ffi.from_buffer("float[]", pixels), *pixels.shape[1::-1], text)
    return ffi.string(text).decode()


def compare(picture: ArrayLike, other: ArrayLike) -> dict[str, float]:
    """The differences of two pictures of one size, as a dict: rmse, psnr, largest, pixels."""
    a, b = np.asarray(picture, np.float64), np.asarray(other, np.float64)
    if a.shape != b.shape:
        raise ArgumentError(f"the pictures have the shapes {a.shape} and {b.shape}")
    apart = np.abs(a - b)
    rmse = np.sqrt(np.mean(apart**2))
    psnr = -20 * np.log10(rmse) if rmse > 0 else np.inf
    return {"rmse": float(rmse), "psnr": float(psnr), "largest": float(apart.max(initial=0)),
            "pixels": int((apart > 0).any(-1).sum())}
