#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests the command line: usage, devices, options that change no bit, samples, statistics, kernels.
# Usage: test_cli.py CLRT FORMATS WINDOW NO_FP64; WINDOW is ON for a build with a window
import os
import subprocess
import sys

from work import FORMATS, HAS_EXR, NO_OPENCL, ROOT, SCENE, SharedWork, Work, main, preload

HAS_WINDOW, NO_FP64 = sys.argv[3] == "ON", preload(sys.argv[4])
CUBE = str(ROOT / "scenes/cube.ply")
SMALL = [SCENE, "-s", "48x32", "-o"]
# The kernels that compile fastest. All runs of QUICK write statistics, so that they share their kernels.
PAIR = "--tune=kernel=pair"
QUICK = [PAIR, *SMALL]
FORMAT_NAMES = ", ".join(FORMATS) + ("" if HAS_EXR else " (more after tools/setup images && tools/render)")
FILE = [SCENE, "-o", "a.pfm"]
TOO_MANY = "'{}' is one name too many"
AFTER_EQUALS_SIGN = "the value of --aa follows an equals sign: --aa=4"
SIZE = "--size wants WIDTHxHEIGHT, each between 1 and 131072, not '{}'"
NOT_HERE = "clrt SCENE -o FILE takes no --"
NO_FILE = "cannot be opened: No such file or directory"
REFUSALS = [
    (2, "a name is missing: the usage is clrt SCENE [options]; clrt --help lists them", []),
    (2, NOT_HERE, [*FILE, "--keys", "q"]),
    (2, "clrt warm takes no --hash; clrt SCENE -o FILE does", ["warm", "--hash"]),
    (2, "clrt devices takes no --aa; clrt SCENE does", ["devices", "--aa=9"]),
    (2, "unknown option '--quit-after', perhaps --keys=KEYSq", [SCENE, "--quit-after", "1"]),
    (2, "unknown option '--sise', perhaps --size", [*FILE, "--sise", "4x4"]),
    (2, "unknown option '--preciasion', perhaps --precision", [*FILE, "--preciasion", "fp64"]),
    (2, "unknown option '-z'; clrt --help lists them", ["-z"]),
    (2, "--size wants a value", [SCENE, "--size"]),
    (2, SIZE.format("0x5"), [*FILE, "--size", "0x5"]),
    (2, TOO_MANY.format("b.scn"), ["a.scn", "b.scn", "-o", "a.pfm"]),
    (2, "to write the picture 'e.png', give -o e.png", ["a.scn", "e.png"]),
    (2, TOO_MANY.format("e.png"), ["a.scn", "e.png", "-o", "a.pfm"]),
    (2, AFTER_EQUALS_SIGN, ["a.scn", "--aa", "4", "-o", "a.pfm"]),
    (2, AFTER_EQUALS_SIGN, ["--aa", "4", "a.scn", "-o", "a.pfm"]),
    (2, AFTER_EQUALS_SIGN, ["--aa", "4", "-o", "a.pfm"]),
    (2, TOO_MANY.format("b.json"), ["a.scn", "--json", "b.json", "-o", "a.pfm"]),
    (2, SIZE.format("640") + ", perhaps 640x640", ["a.scn", "-s", "640"]),
    (2, SIZE.format("0"), ["a.scn", "-s", "0"]),
    (2, SIZE.format("640x"), ["a.scn", "-s", "640x"]),
    (2, "--tune tile wants WIDTHxHEIGHT, each between 1 and 131072, not '64', perhaps 64x64",
     [*FILE, "--tune", "tile=64"]),
    (2, "unknown option '--samples=4', perhaps --aa=N", [*FILE, "--samples=4"]),
    (2, "unknown option '--width', perhaps --size=WxH", [*FILE, "--width", "640"]),
    (2, "unknown option '--bounces', perhaps --max-level", [*FILE, "--bounces", "4"]),
    (2, f"a.xyz: the ending names no format; this build writes {FORMAT_NAMES}", ["none.scn", "-o", "a.xyz"]),
    (2, "--aa and --aa-adaptive exclude each other",
     [*FILE, "--aa=3", "--aa-adaptive"]),
    (2, "--aa-adaptive wants a number above 0 and up to 1, not '2'", [*FILE, "--aa-adaptive=2"]),
    (2, "--error wants a number above 0 and up to 1, or 100%, not 'low'", [*FILE, "--error", "low"]),
    (2, "--time wants seconds above 0 and up to 1000000, not '0'", [*FILE, "--time", "0"]),
    (2, "--max-level wants auto or an integer between 0 and 1000, not 'all'", [*FILE, "--max-level", "all"]),
    (2, "--precision wants fp32 or fp64, not 'fp16'", [*FILE, "--precision", "fp16"]),
    *((2, "--precision fp64 traces rays one by one through pair nodes: leave out --tune kernel",
       [*FILE, "--precision", "fp64", "--tune", f"kernel={form}"]) for form in ("packet", "wide", "wide:8")),
    *((2, "--tune kernel wants auto, pair, wide or packet", [*FILE, "--tune", f"kernel={form}"])
      for form in ("", "ray", "pair:4", "auto:8", "wide:5", "packet:2", "packet:", "wide:8:8", "wide ")),
    *((2, "--tune wants KEY=VALUE, where KEY is one of kernel, tile, group, specialize, bvh", [*FILE, f"--tune={text}"])
      for text in ("", "kernel", "nodes=wide", "bvh=sah,", ",", "bvh=sah,,", "tile=" + 99 * "0")),
    (2, "--tune bvh wants auto, sah, midpoint or none, not 'both'", [*FILE, "--tune", "tile=8x8,bvh=both"]),
    (2, "unknown option '--stats=a.json', perhaps --json=FILE", [*FILE, "--stats=a.json"]),
    (2, "unknown option '--expect-hash', perhaps --hash=EXPECTED", [*FILE, "--expect-hash", 32 * "0"]),
    (2, "unknown option '--nodes', perhaps --tune kernel=FORM", [*FILE, "--nodes", "wide"]),
    (2, "unknown option '-aa'; clrt --help lists them", ["none.scn", "-aa", "-o", "a.pfm"]),
    (2, "unknown option '-aa'; clrt --help lists them", ["-aa", "none.scn"]),
    (2, "unknown option '-qx'; clrt --help lists them", ["none.scn", "-q", "-qx"]),
    (2, "unknown option '-x'; clrt --help lists them", ["none.scn", "-x", "-aa"]),
    (2, "unknown option '-1,5'; clrt --help lists them", ["explain", "none.scn", "-1,5"]),
    (2, "there is no command 'render'; clrt --help lists the commands", ["render", "none.scn"]),
    (2, "there is no command 'help'; clrt --help lists the commands", ["help"]),
    (2, "there is no command 'chekc', perhaps check", ["chekc", "none.scn"]),
    (2, "there is no command 'devcies', perhaps devices", ["devcies"]),
    (3, f"none: {NO_FILE}", ["none", "-o", "a.pfm"]),
    (2, "unknown option '--work-group=8x8', perhaps --tune group=WxH", [*FILE, "--work-group=8x8"]),
    (4, "work-groups of 100 x 100 are too large", [*FILE, "--tune", "group=100x100"]),
    (3, f"none.scn: {NO_FILE}", ["none.scn", "-o", "a.pfm"]),
    (3, f"none.scn: {NO_FILE}", ["warm", "none.scn"]),
    (3, f"{ROOT}: cannot be read: it is not a file", [str(ROOT), "-o", "a.pfm"]),
    (3, "empty.ply:1: the file does not begin with 'ply'", ["empty.ply", "-o", "a.pfm"]),
    (3, "empty.ply:1: the file does not begin with 'ply'", ["check", "empty.ply"]),
    (3, "short.ply:1: the file ends before 'end_header'", ["short.ply", "--hash"]),
    (3, "evil?[31mred.scn: cannot be opened", ["evil\33[31mred.scn", "--hash"]),
    (3, "bad.scn:1:1: unknown statement (did you mean 'sphere'?): found 'spheer'", ["bad.scn", "-o", "a.pfm"]),
    (3, f"{SCENE}: there is no view 7; the last one is 6", [*FILE, "--view", "7"]),
    # clrt checks outputs before any work, such as reading the scene.
    (5, "no/: cannot be written: it is a folder", ["none.scn", "--format", "pfm", "-o", "no/"]),
    (5, "no/a.pfm: cannot be written: No such file or directory", ["none.scn", "-o", "no/a.pfm"]),
]
# These options change no bit of the picture. Each row has options, and expected statistics or None.
SAME = {"-q": None, "-j 1": None, "-j 2 -s 48X32": None, "--tune bvh=sah": None, "--tune specialize=never": None,
        "--tune bvh=none": {"tests__box": 0, "bvh__builder": "none"},
        "--tune bvh=midpoint": {"bvh__builder": "midpoint"},
        "--tune tile=16x8,group=4x2": {"settings__tile": [16, 8], "settings__work_group": [4, 2]},
        "--tune specialize=always,kernel=pair": {"settings__specialized": True},
        "--precision fp32": {"settings__precision": "fp32"}, "--device 0:0": None, "--device cpu": None}


