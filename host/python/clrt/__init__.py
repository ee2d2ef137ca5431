# SPDX-License-Identifier: MIT
"""Exact rays and pictures: the ray tracer clrt for Python.

>>> import clrt
>>> scene = clrt.Scene()
>>> scene.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
>>> hits = clrt.Renderer().trace(scene, [(0.2, 0.2, 1), (2, 2, 1)], (0, 0, -1))
>>> hits.distance.tolist(), hits.face.tolist() == [0, clrt.NOTHING]
([1.0, inf], True)
"""

from .arrays import Hits, Picture, channel_kinds, compare, hash
from .library import NOTHING, ArgumentError, DeviceError, Error, SceneError, Stopped, ffi, lib
from .renderer import Renderer, devices
from .scene import Camera, Scene, load

__version__ = ffi.string(lib.clrt_version()).decode()
__all__ = ["NOTHING", "ArgumentError", "Camera", "DeviceError", "Error", "Hits", "Picture",
           "Renderer", "Scene", "SceneError", "Stopped", "channel_kinds", "compare", "devices",
           "hash", "load"]
