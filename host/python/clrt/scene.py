# SPDX-License-Identifier: MIT
"""Scenes: what is drawn, and what rays are cast at."""

import os

import numpy as np

from . import library
from .library import call, ffi, rows, struct, vector

_MATERIALS = {"silhouette": 0, "matte": 1, "blinn_phong": 2, "mirror": 3}
_SHADINGS = {"silhouette": 0, "matte": 1, "blinn_phong": 2}
_UPS = {name: i for i, name in enumerate(("auto", "x", "y", "z", "-x", "-y", "-z"))}


class Camera:
    """A camera at `eye`. `fov` is its vertical field of view in degrees."""

    def __init__(self, eye, look_at=(0, 0, 0), up=(0, 0, 1), fov=45.0):
        self.eye, self.look_at, self.up, self.fov = eye, look_at, up, fov

    def __repr__(self):
        return f"Camera({self.eye}, {self.look_at}, {self.up}, {self.fov})"

    def _struct(self):
        return struct("ClrtCamera", eye=vector(self.eye, "eye"),
                      look_at=vector(self.look_at, "look_at"), up=vector(self.up, "up"),
                      fov_degrees=self.fov)


class Scene:
    """An empty scene with a white background. `load` reads one from a file.

    >>> import clrt
    >>> scene = clrt.Scene()
    >>> gold = scene.material(diffuse=(0.9, 0.7, 0.2), reflectivity=0.3)
    >>> scene.sphere((0, 0, 1), 1, gold)
    >>> scene.light((4, -2, 6))
    >>> scene.info["sphere_count"]
    1
    """

    def __init__(self):
        self._handle = library.handle("scene_create", free="scene")

    def material(self, shading="blinn_phong", *, diffuse=(1, 1, 1), specular=(1, 1, 1), kd=0.8,
                 ks=0.5, shininess=50.0, reflectivity=0.0):
        """Adds a material and returns its number.

        shading: "silhouette", "matte" or "blinn_phong". Colors are R G B in [0, 1]; clrt.h has the
        formula.
        """
        number = ffi.new("uint32_t *")
        given = struct("ClrtMaterial", shading=_named(_SHADINGS, shading, "shading"),
                       diffuse=vector(diffuse, "diffuse"), specular=vector(specular, "specular"),
                       kd=kd, ks=ks, shininess=shininess, reflectivity=reflectivity)
        call("scene_add_material", self._handle, given, number)
        return number[0]

    def mesh(self, vertices, faces, material="matte", *, normals=None, two_sided=False,
             smooth=False, crease=None):
        """Adds a mesh.

        vertices: (n, 3) numbers, kept as float64. faces: (m, 3) vertex numbers, counter-clockwise
        seen from the front. normals: (n, 3), one per vertex. smooth computes normals that are
        missing; angles above `crease` degrees (33) stay sharp. Pictures show the backs of two_sided
        meshes, too. material: a number that `material`
        returned, "silhouette", "matte", "blinn_phong" or "mirror".
        """
        vertices = rows(vertices, np.float64, 3, "vertices")
        faces = np.asarray(faces)
        library.check_unsigned(faces, "vertex number")
        faces = rows(faces, np.uint32, 3, "faces")
        if normals is not None:
            normals = rows(normals, np.float32, 3, "normals")
            if len(normals) != len(vertices):
                raise library.ArgumentError(f"{len(normals)} normals for {len(vertices)} vertices")
        given = struct("ClrtMesh", positions=vertices, triangles=faces, normals=normals,
                       vertex_count=len(vertices), triangle_count=len(faces),
                       material=_material(material), two_sided=two_sided, smooth=smooth,
                       flat=normals is None and not smooth, crease_degrees=crease)
        call("scene_add_mesh", self._handle, given)

    def sphere(self, center, radius, material="matte"):
        """Adds a sphere."""
        center = vector(center, "center")
        call("scene_add_sphere", self._handle, center, radius, _material(material))

    def light(self, position, intensity=1.0, color=(1, 1, 1)):
        """Adds a point light without attenuation."""
        call("scene_add_colored_light", self._handle, vector(position, "position"), intensity,
             vector(color, "color"))

    def camera(self, eye, look_at=(0, 0, 0), up=(0, 0, 1), fov=45.0):
        """Appends a view. Its number is len(scene.cameras)."""
        call("scene_add_camera", self._handle, Camera(eye, look_at, up, fov)._struct())

    def background(self, color):
        """Sets the color of rays that hit nothing."""
        call("scene_set_background", self._handle, vector(color, "color"))

    def ambient(self, intensity):
        """Sets the ambient light, in [0, 1]."""
        call("scene_set_ambient", self._handle, intensity)

    @property
    def info(self):
        """The counts of the scene's parts, and the size of its pictures, as a dict."""
        info = struct("ClrtSceneInfo")
        call("scene_get_info", self._handle, info)
        return library.values_of(info)

    @property
    def cameras(self):
        """The scene's views, as a list of Camera. View n is element n - 1."""
        return [self._camera(view + 1) for view in range(self.info["view_count"])]

    def _camera(self, view):
        camera = struct("ClrtCamera")
        call("scene_get_camera", self._handle, view, camera)
        vectors = (tuple(camera.eye), tuple(camera.look_at), tuple(camera.up))
        return Camera(*vectors, camera.fov_degrees)

    def render(self, width=0, height=0, **settings):
        """Draws the scene on the default device. See Renderer.render."""
        from .renderer import default_renderer

        return default_renderer().render(self, width, height, **settings)


def load(path, *, up="auto", flat=False, crease=None):
    """Reads a scene file (man 5 clrt-scene) or a mesh file, which clrt places in a studio.

    up: the axis of a mesh file that points up, "x" to "-z". flat ignores its normals. Angles above
    `crease` degrees stay sharp.
    """
    load_ = struct("ClrtLoad", up=_named(_UPS, up, "up"), flat=flat, crease_degrees=crease)
    scene = Scene.__new__(Scene)
    scene._handle = library.handle("scene_load", os.fsencode(path), load_, free="scene")
    return scene


def _named(names, given, what):
    if given not in names:
        raise library.ArgumentError(f"{what} is {given!r}, not one of {', '.join(names)}")
    return names[given]


def _material(material):
    return _named(_MATERIALS, material, "material") if isinstance(material, str) else material
