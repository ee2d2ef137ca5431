#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests clrt compare: report, JSON, map, limits, causes, every format, and hostile files.
# Usage: test_compare.py CLRT FORMATS
import os
import random
import re
import struct

from pictures import pfm
from work import EVERY_FEATURE, FORMATS, ROOT, SCENE, SharedWork, main, needs_exr

BOTH = ["compare", "a.pfm", "b.pfm"]
LIMITS = "--fail needs limits like rmse=0.01,max=0.1,psnr=40,share1=1%,share4=0,hits=0, not 'mse=1'"
REFUSALS = [
    (2, "a name is missing", ["compare", "a.pfm"]),
    (2, "one name too many", [*BOTH, "a.pfm"]),
    (2, "takes no --aa", [*BOTH, "--aa"]),
    (2, "takes no --fail; clrt compare PICTURE PICTURE does", [SCENE, "-o", "a.png", "--fail", "rmse=1"]),
    (2, LIMITS, [*BOTH, "--fail", "mse=1"]),
    (2, "cannot both go to standard output", [*BOTH, "-o", "-"]),
    (3, "a.pfm and b.pfm do not both have a channel 'primitive'",
     [*BOTH, "--fail", "hits=0"]),
    (3, "a.pfm has 4 x 1 pixels and long.pfm has 5 x 1", ["compare", "a.pfm", "long.pfm"]),
    (3, "none.pfm: cannot be read: No such file or directory", ["compare", "a.pfm", "none.pfm"]),
    (3, ".: cannot be read: Is a directory", ["compare", "a.pfm", "."]),
    (3, "pipe: cannot be read: it is not a file", ["compare", "a.pfm", "pipe"]),
    (3, "nan.pfm: R of pixel 2,0 is not finite", ["compare", "a.pfm", "nan.pfm"]),
    (3, "inf.pfm: R of pixel 1,0 is not finite", ["compare", "inf.pfm", "a.pfm"]),
    (3, "vast: cannot be read: 65536 x 65536 pixels", ["compare", "vast", "vast"]),
    (3, "hollow: cannot be read: it ends early", ["compare", "hollow", "hollow"]),
    (3, "wide: cannot be read: 60000 x 5000 pixels",
     ["compare", "wide", "wide"]),
    (5, "none/map.png: cannot be written: No such file or directory", [*BOTH, "-o", "none/map.png"]),
    (5, "/dev/full: cannot be written: No space left on device", [*BOTH, "--json=/dev/full"]),
]


