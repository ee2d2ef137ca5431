# SPDX-License-Identifier: MIT
"""Devices, pictures of scenes, and rays cast at scenes."""

import dataclasses
import functools
import struct as bytes_struct
import threading
import zlib

import numpy as np

from . import library
from .library import NOTHING, call, ffi, rows, struct

_RESULTS = ("distance", "primitive", "mesh", "face", "weights", "normal", "front")
_GOALS = ("samples", "contrast", "error", "seconds", "max_level", "truncation")
_LIGHTS = ("behind", "reaches", "blocked", "behind face")


class Picture(np.ndarray):
    """A picture: a float32 array of shape (height, width, 3), R G B in [0, 1], top row first.

    channels maps the names of the requested channels to arrays of shape (height, width) or
    (height, width, components). result is a dict of ClrtResult in clrt.h.
    """

    def __new__(cls, pixels, channels=None, result=None):
        picture = np.asarray(pixels, np.float32).view(cls)
        picture.channels, picture.result = channels or {}, result or {}
        return picture

    def __array_finalize__(self, source):
        self.channels = getattr(source, "channels", {})
        self.result = getattr(source, "result", {})

    def _repr_png_(self):
        """PNG bytes for notebooks, with the values that `clrt -o FILE.png` writes."""
        if self.ndim != 3 or self.shape[2] != 3:
            return None
        values = np.rint(np.clip(np.asarray(self), 0, 1) * 255).astype(np.uint8)
        lines = np.zeros((values.shape[0], 1 + 3 * values.shape[1]), np.uint8)
        lines[:, 1:] = values.reshape(values.shape[0], -1)
        header = bytes_struct.pack(">IIBBBBB", values.shape[1], values.shape[0], 8, 2, 0, 0, 0)
        parts = ((b"IHDR", header), (b"IDAT", zlib.compress(lines.tobytes())), (b"IEND", b""))
        return b"\x89PNG\r\n\x1a\n" + b"".join(map(_png_part, parts))


def _png_part(part):
    kind, data = part
    check = zlib.crc32(kind + data)
    return bytes_struct.pack(">I", len(data)) + kind + data + bytes_struct.pack(">I", check)


@dataclasses.dataclass
class Hits:
    """What rays hit. Arrays have one element per ray, or per crossing of trace_all.

    distance: float64, in lengths of the ray's direction; infinity without a hit. primitive, mesh,
    face: uint32. primitive is the number that `starts` and the channel of this name take: first
    all spheres, then all faces but those with two corners at one place. mesh and face count from 0,
    as the meshes and their faces were given. Without a hit, and for the mesh and face of spheres,
    they are clrt.NOTHING. u, v: float64, the weights of the face's second and third corner
    (requested as "weights"). normal: float64, of shape (n, 3), the unit normal of the front.
    front: bool, whether the ray comes from the front. ray: the rays' numbers, of trace_all only.
    Arrays that were not requested are None.
    """

    distance: np.ndarray = None
    primitive: np.ndarray = None
    mesh: np.ndarray = None
    face: np.ndarray = None
    u: np.ndarray = None
    v: np.ndarray = None
    normal: np.ndarray = None
    front: np.ndarray = None
    ray: np.ndarray = None

    @property
    def hit(self):
        """Which rays hit something, as bools, from distance or primitive."""
        if self.primitive is not None:
            return self.primitive != NOTHING
        if self.distance is not None:
            return np.isfinite(self.distance)
        raise library.ArgumentError("neither 'distance' nor 'primitive' was requested")


