#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# clrt compare and OpenImageIO's comparison report the same figures of the same files, in every format.
# Usage: test_judge.py CLRT FORMATS JUDGE, as tests/image/judge.cpp is built
import json
import os
import subprocess
import sys

from work import EVERY_FEATURE, FORMATS, Work, main

JUDGE = os.path.abspath(sys.argv[3])
# A step of 8 bits and the room for rounding that clrt adds.
THRESHOLDS = [repr(step / 255 + 2.0**-22) for step in (1, 4)]


class Judge(Work):
    def test_figures_are_those_of_openimageio(self):
        for ending in FORMATS:
            files = [str(self.work / f"{name}.{ending}") for name in ("one", "two")]
            for file, words in zip(files, [[], ["--aa=4"]]):
                self.clrt(EVERY_FEATURE, "-q", "-s", "200x150", "-o", file, *words)
            ours = self.report("compare", *files, "--json")
            told = subprocess.run([JUDGE, *files, *THRESHOLDS], check=True, stdout=subprocess.PIPE).stdout
            judged = json.loads(told)
            # OpenImageIO sums squares in floats.
            self.assertAlmostEqual(ours["rmse"], judged["rmse"], delta=1e-6 * judged["rmse"], msg=ending)
            self.assertAlmostEqual(ours["psnr"], judged["psnr"], delta=1e-5, msg=ending)
            self.assertAlmostEqual(ours["maximum"]["value"], judged["maximum"], delta=2.0**-24, msg=ending)
            for name in "off_by_1", "off_by_4":
                self.assertEqual(ours[name]["pixels"], judged[name], (ending, name))
            self.assertGreater(judged["off_by_4"], 100, "the pictures hardly differ")


if __name__ == "__main__":
    main(3)
