#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that clrt compare and OpenImageIO report the same differences in every format. Usage:
test_judge.py CLRT JUDGE SCENE"""

import json
import os
import subprocess
import sys
import tempfile

FORMATS = ["png", "jpg", "tif", "ppm", "exr", "hdr", "pfm"]
ROUNDING = 2.0**-22  # the tolerance of clrt's counts


def told(words):
    return json.loads(subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout)


def differences(ours, judged):
    """Yields a message for each figure that differs. OpenImageIO's sums of squares have a relative
    error of 1e-6."""
    figures = {
        "rmse": (ours["rmse"], judged["rmse"], 1e-6 * judged["rmse"]),
        "psnr": (ours["psnr"], judged["psnr"], 1e-5),
        "maximum": (ours["maximum"]["value"], judged["maximum"], 2.0**-24),
        "off_by_1": (ours["off_by_1"]["pixels"], judged["off_by_1"], 0),
        "off_by_4": (ours["off_by_4"]["pixels"], judged["off_by_4"], 0),
    }
    for name, (own, other, room) in figures.items():
        if abs(own - other) > room:
            yield f"{name}: {own} by clrt, {other} by OpenImageIO"


def main():
    clrt, judge, scene = sys.argv[1:]
    thresholds = [repr(step / 255 + ROUNDING) for step in (1, 4)]
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for ending in FORMATS:
            files = [os.path.join(folder, f"{name}.{ending}") for name in ("one", "two")]
            for file, options in zip(files, [[], ["--aa=4"]]):
                subprocess.run([clrt, scene, "-q", "-s", "200x150", "-o", file, *options], check=True)
            ours = told([clrt, "compare", *files, "--json"])
            judged = told([judge, *files, *thresholds])
            failing = [*differences(ours, judged)]
            if ours["off_by_4"]["pixels"] < 100:
                failing.append("the pictures hardly differ")
            print(f"{ending}: {'; '.join(failing) or 'the same'}")
            failures += len(failing)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