class Renderer:
    """A device that draws pictures and casts rays. Keeps the last scene's tree between calls.

    device: as `clrt --device`: "cpu", "gpu", a part of a name or PLATFORM:DEVICE. threads build
    trees; PoCL's own threads follow POCL_MAX_PTHREAD_COUNT. precision: "fp32" or "fp64". Threads
    may share a renderer, but then wait for each other.
    """

    def __init__(self, device=None, threads=0, precision="fp32"):
        precisions = {"fp32": 0, "fp64": 1}
        settings = struct("ClrtSettings", device=device, threads=threads,
                          precision=precisions[precision])
        self._handle = library.handle("renderer_create", settings, free="renderer")
        self._lock = threading.Lock()

    def render(self, scene, width=0, height=0, *, view=1, camera=None, samples=0, contrast=0.0,
               error=0.0, seconds=0.0, max_level=None, truncation=0.0, crop=None, channels=(),
               statistics=False, progress=None):
        """Draws the scene and returns a Picture.

        width, height: in pixels; 0 is the scene's size. view: number of the scene's view, from 1.
        camera: a Camera to use instead. samples: N for N x N per pixel. contrast, error, seconds:
        goals that choose the samples. crop: (left, top, width, height). channels: names as in
        `clrt --aov`, such as "depth", "primitive", "normal", "certainty". progress: a function of
        (done, all) that may return False to stop, or True for a bar by tqdm.
        """
        picture, kept = self._request(locals())
        shape = (crop[3], crop[2]) if crop else self._size(scene, width, height)
        made = {name: _channel_array(name, shape) for name in channels}
        names = [ffi.new("char[]", name.encode()) for name in made]
        array = ffi.new("ClrtChannel[]", max(len(made), 1))
        for i, (name, values) in enumerate(zip(names, made.values())):
            array[i].name, array[i].values = name, ffi.from_buffer(values)
        result = struct("ClrtResult")
        picture.channels, picture.channel_count, picture.result = array, len(made), result
        pixels = np.zeros((*shape, 3), np.float32)
        self._draw("render", scene, picture, pixels, progress)
        return Picture(pixels, made, library.values_of(result))

    def reference(self, scene, width=0, height=0, *, view=1, camera=None, samples=256,
                  progress=None):
        """Draws the same picture with `samples` samples per pixel and the accuracy of fp64."""
        picture, kept = self._request(dict(width=width, height=height, view=view, camera=camera))
        result = struct("ClrtResult")
        picture.reference_samples, picture.result = samples, result
        pixels = np.zeros((*self._size(scene, width, height), 3), np.float32)
        self._draw("reference", scene, picture, pixels, progress)
        return Picture(pixels, {}, library.values_of(result))

    def explain(self, scene, x, y, width=0, height=0, *, view=1, camera=None, samples=0,
                max_level=None):
        """How clrt computes the color of the pixel in column x and row y, as a dict.

        Its "samples" have "rays", and these have "lights"; clrt.h describes the members.
        """
        picture, kept = self._request(locals())
        pixel = ffi.new("uint32_t[2]", [x, y])
        with self._lock:
            explanation = library.handle("explain", self._handle, scene._handle, picture, pixel,
                                         free="explanation")
        part = functools.partial(_explained, explanation)
        made = part("pixel", "ClrtExplainedPixel")
        made["samples"] = [part("sample", "ClrtExplainedSample", i)
                           for i in range(made["sample_count"])]
        for i, sample in enumerate(made["samples"]):
            sample["rays"] = [part("ray", "ClrtExplainedRay", i, k)
                              for k in range(sample["ray_count"])]
            for k, ray in enumerate(sample["rays"]):
                ray["lights"] = [part("light", "ClrtExplainedLight", i, k, light)
                                 for light in range(ray["light_count"])]
        return made

    def trace(self, scene, origins, directions, *, near=None, far=None, starts=None,
              one_sided=False, results=_RESULTS, progress=None):
        """Finds the nearest hit of each ray and returns Hits.

        origins, directions: (n, 3) numbers, or three for all rays; float64 arrays are not copied.
        near, far: limits of the distance, one number or n. starts: the primitive on which each ray
        starts (Hits.primitive), so that it is not hit again, or clrt.NOTHING; without `near`.
        one_sided: rays pass the backs of meshes that are not two-sided; otherwise all faces stop
        rays from both sides. results: what to compute; fewer take less time.
        """
        rays = _Rays(origins, directions, near, far, starts, one_sided)
        return self._hits("trace", scene, rays, results, 1, progress)[0]

    def trace_all(self, scene, origins, directions, *, near=None, far=None, starts=None,
                  one_sided=False, results=_RESULTS, progress=None):
        """Finds all faces that the rays cross, and returns Hits ordered by ray, then by distance.

        A ray through an edge or vertex of a closed mesh crosses it in one face. Spheres do not
        count.
        """
        rays = _Rays(origins, directions, near, far, starts, one_sided)
        counts = self._hits("trace_all", scene, rays, (), 0, None)[1]
        room = max(int(counts.max(initial=0)), 1)
        hits, _ = self._hits("trace_all", scene, rays, {*results, "primitive"}, room, progress)
        found = np.arange(room) < counts[:, None]
        hits.ray = np.nonzero(found)[0]
        for name, values in vars(hits).items():
            if name != "ray" and values is not None:
                setattr(hits, name, values.reshape(*found.shape, *values.shape[1:])[found])
        return hits

    def occluded(self, scene, origins, directions, *, near=None, far=None, starts=None,
                 one_sided=False, progress=None):
        """Whether each ray hits anything, as an array of bools."""
        rays = _Rays(origins, directions, near, far, starts, one_sided)
        return self._flags("occluded", scene, rays, progress)

    def contains(self, scene, points, *, progress=None):
        """Whether each point is inside of the scene's meshes, which must be closed."""
        points = rows(points, np.float64, 3, "points")
        return self._flags("contains", scene, _Rays(points, (0, 0, 1)), progress)

    def _size(self, scene, width, height):
        info = scene.info if not (width and height) else {}
        return height or info["height"], width or info["width"]

    def _request(self, given):
        crop, camera, max_level = given.get("crop"), given.get("camera"), given.get("max_level")
        members = {name: given[name] for name in _GOALS if given.get(name) and name != "max_level"}
        if crop:
            members.update(zip(("left", "top", "crop_width", "crop_height"), crop))
        if max_level is not None:
            members["max_level"] = max_level or -1
        kept = camera and camera._struct()
        members.update(width=given["width"], height=given["height"], view=given["view"])
        members.update(camera=kept, statistics=given.get("statistics", False))
        return struct("ClrtPicture", **members), kept

    def _draw(self, kind, scene, picture, pixels, progress):
        callback, close = library.progress_of(progress)
        picture.progress = callback or ffi.NULL
        try:
            with self._lock:
                call(kind, self._handle, scene._handle, picture, ffi.from_buffer("float[]", pixels))
        finally:
            close()

    def _cast(self, kind, scene, rays, target, progress):
        callback, close = library.progress_of(progress)
        rays.struct.progress = callback or ffi.NULL
        try:
            with self._lock:
                call(kind, self._handle, scene._handle, rays.struct, target)
        finally:
            close()

    def _flags(self, kind, scene, rays, progress):
        flags = np.empty(rays.count, np.bool_)
        self._cast(kind, scene, rays, ffi.from_buffer("uint8_t[]", flags.view(np.uint8)), progress)
        return flags

    def _hits(self, kind, scene, rays, results, room, progress):
        n = rays.count * room
        counts = np.zeros(rays.count, np.uint32)
        arrays = {
            "distance": np.empty(n), "primitive": np.empty(n, np.uint32),
            "mesh": np.empty(n, np.uint32), "face": np.empty(n, np.uint32),
            "weights": np.empty((n, 2)), "normal": np.empty((n, 3)), "front": np.empty(n, np.bool_)}
        for unknown in set(results) - set(arrays):
            raise library.ArgumentError(f"{unknown!r} is not one of {', '.join(_RESULTS)}")
        wanted = {name: array for name, array in arrays.items() if name in results}
        members = {"face": "triangles", "primitive": "primitives", "mesh": "meshes"}
        given = {members.get(name, name + "s" * (name != "weights")): array
                 for name, array in wanted.items()}
        if kind == "trace_all":
            given["counts"] = counts
        target = struct("ClrtHits", room=room, **given)
        self._cast(kind, scene, rays, target, progress)
        if "weights" in wanted:
            weights = wanted.pop("weights")
            wanted.update(u=weights[:, 0], v=weights[:, 1])
        return Hits(**wanted), counts


