# SPDX-License-Identifier: MIT
"""Scenes for pictures and rays."""

import dataclasses
import os
import sys
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .arrays import Picture
from .library import (VECTOR, ArgumentError, c_value, call, choices, ffi, fractions, lib, parts,
                      result_of, struct, threes)

_MATERIALS = ("silhouette", "matte", "blinn_phong", "mirror")


@dataclasses.dataclass
class Camera:
    """A camera at `eye`. `fov` is the vertical field of view in degrees.

    If `height` is above 0, the camera is orthographic, and its pictures show `height` scene units.
    Across, narrow pictures show at least `width` units or, in perspective, `width_degrees` degrees.
    """

    eye: ArrayLike
    look_at: ArrayLike = (0, 0, 0)
    up: ArrayLike = (0, 0, 1)
    fov: float = 45.0
    height: float = 0.0
    width: float = 0.0
    width_degrees: float = 0.0

    def __post_init__(self):
        for name in ("eye", "look_at", "up"):
            setattr(self, name, c_value(getattr(self, name), VECTOR, name))

    def _struct(self):
        members = dict(vars(self))
        return struct("ClrtCamera", fov_degrees=members.pop("fov"), **members)


class Scene:
    """A scene, at first empty and with a white background. `load` reads a scene from a file."""

    def __init__(self, handle: Any = None):
        self._handle = ffi.gc(handle or call("scene_create"), lib.clrt_scene_free)

    def material(self, shading: str = "blinn_phong", *, diffuse: ArrayLike = (1, 1, 1),
                 specular: ArrayLike = (1, 1, 1), kd: float = 0.8, ks: float = 0.5,
                 shininess: float = 50.0, reflectivity: float = 0.0,
                 checker: tuple[float, ArrayLike, ArrayLike] | None = None, ior: float = 1.5) -> int:
        """Adds a material and returns its number. clrt.h has the formulas of colors.

        shading: "silhouette", "matte", "blinn_phong" or "glass". Glass uses only `ior` and
        `diffuse`, which is the color of refracted light. Colors are R G B in [0, 1]. checker: the
        size of cubes and two colors for them, instead of `diffuse`. The cube from (0, 0, 0) to
        (size, size, size) has the first color.
        """
        size, even, odd = parts(checker or (0, None, None), "checker", "size", "color", "color")
        given = struct("ClrtMaterial", shading=shading, diffuse=diffuse, specular=specular, kd=kd,
                       ks=ks, shininess=shininess, reflectivity=reflectivity, check_size=size,
                       even=even, odd=odd, ior=ior)
        return result_of("scene_add_material", self._handle, given)

    def mesh(self, vertices: ArrayLike, faces: ArrayLike, material: int | str = "matte", *,
             normals: ArrayLike | None = None, colors: ArrayLike | None = None,
             two_sided: bool = False, smooth: bool = False, crease: float | None = None) -> None:
        """Adds a mesh.

        vertices: (n, 3) numbers, kept as float64. faces: (m, 3) vertex numbers, counter-clockwise
        seen from the front. normals, colors: (n, 3), one per vertex. Colors replace the material's
        diffuse color: uint8, uint16 or numbers in [0, 1]. smooth: computes missing normals; angles
        above `crease` degrees stay sharp (33 by default). two_sided: also visible from behind.
        material: "silhouette", "matte", "blinn_phong", "mirror" or the result of `material`.
        """
        vertices = _rows(vertices, np.float64, "vertices")
        faces = _rows(faces, np.uint32, "faces")
        vectors = {what: _rows(fractions(given), np.float32, what, len(vertices))
                   for what, given in (("normals", normals), ("colors", colors))
                   if given is not None}
        given = struct("ClrtMesh", positions=vertices, triangles=faces, **vectors,
                       vertex_count=len(vertices), triangle_count=len(faces),
                       material=_material(material), two_sided=two_sided, smooth=smooth,
                       flat=normals is None and not smooth, crease_degrees=_crease(crease))
        call("scene_add_mesh", self._handle, given)

    def sphere(self, center: ArrayLike, radius: float, material: int | str = "matte") -> None:
        """Adds a sphere."""
        call("scene_add_sphere", self._handle, center, radius, _material(material))

    def light(self, position: ArrayLike, intensity: float = 1.0,
              color: ArrayLike = (1, 1, 1), is_sun: bool = False,
              area: tuple[ArrayLike, ArrayLike, int] | None = None) -> None:
        """Adds a light whose intensity does not decrease with distance.

        is_sun: the light is infinitely far away, in the direction `position`. area: two sides of a
        parallelogram around `position`, and a number n up to 16. The light then consists of n * n
        points, and casts soft shadows.
        """
        if area is None:
            call("scene_add_sun" if is_sun else "scene_add_colored_light", self._handle, position,
                 intensity, color)
        elif is_sun:
            raise ArgumentError("a sun has no area")
        else:
            side_u, side_v, cells = parts(area, "area", "side", "side", "n")
            given = struct("ClrtAreaLight", position=position, side_u=side_u, side_v=side_v,
                           cells=cells, intensity=intensity, color=color)
            call("scene_add_area_light", self._handle, given)

    def camera(self, eye: ArrayLike, *settings: Any, **more: Any) -> None:
        """Adds a Camera of these arguments as the last view, whose number is len(cameras)."""
        call("scene_add_camera", self._handle, Camera(eye, *settings, **more)._struct())

    def background(self, color: ArrayLike) -> None:
        """Sets the color of rays that hit nothing."""
        call("scene_set_background", self._handle, color)

    def ambient(self, intensity: float) -> None:
        """Sets the ambient light, in [0, 1]."""
        call("scene_set_ambient", self._handle, intensity)

    @property
    def info(self) -> dict[str, Any]:
        """The members of ClrtSceneInfo in clrt.h, such as counts of objects, as a dict."""
        return result_of("scene_get_info", self._handle)

    @property
    def cameras(self) -> list[Camera]:
        """The scene's views, as a list of Camera. View n is element n - 1."""
        views = [result_of("scene_get_camera", self._handle, i + 1)
                 for i in range(self.info["view_count"])]
        return [Camera(fov=view.pop("fov_degrees"), **view) for view in views]

    def render(self, width: int = 0, height: int = 0, **settings: Any) -> Picture:
        """Draws the scene on the default device. See Renderer.render."""
        from .renderer import default_renderer
        return default_renderer().render(self, width, height, **settings)