class Usage(Work):
    def test_refusals(self):
        self.write(bad_scn="spheer 0 0 0 1\n", empty_ply="", short_ply="ply")
        for code, sentence, words in REFUSALS:
            self.refuses(code, sentence, *words)

    def test_without_a_file_there_must_be_a_window(self):
        if not HAS_WINDOW:
            self.refuses(2, "this build has no window: write the picture with -o FILE, or add the window: "
                         "tools/setup window && tools/render SCENE", SCENE)
            return
        told = self.clrt(SCENE, code=2, WAYLAND_DISPLAY=None, DISPLAY=":12345")
        self.assertRegex(told, r"^clrt: no window can be opened \(.*\): write the picture with -o FILE\n$")

    def test_help_lists_commands_and_exit_statuses(self):
        told = self.clrt("--help")
        self.assertIn("clrt devices", told)
        self.assertIn("faults found by check", told)

    def test_the_version_is_a_name_and_a_number(self):
        self.assertRegex(self.clrt("--version"), r"^clrt [0-9]+\.[0-9]+\.[0-9]+\n$")

    def test_a_device_that_is_not_there_is_exit_4_and_lists_the_others(self):
        told = self.clrt(*FILE, "--device", "nosuchdevice", code=4)
        self.assertIn("no device matches 'nosuchdevice'; the devices are:", told)
        self.assertIn("Platform #0: ", told)
        self.clrt("warm", "--device", "9:9", code=4)

    def test_without_opencl_it_is_exit_4_and_names_what_to_install(self):
        self.assertIn("install pocl-opencl-icd", self.clrt(*FILE, code=4, **NO_OPENCL))

    def test_without_kernels_it_is_exit_4(self):
        self.clrt(*FILE, code=4, CLRT_KERNEL_DIR="/nonexistent")


