#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that no output replaces an input or another output, even through other names and links.
# Usage: test_overwriting.py CLRT FORMATS
import os
import subprocess

import models
from work import CLRT, Work, main, needs_exr

SCENE = "size 8 6\nlight 5 -7 8 1\ncamera 3 -7 4 0 0 0 40\nmaterial 1\nmesh a.ply\nsphere 0 0 0 1\n"
MESH = models.ply([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])


class Overwriting(Work):
    def setUp(self):
        super().setUp()
        self.write(a_scn=SCENE, a_ply=MESH)

    def contents(self):
        return {file.name: file.read_bytes() for file in self.work.iterdir() if file.is_file()}

    def refuses_files(self, one, other, *words, **settings):
        """Expects the message that both names are the same file. No file in the folder may change."""
        before = self.contents()
        done = subprocess.run([CLRT, *words], cwd=self.work, stderr=subprocess.PIPE, text=True, timeout=300,
                              **{"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, **settings})
        sentence = f"clrt: {one} and {other} are the same file: choose another name\n"
        self.assertEqual((done.stderr, done.returncode), (sentence, 5), words)
        self.assertEqual(self.contents(), before, words)

    def accepts(self, *words):
        done = self.run_clrt(*words, content=b"")
        self.assertEqual((done.stderr, done.returncode), (b"", 0), words)


class Pictures(Overwriting):
    def test_the_scene_is_kept(self):
        for words in (["-o", "a.scn", "--format", "png"], ["-o", "./a.scn", "--format", "pfm"],
                      ["-o", str(self.work / "a.scn"), "--format", "pfm"]):
            self.refuses_files(f"-o {words[1]}", "the scene a.scn", "a.scn", *words)
        picture = ["a.scn", "-o", "a.pfm"]
        self.refuses_files("--json=a.scn", "the scene a.scn", *picture, "--json=a.scn")
        self.write(b_png=SCENE)
        self.refuses_files("--reference=b.png", "the scene b.png", "b.png", "-o", "a.pfm", "--reference=b.png")

    def test_the_scenes_meshes_are_kept(self):
        for words in (["-o", "a.ply", "--format", "pfm"], ["-o", "a.pfm", "--json=a.ply"]):
            name = words[1] if words[1] == "a.ply" else "a.ply"
            option = "-o " if words[1] == "a.ply" else "--json="
            self.refuses_files(option + name, "the scene's file a.ply", "a.scn", *words)
        self.refuses_files("-o a.ply", "the scene a.ply", "a.ply", "-o", "a.ply", "--format", "pfm")

    def test_outputs_keep_each_other(self):
        for there in False, True:
            if there:
                self.write(a_png="an earlier picture")
            self.refuses_files("--json=a.png", "-o a.png", "a.scn", "-o", "a.png", "--json=a.png")
            self.refuses_files("--reference=a.png", "-o a.png", "a.scn", "-o", "a.png", "--reference=a.png")
            self.refuses_files("--json=./b.png", "--reference=b.png",
                         "a.scn", "-o", "a.png", "--reference=b.png", "--json=./b.png")

    def test_links_lead_to_the_same_file(self):
        (self.work / "soft.pfm").symlink_to("a.scn")
        os.link(self.work / "a.scn", self.work / "hard.pfm")
        (self.work / "nothing.pfm").symlink_to("new.pfm")
        (self.work / "chain.pfm").symlink_to("nothing.pfm")
        (self.work / "here").symlink_to(".")
        self.refuses_files("-o soft.pfm", "the scene a.scn", "a.scn", "-o", "soft.pfm")
        self.refuses_files("-o hard.pfm", "the scene a.scn", "a.scn", "-o", "hard.pfm")
        self.refuses_files("-o a.scn", "the scene soft.pfm", "soft.pfm", "-o", "a.scn", "--format", "pfm")
        for new in "new.pfm", "here/new.pfm", "nothing.pfm":
            self.refuses_files(f"--json={new}", "-o chain.pfm", "a.scn", "-o", "chain.pfm", f"--json={new}")

    def test_every_frame_counts(self):
        self.write(turn_0002_png=SCENE)
        os.rename(self.work / "turn_0002.png", self.work / "turn.0002.png")
        self.refuses_files("-o turn.0002.png", "the scene turn.0002.png",
                     "turn.0002.png", "-o", "turn.png", "--turntable", "3")
        os.link(self.work / "a.ply", self.work / "view3.png")
        self.refuses_files("-o view3.png", "the scene's file a.ply",
                     "a.scn", "-o", "view#.png", "--turntable", "9", "--frames", "1-9:2")
        for name in "old.0001.png", "old.0003.png":
            (self.work / name).symlink_to("one.png")
        self.refuses_files("-o old.0003.png", "-o old.0001.png", "a.scn", "-o", "old.png", "--turntable", "3")

    def test_the_journal_counts(self):
        self.refuses_files("the journal a.pfm.part", "--json=a.pfm.part",
                     "a.scn", "-o", "a.pfm", "--resume", "--json=a.pfm.part")
        os.link(self.work / "a.ply", self.work / "b.pfm.part")
        self.refuses_files("the journal b.pfm.part", "the scene's file a.ply", "a.scn", "-o", "b.pfm", "--resume")

    def test_standard_streams_that_are_files_count(self):
        with open(self.work / "a.scn") as scene:
            self.refuses_files("-o a.scn", "the scene -", "-", "-o", "a.scn", "--format", "pfm", stdin=scene)
        for name in "-", "/dev/stdout":
            with open(self.work / "a.ply", "a") as mesh:
                self.refuses_files(f"-o {name}", "the scene's file a.ply",
                             "a.scn", "-o", name, "--format", "pfm", stdout=mesh)

    def test_devices_and_pipes_may_coincide(self):
        self.accepts("a.scn", "-o", "/dev/null", "--format", "pfm", "--json=/dev/null")
        self.accepts("a.scn", "-o", "/dev/stdout", "--format", "pfm", "--json=/dev/stdout")

    def test_different_files_of_one_name_or_content_are_no_clash(self):
        (self.work / "inner").mkdir()
        self.write(b_scn=SCENE)
        self.accepts("a.scn", "-o", "a.pfm", "--json=inner/a.pfm")
        self.accepts("a.scn", "-o", "b.scn", "--format", "pfm")
        self.refuses(5, "no/a.pfm: cannot be written: No such file or directory",
                     "a.scn", "-o", "no/a.pfm", "--json=none/a.pfm")

    def test_a_missing_scene_is_reported_before_a_clash(self):
        self.refuses(3, "none.scn: cannot be opened: No such file or directory",
                     "none.scn", "-o", "none.scn", "--format", "pfm")


class Reports(Overwriting):
    def test_explanations_and_checks_keep_what_they_read(self):
        for words in (["check", "a.scn"], ["explain", "a.scn"], ["explain", "a.scn", "1,1"]):
            self.refuses_files("--json=a.scn", "the scene a.scn", *words, "--json=a.scn")
            self.refuses_files("--json=a.ply", "the scene's file a.ply", *words, "--json=a.ply")

    def test_compare_keeps_its_pictures(self):
        for name in "a.pfm", "b.pfm":
            self.accepts("a.scn", "-o", name)
        both = ["compare", "a.pfm", "b.pfm"]
        for name in "a.pfm", "b.pfm":
            self.refuses_files(f"-o {name}", f"the picture {name}", *both, "-o", name)
            self.refuses_files(f"--json={name}", f"the picture {name}", *both, f"--json={name}")
        self.refuses_files("--json=c.pfm", "-o c.pfm", *both, "-o", "c.pfm", "--json=c.pfm")
        self.assertEqual(self.run_clrt("compare", "a.pfm", "a.pfm").returncode, 0)

    @needs_exr
    def test_merge_keeps_its_parts(self):
        for part in 1, 2:
            self.accepts("a.scn", "-q", "--tune", "tile=4x4", "--part", f"{part}/2", "-o", f"p{part}.exr")
        for name in "p1.exr", "p2.exr":
            self.refuses_files(f"-o {name}", f"the part {name}", "merge", "p2.exr", "p1.exr", "-o", name)

    def test_convert_keeps_what_it_reads_and_writes(self):
        self.refuses_files("the output a.scn", "the scene a.scn", "convert", "a.scn", "a.scn")
        self.refuses_files("the output a.ply", "the scene's file a.ply", "convert", "a.scn", "a.ply")
        os.link(self.work / "a.ply", self.work / "c-1.ply")
        self.refuses_files("the output c-1.ply", "the scene's file a.ply", "convert", "a.scn", "c.scn")
        self.refuses_files("the output a.ply", "the scene a.ply", "convert", "a.ply", "a.ply")
        (self.work / "b.scn").symlink_to("b-1.ply")
        self.refuses_files("the output b-1.ply", "the output b.scn", "convert", "a.ply", "b.scn")


if __name__ == "__main__":
    main(2)