class Rows(SharedWork):
    """Each picture has one row, in which green and blue are constant."""

    def prepare(self):
        inf, nan = float("inf"), float("nan")
        for name, other, reds in (
            ("a", 0.5, [0, 0, 0, 0]), ("b", 0.5, [0, 0.25, 0, 0.0078125]), ("long", 0.5, [0] * 5),
            ("expected", 0, [0, 0.25, 0, 0.0078125]), ("brightness", 0, [0, 0.99805, 0, 0.17643]),
            ("nan", 0.5, [0, 0, nan, 0]), ("inf", 0.5, [0, inf, 0, 0]),
        ):
            (self.work / f"{name}.pfm").write_bytes(pfm([v for red in reds for v in (red, other, other)]))

    def test_the_report_has_the_figures_and_no_word_on_first_hits(self):
        self.assertIn("all colors are equal", self.clrt("compare", "a.pfm", "a.pfm"))
        told = self.clrt(*BOTH)
        for line in ("RMSE 0.072204 (7.22 %), PSNR 22.83 dB", "largest difference 0.25, in red at 1,0",
                     "off by more than 1/255: 2 pixels (50 %)", "off by more than 4/255: 1 pixels (25 %)"):
            self.assertIn(line, told)
        self.assertEqual(told.count("\n"), 5)
        self.assertEqual(self.clrt(*BOTH, "-q"), "")

    def test_json_has_every_figure(self):
        found = self.report(*BOTH, "--json")
        self.assertAlmostEqual(found["rmse"] ** 2, (0.25**2 + 2**-14) / 12, delta=1e-15)
        expected = {"schema": 1, "maximum": {"value": 0.25, "x": 1, "y": 0, "color": 0}, "wrong_hits": None,
                    "off_by_1": {"pixels": 2, "share": 0.5}, "off_by_4": {"pixels": 1, "share": 0.25}}
        self.assertEqual({name: found[name] for name in expected}, expected)

    def test_json_in_a_file_leaves_the_report_and_equal_pictures_have_no_ratio(self):
        told = self.clrt("compare", "a.pfm", "a.pfm", "--json=same.json")
        self.assertIn("all colors are equal", told)
        same = self.json_of("same.json")
        self.assertEqual((same["psnr"], same["rmse"], same["files"]), (None, 0, ["a.pfm", "a.pfm"]))

    def test_each_limit_is_kept_or_broken(self):
        told = self.clrt(*BOTH, "--fail", "rmse=0.1,max=0.25,psnr=20,share1=50%,share4=0.25")
        self.assertIn("kept: share1 0.5, the limit is 0.5", told)
        for limit in "rmse=7%", "max=0.24", "psnr=23", "share1=0.49", "share4=24%":
            done, name = self.run_clrt(*BOTH, "--fail", limit, "--json=limit.json"), limit.split("=")[0]
            self.assertEqual(done.returncode, 1, limit)
            self.assertIn(f"BROKEN: {name} ", done.stdout)
            found = self.json_of("limit.json")
            self.assertEqual((found["kept"], found["limits"][name]["kept"]), (False, False))

    def test_the_map_shows_the_difference(self):
        self.clrt(*BOTH, "-o", "map.png")
        # The map's brightness is sqrt(difference / (64/255)), at most 1.
        self.clrt("compare", "map.png", "brightness.pfm", "--fail", "max=0.002")
        self.clrt(*BOTH, "-o", "map.pfm", "-q")
        self.assert_same_bytes("map.pfm", "expected.pfm")
        written = self.run_clrt(*BOTH, "-q", "-o", "-", "--format", "pfm", content=b"").stdout
        self.assertEqual(written, self.bytes_of("expected.pfm"))

    def test_refusals(self):
        os.mkfifo(self.work / "pipe")
        self.write(vast="PF\n65536 65536\n-1.0\n", hollow="PF\n6000 5000\n-1.0\n", wide="PF\n60000 5000\n-1.0\n")
        for code, sentence, words in REFUSALS:
            self.refuses(code, sentence, *words)

    def test_other_formats_are_named(self):
        self.write(a_gif=b"GIF89a\1\0\1\0", vast_ppm="P6\n65535 65535\n255\n")
        self.assertIn("a.gif: cannot be read: it is not a PNG", self.clrt("compare", "a.gif", "a.gif", code=3))
        if "ppm" in FORMATS:
            self.refuses(3, "vast.ppm: cannot be read: it is too large", "compare", "vast.ppm", "vast.ppm")

    def test_integers_of_32_bits_are_colors_unlike_numbers_of_things(self):
        tags = [(256, 3, 1, 1), (257, 3, 1, 1), (258, 3, 3, 122), (259, 3, 1, 1), (262, 3, 1, 2),
                (273, 4, 1, 128), (277, 3, 1, 3), (278, 3, 1, 1), (279, 4, 1, 12)]
        entries = b"".join(struct.pack("<HHII", *tag) for tag in tags)
        colors = bytes(4) + struct.pack("<3H3I", 32, 32, 32, 2**32 - 1, 2**31, 0)
        self.write(wide_tif=b"II*\0" + struct.pack("<IH", 8, len(tags)) + entries + colors,
                   colors_pfm=pfm([1, 0.5, 0]))
        if "tif" in FORMATS:
            self.clrt("compare", "wide.tif", "colors.pfm", "--fail", "max=1e-6")

    def test_tiff_files_without_their_depth_are_refused(self):
        for order, magic in ("<", b"II*\0"), (">", b"MM\0*"):
            for depth in [], [(258, 1)]:
                tags = [(256, 16), (257, 1), *depth, (259, 1), (262, 1), (273, 128), (277, 1), (278, 1), (279, 2)]
                entries = b"".join(struct.pack(order + "HHIHH", tag, 3, 1, value, 0) for tag, value in tags)
                head = magic + struct.pack(order + "IH", 8, len(tags)) + entries
                self.write(bits_tif=head.ljust(128, b"\0") + b"\xaa\xf0")
                if "tif" in FORMATS and depth:
                    self.clrt("compare", "bits.tif", "bits.tif")
                elif "tif" in FORMATS:
                    self.refuses(3, "without BitsPerSample", "compare", "bits.tif", "bits.tif")


