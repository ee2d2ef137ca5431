#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws pictures and casts rays from Python, and compares them with the results of the program.

usage: test_python.py CLRT SCENES"""
import copy
import json
import os
import pathlib
import pickle
import re
import resource
import subprocess
import sys
import tempfile
import threading
import types
import unittest
import unittest.mock

try:
    import cffi  # pylint: disable=unused-import
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup python installs it")
    sys.exit(77)

import clrt
import clrt.trimesh

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from pictures import read_exr, read_png  # noqa: E402 pylint: disable=wrong-import-position

CLRT, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])
# This scene contains no models, because builds with sanitizers do not generate models.
REFLECTIONS = SCENES / "reflections.scn"
CUBE = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], float)
SIDES = np.array([(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
                  (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)])


def cube():
    scene = clrt.Scene()
    scene.mesh(CUBE, SIDES)
    return scene


class Mesh:
    """Has the attributes of a trimesh that clrt.trimesh uses."""
    vertices, faces = CUBE, SIDES


class Pictures(unittest.TestCase):
    def test_a_picture_has_the_programs_hash(self):
        printed = subprocess.run([CLRT, REFLECTIONS, "--hash", "-s", "96x64", "--aa=2"], check=True,
                                 capture_output=True, text=True).stdout.strip()
        picture = clrt.load(REFLECTIONS).render(96, 64, samples=2)
        self.assertEqual(picture.shape, (64, 96, 3))
        self.assertEqual(picture.dtype, np.float32)
        self.assertEqual(clrt.hash(picture), printed)

    def test_cameras_may_be_orthographic(self):
        scene = clrt.Scene()
        scene.sphere((0, 0, 0), 1, scene.material("silhouette", diffuse=(0, 0, 0)))
        scene.camera((9, 0, 0), height=4)
        covered = (scene.render(64, 64) == 0).all(axis=2).mean()
        self.assertAlmostEqual(covered, np.pi / 16, delta=0.01)
        self.assertEqual(scene.cameras[0].height, 4)
        self.assertEqual(clrt.hash(scene.render(32, 32, camera=clrt.Camera((9, 0, 0), height=4))),
                         clrt.hash(scene.render(32, 32)))

    def test_suns_and_area_lights_shine_as_in_scene_files(self):
        scene = clrt.Scene()
        scene.sphere((0, 0, 0), 1)
        scene.light((9, 1, 5), 0.5, area=((1, 2, 0), (0, 1, 1), 3))
        scene.light((1, -2, 3), 0.7, (1, 0.5, 0.25), is_sun=True)
        scene.camera((9, 0, 0), fov=30)
        with tempfile.NamedTemporaryFile("w", suffix=".scn") as file:
            file.write("material 1\nsphere 0 0 0 1\nlight 9 1 5 0.5 area 1 2 0 0 1 1 3\nsun 1 -2 3 0.7 1 0.5 0.25\ncamera 9 0 0 0 0 0 30\n")
            file.flush()
            self.assertEqual(clrt.hash(scene.render(32, 32)), clrt.hash(clrt.load(file.name).render(32, 32)))

    def test_checkers_look_as_in_scene_files(self):
        scene = clrt.Scene()
        scene.sphere((0, 0, 0), 1, scene.material("silhouette", checker=(0.3, (1, 0.5, 0), (0, 0.25, 1))))
        scene.camera((9, 0, 0), fov=30)
        with tempfile.NamedTemporaryFile("w", suffix=".scn") as file:
            file.write("define a silhouette checker 0.3 1 0.5 0 0 0.25 1\nmaterial a\nsphere 0 0 0 1\n"
                       "camera 9 0 0 0 0 0 30\n")
            file.flush()
            self.assertEqual(clrt.hash(scene.render(32, 32)), clrt.hash(clrt.load(file.name).render(32, 32)))

    def test_narrow_orthographic_pictures_have_the_least_width(self):
        scene = clrt.Scene()
        scene.sphere((0, 0, 0), 1, scene.material("silhouette", diffuse=(0, 0, 0)))
        scene.camera((9, 0, 0), height=4, width=4)
        covered = (scene.render(32, 64) == 0).all(axis=2).mean()
        self.assertAlmostEqual(covered, np.pi / 32, delta=0.01)

    def test_the_cameras_of_a_scene_draw_its_views(self):
        scene = clrt.load(SCENES / "cone.ply")
        self.assertGreater(scene.cameras[0].width_degrees, 0)
        scene.camera((3, -4, 2), (0, 0, 1), (0, 1, 1), height=3, width=2.5)
        for number, camera in enumerate(scene.cameras, 1):
            self.assertEqual(clrt.hash(scene.render(16, 48, camera=camera)),
                             clrt.hash(scene.render(16, 48, view=number)))

    def test_meshes_have_colors_of_vertices(self):
        def draw(colors):
            scene = clrt.Scene()
            scene.mesh(CUBE, SIDES, "silhouette", colors=colors)
            scene.camera((3, -4, 2))
            return scene.render(32, 32)

        red = draw([(1, 0, 0)] * 8)
        shown = np.unique(red.reshape(-1, 3).round(6), axis=0)
        self.assertEqual(shown.tolist(), [[1, 0, 0], [1, 1, 1]])
        bytes_ = (np.arange(24) * 11).reshape(8, 3).astype(np.uint8)
        picture = draw(bytes_)
        self.assertEqual(clrt.hash(picture), clrt.hash(draw(bytes_ / 255)))
        self.assertTrue((picture == draw((bytes_.astype(np.uint16) * 257))).all())
        self.assertGreater(len(np.unique(picture)), 50)

    def test_arrays_have_the_bits_of_the_programs_exr_file(self):
        # The numbers of box and triangle tests depend on the kernel.
        names = [name for name in clrt.channel_kinds() if not name.endswith("tests")]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "reflections.exr")
            subprocess.run([CLRT, REFLECTIONS, "-o", path, "-s", "64x48", "--aov", ",".join(names)],
                           check=True, capture_output=True)
            _, stored = read_exr(path)
        picture = clrt.load(REFLECTIONS).render(64, 48, channels=names)
        arrays = {"R": picture[..., 0], "G": picture[..., 1], "B": picture[..., 2]}
        for name, array in picture.channels.items():
            prefix = {"depth": "Z", "normal": "N", "position": "P"}.get(name, name)
            if array.ndim == 2:
                arrays[prefix] = array
            else:
                arrays.update({f"{prefix}.{axis}": array[..., i] for i, axis in enumerate("XYZ")})
        self.assertEqual(sorted(stored), sorted(arrays))
        for name, values in stored.items():
            expected = np.array(values, arrays[name].dtype)
            self.assertEqual(arrays[name].tobytes(), expected.tobytes(), name)

    def test_copies_and_pickles_have_channels_and_result(self):
        picture = clrt.load(REFLECTIONS).render(8, 6, channels=["depth"])
        for made in (pickle.loads(pickle.dumps(picture)), copy.deepcopy(picture), copy.copy(picture),
                     picture.copy()):
            self.assertEqual((type(made), made.tobytes(), made.result),
                             (clrt.Picture, picture.tobytes(), picture.result))
            self.assertEqual(made.channels["depth"].tobytes(), picture.channels["depth"].tobytes())
            self.assertFalse(np.shares_memory(made, picture))
        copy.deepcopy(picture).channels["depth"][:] = 0
        self.assertGreater(picture.channels["depth"].max(), 0)
        for made in picture[::-1], picture + 1:
            self.assertEqual((made.channels, made.result), ({}, {}))

    def test_channels_are_arrays_and_agree_with_rays(self):
        scene, renderer = clrt.load(REFLECTIONS), clrt.Renderer()
        picture = renderer.render(scene, 48, 32, channels=["depth", "primitive", "normal"])
        self.assertEqual(picture.channels["depth"].shape, (32, 48))
        self.assertEqual(picture.channels["normal"].shape, (32, 48, 3))
        for x, y in ((5, 3), (24, 16), (30, 20)):
            ray = renderer.explain(scene, x, y, 48, 32)["samples"][0]["rays"][0]
            hits = renderer.trace(scene, [ray["origin"]], [ray["direction"]], one_sided=True)
            self.assertEqual(picture.channels["primitive"][y, x], ray["primitive"])
            self.assertEqual(hits.primitive[0], ray["primitive"])

    def test_notebooks_show_the_pixels_of_the_programs_png(self):
        # Multiplied by 255, the background's values are 26.5, 100.5 and 200.5, up to rounding.
        text = "background 0.10392157 0.39411765 0.7862745\nlight 0 0 9 0.7\nmaterial 1\nsphere 0 0 0.5 1"
        with tempfile.TemporaryDirectory() as folder:
            scene, file = pathlib.Path(folder, "a.scn"), pathlib.Path(folder, "a.png")
            scene.write_text(text)
            subprocess.run([CLRT, scene, "-o", file, "-s", "32x32"], check=True, capture_output=True)
            picture = clrt.load(scene).render(32, 32)
            self.assertEqual(read_png(picture._repr_png_()), read_png(file.read_bytes()))
        self.assertGreater(len(np.unique(picture)), 50)
        strange = np.full((1, 1, 3), [np.nan, -1, 2], np.float32).view(clrt.Picture)
        self.assertEqual(read_png(strange._repr_png_()), [[255, 0, 255]])

    def test_pictures_compare(self):
        one = clrt.load(REFLECTIONS).render(32, 32)
        other = one.copy()
        self.assertEqual(clrt.compare(one, other)["largest"], 0)
        other[3, 4, 1] += 0.5
        found = clrt.compare(one, other)
        self.assertEqual(found["pixels"], 1)
        self.assertAlmostEqual(found["largest"], 0.5, places=6)

    def test_pictures_of_integers_compare_as_their_files(self):
        bytes_ = np.arange(48, dtype=np.uint8).reshape(4, 4, 3) * 5
        floats = (bytes_ / 255).astype(np.float32)
        for picture in (bytes_, bytes_.astype(np.uint16) * 257):
            self.assertEqual(clrt.compare(picture, floats)["largest"], 0)
            self.assertEqual(clrt.hash(picture), clrt.hash(floats))

    def test_pictures_that_the_program_rejects_do_not_compare(self):
        one = np.zeros((4, 5, 3))
        for value in (np.nan, np.inf):
            other = one.copy()
            other[2, 1, 0] = value
            for pair in ((one, other), (other, one), (other, other)):
                with self.assertRaisesRegex(clrt.ArgumentError, "R of pixel 1,2 is not finite"):
                    clrt.compare(*pair)
        for other in (one[..., 0], one[..., :2], one[0]):
            with self.assertRaisesRegex(clrt.ArgumentError, r"not \(height, width, 3\)"):
                clrt.compare(other, other)

    def test_progress_stops_a_picture(self):
        with self.assertRaises(clrt.Stopped):
            clrt.load(REFLECTIONS).render(300, 300, progress=lambda done, all_: False)

    def test_exceptions_of_progress_functions_arrive(self):
        calls = []

        def fail(done, all_):
            calls.append((done, all_))
            raise KeyboardInterrupt

        scene, renderer = clrt.load(REFLECTIONS), clrt.Renderer()
        for size in (30, 300):
            calls.clear()
            with self.assertRaises(KeyboardInterrupt):
                renderer.render(scene, size, size, channels=["depth"], progress=fail)
            self.assertEqual(len(calls), 1)
        with self.assertRaises(KeyboardInterrupt):
            renderer.trace(scene, [(0, 0, 5)], (0, 0, -1), progress=fail)
        with self.assertRaises(TypeError):
            renderer.render(scene, 30, 30, progress=3)

    def test_crops_and_references_are_settings(self):
        renderer, scene = clrt.Renderer(), clrt.load(REFLECTIONS)
        picture = renderer.render(scene, 32, 32)
        part = renderer.render(scene, 32, 32, crop=(4, 8, 16, 2))
        self.assertTrue((part == picture[8:10, 4:20]).all())
        reference = renderer.render(scene, 32, 32, reference_samples=4)
        self.assertGreater(reference.result["error"], 0)
        with self.assertRaisesRegex(TypeError, "'sampels'"):
            renderer.render(scene, 32, 32, sampels=2)

    def test_a_bar_shows_the_progress(self):
        bars, modules = [], {"tqdm": types.ModuleType("tqdm"), "tqdm.auto": types.ModuleType("auto")}
        modules["tqdm.auto"].tqdm = lambda unit: bars.append(unittest.mock.Mock()) or bars[0]
        with unittest.mock.patch.dict(sys.modules, modules):
            clrt.load(REFLECTIONS).render(300, 200, progress=True)
        self.assertEqual((bars[0].n, bars[0].total), (6, 6))
        with unittest.mock.patch.dict(sys.modules, {"tqdm.auto": None}):
            clrt.load(REFLECTIONS).render(8, 8, progress=True)


class Rays(unittest.TestCase):
    def test_hits_name_the_face_and_the_place(self):
        hits = clrt.Renderer().trace(cube(), [(0.5, 0.25, 3), (5, 5, 5)], (0, 0, -2))
        self.assertEqual(hits.hit.tolist(), [True, False])
        self.assertEqual(hits.distance.tolist(), [1.0, np.inf])
        self.assertEqual((hits.mesh[0], hits.face[1]), (0, clrt.NOTHING))
        self.assertEqual(hits.normal[0].tolist(), [0, 0, 1])
        self.assertTrue(hits.front[0])
        a, b, c = CUBE[SIDES[hits.face[0]]]
        place = a + hits.u[0] * (b - a) + hits.v[0] * (c - a)
        self.assertTrue(np.allclose(place, (0.5, 0.25, 1), atol=1e-6))

    def test_hits_are_known_from_the_distance_alone(self):
        cast = clrt.Renderer().trace
        hits = cast(cube(), (0, 0, 3), [(0, 0, -1), (0, 0, 1)], results=("distance",))
        self.assertEqual(hits.hit.tolist(), [True, False])
        with self.assertRaises(clrt.ArgumentError):
            _ = cast(cube(), (0, 0, 3), [(0, 0, -1)], results=iter(["face"])).hit

    def test_all_crossings_are_in_order(self):
        hits = clrt.Renderer().trace_all(cube(), [(0, 0, 3), (9, 9, 9), (0.1, 0.2, 0)], (0, 0, -1))
        self.assertEqual(hits.ray.tolist(), [0, 0, 2])
        self.assertEqual(hits.distance.tolist(), [2, 4, 1])
        on_face = clrt.Renderer().trace_all(cube(), [(0.1, 0.2, 1)], (0, 0, -1))
        self.assertEqual(on_face.distance.tolist(), [0, 2])

    def test_a_ray_with_many_crossings_takes_no_memory_for_other_rays(self):
        scene, count, layers = clrt.Scene(), 200_000, 5000
        z = np.repeat(np.arange(layers), 3)
        corners = np.tile([(0, 0), (1, 0), (0, 1)], (layers, 1))
        scene.mesh(np.column_stack([corners, z]), np.arange(3 * layers).reshape(-1, 3))
        origins = np.column_stack([np.arange(count), np.zeros((count, 2))]) + (0.25, 0.25, layers)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        near = np.where(np.arange(count) == count - 1, 0.5, 0)
        hits = clrt.Renderer().trace_all(scene, origins[::-1], (0, 0, -1), near=near)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before  # in KiB
        self.assertEqual(hits.ray.tolist(), [count - 1] * layers)
        self.assertEqual(hits.distance.tolist(), list(range(1, layers + 1)))
        self.assertLess(grown, 2 << 20)

    def test_rays_may_start_on_faces(self):
        renderer, scene = clrt.Renderer(), cube()
        hits = renderer.trace(scene, [(0.5, 0.25, 3)], (0, 0, -1))
        on = renderer.trace(scene, [(0.5, 0.25, 1)], (0, 0, -1), starts=hits.primitive)
        self.assertEqual(on.distance.tolist(), [2])
        self.assertTrue(renderer.occluded(scene, [(0, 0, 3)], (0, 0, -1), far=3).all())
        self.assertFalse(renderer.occluded(scene, [(0, 0, 3)], (0, 0, -1), far=1.5).any())

    def test_points_are_inside_or_not(self):
        points = np.random.default_rng(5).uniform(-2, 2, (5000, 3))
        inside = clrt.Renderer().contains(cube(), points)
        self.assertEqual(inside.tolist(), (np.abs(points).max(1) < 1).tolist())

    def test_arrays_of_other_layouts_give_the_same_hits(self):
        renderer, scene = clrt.Renderer(), cube()
        origins = np.random.default_rng(6).uniform(-3, 3, (100, 3))
        expected = renderer.trace(scene, origins, -origins).distance
        wide = np.hstack([origins, -origins])
        for other in (np.asfortranarray(origins), np.repeat(origins, 2, 0)[::2], wide[:, :3],
                      wide[::-1, :3][::-1], origins.tolist()):
            self.assertTrue((renderer.trace(scene, other, -origins).distance == expected).all())

    def test_calls_compile_only_their_kernel(self):
        code = ("import clrt, sys; renderer = clrt.Renderer();"
                " renderer.trace(clrt.load(sys.argv[1]), (0, 0, 9), [(0, 0, -1)]); del renderer;"
                " clrt.Renderer()")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-c", code, REFLECTIONS], check=True,
                           env={**os.environ, "POCL_CACHE_DIR": folder})
            program, = pathlib.Path(folder, "clrt").glob("*.bin")
            kernels = re.findall(rb"trace_rays|render_tile|find_crossings", program.read_bytes())
        self.assertEqual(set(kernels), {b"trace_rays"})

    def test_threads_get_the_same_hits(self):
        scene, found = cube(), [None] * 4
        origins = np.random.default_rng(7).uniform(-3, 3, (50000, 3))

        def cast(i):
            found[i] = clrt.Renderer().trace(scene, origins, -origins).primitive

        threads = [threading.Thread(target=cast, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for other in found[1:]:
            self.assertTrue((other == found[0]).all())

    def test_a_trimesh_gets_the_results_of_its_own_intersectors(self):
        ray = clrt.trimesh.RayMeshIntersector(Mesh())
        places, rays, faces = ray.intersects_location([(0.5, 0.25, 3)], [(0, 0, -4)])
        self.assertTrue(np.allclose(places, [(0.5, 0.25, 1), (0.5, 0.25, -1)]))
        self.assertEqual(rays.tolist(), [0, 0])
        first = ray.intersects_first([(0.5, 0.25, 3), (5, 5, 5)], [(0, 0, -1), (0, 0, 1)])
        self.assertEqual(first.tolist(), [faces[0], -1])
        self.assertEqual(ray.contains_points([(0, 0, 0), (3, 0, 0)]).tolist(), [True, False])


class Checks(unittest.TestCase):
    def test_checks_have_the_facts_of_the_program(self):
        renderer = clrt.Renderer()
        for file in (REFLECTIONS, SCENES / "cone.ply", SCENES / "ball.scn"):
            printed = json.loads(subprocess.run([CLRT, "check", file, "--json", "-q"], check=True,
                                                capture_output=True, text=True).stdout)
            found = renderer.check(clrt.load(file))
            self.assertEqual(found["fine"], printed["fine"])
            self.assertEqual(len(found["meshes"]), len(printed["meshes"]))
            for mesh, other in zip(found["meshes"], printed["meshes"]):
                test, edge = other["leak_test"], other["shortest_edge"]
                self.assertEqual(mesh, {
                    "path": other["path"], "closed": other["closed"],
                    "inside_out": other["inside_out"], "triangle_count": other["triangles"],
                    "vertex_count": other["vertices"], "edge_count": other["edges"],
                    "unused_vertices": other["unused_vertices"],
                    "repeated_vertices": other["repeated_vertices"],
                    "shortest_edge": edge["size"], "shortest_steps": edge["steps"],
                    "lowest_height": other["lowest_height"]["size"],
                    "lowest_steps": other["lowest_height"]["steps"], "aim_count": test["aims"],
                    "aimed_at": test["aimed_at"], "ray_count": test["rays"],
                    "hidden": test["hidden"], "leaks": test["leaks"]["count"]})
            for finding, other in zip(found["findings"], printed["findings"], strict=True):
                mesh = None if finding["mesh"] == clrt.NOTHING else finding["mesh"]
                self.assertEqual((finding["kind"], finding["fails"], finding["count"], mesh,
                                  finding["text"]),
                                 (other["kind"], other["fails"], other["count"], other["mesh"],
                                  other["text"]))


class Errors(unittest.TestCase):
    def test_errors_have_the_librarys_text_and_a_kind(self):
        cases = ((clrt.SceneError, "cannot be opened", lambda: clrt.load("/nowhere.scn")),
                 (clrt.ArgumentError, "vertex 12", lambda: clrt.Scene().mesh(CUBE, [(0, 1, 12)])),
                 (clrt.ArgumentError, "not an integer",
                  lambda: clrt.Scene().mesh(CUBE, [(0, 1, -1)])),
                 (clrt.ArgumentError, "7 colors for 8", lambda: clrt.Scene().mesh(
                     CUBE, SIDES, colors=[(0, 0, 0)] * 7)),
                 (clrt.ArgumentError, "color of vertex 0", lambda: clrt.Scene().mesh(
                     CUBE, SIDES, colors=[(0, 255, 0)] * 8)),
                 (clrt.ArgumentError, r"shape is \(3,\), not \(n, 3\)",
                  lambda: clrt.Scene().mesh(CUBE[0], SIDES)),
                 (clrt.ArgumentError, "center: the shape", lambda: clrt.Scene().sphere((1, 2), 1)),
                 (clrt.ArgumentError, "channel",
                  lambda: clrt.load(REFLECTIONS).render(8, 8, channels=["dept"])),
                 (clrt.ArgumentError, "directions",
                  lambda: clrt.Renderer().trace(cube(), [(0, 0, 0)], [(0, 0, 1)] * 2)),
                 (ValueError, "primitive", lambda: clrt.Renderer().trace(
                     cube(), [(0, 0, 0)], [(0, 0, 1)], starts=99)))
        for kind, words, action in cases:
            with self.assertRaisesRegex(kind, words):
                action()


unittest.main(argv=sys.argv[:1])
