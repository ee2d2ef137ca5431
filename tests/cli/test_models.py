#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests meshes in formats other than PLY: they give the picture of the PLY mesh and keep their
# materials. Also tests hostile files. Usage: test_models.py CLRT 1|0 [EXPORT], with 0 for a build
# without Assimp. EXPORT is the program of export_model.c.
import os
import re
import subprocess
import sys
import time
import unittest

import models
from work import Work, main

ASSIMP = sys.argv[2] == "1"
EXPORT = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 else None
CAMERA = "size 96 64\ncamera 3 -7 4 0 0 0 40\nlight 5 -7 8 1\n"
POINTS, TRIANGLES = models.knot()
COARSE = models.coarse(POINTS)
HALF = len(TRIANGLES) // 2
LIBRARY = (
    "newmtl red\nKd 0.5 0.25 0.125\nKs 0 0 0\nNs 10\n"
    "newmtl shiny\nKd 0.125 0.5 0.25\nKs 0.5 0.5 0.25\nNs 40\n"
)
DEFINES = (
    "define red matte diffuse 0.5 0.25 0.125\n"
    "define shiny blinn_phong diffuse 0.125 0.5 0.25 specular 0.5 0.5 0.25 kd 1 ks 1 shininess 40\n"
)
COLORED = models.obj(COARSE, TRIANGLES, "mtllib colors.mtl", [("usemtl red", 0), ("usemtl shiny", HALF)])
GRAY = "those that it names are gray (0.6 0.6 0.6)"


@unittest.skipIf(ASSIMP, "this build has Assimp")
class WithoutAssimp(Work):
    def test_a_format_that_needs_it_is_refused_in_one_sentence(self):
        self.write(a_obj="", a_scn="mesh a.obj\n")
        sentence = "a.obj: this build reads only PLY meshes, because it lacks Assimp; add it: " \
                   "tools/setup meshes && tools/render SCENE"
        self.fails(sentence, "a.obj")
        self.fails("a.scn:1:6: " + sentence, "a.scn")