class _Rays:
    """Rays as the library takes them."""

    def __init__(self, origins, directions, near=None, far=None, starts=None, one_sided=False):
        origins, directions = np.asarray(origins, np.float64), np.asarray(directions, np.float64)
        if origins.ndim == 1 and directions.ndim == 2:
            origins = np.broadcast_to(origins, directions.shape)
        if directions.ndim == 1:
            directions = np.broadcast_to(directions, origins.shape)
        origins = rows(origins, np.float64, 3, "origins")
        directions = rows(directions, np.float64, 3, "directions")
        self.count = len(origins)
        if len(directions) != self.count:
            raise library.ArgumentError(f"{self.count} origins, but {len(directions)} directions")
        self.struct = struct("ClrtRays", count=self.count, origins=origins, directions=directions,
                             nears=self._per_ray(near, np.float64),
                             fars=self._per_ray(far, np.float64),
                             starts=self._per_ray(starts, np.uint32), one_sided=one_sided)

    def _per_ray(self, values, dtype):
        if values is None:
            return None
        values = np.asarray(values)
        if dtype is np.uint32:
            library.check_unsigned(values, "start")
        return np.ascontiguousarray(np.broadcast_to(values.astype(dtype), (self.count,)))


def _explained(explanation, kind, struct_kind, *place):
    part = struct(struct_kind)
    places = {0: (), 1: place}.get(len(place), (ffi.new("uint32_t[]", list(place)),))
    call("explanation_get_" + kind, explanation, *places, part)
    values = library.values_of(part)
    if kind == "light":
        values["state"] = _LIGHTS[values["state"]]
    return values