class SamePictures(SharedWork):
    def prepare(self):
        self.assertEqual(self.run_clrt(*SMALL, "plain.pfm", "-q").stderr, "")
        type(self).fp64 = self.run_clrt(*SMALL, "fp64.pfm", "--precision", "fp64", "-v").stderr

    def expect_same(self, words, values=None):
        words = [*SMALL, "same.pfm", *words]
        if values:
            self.expect(self.statistics(*words), **values)
        else:
            self.clrt(*words)
        self.assert_same_bytes("plain.pfm", "same.pfm", words)

    def test_options_of_speed_and_devices_change_no_bit(self):
        for words, values in SAME.items():
            self.expect_same(words.split(), values)
        devices = self.clrt("devices")
        self.assertRegex(devices, "(?m)^Platform #0: ")
        self.expect_same(["--device", devices.split("Device #0: ")[1][:5]])
        self.assertEqual(list(self.work.glob("*.pfm.*")), [], "files that clrt left unfinished")

    def test_kernels_from_a_folder_draw_the_same(self):
        self.clrt(*SMALL, "folder.pfm", "--tune", "kernel=pair", CLRT_KERNEL_DIR=str(ROOT / "kernels"))
        self.assert_same_bytes("plain.pfm", "folder.pfm")

    def test_fp64_draws_another_picture_by_rays_and_pairs(self):
        self.assertNotEqual(self.bytes_of("plain.pfm"), self.bytes_of("fp64.pfm"))
        self.assertIn("kernels: ray, pair nodes, fp64", self.fp64)

    def test_a_device_without_fp64_draws_in_fp32_alone(self):
        self.clrt(*SMALL, "b.pfm", **NO_FP64)
        told = self.clrt(*FILE, "--precision", "fp64", code=4, **NO_FP64)
        self.assertIn("has no double arithmetic, which --precision fp64 needs", told)
        self.clrt("check", CUBE, "--precision", "fp64", code=4, **NO_FP64)

    def test_few_triangles_have_no_tree_unless_one_is_requested(self):
        words = [CUBE, "-s", "16x16", "--tune", "kernel=packet", "-o"]
        self.expect(self.statistics(*words, "none.pfm"), tests__box=0, bvh__builder="none")
        self.expect(self.statistics(*words, "tree.pfm", "--tune", "bvh=sah"), bvh__builder="sah")
        self.assert_same_bytes("none.pfm", "tree.pfm")

    def test_repeated_pictures_are_timed_each_and_counted_once(self):
        found = self.statistics(*SMALL, "repeat.pfm", "--repeat", "3")
        times = found["frame_seconds"]
        self.assertEqual((len(times), found["seconds"]["trace"]), (3, times[0]))
        self.assertGreater(min(times), 0)
        self.expect(found, rays__camera=1536)
        self.assert_same_bytes("plain.pfm", "repeat.pfm")


