#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that files written by clrt convert give the picture of their source, bit for bit, and that
# wrong or damaged inputs get one message. Usage: test_convert.py CLRT 1|0, with 0 for a build
# without Assimp
import os
import pathlib
import random
import shutil
import sys
import unittest

import models
from work import ROOT, Work, main

ASSIMP = sys.argv[2] == "1"
COURSE = pathlib.Path(os.environ.get("CLRT_COURSE", ROOT.parent / "shared/course"))
POINTS, TRIANGLES = models.knot()
NORMALS = models.normals_of(POINTS)
MUTANTS = 150


class Convert(Work):
    def converts(self, *words, says=""):
        done = self.run_clrt("convert", *words)
        self.assertEqual((done.stderr, done.returncode, done.stdout), (says, 0, ""))

    def expect_same_pictures(self, before, after, views):
        for view in range(1, views + 1):
            self.expect_same(before, after, "--view", str(view), "-q", "--aa=1")


class Scenes(Convert):
    def scenes(self):
        """Yields the scenes whose meshes exist and have less than 4 MB. Larger meshes take minutes."""
        for scene in sorted(ROOT.glob("scenes/*.scn")) + sorted(COURSE.glob("scenes/*.scn")):
            statements = [line.split() for line in scene.read_text(errors="replace").splitlines()]
            meshes = [scene.parent / words[1].strip('"')
                      for words in statements if words and words[0] in ("mesh", "ply_file")]
            if all(mesh.is_file() and mesh.stat().st_size < 4e6 for mesh in meshes):
                yield scene

    def test_every_scene_gives_the_same_pictures(self):
        scenes = list(self.scenes())
        self.assertGreater(len(scenes), 5)
        if not COURSE.is_dir():
            print("skipped: the course's scenes are missing")
        for scene in scenes:
            self.converts(scene, "out.scn", "-q")
            self.expect_same_pictures(scene, "out.scn", 1)

    def test_a_scene_with_every_statement_gives_the_same_pictures(self):
        shutil.copy(ROOT / "scenes/cube.ply", self.work)
        self.write(
            a_scn="size 96 64\nbackground 0.1 0.2 0.3\nambient 0.07\nmax_level 5\n"
            "camera 3 -7 4 0 0 0 40\nup 0 1 0.1\ncamera 5 1 2 0 0 0.1 33.3\nlight 5 -7 8 0.7\n"
            "define gold blinn_phong diffuse 1 .8 .2 shininess 200.5 reflectivity .3 ks 3.3\n"
            'define "my wax" matte diffuse 0.1 0.2 0.3 kd 0.9\nsphere 1 0.2 0.3 0.4\n'
            "material gold\nsphere -1 0.2 0.3 0.4\nmesh cube.ply scale 0.3 rotate 1 2 3 17.3\n"
            'material "my wax"\nsides two\nnormals flat\nply_file cube.ply\n'
        )
        self.converts("a.scn", "b.scn")
        self.expect_same_pictures("a.scn", "b.scn", 2)
        self.converts("b.scn", "c.scn")
        texts = [(self.work / name).read_text() for name in ("b.scn", "c.scn")]
        self.assertEqual(texts[0].replace("b-", "c-"), texts[1])

    def test_computed_and_flat_normals_are_kept(self):
        normals = [(0, 0, 0)] + NORMALS[1:]
        self.write(a_ply=models.ply(POINTS, TRIANGLES), n_ply=models.ply(POINTS, TRIANGLES, normals),
                   a_scn="light 5 -7 8 0.7\nmaterial 1\nmesh n.ply scale 0.3\nnormals smooth 20\nmesh a.ply scale 0.3\n"
                         "normals flat\nmesh n.ply scale 0.2\nnormals smooth\nmesh n.ply scale 0.1\n")
        self.converts("a.scn", "b.scn")
        self.expect_same_pictures("a.scn", "b.scn", 3)

    def test_colors_of_vertices_are_kept(self):
        colors = [(number % 2, 0.3, number / 8) for number in range(len(POINTS))]
        self.write(a_ply=models.ply(POINTS, TRIANGLES, colors=colors), b_ply=models.ply(POINTS, TRIANGLES),
                   a_scn="light 5 -7 8 0.7\ndefine gold blinn_phong reflectivity 0.2\nmesh a.ply scale 0.3\n"
                         "material own gold\nnormals smooth\nmesh a.ply scale 0.2\nmaterial gold\nmesh b.ply\n")
        self.converts("a.scn", "b.scn")
        self.expect_same_pictures("a.scn", "b.scn", 3)
        self.converts("a.ply", "lone.scn")
        self.expect_same_pictures("a.ply", "lone.scn", 1)

    def test_uncolored_meshes_keep_their_color_beside_colored_ones(self):
        colors = [(0.0, 0.5, 1.0)] * len(POINTS)
        self.write(a_ply=models.ply(POINTS, TRIANGLES, colors=colors), b_ply=models.ply(POINTS, TRIANGLES),
                   both_scn="define red matte diffuse 1 0.25 0\nmesh a.ply\nmaterial red\nmesh b.ply scale 2\n")
        self.converts("both.scn", "both.ply", "-q")
        doubled = [tuple(2 * value for value in point) for point in POINTS]
        second = [tuple(len(POINTS) + corner for corner in triangle) for triangle in TRIANGLES]
        self.write(expected_ply=models.ply(POINTS + doubled, TRIANGLES + second,
                                           colors=colors + [(1.0, 0.25, 0.0)] * len(POINTS)))
        self.expect_same_pictures("both.ply", "expected.ply", 1)

    def test_verbose_names_the_meshes(self):
        self.converts(ROOT / "scenes/cube.ply", "b.scn", "-v", says="b-1.ply: 10 triangles\n")

    def test_a_mesh_is_one_mesh_again(self):
        self.write(a_ply=models.ply(POINTS, TRIANGLES, NORMALS))
        self.converts("a.ply", "b.ply")
        self.assert_same_bytes("a.ply", "b.ply")

    def test_the_meshes_of_a_scene_become_one_mesh_and_keep_their_places(self):
        self.write(a_ply=models.ply(POINTS, TRIANGLES),
                   a_scn="mesh a.ply scale 0.1\nmesh a.ply rotate 1 1 1 30\n")
        losses = "materials, lights and cameras are left out, because PLY cannot store them"
        self.converts("a.scn", "b.ply", says=f"clrt: b.ply: {losses}\n")
        self.write(b_scn="mesh b.ply\n")
        self.expect_same_pictures("a.scn", "b.scn", 2)

    def test_spheres_do_not_become_a_mesh(self):
        self.write(a_scn="sphere 0 0 0 1\n")
        self.refuses(3, "a.scn: PLY cannot store spheres",
                     "convert", "a.scn", "b.ply")
        self.assertFalse((self.work / "b.ply").exists())