@unittest.skipUnless(ASSIMP, "this build is without Assimp")
class Formats(Work):
    def expect_pictures_of_ply(self, *names):
        for name in names:
            self.expect_same(name, "a.ply", "--up", "z")

    def test_formats_that_keep_floats_give_the_picture_of_ply(self):
        self.write(a_ply=models.ply(POINTS, TRIANGLES), a_stl=models.stl(POINTS, TRIANGLES),
                   a_glb=models.glb(POINTS, TRIANGLES))
        self.expect_pictures_of_ply("a.stl", "a.glb")

    def test_formats_in_decimals_give_the_picture_of_ply_if_decimals_are_short(self):
        self.write(a_ply=models.ply(COARSE, TRIANGLES), a_obj=models.obj(COARSE, TRIANGLES),
                   a_OFF=models.off(COARSE, TRIANGLES))
        self.expect_pictures_of_ply("a.obj", "a.OFF")

    def test_normals_come_from_the_file(self):
        normals = models.normals_of(POINTS)
        self.write(a_ply=models.ply(POINTS, TRIANGLES, normals), a_glb=models.glb(POINTS, TRIANGLES, normals),
                   flat_glb=models.glb(POINTS, TRIANGLES))
        self.expect_same("a.glb", "a.ply", "--up", "z")
        self.assertNotEqual(self.picture("a.glb"), self.picture("flat.glb"))

    def test_computed_normals_are_the_same_in_every_format(self):
        models_of = {"ply": models.ply, "stl": models.stl, "glb": models.glb, "obj": models.obj, "off": models.off}
        for ending, write in models_of.items():
            (self.work / f"a.{ending}").write_bytes(write(COARSE, TRIANGLES))
            text = f"{CAMERA}material 2\nnormals smooth 50\nmesh a.{ending} rotate 1 2 3 10\n"
            (self.work / f"{ending}.scn").write_text(text)
        expected = self.picture("ply.scn")
        for ending in models_of:
            for threads in "1", "2", "3":
                self.assertEqual(self.picture(f"{ending}.scn", "--threads", threads), expected, (ending, threads))

    def test_only_a_statement_or_a_lone_mesh_computes_normals(self):
        self.write(a_ply=models.ply(POINTS, TRIANGLES))
        for name, statement in ("plain", ""), ("flat", "normals flat\n"), ("smooth", "normals smooth\n"), (
                "sharp", "normals smooth 0\n"), ("round", "normals smooth 180\n"):
            text = f"{CAMERA}material 2\n{statement}mesh a.ply\n"
            (self.work / f"{name}.scn").write_text(text)
        plain, smooth = self.picture("plain.scn"), self.picture("smooth.scn")
        self.assertEqual(self.picture("flat.scn"), plain)
        self.assertEqual(len({plain, smooth, self.picture("round.scn")}), 3)
        self.converts_to_flat("a.ply")

    # The flat picture needs the lone mesh's cameras, so its scene is converted from the mesh.
    def converts_to_flat(self, name):
        self.clrt("convert", name, "lone.scn")
        self.expect_same(name, "lone.scn", "--aa=1")
        text = (self.work / "lone.scn").read_text()
        (self.work / "flat.scn").write_text(text.replace("mesh ", "normals flat\nmesh "))
        self.assertNotEqual(self.picture(name), self.picture("flat.scn"))

    def test_check_counts_the_vertices_of_the_file(self):
        self.write(a_stl=models.stl(POINTS, TRIANGLES), a_scn="normals smooth\nmesh a.stl\n")
        for name in "a.stl", "a.scn":
            self.run_clrt("check", name, "--json=check.json")
            self.assertEqual(self.json_of("check.json")["meshes"][0]["vertices"], 3 * len(TRIANGLES))

    def test_faces_of_four_corners_are_split(self):
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        self.write(a_ply=models.ply(square, [(0, 1, 2), (0, 2, 3)]), a_obj=models.obj(square, [(0, 1, 2, 3)]))
        self.expect_same("a.obj", "a.ply", "--up", "z")

    def test_a_statement_moves_every_part(self):
        moves = "scale 0.5 rotate 0 1 0 30 translate 0.25 0 0\n"
        self.write(a_ply=models.ply(COARSE, TRIANGLES), colors_obj=COLORED, colors_mtl=LIBRARY,
                   a_scn=CAMERA + "material 2\nmesh colors.obj " + moves,
                   b_scn=CAMERA + "material 2\nmesh a.ply " + moves)
        self.expect_same("a.scn", "b.scn")

    def test_a_node_places_and_a_mirroring_one_keeps_fronts_in_front(self):
        turn = {"translation": [1, 2, 3], "scale": [-2, 1, 1]}
        moved = [(1 - 2 * x, 2 + y, 3 + z) for x, y, z in COARSE]
        turned = [(a, c, b) for a, b, c in TRIANGLES]
        self.write(a_glb=models.glb(COARSE, TRIANGLES, node=turn), a_ply=models.ply(moved, turned),
                   a_scn=CAMERA + "material 2\nmesh a.glb\n", b_scn=CAMERA + "material 2\nmesh a.ply\n")
        self.expect_same("a.scn", "b.scn")

    def test_lines_and_points_are_left_out_and_reported(self):
        self.write(a_obj=models.obj(COARSE, TRIANGLES) + b"l 1 2\np 3\n")
        self.picture("a.obj", says="clrt: a.obj: 2 lines and points are left out\n")
        self.assertIn("2 lines and points", self.run_clrt("check", "a.obj").stderr)

    def test_colors_of_vertices_are_those_of_ply(self):
        colors = [(number % 4 / 4, number % 3 / 2, 0.75) for number in range(len(COARSE))]
        painted = [point + color for point, color in zip(COARSE, colors)]
        self.write(a_ply=models.ply(COARSE, TRIANGLES, colors=colors), a_obj=models.obj(painted, TRIANGLES),
                   plain_ply=models.ply(COARSE, TRIANGLES))
        self.expect_same("a.obj", "a.ply", "--up", "z")
        self.assertNotEqual(self.picture("a.ply"), self.picture("plain.ply"))
        for material in "own", "own 2":
            self.write(a_scn=CAMERA + f"material {material}\nmesh a.obj\n",
                       b_scn=CAMERA + f"material {material}\nmesh a.ply\n")
            self.expect_same("a.scn", "b.scn")

    def test_a_selected_material_ignores_the_colors_of_vertices(self):
        colors = [(1.0, 0.0, 0.5)] * len(COARSE)
        self.write(a_ply=models.ply(COARSE, TRIANGLES, colors=colors), b_ply=models.ply(COARSE, TRIANGLES),
                   a_scn=CAMERA + "material 2\nmesh a.ply\n", b_scn=CAMERA + "material 2\nmesh b.ply\n")
        self.expect_same("a.scn", "b.scn")

    def test_ply_file_stays_for_ply(self):
        self.write(a_obj=COLORED, a_scn="ply_file a.obj\n")
        self.fails("a.obj:1: the file does not begin with 'ply'", "a.scn")

    def test_check_reads_models(self):
        self.write(a_stl=models.stl(POINTS, TRIANGLES), colors_obj=COLORED, colors_mtl=LIBRARY)
        self.assertRegex(self.clrt("check", "a.stl"), rf"a\.stl: {len(TRIANGLES)} triangles, .*, closed\n")
        told = self.clrt("check", "colors.obj")
        for name, count in ("red", HALF), ("shiny", len(TRIANGLES) - HALF):
            self.assertIn(f"colors.obj, material colors.obj:{name}: {count} triangles, ", told)

    def test_warm_and_statistics_read_models(self):
        self.write(a_stl=models.stl(POINTS, TRIANGLES))
        self.clrt("warm", "a.stl", "--tune=specialize=never")
        self.picture("a.stl", "-q", "--json=stats.json")
        self.assertIn(f'"triangles": {len(TRIANGLES)}', (self.work / "stats.json").read_text())