class Statistics(Work):
    def test_text_has_rays_samples_and_tests(self):
        told = self.run_clrt(*QUICK, "a.pfm", "--stats", "-v", "-j", "1").stderr
        for line in ("rays: 1536 camera,", "(?m)^1536 samples, 1.00 per pixel$", "box tests, .* per ray",
                     ", 1 compute units"):
            self.assertRegex(told, line)

    def test_json_has_rays_and_the_time_of_each_stage(self):
        found = self.statistics(*QUICK, "a.pfm")
        self.expect(found, rays__camera=1536, schema=1)
        stages = "parse load build device upload kernel_build trace write total"
        self.assertEqual(sorted(found["seconds"]), sorted(stages.split()))


class Samples(Work):
    def test_each_number_of_samples_and_each_contrast_draws_another_picture(self):
        pictures = set()
        for words in ([], ["--aa"], ["--aa=3"], ["--aa-adaptive"]):
            self.statistics(*QUICK, "a.pfm", *words)
            pictures.add(self.bytes_of("a.pfm"))
        found = self.statistics(*QUICK, "a.pfm", "--aa-adaptive=0.001")
        pictures.add(self.bytes_of("a.pfm"))
        self.assertEqual(len(pictures), 5)
        total = found["samples"]["total"]
        self.assertGreater(total, 1536)
        self.expect(found, rays__camera=total, samples__contrast=0.001, samples__per_pixel=total / 1536)
        self.statistics(*QUICK, "b.pfm", "--aa-adaptive=0.001", "-j", "1")
        self.assert_same_bytes("a.pfm", "b.pfm")

    def test_an_error_is_held_within_its_estimate_with_enough_levels(self):
        found = self.statistics(*QUICK, "a.pfm", "--error", "0.5%")
        self.assertTrue(found["samples"]["goal_reached"])
        self.assertTrue(0 < found["samples"]["error_estimate"] < found["samples"]["error_bound"] <= 0.005)
        self.assertLessEqual(found["settings"]["truncation_bound"], 0.00125)
        told = self.run_clrt(*QUICK, "a.pfm", "--error", "0.005", "--stats").stderr
        self.assertRegex(told, "(?m)with 95 % confidence, including at most 0.098 % because rays end at level 5$")
        told = self.run_clrt(*QUICK, "a.pfm", "--error", "0.005", "--max-level", "5", "--stats").stderr
        self.assertRegex(told, "(?m)with 95 % confidence$")

    def test_a_smaller_error_takes_more_samples(self):
        samples = self.statistics(*QUICK, "a.pfm", "--error", "0.001")["samples"]
        self.assertGreater(samples["total"], 1600)
        self.assertLessEqual(samples["error_bound"], 0.001)

    def test_more_samples_find_smaller_features(self):
        coarse, refined, fine = (
            self.statistics(*QUICK, "a.pfm", *words)["samples"]["smallest_feature"]
            for words in (["--aa=1"], ["--error", "1%"], ["--aa=4"]))
        self.assertAlmostEqual(coarse, 4 * fine, delta=1e-6)
        self.assertTrue(coarse > refined > fine)
        adaptive = self.statistics(*QUICK, "a.pfm", "--aa-adaptive=0.001")["samples"]
        self.assertTrue(coarse > adaptive["smallest_feature"] > coarse / 3)
        told = self.run_clrt(*QUICK, "a.pfm", "--aa=4", "--stats").stderr
        self.assertRegex(told, "(?m)^smallest disk found with a probability of 95 %: 0.30 pixels wide$")

    def test_an_error_that_no_levels_hold_is_exit_1(self):
        self.write(mirror_scn="define it matte reflectivity 1\nmaterial it\nsphere 0 0 0 1\n")
        told = self.clrt("mirror.scn", PAIR, "--stats", "-s", "8x8", "--error", "1%", "-o", "a.pfm", code=1)
        self.assertIn("clrt: the error may be 1e+02 %, more than --error allows: give a larger error\n", told)

    def test_an_error_too_small_for_the_ladder_is_exit_1_in_doubles(self):
        words = [*SMALL, "a.pfm", "--error", "0.01%", "--json=a.json"]
        self.assertRegex(self.clrt(*words, code=1), r"clrt: the error may be 0\.0[0-9]* %, more than --error allows")
        found = self.json_of("a.json")
        self.expect(found, samples__goal_reached=False, settings__precision="fp64", settings__kernel="ray",
                    settings__nodes="pair")
        self.assertGreater(found["samples"]["error_bound"], 0.0001)

    def test_time_is_spent_on_samples_and_no_more(self):
        found = self.statistics(*QUICK, "a.pfm", "--time", "0.5")
        self.expect(found, samples__goal_reached=True)
        self.assertGreater(found["samples"]["total"], 10000)
        self.assertLess(found["seconds"]["trace"], 2)

    def test_no_bound_is_0_and_the_last_rung_ends_a_picture_of_one_color(self):
        self.write(blank_scn="size 64 64\nsphere 0 0 0 1\ncamera 0 -9 0 0 -99 0 30\n")
        found = self.statistics("blank.scn", "-o", "a.pfm", "--time", "60", PAIR)
        self.assertTrue(0 < found["samples"]["error_bound"] < 0.0001)
        self.expect(found, samples__per_pixel=1025)
        self.assertLess(found["seconds"]["trace"], 30)

    def test_too_little_time_is_exit_1(self):
        self.assertRegex(self.clrt(*FILE, "--time", "1e-9", code=1), "longer than --time allows: give more time or a smaller --size\n$")

    def test_max_level_auto_is_the_least_that_the_file_can_show(self):
        bytes_alone = self.statistics(*QUICK, "a.ppm", "--format", "png", "--max-level", "auto")
        self.expect(bytes_alone, settings__max_level=5, settings__truncation_bound=0.25**5)
        self.assertLess(0.25**5, 1 / 510)
        floats = self.statistics(*QUICK, "a.pfm", "--max-level", "auto")
        self.expect(floats, settings__max_level=13, settings__truncation_bound=0.25**13)
        self.clrt(*QUICK, "b.pfm", "--max-level", "40")
        self.assert_same_bytes("a.pfm", "b.pfm")