class Refusals(Convert):
    def refuses(self, code, sentence, *words):
        super().refuses(code, sentence, "convert", *words)

    def test_other_endings_and_counts_of_files_are_usage(self):
        self.refuses(2, "not 'b.obj'", "a.ply", "b.obj")
        self.refuses(2, "a name is missing", "a.ply")
        self.refuses(2, "takes no --aa", "a.ply", "b.ply", "--aa")

    def test_a_full_disk_is_one_sentence(self):
        self.write(a_ply=models.ply(POINTS, TRIANGLES))
        (self.work / "b.ply").symlink_to("/dev/full")
        (self.work / "c.scn").symlink_to("/dev/full")
        for name in ("b.ply", "c.scn"):
            self.refuses(5, f"{name}: cannot be written", "a.ply", name)
        self.refuses(5, "none/b.ply: cannot be written", "a.ply", "none/b.ply")

    def test_a_scene_that_is_wrong_is_exit_3_and_writes_nothing(self):
        self.write(a_scn="mesh none.ply\n")
        self.clrt("convert", "a.scn", "b.scn", code=3)
        self.assertEqual(sorted(file.name for file in self.work.iterdir()), ["a.scn"])

    def test_bad_geometry_is_refused_on_request(self):
        self.write(a_ply=models.ply([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]))
        self.refuses(3, "a.ply: triangle 0 has its corners on a line",
                     "a.ply", "b.ply", "--bad-geometry", "fail")


@unittest.skipUnless(ASSIMP, "this build is without Assimp")
class Models(Convert):
    def test_models_in_any_format_give_the_same_pictures(self):
        coarse = models.coarse(POINTS)
        node = {"translation": [0.1, 0.2, 0.3], "rotation": [0.5, 0.5, 0.5, 0.5]}
        self.write(a_stl=models.stl(POINTS, TRIANGLES), c_obj=models.obj(coarse, TRIANGLES),
                   b_glb=models.glb(POINTS, TRIANGLES, NORMALS, node))
        for name in ("a.stl", "b.glb", "c.obj"):
            self.converts(name, "out.ply")
            self.converts(name, "out.scn")
            self.expect_same_pictures(name, "out.ply", 2)
            self.expect_same_pictures(name, "out.scn", 2)

    def test_scenes_keep_materials_and_their_loss_in_ply_is_reported(self):
        groups = [("usemtl red", 0), ("usemtl dull blue", 200)]
        self.write(a_obj=models.obj(models.coarse(POINTS), TRIANGLES, "mtllib a.mtl", groups),
                   a_mtl="newmtl red\nKd 0.7 0.1 0.3\nKs .3 .3 .3\nNs 33.3\nnewmtl dull blue\nKd 0 0 .7\n")
        self.converts("a.obj", "b.scn")
        self.expect_same_pictures("a.obj", "b.scn", 2)
        losses = "materials are left out, because PLY cannot store them"
        self.converts("a.obj", "b.ply", says=f"clrt: b.ply: {losses}\n")

    def test_changed_files_are_converted_or_refused_in_one_sentence(self):
        points, triangles = models.knot(6, 4)
        coarse = models.coarse(points)
        whole = {"obj": models.obj(coarse, triangles, "mtllib a.mtl", [("usemtl red", 0)]),
                 "stl": models.stl(points, triangles),
                 "glb": models.glb(points, triangles, models.normals_of(points)),
                 "off": models.off(coarse, triangles)}
        chance = random.Random(1)
        inserts = [b"-1", b"99999999999", b"nan", b"\xff" * 4, b"{", b"f 1 2 3\n", b"1e39"]
        outcomes = set()
        for number in range(MUTANTS):
            ending = chance.choice(sorted(whole))
            content = bytearray(whole[ending])
            for _ in range(chance.choice([1, 2, 5, 20])):
                place = chance.randrange(len(content))
                kind = chance.randrange(3)
                if kind == 0:
                    content[place] = chance.randrange(256)
                elif kind == 1:
                    del content[place : place + chance.randrange(1, 40)]
                else:
                    content[place:place] = chance.choice(inserts)
                content = content or bytearray(b"x")
            (self.work / f"m.{ending}").write_bytes(content)
            done = self.run_clrt("convert", f"m.{ending}", "out.ply", "-q")
            outcomes.add(done.returncode)
            self.assertIn(done.returncode, (0, 3), (number, ending, done.stderr))
            if done.returncode == 3:
                self.assertRegex(done.stderr, rf"^clrt: m\.{ending}: [ -~]+\n$", (number, ending))
        self.assertEqual(outcomes, {0, 3})


if __name__ == "__main__":
    main(2)
