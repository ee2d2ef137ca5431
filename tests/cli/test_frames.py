#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests runs that draw many pictures. Each numbered file must equal the file of a run that draws only
# this picture.
# Usage: test_frames.py CLRT FORMATS
import json
import re
import signal
import subprocess

from pictures import read_exr, read_header
from work import HAS_EXR, SCENE, Work, main, needs_exr

SMALL = [SCENE, "-s", "32x24"]
# A pipe with room for 124 hashes. Afterwards, the run waits until they are read.
HASH_PIPE = {"stdout": subprocess.PIPE, "pipesize": 4096}
TURNED = [(5, 0, 2), (0, 5, 2), (-5, 0, 2), (0, -5, 2)]


class Frames(Work):
    def names(self, suffix):
        return sorted(str(path.relative_to(self.work)) for path in self.work.rglob(f"*{suffix}"))

    def test_frames_are_the_views_to_the_byte(self):
        for more in [], ["--aa=3"], ["--precision", "fp64"], ["--aa-adaptive"], ["--crop", "3,2,30,20"]:
            self.clrt(*SMALL, *more, "--frames", "1-6:2", "-o", "a.png")
            self.assertEqual(self.names(".png"), ["a.0001.png", "a.0003.png", "a.0005.png"])
            for view in "1", "3", "5":
                self.clrt(*SMALL, *more, "--view", view, "-o", "one.png")
                self.assert_same_bytes(f"a.000{view}.png", "one.png", more)
                (self.work / f"a.000{view}.png").unlink()
            (self.work / "one.png").unlink()

    @needs_exr
    def test_channels_are_each_frame_s_own(self):
        words = [*SMALL, "--tune", "bvh=sah", "--aov", "depth,normal,samples,certainty", "--reference-samples", "2"]
        self.clrt(*words, "--frames", "2-4", "-o", "a.exr")
        for view in "2", "3", "4":
            self.clrt(*words, "--view", view, "-o", "one.exr")
            self.assert_same_bytes(f"a.000{view}.exr", "one.exr")

    def test_a_turntable_turns_the_eye_about_what_it_looks_at(self):
        scene = "light 3 2 8 1\nsphere 0 0 0 1\nsphere 1 1 0 0.5\n"
        look = "0 0 0.5 45\n"
        cameras = "".join(f"camera {x} {y} {z} {look}" for x, y, z in TURNED)
        self.write(turn_scn=f"{scene}camera 5 0 2 {look}", views_scn=scene + cameras)
        for name, words in (("turn", ["--turntable", "4"]), ("views", ["--frames", "1-4"])):
            self.clrt(f"{name}.scn", "-s", "40x30", *words, "-o", f"{name}.pfm")
        pictures = [self.bytes_of(f"turn.000{number}.pfm") for number in range(1, 5)]
        self.assertEqual(len(set(pictures)), 4)
        for number, picture in enumerate(pictures, 1):
            self.assertTrue(picture == self.bytes_of(f"views.000{number}.pfm"), number)

    def test_the_first_of_a_turntable_is_the_view_itself(self):
        self.clrt(*SMALL, "--turntable", "7", "--frames", "1-1", "--view", "3", "-o", "a.png")
        self.clrt(*SMALL, "--view", "3", "-o", "one.png")
        self.assert_same_bytes("a.0001.png", "one.png")

    def test_selected_frames_of_a_turntable_equal_the_whole_turns_frames(self):
        hashes = self.clrt(*SMALL, "--turntable", "6", "-o", "all.pfm", "--hash").split()
        self.assertEqual(len(set(hashes)), 6)
        some = self.clrt(*SMALL, "--turntable", "6", "--frames", "2-6:3", "-o", "some.pfm", "--hash").split()
        self.assertEqual(some, [hashes[1], hashes[4]])
        self.assertEqual(self.names(".pfm")[6:], ["some.0002.pfm", "some.0005.pfm"])

    @needs_exr
    def test_a_gif_holds_all_pictures(self):
        words = ["--turntable", "5", "--aa", "-s", "21x16", SCENE]
        hashes = self.clrt(*words, "-o", "a.png", "--hash")
        for name in "a.gif", "b.gif":
            self.assertEqual(self.clrt(*words, "-o", name, "--hash"), hashes)
        self.assertEqual(self.names(".gif"), ["a.gif", "b.gif"])
        self.assert_same_bytes("a.gif", "b.gif")
        data = self.bytes_of("a.gif")
        self.assertEqual(data[:10], b"GIF89a" + bytes([21, 0, 16, 0]))
        # A graphic control extension with a delay of 5/100 s, and an image of the whole size.
        frame = rb"\x21\xf9\x04.\x05\x00.\x00\x2c\0\0\0\0\x15\0\x10\0"
        self.assertEqual(len(re.findall(frame, data, re.DOTALL)), 5)

    def test_one_picture_is_no_film_and_other_films_are_ffmpeg_s(self):
        if HAS_EXR:
            self.refuses(2, "a GIF holds the pictures of --turntable or --frames: give one, or another format",
                         *SMALL, "-o", "a.gif")
        told = self.clrt(*SMALL, "--turntable", "3", "-o", "a.mp4", code=2)
        self.assertTrue(told.endswith("; for a film, draw -o turn.####.png and run ffmpeg -framerate 20 "
                                      "-i turn.%04d.png a.mp4\n"), told)

    @needs_exr
    def test_a_stopped_film_holds_its_pictures(self):
        process = self.start(SCENE, "-s", "150x150", "--aa=2", "--turntable", "1000", "-o", "a.gif", "--hash",
                             **HASH_PIPE)
        process.stdout.readline()
        process.send_signal(signal.SIGINT)
        told = process.communicate()[1]
        self.assertEqual(process.returncode, 130, told)
        self.assertEqual(self.bytes_of("a.gif")[:6], b"GIF89a")

    def test_metadata_have_the_angle_of_the_turn(self):
        self.clrt(*SMALL, "--turntable", "8", "--frames", "2-3", "-o", "a.png")
        data = self.bytes_of("a.0003.png")
        self.assertIn(b'"turned":90.0,"view":1', data)
        self.assertIn(b'"turned":45.0,"view":1', self.bytes_of("a.0002.png"))

    def test_names_are_numbered_in_place_of_the_last_crosses(self):
        (self.work / "d#.d").mkdir()
        for pattern, name in (("a.pfm", "a.0002.pfm"), ("b##.pfm", "b02.pfm"), ("#c######x.pfm", "#c000002x.pfm"),
                              ("d#.d/e.pfm", "d#.d/e.0002.pfm"), ("#.pfm", "2.pfm")):
            self.clrt(*SMALL, "--frames", "2-2", "-o", pattern)
            self.assertEqual(self.names(".pfm"), [name])
            (self.work / name).unlink()
        self.clrt(*SMALL, "--frames", "2-2", "-o", "f", "--format", "pfm")
        self.assertTrue((self.work / "f.0002").exists())
        self.clrt(*SMALL, "-o", "g##.pfm")
        self.assertEqual(self.names(".pfm"), ["g##.pfm"])

    @needs_exr
    def test_a_signal_ends_the_series_with_the_picture_it_meets(self):
        # Drawing a picture takes much longer than writing it.
        words = [SCENE, "-s", "200x150", "--aa=16", "--tune", "tile=200x10", "-j", "1", "--turntable", "99"]
        for _ in range(9):  # repeats until a signal interrupts a picture
            process = self.start(*words, "-q", "-o", "a.exr")
            self.wait_for((self.work / "a.0001.exr").exists)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=200), 128 + signal.SIGINT)
            *whole, last = self.names(".exr")
            for name in whole:
                self.assertEqual(read_header(self.bytes_of(name))[0]["clrt:complete"], b"yes")
            texts = read_header(self.bytes_of(last))[0]
            if texts["clrt:complete"] == b"no":
                break
            for name in (*whole, last):
                (self.work / name).unlink()
        self.assertEqual(texts["clrt:complete"], b"no")
        done = json.loads(texts["clrt:settings"])["tiles_done"]
        below = read_exr(self.work / last)[1]["R"][done * 10 * 200 :]
        self.assertTrue(done == 15 or set(below) == {0}, "what is not drawn is black")

    def test_resuming_skips_the_pictures_that_exist(self):
        for more in [], ["--aa-adaptive"], ["--aa", "--crop", "3,2,30,20"]:
            words = [*SMALL, *more, "--turntable", "4", "--frames", "1-3", "-o", "a.png"]
            self.clrt(*words)
            names = self.names(".png")
            whole = [self.bytes_of(name) for name in names]
            (self.work / names[1]).unlink()
            self.write(**{"a.0003_png": "kept"})
            self.clrt(*words, "--resume")
            self.assertEqual([self.bytes_of(name) for name in names], [*whole[:2], b"kept"])

    def test_a_stopped_series_that_resumes_holds_whole_pictures(self):
        words = [SCENE, "-s", "40x30", "--aa=4", "--tune", "tile=40x3", "-j", "1", "--turntable", "150", "-o", "a.pfm"]
        whole = self.clrt(*words, "--hash")
        for path in self.work.glob("a.*"):
            path.unlink()
        process = self.start(*words, "-q", "--resume", "--hash", **HASH_PIPE)
        self.wait_for((self.work / "a.0002.pfm").exists)
        process.send_signal(signal.SIGTERM)
        told = process.communicate()[1]
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)
        self.assertRegex(told, r"^clrt: stopped: (a.0\d*.pfm is not written|\d+ of 150 pictures are drawn)\n$")
        drawn = {name: (self.work / name).stat().st_mtime_ns for name in self.names(".pfm")}
        self.assertLess(len(drawn), 150)
        self.clrt(*words, "--resume")
        for name, moment in drawn.items():
            self.assertEqual((self.work / name).stat().st_mtime_ns, moment)
        rest = self.names(".pfm")
        self.assertEqual(len(rest), 150)
        resumed = [self.bytes_of(name) for name in rest]
        self.assertEqual(self.clrt(*words, "--hash"), whole)
        self.assertEqual(resumed, [self.bytes_of(name) for name in rest])

    @needs_exr
    def test_a_film_cannot_resume(self):
        self.refuses(2, "--frames and --turntable draw many pictures, and --resume wants a file for each: give "
                     "another format", *SMALL, "--turntable", "3", "-o", "a.gif", "--resume")

    def test_options_for_one_picture_are_refused(self):
        many = "--frames and --turntable draw many pictures, and "
        for words, sentence in (
            (["-o", "-"], many + "standard output takes one: give -o FILE"),
            (["-o", "a.pfm", "--json=a.json"], "--frames and --json exclude each other: give one"),
            (["-o", "a.pfm", "--reference=b.pfm"], many + "--reference=FILE holds one"),
            (["-o", "a.pfm", "--hash=" + 32 * "0"], many + "--hash=EXPECTED describes one"),
            (["-o", "a.pfm", "--turntable", "1"], "--turntable 1 has no picture 2"),
        ):
            self.refuses(2, sentence, *SMALL, "--frames", "1-2", *words)
        self.refuses(3, f"{SCENE}: there is no view 7; the last one is 6", *SMALL, "--frames", "5-7", "-o", "a.pfm")

    def test_wrong_ranges_are_refused(self):
        for value in ("3", "0-2", "3-2", "1-2:0", "1-2:", "a-2", "1-2-3", "-2", "1-", "0/2", "3/2", "1/0", "1/", "/2",
                      "auto", "auto/", "auto/0", "1-2,", ",1/2", "1-2,3", "1/2,1-2", "1-2,1/2,1/2", "1-2,autos/2"):
            self.refuses(2, "--frames wants A-B or A-B:S, from 1 to 1000000, or I/N, auto/N, A-B,I/N or A-B,auto/N, "
                         f"not '{value}'",
                         *SMALL, "-o", "a.pfm", f"--frames={value}")


if __name__ == "__main__":
    main(2)