@unittest.skipUnless(ASSIMP, "this build is without Assimp")
class Exported(Work):
    """Tests files that Assimp writes from a PLY mesh."""

    SCENE = CAMERA + "material 2\nmesh "

    def expect_same_picture(self, mesh, formats):
        self.write(a_ply=mesh, a_scn=self.SCENE + "a.ply\n")
        expected = self.picture("a.scn")
        for name, ending in formats.items():
            subprocess.run([EXPORT, "a.ply", name, f"a.{ending}"], cwd=self.work, check=True)
            self.write(b_scn=f"{self.SCENE}a.{ending}\n")
            self.assertEqual(self.picture("b.scn"), expected, name)

    def test_every_ending_that_assimp_reads_is_a_model(self):
        told = subprocess.run([EXPORT], capture_output=True, text=True, check=True).stdout
        own = {"ply", "scn", "xml"}  # .xml does not identify a format
        for ending in set(told.split()) - own:
            (self.work / f"a.{ending}").write_text("light\n")
            self.assertNotIn("the statement is", self.clrt(f"a.{ending}", "-o", "a.pfm", code=3), ending)

    def test_formats_of_floats_give_the_picture_of_ply(self):
        mesh = models.ply(POINTS, TRIANGLES, models.axes_of(POINTS))
        self.expect_same_picture(mesh, {"glb2": "glb", "gltf2": "gltf", "assbin": "assbin"})

    def test_formats_without_normals_give_the_picture_of_ply(self):
        self.expect_same_picture(models.ply(POINTS, TRIANGLES), {"stlb": "stl"})

    def test_decimal_formats_give_the_picture_of_ply_if_decimals_are_short(self):
        mesh = models.ply(COARSE, TRIANGLES, models.axes_of(POINTS))
        self.expect_same_picture(mesh, {"obj": "obj", "collada": "dae", "fbxa": "fbx"})


