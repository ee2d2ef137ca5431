#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Passes unusual and invalid arguments to the Python package.

usage: test_arguments.py CLRT"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import cffi  # pylint: disable=unused-import
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup python installs it")
    sys.exit(77)

import clrt

CLRT = sys.argv[1]
# The angle between both faces is 14 degrees.
ROOF = np.array([(-2, -1, 0), (0, -1, 0.25), (0, 1, 0.25), (2, 1, 0)])
SLOPES = np.array([(0, 1, 2), (1, 3, 2)])


def roof(**settings):
    scene = clrt.Scene()
    scene.mesh(ROOF, SLOPES, **settings)
    scene.light((3, -4, 6))
    scene.camera((0, -1, 5))
    return scene


class Creases(unittest.TestCase):
    def expect_program(self, scene, words):
        """Fails unless the scene looks like the roof in a scene file with these words."""
        lines = [" ".join(map(str, line)) for line in ROOF.tolist()]
        lines += [" ".join(map(str, [3, *line])) for line in SLOPES.tolist()]
        axes = "".join(f"property float {axis}\n" for axis in "xyz")
        header = (f"ply\nformat ascii 1.0\nelement vertex 4\n{axes}element face 2\n"
                  "property list uchar int vertex_indices\nend_header\n")
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "roof.ply").write_text(header + "\n".join(lines) + "\n")
            file = pathlib.Path(folder, "roof.scn")
            file.write_text(f"light 3 -4 6 1\ncamera 0 -1 5 0 0 0 45\nmaterial 1\n{words}\nmesh roof.ply\n")
            printed = subprocess.run([CLRT, file, "--hash", "-s", "32x32", "--aa=1"], check=True,
                                     capture_output=True, text=True).stdout.strip()
        self.assertEqual(clrt.hash(scene.render(32, 32, samples=1)), printed)

    def test_creases_are_those_of_scene_files(self):
        self.expect_program(roof(smooth=True, crease=0), "normals smooth 0")
        self.expect_program(roof(smooth=True), "normals smooth")
        self.assertNotEqual(clrt.hash(roof(smooth=True).render(32, 32)),
                            clrt.hash(roof(smooth=True, crease=0).render(32, 32)))

    def test_creases_need_smooth_normals(self):
        for crease in (0, 33):
            with self.assertRaisesRegex(clrt.ArgumentError, "crease"):
                roof(crease=crease)


class Lights(unittest.TestCase):
    def test_lights_return_nothing(self):
        scene = clrt.Scene()
        area = ((1, 0, 0), (0, 1, 0), 2)
        self.assertIsNone(scene.light((0, 0, 9)))
        self.assertIsNone(scene.light((0, 0, 9), is_sun=True))
        self.assertIsNone(scene.light((0, 0, 9), area=area))
        with self.assertRaisesRegex(clrt.ArgumentError, "a sun has no area"):
            scene.light((0, 0, 9), is_sun=True, area=area)
        self.assertEqual(scene.info["light_count"], 6)


class Forks(unittest.TestCase):
    def test_forks_use_a_device_only_if_their_parent_has_not(self):
        code = """if True:
            import clrt, multiprocessing
            def trace(name):
                scene = clrt.Scene()
                scene.sphere((0, 0, 0), 1)
                return (renderer or clrt.Renderer()).trace(scene, [(0, 0, 5)], (0, 0, -1))
            def use(name):
                try:
                    {"trace": trace, "Renderer": clrt.Renderer,
                     "devices": lambda _: clrt.devices()}[name](None)
                    print("works", flush=True)
                except clrt.DeviceError as error:
                    print(str(error)[:22], flush=True)
            renderer = None
            for i in range(2):
                for name in ("trace", "devices", "Renderer"):
                    process = multiprocessing.get_context("fork").Process(target=use, args=(name,))
                    process.start()
                    process.join(30)
                    process.kill()
                renderer = clrt.Renderer()
                use("trace")"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                              check=False)
        expected = ["works"] * 4 + ["this process is a fork"] * 3 + ["works"]
        self.assertEqual(done.stdout.splitlines(), expected, done.stderr)


unittest.main(argv=sys.argv[:1])
