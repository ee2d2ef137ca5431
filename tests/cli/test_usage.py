#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests the messages for contradictory options, and the notes on probable mistakes.
# Usage: test_usage.py CLRT FORMATS WINDOW; WINDOW is ON for a build with a window
import json
import os
import sys
import unittest

import models
from work import ROOT, SCENE, Work, main, needs_exr

HAS_WINDOW = sys.argv[3] == "ON"
SCENES = ROOT / "scenes"
SMALL = [SCENE, "-s", "8x6"]
PICTURE = SMALL + ["-o", "a.pfm"]
NO_MESH = (
    "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 0\nproperty list uchar int vertex_indices\nend_header\n"
)
BLANK = "there is nothing to draw: it has no triangles and no spheres"
POINTS = "there is nothing to draw: it has points and no triangles"
DARK = "it has no lights: its surfaces show ambient light only"


class Combinations(Work):
    def refuses(self, sentence, *words):
        super().refuses(2, sentence, *words)
        self.assertEqual(os.listdir(self.work), [], words)

    def test_a_file_is_named_once(self):
        self.refuses("--output is given twice: name one file", *PICTURE, "-o", "b.pfm")
        self.refuses("--output is given twice: name one file", *PICTURE, "--output=a.pfm")
        for name, value in ("json", "=a.json"), ("reference", "=b.pfm"), ("json", ""):
            sentence = f"--{name} is given twice: name one file"
            self.refuses(sentence, *PICTURE, f"--{name}{value}", f"--{name}")
        words = ["check", SCENE, "--json=a.json", "--json=b.json"]
        self.refuses("--json is given twice: name one file", *words)

    def test_statistics_are_text_and_json(self):
        done = self.run_clrt(*PICTURE, "--stats", "--json")
        self.assertIn("rays", done.stderr)
        self.assertEqual(json.loads(done.stdout)["schema"], 1)
        self.assertNotIn("rays", self.run_clrt(*PICTURE, "--json=b.json").stderr)

    def test_the_last_of_two_settings_counts(self):
        self.clrt(*SMALL, "-s", "4x4", "--view", "2", "--view", "1", "-o", "a.pfm")
        self.clrt(*SMALL, "-s", "4x4", "-o", "b.pfm")
        self.assert_same_bytes("a.pfm", "b.pfm")

    def test_a_channel_is_named_once(self):
        for channels in "depth,depth", "depth,normal,depth", "all,depth", "depth,all", "all,all":
            self.refuses("--aov names 'depth' twice", *SMALL, "-o", "a.exr", "--aov", channels)

    @needs_exr
    def test_merge_may_be_quiet(self):
        for part in 1, 2:
            self.clrt(*SMALL, "--tune", "tile=4x4", "--part", f"{part}/2", "-o", f"{part}.exr")
        done = self.run_clrt("merge", "1.exr", "2.exr", "-o", "a.exr", "-q")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_hashes_need_no_file(self):
        whole = self.clrt(*PICTURE, "--hash")
        os.remove(self.work / "a.pfm")
        for words in ["--tune", "tile=4x4"], ["-q", "--hash=" + 32 * "0"]:
            self.assertEqual(self.clrt(*SMALL, *words, "--hash", DISPLAY=None, WAYLAND_DISPLAY=None), whole)
        self.assertEqual(self.clrt(*SMALL, "--hash=" + whole.strip(), DISPLAY=None, WAYLAND_DISPLAY=None), "")
        self.assertIn("the hash of the pixels is", self.clrt(*SMALL, "--hash=" + 32 * "0", code=1))
        self.refuses("the hash goes to standard output: write the statistics to a file", *SMALL, "--hash", "--json=-")
        self.clrt(*SMALL, "--hash", "--json=a.json", "--reference=r.pfm", "--reference-samples", "2", "-q")
        self.assertEqual(sorted(os.listdir(self.work)), ["a.json", "r.pfm"])

    def test_options_without_effect_beside_another_are_refused(self):
        frames = "--frames names the views: leave out --view"
        for keyword, *words in (
            ("--encode srgb is for 8-bit files: pfm holds the traced colors", *PICTURE, "--encode", "srgb"),
            (frames, *PICTURE, "--frames", "1-2", "--view", "2"), (frames, *PICTURE, "--frames", "1-2", "--view", "1"),
            ("'a.png' is one name too many", "devices", "a.png"),
        ):
            self.refuses(keyword, *words)
        self.clrt(SCENE, "-s", "8x6", "-o", "a.pfm", "--encode", "srgb", "--reference=b.png", "--reference-samples",
                  "2", "-q")

    def test_references_have_an_even_number_of_samples(self):
        for number in "3", "1", "0", "65537", "2.5", "many":
            self.refuses(f"--reference-samples wants an even number between 2 and 65536, not '{number}'",
                         *PICTURE, "--reference-samples", number)
        self.expect(self.statistics(*PICTURE, "--reference-samples", "4"), reference__samples=4)