def load(path: str | os.PathLike, *, up: str = "auto", flat: bool = False,
         crease: float | None = None, soft: bool = False) -> Scene:
    """Reads a scene file (man 5 clrt-scene) or a mesh file, which clrt places in a studio.

    up: the axis of a mesh file that points up, "x" to "-z". flat: ignores the file's normals.
    crease: larger angles in degrees stay sharp (33 or 70 by default, by the shape). soft: the
    studio has area lights, which cast soft shadows.
    """
    settings = struct("ClrtLoad", up=up, flat=flat, crease_degrees=_crease(crease), soft=soft)
    return Scene(call("scene_load", os.fsdecode(path), settings))


def _rows(values, dtype, what, count=None):
    """The values as a dense array of the shape (n, 3). If `count` is given, n must equal it."""
    made = np.ascontiguousarray(threes(values, dtype, what, "n"))
    if count not in (None, len(made)):
        raise ArgumentError(f"{len(made)} {what} for {count} vertices")
    return made


def _crease(degrees):
    """The degrees for the library. The least positive number replaces 0, which is the default."""
    return sys.float_info.min if degrees == 0 else degrees


def _material(material):
    is_name = isinstance(material, str)
    return _MATERIALS.index(*choices(_MATERIALS, material, "material")) if is_name else material
