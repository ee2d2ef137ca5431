#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that a crop has the bits of this part of the whole picture with all options. Usage:
# test_crop.py CLRT FORMATS
import json
import pathlib
import struct
import sys
import unittest

from read_exr import read_exr, read_header
from work import Work

HAS_EXR = "exr" in sys.argv[2]
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = str(ROOT / "scenes/reflections.scn")
WIDTH, HEIGHT = 61, 43
WHOLE = [SCENE, "-s", f"{WIDTH}x{HEIGHT}"]
CROPS = [(0, 0, 61, 43), (13, 5, 50, 38), (60, 42, 61, 43), (0, 17, 61, 18), (7, 0, 8, 43)]


def part_of(rows, crop):
    return [row[crop[0] : crop[2]] for row in rows[crop[1] : crop[3]]]


def read_pfm(path):
    """Returns the rows, the top row first. Each pixel is the bytes of three floats."""
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n"
        width, height = map(int, file.readline().split())
        file.readline()
        rows = [file.read(12 * width) for _ in range(height)][::-1]
    return [[row[12 * x : 12 * x + 12] for x in range(width)] for row in rows]


def channels_in_rows(path):
    """Returns the rows of each channel, the data window and the display window."""
    attributes, _ = read_header(path.read_bytes())
    data, display = (struct.unpack("<4i", attributes[name]) for name in ("dataWindow", "displayWindow"))
    width = data[2] - data[0] + 1
    _, channels = read_exr(path)
    # Compares texts, because NaN does not equal itself.
    rows = {name: [list(map(repr, values[at : at + width])) for at in range(0, len(values), width)]
            for name, values in channels.items()}
    return rows, data, display


class Crop(Work):
    def expect_parts(self, crops, *words):
        self.clrt(*WHOLE, *words, "-o", "whole.pfm")
        whole = read_pfm(self.work / "whole.pfm")
        for crop in crops:
            self.clrt(*WHOLE, *words, "-o", "part.pfm", "--crop", ",".join(map(str, crop)))
            self.assertTrue(read_pfm(self.work / "part.pfm") == part_of(whole, crop), (crop, words))

    def test_every_crop_is_that_part_of_the_picture(self):
        self.expect_parts(CROPS)

    def test_whatever_the_kernels_the_tiles_and_the_samples(self):
        for words in (["--aa=3"], ["--kernel", "ray"], ["--kernel", "packet", "--tile", "7x9"],
                      ["--precision", "fp64"], ["--no-bvh", "-j", "1"], ["--view", "3"]):
            self.expect_parts([(13, 5, 50, 38)], *words)

    def test_parts_of_the_sides_fit_together(self):
        self.clrt(*WHOLE, "-o", "whole.pfm")
        whole, joined = read_pfm(self.work / "whole.pfm"), []
        edges = ["0", ".33", "0.6", "1."]
        for top, bottom in zip(edges, edges[1:]):
            strips = []
            for left, right in zip(edges, edges[1:]):
                self.clrt(*WHOLE, "-o", "part.pfm", "--crop", f"{left},{top},{right},{bottom}")
                strips.append(read_pfm(self.work / "part.pfm"))
            joined += [sum(rows, []) for rows in zip(*strips)]
        self.assertTrue(joined == whole)

    def test_statistics_count_the_rays_of_the_crop_alone(self):
        self.clrt(*WHOLE, "-o", "a.pfm", "--aa", "--stats=a.json", "--crop", "13,5,50,38")
        report = json.loads((self.work / "a.json").read_text())
        self.assertEqual(report["rays"]["camera"], 4 * 37 * 33)
        self.assertEqual(report["samples"]["per_pixel"], 4)
        settings = report["settings"]
        self.assertEqual((settings["width"], settings["height"], settings["crop"]),
                         (WIDTH, HEIGHT, [13, 5, 50, 38]))

    def test_a_reference_is_that_of_the_crop(self):
        words = [*WHOLE, "--reference-samples", "8"]
        self.clrt(*words, "-o", "a.pfm", "--reference=whole.pfm")
        self.clrt(*words, "-o", "b.pfm", "--reference=part.pfm", "--crop", "13,5,50,38")
        whole, part = (read_pfm(self.work / name) for name in ("whole.pfm", "part.pfm"))
        self.assertTrue(part == part_of(whole, (13, 5, 50, 38)))

    @unittest.skipUnless(HAS_EXR, "this build writes no EXR")
    def test_channels_are_that_part_and_exr_tells_where(self):
        crop = (13, 5, 50, 38)
        channels = "depth,normal,position,primitive,material,shadow,bounces,samples,boxtests,certainty"
        words = [*WHOLE, "--aa", "--aov", channels, "--bvh", "sah"]
        self.clrt(*words, "-o", "whole.exr")
        self.clrt(*words, "-o", "part.exr", "--crop", ",".join(map(str, crop)))
        whole, _, display = channels_in_rows(self.work / "whole.exr")
        part, data, display_of_part = channels_in_rows(self.work / "part.exr")
        self.assertEqual(data, (13, 5, 49, 37))
        self.assertEqual(display_of_part, display)
        self.assertEqual(part.keys(), whole.keys())
        for name, rows in whole.items():
            self.assertTrue(part[name] == part_of(rows, crop), name)

    @unittest.skipUnless(HAS_EXR, "this build writes no EXR")
    def test_a_crop_of_everything_is_the_same_file(self):
        self.clrt(*WHOLE, "-o", "whole.exr")
        self.clrt(*WHOLE, "-o", "all.exr", "--crop", "0.0,0,1,1")
        self.assertEqual((self.work / "whole.exr").read_bytes(), (self.work / "all.exr").read_bytes())

    def test_what_is_no_crop_is_refused_in_one_sentence(self):
        for crop in ("1,2,3", "1,2,3,4,5", "4,0,4,9", "0,9,9,3", "-1,0,9,9", "0,0,1.5,1", "a,0,9,9", ""):
            self.assertEqual(self.clrt(*WHOLE, "-o", "a.pfm", "--crop", crop, code=2),
                             "clrt: --crop wants X0,Y0,X1,Y1, pixels from the upper left corner or "
                             f"parts of the sides from 0 to 1, not '{crop}'\n")
        self.assertEqual(self.clrt(*WHOLE, "-o", "a.pfm", "--crop", "0,0,62,43", code=3),
                         "clrt: the crop 0,0,62,43 leaves the picture of 61 x 43 pixels\n")
        self.assertEqual(self.clrt(*WHOLE, "-o", "a.pfm", "--crop", "0.1,0,0.101,1", code=3),
                         "clrt: no pixel of the picture of 61 x 43 is in the crop\n")

    def test_what_depends_on_the_pixels_around_is_refused(self):
        for words in (["--aa-adaptive"], ["--error", "1%"], ["--time", "1"]):
            self.assertEqual(self.clrt(*WHOLE, "-o", "a.pfm", "--crop", "0,0,9,9", *words, code=2),
                             "clrt: --crop does not go with --aa-adaptive, --error and --time, which "
                             "refine the picture as a whole: give --aa\n")
        self.assertEqual(self.clrt(*WHOLE, "--explain-pixel", "3,3", "--crop", "0,0,9,9", code=2),
                         "clrt: clrt --explain-pixel takes no --crop\n")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
