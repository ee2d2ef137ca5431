#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Passes unusual and invalid arguments to the Python package.

usage: test_arguments.py CLRT"""
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

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
                    process.join(120)
                    process.kill()
                renderer = clrt.Renderer()
                use("trace")"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                              check=False)
        expected = ["works"] * 4 + ["a fork of a process th"] * 3 + ["works"]
        self.assertEqual(done.stdout.splitlines(), expected, done.stderr)


class Errors(unittest.TestCase):
    def test_errors_name_the_argument(self):
        scene, renderer, ray = roof(), clrt.Renderer(), ((0, 0, 5), [(0, 0, -1)])
        cases = (
            ("a result is 'near', not one of distance", lambda: renderer.trace(scene, *ray, results="near")),
            ("a result is 'certain'", lambda: renderer.trace_all(scene, *ray, results=("certain",))),
            ("a channel is 'dept', not one of depth", lambda: scene.render(8, 8, channels="dept")),
            ("error is '0.5%', not a number", lambda: scene.render(8, 8, error="0.5%")),
            ("max_level is 'auto', not an integer", lambda: scene.render(8, 8, max_level="auto")),
            ("samples is -1, not an integer from 0", lambda: scene.render(8, 8, samples=-1)),
            ("statistics is 'yes', not True or", lambda: scene.render(8, 8, statistics="yes")),
            ("camera is of the type tuple, not Camera", lambda: scene.render(8, 8, camera=(0, -6, 3))),
            (r"crop is \(2, 2, 4\), not \(left, top, width", lambda: scene.render(8, 8, crop=(2, 2, 4))),
            ("scene is of the type ndarray, not Scene", lambda: renderer.trace(ROOF, *ray)),
            ("scene is of the type str, not Scene", lambda: renderer.render("a.scn", 8, 8)),
            ("material is -1, not an integer", lambda: scene.sphere((0, 0, 0), 1, -1)),
            ("material is -1, not an integer", lambda: scene.mesh(ROOF, SLOPES, -1)),
            ("radius is 'big', not a number", lambda: scene.sphere((0, 0, 0), "big")),
            ("radius is None, not a number", lambda: scene.sphere((0, 0, 0), None)),
            ("material is None, not an integer", lambda: scene.sphere((0, 0, 0), 1, None)),
            ("path contains a null character", lambda: clrt.load("a.scn\0")),
            ("device contains a null character", lambda: clrt.Renderer("cpu\0")),
            ("intensity is '1', not a number", lambda: scene.light((0, 0, 9), "1")),
            ("area is 2, not", lambda: scene.light((0, 0, 9), area=2)),
            ("checker is .*, not", lambda: scene.material(checker=(1, (1, 1, 1)))),
            ("x is -1, not an integer", lambda: renderer.explain(scene, -1, 0, 8, 8)),
            ("'weights' was not requested", lambda: renderer.trace(scene, *ray, results=["face"]).u),
            ("device is of the type int, not str", lambda: clrt.Renderer(0)),
            ("origins: .*abc", lambda: renderer.trace(scene, "abc", [(0, 0, 1)])),
            ("directions: .*inhomogeneous", lambda: renderer.trace(scene, (0, 0, 5), [(0, 1), (2,)])),
            ("near: .*broadcast", lambda: renderer.trace(scene, *ray, near=[1, 2])),
            ("origins: .*complex", lambda: renderer.trace(scene, [(0, 0, 5j)], (0, 0, 1))),
            ("starts is not an integer", lambda: renderer.trace(scene, *ray, starts=np.nan)),
            ("eye: .*'0'|eye: .*abc", lambda: clrt.Camera("abc")))
        for words, action in cases:
            with self.subTest(words), self.assertRaisesRegex(clrt.ArgumentError, words):
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    action()

    def test_rays_take_no_members_of_structs(self):
        scene, renderer, ray = roof(), clrt.Renderer(), ((0, 0, 5), [(0, 0, -1)])
        for name, value in (("size", 8), ("nears", np.zeros(0)), ("fars", np.zeros(0))):
            with self.subTest(name), self.assertRaisesRegex(TypeError, name):
                renderer.trace(scene, *ray, **{name: value})
        with self.assertRaisesRegex(TypeError, "there is no setting 'size'"):
            scene.render(8, 8, size=160)

    def test_scenes_without_cameras_say_so(self):
        with self.assertRaisesRegex(clrt.ArgumentError, "the scene has no camera"):
            clrt.Scene().render(8, 8)


class Arguments(unittest.TestCase):
    def test_one_name_is_a_list_of_names(self):
        scene = roof()
        self.assertEqual(list(scene.render(8, 8, channels="depth").channels), ["depth"])
        hits = clrt.Renderer().trace(scene, (0, 0, 5), [(0, 0, -1)], results="face")
        self.assertEqual((hits.face.shape, hits.distance), ((1,), None))

    def test_numbers_of_numpy_are_numbers(self):
        scene = roof(two_sided=np.True_, smooth=np.True_, crease=np.float32(20))
        picture = scene.render(np.int64(8), np.uint8(6), samples=np.int32(2), error=np.float64(0))
        self.assertEqual(clrt.hash(picture), clrt.hash(scene.render(8, 6, samples=2)))

    def test_false_of_numpy_stops(self):
        with self.assertRaises(clrt.Stopped):
            roof().render(300, 300, progress=lambda done, all_: np.False_)

    def test_empty_pictures_have_no_png(self):
        self.assertIsNone(roof().render(8, 8)[:0]._repr_png_())  # pylint: disable=protected-access

    def test_cameras_of_arrays_are_equal(self):
        self.assertEqual(clrt.Camera(np.zeros(3), up=[0, 1, 0]), clrt.Camera((0, 0, 0), up=(0, 1, 0)))
        self.assertNotEqual(clrt.Camera(np.zeros(3)), clrt.Camera(np.ones(3)))

    def test_no_rays_have_no_hits(self):
        scene, renderer = roof(), clrt.Renderer()
        for origins, directions in (([], []), ([], (0, 0, 1)), ((0, 0, 1), []), (np.zeros((0, 3)), [])):
            self.assertEqual(renderer.trace(scene, origins, directions).normal.shape, (0, 3))
            self.assertEqual(renderer.trace_all(scene, origins, directions).ray.shape, (0,))
            self.assertEqual(renderer.occluded(scene, origins, directions, far=[]).shape, (0,))
        self.assertEqual(renderer.contains(scene, []).shape, (0,))
        with self.assertRaisesRegex(clrt.ArgumentError, "0 origins, but 2 directions"):
            renderer.trace(scene, [], [(0, 0, 1)] * 2)


unittest.main(argv=sys.argv[:1])