class Compiled(Work):
    """Each test has an empty kernel cache. The cache of all tests has the general kernels after `warm`."""

    def setUp(self):
        super().setUp()
        self.cache = {"XDG_CACHE_HOME": str(self.work), "POCL_CACHE_DIR": None}

    def draws_by(self, kernels, name, **cache):
        done = self.run_clrt(*SMALL, name, "-v", **cache)
        self.assertRegex(done.stderr, rf"(?m)^kernels: {kernels} nodes")

    def test_small_pictures_use_the_kernels_that_compile_sooner(self):
        self.draws_by("ray, pair", "a.pfm", **self.cache)
        line = "general kernels, packet, wide nodes, fp32:"
        self.assertRegex(self.clrt("warm"), f"(?m)^{line} (already )?compiled")
        self.draws_by("packet, wide", "b.pfm")
        self.assert_same_bytes("a.pfm", "b.pfm")
        self.assertRegex(self.clrt("warm"), f"(?m)^{line} already compiled, ready in")

    def test_warm_compiles_ahead_and_nothing_twice(self):
        self.assertRegex(self.clrt("warm", "--precision", "fp64"), "(?m)^general kernels, ray, pair nodes, fp64: ")
        told = self.clrt("warm", SCENE, "--stats", "--tune", "kernel=pair", **self.cache)
        self.assertRegex(told, "(?m)^special kernels, ray, pair nodes, fp32: compiled in")
        found = self.statistics(*SMALL, "a.pfm", "--tune", "kernel=pair", **self.cache)
        self.expect(found, settings__specialized=True)
        for words, cached, text in ([], True, "cached"), (["--aa-adaptive"], False, "compiled"):
            done = self.run_clrt(*SMALL, "a.pfm", "--tune", "kernel=pair", "-v", "--json=a.json", *words, **self.cache)
            self.expect(self.json_of("a.json"), cached=cached)
            self.assertRegex(done.stderr, f"(?m)^kernels: .*, {text}, ready in ")