@unittest.skipUnless(ASSIMP, "this build is without Assimp")
class Materials(Work):
    def setUp(self):
        super().setUp()
        self.write(colors_obj=COLORED, colors_mtl=LIBRARY, red_ply=models.ply(COARSE, TRIANGLES[:HALF]),
                   shiny_ply=models.ply(COARSE, TRIANGLES[HALF:]), whole_ply=models.ply(COARSE, TRIANGLES),
                   own_scn=CAMERA + "mesh colors.obj\n")

    def test_the_files_materials_are_used_until_a_material_is_selected(self):
        self.write(defined_scn=CAMERA + DEFINES + "material red\nmesh red.ply\nmaterial shiny\nmesh shiny.ply\n")
        self.expect_same("own.scn", "defined.scn")

    def test_a_selected_material_replaces_the_files_materials(self):
        self.write(a_scn=CAMERA + "material 2\nmesh colors.obj\n", b_scn=CAMERA + "material 2\nmesh whole.ply\n")
        self.expect_same("a.scn", "b.scn")

    def test_material_own_selects_the_files_materials_again(self):
        self.write(a_scn=CAMERA + "material 2\nmaterial own\nmesh colors.obj\n")
        self.expect_same("a.scn", "own.scn")

    def test_a_model_without_a_scene_has_its_materials(self):
        self.write(plain_obj=models.obj(COARSE, TRIANGLES))
        self.expect_same("plain.obj", "whole.ply", "--up", "z")
        self.assertFalse(self.picture("colors.obj") == self.picture("plain.obj"))

    def test_explanations_name_the_material_and_the_triangle(self):
        text = self.run_clrt("explain", "own.scn", "48,32", "--view", "1").stdout
        self.assertRegex(text, r"triangle \d+ of colors.obj, material colors.obj:(red|shiny)")

    def test_a_missing_library_is_reported(self):
        (self.work / "colors.mtl").unlink()
        self.clrt("convert", "colors.obj", "gray.scn", "-q")
        defined = re.findall(r'define "colors.obj:.*', (self.work / "gray.scn").read_text())
        self.assertTrue(defined and all("matte diffuse 0.6 0.6 0.6 " in line for line in defined), defined)
        self.picture("colors.obj", says=f"clrt: colors.obj: its materials, colors.mtl, cannot be opened: {GRAY}\n")

    def test_the_pictures_hash_is_of_the_library_too(self):
        def hash_in_picture():
            self.clrt("colors.obj", "-s", "8x8", "-o", "a.png")
            return self.bytes_of("a.png").split(b"clrt:scene_hash\0")[1][:32]

        before = hash_in_picture()
        self.assertEqual(hash_in_picture(), before)
        self.write(colors_mtl=LIBRARY + "# a comment\n")
        self.assertNotEqual(hash_in_picture(), before)


