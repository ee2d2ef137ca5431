# SPDX-License-Identifier: MIT
"""Renderers, which draw pictures and cast rays on devices."""

import functools
import threading
from typing import Any, Callable, Iterable

import numpy as np
from numpy.typing import ArrayLike

from .arrays import (RESULTS, Hits, Picture, channel_kinds, hit_arrays, picture_of, rays,
                     rays_struct, strided)
from .library import (NUMBER, c_value, call, choices, ffi, instance, lib, parts, progress_of,
                      result_of, struct, use_device, value_of)
from .scene import Camera, Scene

Progress = bool | Callable[[int, int], bool | None] | None
_ENTRIES = 1 << 23  # trace_all reserves memory for at most this many crossings at once.


class Renderer:
    """A device that draws pictures and casts rays. Keeps the last scene's tree between calls.

    device: as for `clrt --device`: "cpu", "gpu", a part of a name or PLATFORM:DEVICE. threads: the
    number of threads for trees, refining and converting rays; POCL_MAX_PTHREAD_COUNT limits PoCL's
    own threads. precision: "fp32" or "fp64". Python's threads may share a renderer, but wait for
    each other. Most calls take `progress`: True for a bar by tqdm, or a function of (done, all)
    that may return False to stop the call.
    """

    def __init__(self, device: str | None = None, threads: int = 0, precision: str = "fp32"):
        use_device()
        settings = struct("ClrtSettings", device=device, threads=threads, precision=precision)
        self._handle = ffi.gc(call("renderer_create", settings), lib.clrt_renderer_free)
        self._lock = threading.Lock()

    def render(self, scene: Scene, width: int = 0, height: int = 0, *,
               channels: Iterable[str] = (), progress: Progress = None, **settings: Any) -> Picture:
        """Draws the scene and returns a Picture.

        width, height: in pixels; 0 is the scene's size. channels: names as in `clrt --aov`, such as
        "depth", "primitive", "normal", "certainty". crop: (left, top, width, height). view: the
        number of the scene's view, from 1. camera: a Camera to use instead of a view. Further
        settings are members of ClrtPicture in clrt.h, such as samples (N of N x N samples per
        pixel), error, max_level and statistics. An error below 1.6e-4 requires
        Renderer(precision="fp64"). With reference_samples, draws the picture's reference.
        """
        picture = _request(width, height, result=struct("ClrtResult"), **settings)
        info = instance(scene, Scene, "scene").info
        shape = (picture.crop_height or height or info["height"],
                 picture.crop_width or width or info["width"])
        kinds, arrays = channel_kinds(), {}
        for name in choices(kinds, channels, "a channel"):
            components, dtype, _ = kinds[name]
            arrays[name] = np.zeros(shape if components == 1 else (*shape, components), dtype)
        names = [ffi.new("char[]", name.encode()) for name in arrays]
        array = ffi.new("ClrtChannel[]", [*zip(names, map(ffi.from_buffer, arrays.values()))])
        picture.channels, picture.channel_count = array, len(arrays)
        pixels = np.zeros((*shape, 3), np.float32)
        kind = "reference" if picture.reference_samples else "render"
        self._call(kind, scene, picture, pixels, progress=progress)
        result = value_of(picture.result[0], ffi.typeof("ClrtResult"))
        return picture_of(pixels, {"channels": arrays, "result": result})

    def explain(self, scene: Scene, x: int, y: int, width: int = 0, height: int = 0,
                **settings: Any) -> dict[str, Any]:
        """Explains the color of the pixel in column x and row y. Returns a dict.

        The dict has "samples", each sample "rays", and each ray "lights". clrt.h has their members.
        """
        place = [c_value(x, NUMBER, "x"), c_value(y, NUMBER, "y")]
        explanation = self._call("explain", scene, _request(width, height, **settings), place)
        return _explained(ffi.gc(explanation, lib.clrt_explanation_free))

    def trace(self, scene: Scene, origins: ArrayLike, directions: ArrayLike, *,
              results: Iterable[str] = RESULTS, progress: Progress = None, **limits: Any) -> Hits:
        """Finds the nearest hit of each ray and returns Hits.

        origins, directions: (n, 3) numbers, or three for all rays; float64 arrays are not copied.
        results: names of arrays of Hits; "certain" takes longer than the others. near, far: limits
        of the distance, as n numbers or as one for all rays. starts: the primitive on which each
        ray starts (Hits.primitive), or clrt.NOTHING; the ray does not hit this primitive again,
        except a sphere from inside. one_sided: rays pass through the backs of faces that are not
        two_sided.
        """
        given = rays_struct(rays(origins, directions, **limits))
        target, arrays = hit_arrays(results, given.count)
        self._call("trace", scene, given, target, progress=progress)
        return Hits(**arrays)

    def trace_all(self, scene: Scene, origins: ArrayLike, directions: ArrayLike, *,
                  results: Iterable[str] = RESULTS, progress: Progress = None,
                  **limits: Any) -> Hits:
        """Finds all faces and spheres that rays cross. Orders Hits by ray, then by distance.

        A ray that enters or leaves a closed mesh through an edge or vertex crosses an odd number of
        faces there, usually one. A ray crosses a sphere where it enters and where it leaves. If
        rays cross very many faces, the counts that `progress` gets may start again.
        """
        given, results = rays(origins, directions, **limits), choices(RESULTS, results, "a result")
        counts, groups = np.zeros(len(given["origins"]), np.uint32), []
        self._call("trace_all", scene, rays_struct(given), struct("ClrtHits", counts=counts))
        step = max(_ENTRIES // max(int(counts.max(initial=0)), 1), 1)
        for first in range(0, max(len(counts), 1), step):
            part = slice(first, first + step)
            room = max(int(counts[part].max(initial=0)), 1)
            target, arrays = hit_arrays({*results, "primitive"}, len(counts[part]), room)
            self._call("trace_all", scene, rays_struct(given, part), target, progress=progress)
            found = (np.arange(room) < counts[part, None]).ravel()
            groups.append({name: array[found] for name, array in arrays.items()})
        return Hits(ray=np.repeat(np.arange(len(counts)), counts),
                    **{name: np.concatenate([group[name] for group in groups])
                       for name in groups[0]})

    def occluded(self, scene: Scene, origins: ArrayLike, directions: ArrayLike, *,
                 progress: Progress = None, **limits: Any) -> np.ndarray:
        """Whether each ray hits anything, as an array of bools."""
        return self._flags("occluded", scene, rays(origins, directions, **limits), progress)

    def contains(self, scene: Scene, points: ArrayLike, *, progress: Progress = None) -> np.ndarray:
        """Whether each point is inside an odd number of meshes and spheres, as bools.

        The meshes must be closed, which `check` finds out. Results for open meshes are meaningless.
        """
        return self._flags("contains", scene, {"origins": strided(points, "points")}, progress)

    def check(self, scene: Scene) -> dict[str, Any]:
        """The facts about the scene's geometry that `clrt check` reports, as a dict.

        "fine" is True if no finding is a fault. "meshes" and "findings" are lists of dicts with the
        members of ClrtCheckedMesh and ClrtFinding in clrt.h.
        """
        check = ffi.gc(self._call("check", scene), lib.clrt_check_free)
        info = result_of("check_get_info", check)
        meshes = [result_of("check_get_mesh", check, i) for i in range(info["mesh_count"])]
        findings = [result_of("check_get_finding", check, i) for i in range(info["finding_count"])]
        return {"fine": info["fine"], "meshes": meshes, "findings": findings}

    def _flags(self, kind, scene, given, progress):
        flags = np.empty(len(given["origins"]), np.bool_)
        self._call(kind, scene, rays_struct(given), flags, progress=progress)
        return flags

    def _call(self, kind, scene, *arguments, progress=None):
        """Calls clrt_KIND. The first of the arguments, if any, is a struct that takes `progress`."""
        use_device()
        handle = instance(scene, Scene, "scene")._handle
        with progress_of(progress) as function, self._lock:
            for request in arguments[:1]:
                request.progress = function
            return call(kind, self._handle, handle, *arguments)


def _request(width, height, crop=None, camera=None, max_level=None, **settings):
    """A ClrtPicture with the settings as its members."""
    rectangle = zip(("left", "top", "crop_width", "crop_height"),
                    parts(crop or (0, 0, 0, 0), "crop", "left", "top", "width", "height"))
    camera = None if camera is None else instance(camera, Camera, "camera")._struct()
    return struct("ClrtPicture", width=width, height=height, camera=camera, **dict(rectangle),
                  max_level=-1 if max_level == 0 else max_level, **settings)


def _explained(explanation, *place):
    """The part of an explanation at `place`: (), or the numbers of a sample, a ray and a light."""
    kind, *parts = ("pixel", "sample", "ray", "light")[len(place):]
    values = result_of("explanation_get_" + kind, explanation,
                       *(place if len(place) < 2 else [place]))
    for part in parts[:1]:
        values[part + "s"] = [_explained(explanation, *place, i)
                              for i in range(values[part + "_count"])]
    return values


def devices() -> list[dict[str, Any]]:
    """The OpenCL devices, as dicts. A dict's "device" is the argument of Renderer(device=)."""
    use_device()
    return [result_of("device_get", i) for i in range(result_of("device_count"))]


# Returns the renderer that Scene.render and trimesh.py use by default. The first call opens it.
default_renderer = functools.cache(Renderer)
