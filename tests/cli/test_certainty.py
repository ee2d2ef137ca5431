#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests --aov certainty: the channel, its counts, and the pixels that clrt repairs in fp64.
# Usage: test_certainty.py CLRT NO_FP64, with the library of tests/cli/no_fp64.c
import sys

from pictures import read_exr
from work import SCENE, SharedWork, main, preload

PICTURE = [SCENE, "-s", "128x96", "-o"]
CERTAIN = ["--aov", "certainty"]


class Certainty(SharedWork):
    def prepare(self):
        self.clrt(*PICTURE, "plain.exr", "--json=plain.json")
        self.clrt(*PICTURE, "fp64.exr", "--precision", "fp64")
        self.clrt(*PICTURE, "certain.exr", *CERTAIN, "--json=certain.json")

    def pixels(self, name):
        """Returns the color and the certainty of each pixel."""
        channels = read_exr(self.work / name)[1]
        return list(zip(*(channels[color] for color in "RGB"))), channels.get("certainty")

    def test_pixels_are_certified_repaired_or_open_and_statistics_count_them(self):
        kinds = self.pixels("certain.exr")[1]
        self.assertLessEqual(set(kinds), {0, 0.5, 1})
        self.assertLessEqual({0.5, 1}, set(kinds))
        counts = self.json_of("certain.json")["certainty"]
        for name, kind in ("certified", 1), ("repaired", 0.5), ("open", 0):
            self.assertEqual(counts[name], kinds.count(kind), name)

    def test_only_repaired_pixels_change_and_have_the_colors_of_fp64(self):
        plain, exact = self.pixels("plain.exr")[0], self.pixels("fp64.exr")[0]
        certain, kinds = self.pixels("certain.exr")
        repaired = [kind == 0.5 for kind in kinds]
        expected = [e if r else p for p, e, r in zip(plain, exact, repaired)]
        self.assertTrue(certain == expected)
        self.assertTrue(certain != plain)

    def test_certainty_is_the_same_in_every_form(self):
        for form in "-j 1", "--tune tile=16x8", "--tune kernel=wide", "--tune kernel=pair", "--tune bvh=midpoint", \
                    "--tune bvh=none":
            self.clrt(*PICTURE, "form.exr", *CERTAIN, *form.split())
            self.assert_same_bytes("certain.exr", "form.exr", form)

    def test_statistics_as_text_count_them(self):
        talk = self.run_clrt(*PICTURE, "counted.exr", *CERTAIN, "--stats").stderr
        self.assertRegex(talk, "pixels certified, [0-9]* repaired, [0-9]* open")

    def test_statistics_without_certainty_have_null(self):
        self.expect(self.json_of("plain.json"), certainty=None)

    def test_all_samples_of_a_pixel_count_so_that_fewer_are_certified(self):
        found = self.statistics(*PICTURE, "aa.exr", *CERTAIN, "--aa")["certainty"]["certified"]
        self.assertLess(found, self.json_of("certain.json")["certainty"]["certified"])

    def test_adaptive_samples_and_fp64_are_refused(self):
        for message, words in (
            ("--aov certainty and --aa-adaptive exclude each other", ["--aa-adaptive"]),
            ("--aov certainty and --precision fp64 exclude each other", ["--precision", "fp64"]),
        ):
            self.refuses(2, message, *PICTURE, "a.exr", *CERTAIN, *words)

    def test_a_device_without_fp64_is_exit_4(self):
        told = self.clrt(SCENE, "-s", "8x8", "-o", "a.exr", *CERTAIN, code=4, **preload(sys.argv[2]))
        self.assertIn("has no double arithmetic, which certainty needs", told)


if __name__ == "__main__":
    main(2)