class Notes(Work):
    def draws(self, note, *words):
        """Expects that clrt draws the picture, and prints only the note. With -q, clrt prints nothing."""
        for quiet in [], ["-q"]:
            done = self.run_clrt(*words, "-s", "8x6", "-o", "a.pfm", *quiet)
            expected = f"clrt: {note}\n" if note and not quiet else ""
            self.assertEqual((done.stderr, done.returncode), (expected, 0), words)

    def test_a_blank_picture_is_noted(self):
        self.write(a_scn="", b_scn="light 1 1 1 1\n", b_ply=NO_MESH, c_scn="mesh b.ply\n")
        for name in "a.scn", "b.scn", "b.ply", "c.scn":
            self.draws(f"{name}: {BLANK}", name)

    def test_parts_that_are_not_read_are_no_blank_picture(self):
        points = NO_MESH.replace("vertex 0", "vertex 1") + "0 0 0\n"
        grid = points.replace("face 0", "face 0\nproperty list uchar int vertex_index\nelement range_grid 1") + "0\n"
        self.write(a_ply=points, b_ply=grid, a_scn="mesh a.ply\n", b_scn="mesh a.ply\nsphere 0 0 0 1\nlight 0 0 9 1\n")
        unread = "there is nothing to draw: the file has no triangles, and clrt does not read this element"
        for command in [], ["explain"]:
            words = ["-o", "a.pfm"] if not command else []
            for name in "a.ply", "a.scn":
                self.refuses(3, f"{name}: {POINTS}", *command, name, *words)
            self.refuses(3, f"b.ply:9: element range_grid: {unread}", *command, "b.ply", *words)
        self.assertIn(f"  FAULT: {POINTS}\n", self.run_clrt("check", "a.ply").stdout)
        self.draws("", "b.scn")

    def test_surfaces_without_lights_are_noted(self):
        self.write(a_scn="material 1\nsphere 0 0 0 1\n", b_scn=f"material 2\nmesh {SCENES}/cube.ply\n")
        for name in "a.scn", "b.scn":
            self.draws(f"{name}: {DARK}", name)

    def test_scenes_that_need_no_light_have_no_note(self):
        self.write(
            a_scn="sphere 0 0 0 1\n",  # the default material is a silhouette
            b_scn="define all matte reflectivity 1\nmaterial all\nsphere 0 0 0 1\n",
            c_scn="light 0 0 9 1\nmaterial 1\nsphere 0 0 0 1\n",
        )
        for name in "a.scn", "b.scn", "c.scn":
            self.draws("", name)

    def test_flat_mirrors_are_noted(self):
        points, triangles = models.knot()
        normals = models.normals_of(points)
        self.write(a_ply=models.ply(points, triangles), b_ply=models.ply(points, triangles, normals),
                   c_ply=models.ply(points, triangles[:99]))
        flat = "a.ply: it has no normals, so its mirrors are flat triangles: 'normals smooth' before the mesh " \
               "smooths them, and 'normals flat' keeps them"
        for note, *lines in (
            (flat, "material 3", "mesh a.ply"),
            (flat, "define m matte reflectivity 0.1", "material m", "ply_file a.ply"),
            ("", "material 1", "mesh a.ply"), ("", "material 3", "normals smooth", "mesh a.ply"),
            ("", "material 3", "normals flat", "mesh a.ply"), ("", "material 3", "mesh b.ply"),
            ("", "material 3", "mesh c.ply"),
        ):
            self.write(a_scn="light 5 5 9 1\n" + "\n".join(lines) + "\n")
            self.draws(note, "a.scn")

    def test_cameras_that_rounding_moves_are_noted(self):
        cube = f"light 9 -9 9 1\ncamera 3 -6 1 0 0 0 30\nmesh {SCENES}/cube.ply\n"
        self.write(a_scn=cube + f"mesh {SCENES}/cube.ply translate 1e7 0 0\n", b_scn=cube)
        self.draws("a.scn: view 1 shows objects 6.78 away, but the coordinates of its eye are rounded to "
                   "multiples of 0.5, because the scene's center is 5e+06 away: render distant parts separately", "a.scn")
        self.draws("", "b.scn")

    def test_check_notes_both(self):
        self.write(b_ply=NO_MESH, a_scn="material 1\nsphere 0 0 0 1\n")
        for name, kind, note in ("b.ply", "nothing_to_draw", BLANK), ("a.scn", "no_lights", DARK):
            done = self.run_clrt("check", name, "--json=a.json")
            self.assertIn(f"  note: {note}\n", done.stdout)
            self.assertEqual((done.stderr, done.returncode), ("", 0))
            findings = self.json_of("a.json")["findings"]
            self.assertEqual([f["kind"] for f in findings if f["mesh"] is None], [kind])
        text = self.clrt("check", SCENE)
        self.assertFalse([note for note in (BLANK, DARK) if note in text])

    def test_large_errors_are_noted_in_percent(self):
        self.draws("--error allows an error of 50 %; for 0.5 %, write 0.5%", SCENE, "--error", "0.5")
        self.draws("--error allows an error of 20 %; for 0.2 %, write 0.2%", SCENE, "--error", "20%")
        self.draws("", SCENE, "--error", "10%")
        self.draws("", SCENE, "--error", "0.1")

    @unittest.skipUnless(HAS_WINDOW, "this build has no window")
    def test_a_missing_scene_is_reported_before_a_missing_display(self):
        for name, reason in (("typo.scn", "cannot be opened: No such file or directory"),
                             (".", "cannot be read: it is not a file")):
            self.refuses(3, f"{name}: {reason}", name, WAYLAND_DISPLAY=None, DISPLAY=":12345")

    def test_explain_counts_the_nodes_that_verbose_counts(self):
        scene = str(SCENES / "simple.scn")
        # The number of tree nodes depends on the kernel. A wide node contains several tree nodes.
        for nodes, stored in ("wide", "1 wide node"), ("pair", "16 pair nodes"):
            words = [scene, "--tune", f"kernel={nodes}"]
            told = self.run_clrt(*words, "-s", "8x6", "-o", "a.pfm", "-v").stderr
            count = told.split("tree: ")[1].split(" nodes")[0]
            self.assertIn(f"  tree        {count} nodes over the triangles, uploaded as {stored}\n",
                          self.clrt("explain", *words))

    def test_explain_names_the_tree_over_spheres(self):
        spheres = "".join(f"sphere {i} 0 0 0.4\n" for i in range(20))
        self.write(spheres_scn=f"light 0 0 9 1\n{spheres}")
        told = self.clrt("explain", "spheres.scn", "--tune", "kernel=packet")
        self.assertRegex(told, r"(?m)^  spheres +20 of them, with a tree of \d+ wide nodes?$")
        self.assertRegex(told, r"(?m)^  tree +the spheres have one$")


if __name__ == "__main__":
    main(3)