class Endings(Work):
    """Inputs and outputs may end early or late."""

    def test_a_reader_that_leaves_early_is_exit_5(self):
        os.mkdir(self.work / "temporary")
        words = [SCENE, "-s", "800x800", "-o", "-", "--format", "pfm"]
        process = self.start(*words, stdout=subprocess.PIPE, text=False,
                             env=dict(os.environ, TMPDIR=str(self.work / "temporary")))
        process.stdout.read(9)
        process.stdout.close()
        self.assertIn(b"clrt: standard output: cannot be written: Broken pipe", process.stderr.read())
        self.assertEqual(process.wait(), 5)
        self.assertEqual(os.listdir(self.work / "temporary"), [])

    def test_a_pipe_is_a_scene(self):
        os.mkfifo(self.work / "late.scn")
        process = self.start("late.scn", "-s", "8x8", "-o", "a.pfm")
        (self.work / "late.scn").write_text("sphere 0 0 0 1\n")
        self.assertEqual((process.communicate()[1], process.returncode), ("", 0))

    def test_a_folder_that_vanishes_is_exit_5(self):
        # The scene is a pipe. clrt opens the pipe after it has checked the output's folder.
        os.mkdir(self.work / "gone")
        os.mkfifo(self.work / "late.scn")
        process = self.start("late.scn", "-s", "8x8", "-o", "gone/a.png")
        with open(self.work / "late.scn", "w") as scene:
            os.rmdir(self.work / "gone")
            scene.write("sphere 0 0 0 1\n")
        self.assertIn("clrt: gone/a.png: cannot be written", process.communicate()[1])
        self.assertEqual(process.returncode, 5)


if __name__ == "__main__":
    main(4)
