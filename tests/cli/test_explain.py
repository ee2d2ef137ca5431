#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# --explain-pixel and --explain: text, JSON, the picture's color, and what is compiled and uploaded.
# Usage: test_explain.py CLRT
from models import ply
from pictures import read_pfm
from work import EVERY_FEATURE, ROOT, SharedWork, main

# Worked out by hand in tests/image/test_explain_by_hand.c.
MIRRORS = """size 5 5
ambient 0.1
background 0 0 1
light 0 0 2 1
define mirror matte diffuse 1 1 1 kd 0.5 reflectivity 0.5
material mirror
sphere 0 3 0 1
sphere 0 -3 0 1
camera 0 0 0 0 1 0 90
"""
# The first light is behind the face alone, the second behind the normal too, as worked out there.
LEANING = "size 5 5\nlight 11 -2 -5 1\nlight -9 -2 -5 1\nmaterial 1\nply_file leaning.ply\nup 0 1 0\n" \
          "camera 1 -2 4 1 -2 0 90\n"
PIXEL = ["mirrors.scn", "--explain-pixel", "2,2"]
FORMS = ["", "--aa=3", "--kernel ray --nodes pair", "--kernel ray --nodes wide", "--kernel packet --lanes 4",
         "--precision fp64", "--precision fp64 --aa", "--no-bvh", "--max-level 1", "--max-level 0", "-j 1"]


class Explain(SharedWork):
    def prepare(self):
        corners = [(-10, -10, 0), (10, -10, 0), (10, 10, 0)]
        self.write(
            mirrors_scn=MIRRORS, leaning_scn=LEANING, leaning_ply=ply(corners, [(0, 1, 2)], [(0.6, 0, 0.8)] * 3),
            ball_scn="size 8 8\nlight 0 0 9 1\nmaterial 1\nsphere 0 0 0 1\n",
            flat_scn=f"size 8 8\nmaterial 0\nply_file {ROOT}/scenes/cube.ply\n",
        )


class Pixels(Explain):
    def test_the_text_is_what_the_documentation_shows(self):
        done = self.run_clrt(*PIXEL)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"```\n{done.stdout}```\n", (ROOT / "docs/explaining.md").read_text())
        color = "\nthe pixel's color (0.396859199, 0.396859199, 0.521859169), in 8 bits "
        self.assertTrue(done.stdout.endswith(color + "101 101 133\n"))
        self.assertTrue(self.clrt(*PIXEL, "--encode", "srgb").endswith(color + "169 169 191\n"))

    def test_a_corner_meets_nothing(self):
        self.assertIn("meets      nothing", self.clrt("mirrors.scn", "--explain-pixel", "0,4"))

    def test_json_has_each_ray(self):
        found = self.report(*PIXEL, "--json")
        self.expect(found, schema=1, pixel=[2, 2], size=[5, 5])
        (sample,) = found["samples"]
        rays = [(ray["hit"]["primitive"]["number"], ray["weight"], ray["kind"]) for ray in sample["rays"]]
        self.assertEqual(rays, [(1, 1, "camera"), (2, 0.5, "reflected"), (1, 0.25, "reflected")])

    def test_lights_behind_a_face_and_behind_a_normal_differ(self):
        words = ["leaning.scn", "--explain-pixel", "2,2"]
        told = self.clrt(*words)
        self.assertIn("light 1    does not reach it: the face is turned away; cosine 0.1788", told)
        self.assertIn("light 2    does not reach it: the normal is turned away; cosine -0.8944", told)
        lights = self.report(*words, "--json")["samples"][0]["rays"][0]["hit"]["lights"]
        self.assertEqual([light["state"] for light in lights], ["behind_face", "behind"])

    def test_the_color_is_the_pictures_and_each_blocker_is_named(self):
        for form in FORMS:
            found = self.report(EVERY_FEATURE, "--explain-pixel", "70,60", "--json", *form.split())
            self.clrt(EVERY_FEATURE, "--crop", "70,60,71,61", "-o", "a.pfm", *form.split())
            self.assertEqual([found["color"]], read_pfm(self.work / "a.pfm"), form)
            hits = [ray["hit"] for sample in found["samples"] for ray in sample["rays"] if ray["hit"]]
            for blocker in (light["blocker"] for hit in hits for light in hit["lights"] if light["blocker"]):
                self.assertTrue(blocker["kind"] == "sphere" or blocker["file"].endswith(".ply"), blocker)

    def test_refusals(self):
        for code, sentence, words in (
            (2, "--explain-pixel 2,9: the picture has 5 x 5 pixels, counted from 0",
             ["mirrors.scn", "--explain-pixel", "2,9"]),
            (2, "--explain-pixel wants X,Y counted from 0, X from the left and Y from the top, not '2'",
             ["mirrors.scn", "--explain-pixel", "2"]),
            (2, "clrt --explain-pixel takes no --output", [*PIXEL, "-o", "a.pfm"]),
            (2, "clrt --explain takes no --output", ["ball.scn", "--explain", "-o", "a.pfm"]),
            (3, "nowhere.scn: cannot be opened: No such file or directory",
             ["nowhere.scn", "--explain-pixel", "0,0"]),
            (5, "/dev/full: cannot be written: No space left on device", [*PIXEL, "--json=/dev/full"]),
        ):
            self.refuses(code, sentence, *words)