@functools.cache
def channel_kinds():
    """The channels that render can make: name -> (components, dtype, help)."""
    kinds = {}
    for i in range(library.plain("channel_count")):
        info = struct("ClrtChannelInfo")
        call("channel_get", i, info)
        values = library.values_of(info)
        dtype = np.uint32 if values["is_integer"] else np.float32
        kinds[values["name"]] = (values["components"], dtype, values["help"])
    return kinds


def _channel_array(name, shape):
    kinds = channel_kinds()
    if name not in kinds:
        raise library.ArgumentError(f"{name!r} is no channel; there are {', '.join(kinds)}")
    components, dtype, _ = kinds[name]
    return np.zeros(shape if components == 1 else (*shape, components), dtype)


def devices():
    """The OpenCL devices, as dicts. "device" is the name for Renderer(device=)."""
    count = ffi.new("uint32_t *")
    call("device_count", count)
    made = [struct("ClrtDevice") for _ in range(count[0])]
    for i, device in enumerate(made):
        call("device_get", i, device)
    return [library.values_of(device) for device in made]


def hash(picture):  # pylint: disable=redefined-builtin
    """The 32 digits that `clrt SCENE --hash` prints for this picture."""
    pixels = np.ascontiguousarray(picture, np.float32)
    text = ffi.new("char[33]")
    height, width = pixels.shape[:2]
    library.plain("hash", ffi.from_buffer("float[]", pixels), width, height, text)
    return ffi.string(text).decode()


def compare(picture, other):
    """The differences of two pictures of one size, as a dict: rmse, psnr, largest, pixels."""
    a, b = np.asarray(picture, np.float64), np.asarray(other, np.float64)
    if a.shape != b.shape:
        raise library.ArgumentError(f"the pictures have the shapes {a.shape} and {b.shape}")
    apart = np.abs(a - b)
    rmse = float(np.sqrt(np.mean(apart**2)))
    return {"rmse": rmse, "psnr": float("inf") if rmse == 0 else -20 * float(np.log10(rmse)),
            "largest": float(apart.max(initial=0)), "pixels": int((apart > 0).any(-1).sum())}


_default_lock = threading.Lock()


def default_renderer():
    """The renderer of Scene.render, opened at the first call."""
    with _default_lock:
        return _default_renderer()


@functools.cache
def _default_renderer():
    return Renderer()
