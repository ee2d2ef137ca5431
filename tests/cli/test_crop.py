#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that a crop has the bits of its part of the whole picture, and that some options reject crops.
# Usage: test_crop.py CLRT FORMATS
import struct

from pictures import read_exr, read_header, read_pfm
from work import SCENE, Work, main, needs_exr

WIDTH, HEIGHT = 61, 43
WHOLE = [SCENE, "-s", f"{WIDTH}x{HEIGHT}"]
CROPS = [(0, 0, 61, 43), (13, 5, 50, 38), (60, 42, 61, 43), (0, 17, 61, 18), (7, 0, 8, 43)]


def part_of(rows, crop, values=3):
    return [row[values * crop[0] : values * crop[2]] for row in rows[crop[1] : crop[3]]]


def channels_in_rows(path):
    """Returns the rows of each channel, the data window and the display window."""
    attributes, _ = read_header(path.read_bytes())
    data, display = (struct.unpack("<4i", attributes[name]) for name in ("dataWindow", "displayWindow"))
    width = data[2] - data[0] + 1
    _, channels = read_exr(path)
    # The values become strings, because NaN does not equal itself.
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

    def test_crops_are_exact_with_all_kernels_tiles_and_samples(self):
        for words in (["--aa=3"], ["--tune", "kernel=wide"], ["--tune", "kernel=packet,tile=7x9"],
                      ["--precision", "fp64"], ["--tune=bvh=none", "-j", "1"], ["--view", "3"]):
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
        found = self.statistics(*WHOLE, "-o", "a.pfm", "--aa", "--crop", "13,5,50,38")
        self.expect(found, rays__camera=4 * 37 * 33, samples__per_pixel=4, settings__width=WIDTH,
                    settings__height=HEIGHT, settings__crop=[13, 5, 50, 38])

    def test_a_reference_is_that_of_the_crop(self):
        words = [*WHOLE, "--reference-samples", "8"]
        self.clrt(*words, "-o", "a.pfm", "--reference=whole.pfm")
        self.clrt(*words, "-o", "b.pfm", "--reference=part.pfm", "--crop", "13,5,50,38")
        whole, part = (read_pfm(self.work / name) for name in ("whole.pfm", "part.pfm"))
        self.assertTrue(part == part_of(whole, (13, 5, 50, 38)))

    @needs_exr
    def test_channels_are_cropped_and_exr_has_the_position(self):
        crop = (13, 5, 50, 38)
        channels = "depth,normal,position,primitive,material,shadow,bounces,samples,boxtests,certainty"
        words = [*WHOLE, "--aa", "--aov", channels, "--tune", "bvh=sah"]
        self.clrt(*words, "-o", "whole.exr")
        self.clrt(*words, "-o", "part.exr", "--crop", ",".join(map(str, crop)))
        whole, _, display = channels_in_rows(self.work / "whole.exr")
        part, data, display_of_part = channels_in_rows(self.work / "part.exr")
        self.assertEqual(data, (13, 5, 49, 37))
        self.assertEqual(display_of_part, display)
        self.assertEqual(part.keys(), whole.keys())
        for name, rows in whole.items():
            self.assertTrue(part[name] == part_of(rows, crop, 1), name)

    @needs_exr
    def test_a_crop_of_everything_is_the_same_file(self):
        self.clrt(*WHOLE, "-o", "whole.exr")
        self.clrt(*WHOLE, "-o", "all.exr", "--crop", "0.0,0,1,1")
        self.assert_same_bytes("whole.exr", "all.exr")

    def test_wrong_crops_are_refused_in_one_sentence(self):
        for crop in ("1,2,3", "1,2,3,4,5", "4,0,4,9", "0,9,9,3", "-1,0,9,9", "0,0,1.5,1", "a,0,9,9", ""):
            self.refuses(2, "--crop wants X0,Y0,X1,Y1, pixels from the upper left corner or parts of the sides "
                         f"from 0 to 1, not '{crop}'", *WHOLE, "-o", "a.pfm", "--crop", crop)
        self.refuses(3, "the crop 0,0,62,43 exceeds the picture of 61 x 43 pixels",
                     *WHOLE, "-o", "a.pfm", "--crop", "0,0,62,43")
        self.refuses(3, "no pixel of the picture of 61 x 43 is in the crop",
                     *WHOLE, "-o", "a.pfm", "--crop", "0.1,0,0.101,1")

    def test_samples_that_depend_on_other_pixels_are_refused(self):
        for words in (["--aa-adaptive"], ["--error", "1%"], ["--time", "1"]):
            self.refuses(2, "--crop and --", *WHOLE, "-o", "a.pfm", "--crop", "0,0,9,9", *words)
        self.refuses(2, "clrt explain SCENE X,Y takes no --crop", "explain", *WHOLE, "3,3", "--crop", "0,0,9,9")


if __name__ == "__main__":
    main(2)