class Scenes(Explain):
    """Specialized kernels omit features that a scene lacks; general ones contain them unused."""

    def expect_parts(self, words, **parts):
        """Compares whether each part is needed and compiled, and the reason; returns the report."""
        found = self.report(*words, "--explain", "--json")
        by_name = {part["name"]: part for part in found["parts"]}
        for name, expected in parts.items():
            part = by_name[name]
            self.assertEqual((part["needed"], part["compiled"], part["reason"]), expected, name)
        return found

    def test_the_text_lists_what_is_compiled_left_out_and_uploaded(self):
        told = self.clrt("ball.scn", "--explain", "--specialize", "always")
        left_out = told.split("\nleft out\n")[1].split("\nuploaded")[0]
        self.assertEqual(left_out.count("\n  ") + 1, 4, told)
        self.assertIn("  tree        there are no triangles to find", left_out)
        self.assertIn("  triangles   there are none", left_out)
        for part in "  spheres     1 of them", "  spheres     48 bytes", " nodes triangles looks normals":
            self.assertIn(part, told)

    def test_special_kernels_have_what_the_scene_has(self):
        found = self.expect_parts(
            ["ball.scn", "--specialize", "always"],
            spheres=(True, True, "1 of them"), triangles=(False, False, "there are none"),
            mirrors=(False, False, "no material in use reflects: no ray is followed on"),
        )
        self.assertEqual(found["program"], {"special": True, "reason": "--specialize always"})

    def test_general_kernels_have_all_but_counters_that_nobody_requests(self):
        general = ["ball.scn", "--specialize", "never"]
        self.expect_parts(general, triangles=(False, True, "there are none"),
                          statistics=(False, False, "not requested: no --stats"))
        self.expect_parts([*general, "--stats"], statistics=(True, True, "--stats counts rays and tests"))

    def test_silhouettes_are_not_lit_and_few_triangles_get_no_tree(self):
        self.expect_parts(["flat.scn", "--specialize", "always"],
                          lights=(False, False, "all materials in use are silhouettes: no shadow rays"),
                          tree=(False, False, "10 triangles are tested sooner than found"))

    def test_requested_trees_and_kernels_are_there(self):
        words = ["flat.scn", "--bvh", "sah", "--kernel", "ray", "--nodes", "pair"]
        found = self.expect_parts(words)
        self.assertTrue(next(part for part in found["parts"] if part["name"] == "tree")["needed"])
        self.assertGreater(found["uploaded_bytes"]["nodes"], 0)
        self.assertEqual(found["kernels"], {"family": "ray", "nodes": "pair", "precision": "fp32",
                                            "reason": "--kernel requests it"})


if __name__ == "__main__":
    main(1)