@unittest.skipUnless(ASSIMP, "this build is without Assimp")
class Hostile(Work):
    def test_a_crash_is_one_sentence_that_names_the_line(self):
        self.write(a_off="OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n9 0 1 2\n3 0 1 2\n", a_scn="light 0 0 1 1\n\nmesh a.off\n")
        self.assertRegex(self.clrt("a.scn", "-o", "a.pfm", code=3), r"^clrt: a\.scn:3:6: a\.off: Assimp .*\n$")

    def test_a_tree_of_endless_depth_is_one_sentence(self):
        def deepen(document):
            document["nodes"] = [{"children": [i + 1]} for i in range(200000)] + [{"mesh": 0}]

        self.write(a_glb=models.glb(POINTS, TRIANGLES, change=deepen))
        self.assert_small_failure("Assimp crashed while reading it .*", "ulimit -s unlimited")

    def test_nodes_that_double_with_each_level_are_one_sentence(self):
        def double(document):
            document["nodes"] = [{"children": [i + 1] * 2} for i in range(40)] + [{"mesh": 0}]

        self.write(a_glb=models.glb(POINTS, TRIANGLES, change=double))
        self.assert_small_failure("Assimp needs more memory than the limit for a file of this size")

    # clrt must fail with less than 800 MB, because filling a further gigabyte would take seconds.
    def assert_small_failure(self, sentence, setting=":"):
        before = ["bash", "-c", f'{setting}; exec "$@"', "bash"]
        status, text = self.run_within(60, 800, "a.glb", "-o", "a.pfm", before=before)
        self.assertEqual(status, 3)
        self.assertRegex(text, rf"^clrt: a\.glb: {sentence}\n$")

    def test_huge_counts_are_refused_at_once(self):
        def enlarge(document):
            document["accessors"][1]["count"] = 4000000000

        self.write(a_off="OFF\n4000000000 1 0\n0 0 0\n", a_glb=models.glb(POINTS, TRIANGLES, change=enlarge),
                   a_stl=b"\0" * 80 + b"\xff\xff\xff\x7f" + b"\0" * 50)
        for name in ("a.off", "a.glb", "a.stl"):
            start = time.monotonic()
            self.assertRegex(self.clrt(name, "-o", "a.pfm", code=3), rf"^clrt: {name}: .*\n$")
            self.assertLess(time.monotonic() - start, 20)

    def test_truncated_files_and_noise_are_one_sentence(self):
        whole = models.glb(POINTS, TRIANGLES)
        self.write(a_glb=whole[: len(whole) // 2], a_stl="noise", a_obj="", a_fbx=bytes(range(256)))
        for name in ("a.glb", "a.stl", "a.obj", "a.fbx"):
            told = self.clrt(name, "-o", "a.pfm", code=3)
            self.assertRegex(told, rf"^clrt: {name}: Assimp cannot read it: .*\n$")

    def test_a_polygon_of_many_corners_is_one_sentence(self):
        corners = range(1, 300001)
        points = "".join(f"v {corner} {corner % 7} 0\n" for corner in corners)
        self.write(a_obj=points + "f " + " ".join(map(str, corners)) + "\n",
                   b_obj=points + "f " + " \\\n".join(map(str, corners)) + "\n")
        says = "its polygons of up to 300000 corners take too long to triangulate; PLY files may have such " \
               "polygons if they are convex"
        for name in "a.obj", "b.obj":
            status, text = self.run_within(10, 1000, name, "-o", "a.pfm", "-s", "8x8")
            self.assertEqual((status, text), (3, f"clrt: {name}: {says}\n"))

    def test_a_scene_reads_each_file_once(self):
        self.write(a_obj="v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                   c_obj="v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
        lines = (f"mesh {'ac'[i % 2]}.obj translate {i} 0 0\n" for i in range(1000))
        self.write(a_scn="light 4 4 4 1\n" + "".join(lines))
        self.assertEqual(self.run_within(4, 500, "convert", "a.scn", "b.ply")[0], 0)
        self.assertIn(b"element face 1000\n", self.bytes_of("b.ply"))

    def test_a_model_reads_no_file_outside_of_its_folder(self):
        (self.work / "inner").mkdir()
        self.write(secret_mtl=LIBRARY)
        (self.work / "inner/a.obj").write_bytes(COLORED.replace(b"colors.mtl", b"../secret.mtl"))
        (self.work / "inner/b.obj").write_bytes(
            COLORED.replace(b"colors.mtl", str(self.work / "secret.mtl").encode())
        )
        (self.work / "inner/none.obj").write_bytes(COLORED.replace(b"colors.mtl", b"none.mtl"))
        expected = self.picture("inner/none.obj", "-q")
        for name in ("inner/a.obj", "inner/b.obj"):
            self.assertEqual(self.picture(name, "-q"), expected)
        self.assertIn("it names files outside of its folder, which are not read",
                      self.run_clrt("inner/a.obj", "-s", "8x8", "-o", "a.pfm").stderr)

    def test_links_lead_no_further_than_the_folder(self):
        note = "it names files outside of its folder, which are not read"
        for name in "inner", "other":
            (self.work / name).mkdir()
        self.write(secret_mtl=LIBRARY)
        for name, library in ("a", "colors.mtl"), ("b", "out/secret.mtl"), ("c", "own.mtl"):
            model = COLORED.replace(b"colors.mtl", library.encode())
            (self.work / f"inner/{name}.obj").write_bytes(model)
        (self.work / "inner/plain.obj").write_bytes(COLORED.replace(b"mtllib", b"#"))
        (self.work / "inner/colors.mtl").symlink_to("../secret.mtl")
        (self.work / "inner/out").symlink_to(self.work)
        plain = self.picture("inner/plain.obj")
        for name, library in ("inner/a.obj", "colors.mtl"), ("inner/b.obj", "out/secret.mtl"):
            says = f"clrt: {name}: its materials, {library}, cannot be opened: {GRAY}; {note}\n"
            self.assertEqual(self.picture(name, says=says), plain)
        # Links inside the folder work. The model that the user names may be a link, too.
        (self.work / "inner/kept.mtl").write_text(LIBRARY)
        (self.work / "inner/own.mtl").symlink_to(self.work / "inner/kept.mtl")
        colored = self.picture("inner/c.obj")
        self.assertNotEqual(colored, plain)
        (self.work / "other/a.obj").symlink_to("../inner/a.obj")
        (self.work / "other/colors.mtl").write_text(LIBRARY)
        (self.work / "linked").symlink_to("other")
        for name in "other/a.obj", "linked/a.obj":
            self.assertEqual(self.picture(name), colored)

    def test_pipes_and_folders_are_no_models(self):
        os.mkfifo(self.work / "pipe.obj")
        os.mkfifo(self.work / "colors.mtl")
        (self.work / "folder.obj").mkdir()
        for name in ("pipe.obj", "folder.obj"):
            self.fails(f"{name}: cannot be read: it is not a file", name)
        self.write(colors_obj=COLORED)
        self.picture("colors.obj", says=f"clrt: colors.obj: its materials, colors.mtl, cannot be opened: {GRAY}\n")

    def test_coordinates_that_are_no_numbers_are_refused_as_in_ply(self):
        bad = [(float("nan"), 0, 0)] + POINTS[1:]
        self.write(a_stl=models.stl(bad, TRIANGLES))
        told = self.clrt("a.stl", "-o", "a.pfm", code=3)
        self.assertRegex(told, r"^clrt: a\.stl: part 0: vertex 0: x is -?nan, not a finite number")
        self.clrt("check", "a.stl", code=1)

    def test_messages_about_vertices_name_the_object(self):
        text = "o lamp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no chair\nv 0 0 1\nv 1e31 0 1\nv 0 1 1\nf 4 5 6\n"
        self.write(a_obj=text)
        told = self.clrt("a.obj", "-o", "a.pfm", code=3)
        self.assertRegex(told, r"^clrt: a\.obj: part 0, object chair: vertex \d: x is 1e\+31")

    def test_a_model_without_triangles_is_refused(self):
        self.write(a_obj="v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n", a_3mf=models.three_mf("<model/>", False))
        self.fails("a.obj: there are no triangles in it, only 2 lines and points", "a.obj")
        self.fails("a.3mf: there are no triangles in it", "a.3mf")

    def test_a_face_with_a_missing_vertex_is_reported(self):
        for corner in (3, 2**32 - 1):
            self.write(a_3mf=models.three_mf(models.THREE_MF_TRIANGLE % corner))
            self.fails("a.3mf: one of its faces refers to a missing vertex", "a.3mf")


if __name__ == "__main__":
    main(3 if EXPORT else 2)