class Formats(SharedWork):
    """The first bytes of a file identify each format that clrt writes."""

    def prepare(self):
        picture = [EVERY_FEATURE, "-s", "64x48", "-q"]
        for ending in FORMATS:
            self.clrt(*picture, "-o", f"one.{ending}")
        self.clrt(*picture, "-o", "two.pfm", "--aa")

    def test_each_is_read_whatever_its_name(self):
        limits = {"jpg": "rmse=0.03", "hdr": "max=0.01", "exr": "max=0", "pfm": "max=0"}
        for ending in FORMATS:
            self.write(nameless=self.bytes_of(f"one.{ending}"))
            self.clrt("compare", "one.pfm", "nameless", "--fail", limits.get(ending, "max=0.00197"))
            pair = ["compare", f"one.{ending}", "two.pfm"]
            self.assertEqual(self.run_clrt(*pair, "--fail", "rmse=0.01").returncode, 1, ending)
            self.clrt(*pair, "-o", f"map.{ending}")

    def test_each_that_is_cut_short_is_one_message(self):
        for ending in FORMATS:
            self.write(short=self.bytes_of(f"one.{ending}")[:40])
            self.assertEqual(self.clrt("compare", "short", "short", code=3).count("\n"), 1, ending)

    def test_each_with_spoiled_bytes_is_a_picture_or_one_message(self):
        for seed, ending in enumerate(FORMATS):
            data, chance = bytearray(self.bytes_of(f"one.{ending}")), random.Random(seed)
            for _ in range(8):
                data[chance.randrange(4, min(len(data), 600))] = chance.randrange(256)
            self.write(spoiled=bytes(data))
            done = self.run_clrt("compare", "-q", "spoiled", "spoiled")
            self.assertIn(done.returncode, (0, 3), ending)
            self.assertLess(done.stderr.count("clrt: "), 2, ending)


@needs_exr
class Causes(SharedWork):
    """The pictures have the channels from which clrt compare derives causes. tests/unit/test_causes.c
    tests each cause."""

    def prepare(self):
        scene = (ROOT / "scenes/reflections.scn").read_text().replace("ply_file ", f"ply_file {ROOT}/scenes/")
        self.write(plain_scn=scene, moved_scn=re.sub(r"(?m)^sphere \S+", "sphere 0.2", scene))
        for name, scene, words in (("plain", "plain", []), ("moved", "moved", []), ("aa", "plain", ["--aa"])):
            self.clrt(f"{scene}.scn", "-s", "160x120", "-q", "--aov", "primitive,shadow,bounces",
                      "-o", f"{name}.exr", *words)

    def causes(self, name):
        """Returns the report and the causes. The mean squares of all causes must add up to RMSE squared."""
        found = self.report("compare", "plain.exr", f"{name}.exr", "--json")
        whole = found["rmse"] ** 2
        total = sum(cause["mean_square"] for cause in found["causes"].values())
        self.assertAlmostEqual(total, whole, delta=0.01 * whole)
        return found, found["causes"]

    def test_moved_spheres_and_samples_are_found(self):
        found, causes = self.causes("moved")
        self.assertGreater(causes["primitive"]["share"], 0.3)
        self.assertGreater(causes["shadow"]["pixels"], 0)
        self.assertGreater(causes["reflection"]["pixels"], 0)
        self.assertGreater(found["wrong_hits"]["pixels"], 100)
        self.assertGreater(self.causes("aa")[1]["coverage"]["share"], 0.99)

    def test_a_limit_on_hits_is_judged(self):
        done = self.run_clrt("compare", "plain.exr", "moved.exr", "--fail", "hits=0")
        self.assertEqual(done.returncode, 1)
        self.assertIn("another primitive is hit first", done.stdout)
        self.clrt("compare", "plain.exr", "aa.exr", "--fail", "hits=0")


if __name__ == "__main__":
    main(2)
