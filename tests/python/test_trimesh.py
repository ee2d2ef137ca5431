#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs trimesh's own tests of ray casters with clrt: tests/test_ray.py of trimesh's source package.

pip installs trimesh and fetches its sources, so the test needs the network. The sources contain no
models, so meshes of this file replace the models.

usage: test_trimesh.py CACHE_FOLDER"""
import pathlib
import subprocess
import sys
import tarfile
import time
import types
import unittest
import venv

FOLDER = pathlib.Path(sys.argv[1], "trimesh")
TRIMESH = "trimesh==5.2.0"
PACKAGES = (TRIMESH, "cffi", "numpy", "scipy", "manifold3d")


def prepare():
    """Makes a virtual environment with trimesh, and fetches the sources."""
    python = FOLDER / "bin" / "python"
    if list(FOLDER.glob("trimesh-*.tar.gz")):
        return python
    venv.create(FOLDER, with_pip=True)
    commands = (["install", *PACKAGES],
                ["download", "--no-deps", "--no-binary", ":all:", "-d", FOLDER, TRIMESH])
    for command in commands:
        done = subprocess.run([python, "-m", "pip", "-q", *command], capture_output=True,
                              check=False)
        if done.returncode != 0:
            print(f"skipped: pip cannot {command[0]} {TRIMESH}")
            sys.exit(77)
    return python


def stand_in():
    """Returns a replacement for the module `generic` of trimesh's tests, with all that test_ray.py uses."""
    import logging

    import numpy as np
    import trimesh
    from clrt.trimesh import RayMeshIntersector
    from trimesh.creation import box, icosphere, torus

    class Intersector(RayMeshIntersector):
        """Takes and ignores the settings of embreex's intersector."""

        def __init__(self, geometry, **_):
            super().__init__(geometry)

    def get_mesh(file_name, **_):
        makers = {"unit_sphere.STL": lambda: icosphere(3), "unit_cube.STL": box,
                  "teapot.stl": lambda: torus(5, 2).submesh([range(40, 900)], append=True),
                  "7_8ths_cube.stl": lambda: trimesh.boolean.difference(
                      [box(extents=(10, 10, 10)), box(bounds=[(0, 0, 0), (6, 6, 6)])])}
        mesh = makers.get(file_name, lambda: icosphere(2))()
        mesh.source.file_path = file_name
        return mesh

    ray = trimesh.ray
    ray.ray_triangle.RayMeshIntersector = Intersector
    ray.ray_pyembree = sys.modules["trimesh.ray.ray_pyembree"] = ray.ray_triangle
    ray.has_embree = True
    sys.modules["embreex"] = types.SimpleNamespace(__version__="4.4.0")
    numbers = np.random.default_rng(1)
    origins = 3 * numbers.normal(size=(50, 3))
    names = ("a.stl", "b.stl")
    rays = dict.fromkeys(names, {"ray_origins": origins, "ray_directions": -origins})
    kwargs = [{"file_name": name} for name in names]
    return types.SimpleNamespace(
        np=np, trimesh=trimesh, time=time, log=logging.getLogger("trimesh"), get_mesh=get_mesh,
        random=numbers.random, data={"ray_data": {"load_kwargs": kwargs, "rays": rays}})


class RayTests(unittest.TestCase):
    def test_trimeshs_own_tests_pass(self):
        archive, = FOLDER.glob("trimesh-*.tar.gz")
        with tarfile.open(archive) as files:
            member = next(name for name in files.getnames() if name.endswith("tests/test_ray.py"))
            source = files.extractfile(member).read()
        sys.modules["generic"] = stand_in()
        names = {"__name__": "test_ray"}
        exec(compile(source, "test_ray.py", "exec"), names)  # pylint: disable=exec-used
        tests = {name: test for name, test in names.items() if name.startswith("test_")}
        self.assertGreaterEqual(len(tests), 11)
        for name, test in tests.items():
            with self.subTest(name):
                test()
        print(f"{len(tests)} tests of {archive.name}")


if __name__ == "__main__":
    if FOLDER.resolve() != pathlib.Path(sys.prefix).resolve():
        sys.exit(subprocess.run([prepare(), *sys.argv], check=False).returncode)
    unittest.main(argv=sys.argv[:1])
