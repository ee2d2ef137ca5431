#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests tools/bench --peer povray: the translation of scenes, and that different pictures get no
ratio. If POV-Ray is installed, its picture is compared with the picture of
clrt. Usage: test_povray.py CLRT
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CLRT = str(pathlib.Path(sys.argv[1]).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
from benchmark import povray  # noqa: E402

SIZE = 32, 24
# clrt draws the picture of the first camera. Only this camera has the up vector 0 1 0.
SCENE = f"""\
background 0.2 0.4 0.9
ambient 0.1
light 5 9 4.5 0.9 1 0.8 0.6
max_level 8
define stone matte checker 0.3 0.9 0.85 0.75 0.3 0.5 0.6 kd 0.9 reflectivity 0.25
define clear glass ior 1.33 color 0.6 1 0.7
up 0 1 0
camera 2.35 1.15 2  0.08 0.42 0  28
up 0 0 1
camera 0 5 0  0 0 0  40
sides two
material stone
ply_file {ROOT}/scenes/cube.ply
sphere -0.3 0.8 0.2 0.35
material clear
sphere 0.9 0.7 0.6 0.4
ply_file {ROOT}/scenes/tetrahedron.ply
"""
# Replaces POV-Ray, and writes a black picture.
STUB = f"""\
#!/usr/bin/env python3
import sys
path = next(word[2:] for word in sys.argv if word.startswith("+O"))
open(path, "wb").write(b"P6 {SIZE[0]} {SIZE[1]} 255\\n" + bytes({3 * SIZE[0] * SIZE[1]}))
"""


class PovRay(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        self.scene = self.work / "a.scn"
        self.scene.write_text(SCENE)

    def bench(self, **more):
        """Returns the table that tools/bench prints, and the figures of the only scene in its report."""
        report = self.work / "report.json"
        words = [self.scene, "--peer", "povray", "--runs", "1", "--variants", "mirrors", "-s", "%dx%d" % SIZE]
        done = subprocess.run([ROOT / "tools/bench", *words, "--json", report], check=True, text=True,
                              stdout=subprocess.PIPE, env={**os.environ, "CLRT": CLRT, **more})
        return done.stdout, json.loads(report.read_text())["frames"][0]

    def test_different_pictures_get_no_ratio(self):
        (self.work / "povray").write_text(STUB)
        (self.work / "povray").chmod(0o755)
        table, figures = self.bench(PATH=f"{self.work}:{os.environ['PATH']}")
        self.assertGreater(figures["mean_difference"], 0.01)
        self.assertIsNone(figures["ratio_povray_to_clrt"])
        self.assertRegex(table, r"\na +mirrors .* - +\d+\.\d\d%\n")
        self.assertIn("more than 1 % apart", table)

    def test_the_first_camera_keeps_its_up_vector(self):
        self.assertIn("location <2.35,1.15,2> sky <0,1,0>", povray.translate(SCENE, *SIZE))

    def test_statements_without_a_translation_are_named(self):
        for line in "mesh a.ply", "material 2", "define b blinn_phong":
            with self.assertRaisesRegex(SystemExit, f"cannot translate '{line.removeprefix('define b ')}'"):
                povray.translate(SCENE + line, *SIZE)

    @unittest.skipUnless(shutil.which("povray"), "povray is not installed (tools/setup test)")
    def test_povray_draws_clrt_s_picture(self):
        table, figures = self.bench()
        # Without Fresnel's reflections, glass would differ by 0.7 %.
        self.assertLess(figures["mean_difference"], 0.005, table)
        self.assertGreater(figures["ratio_povray_to_clrt"], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
