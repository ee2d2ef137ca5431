#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that every option of --help has a visible effect on the exit status, streams, picture or
# statistics. Other tests try the window's options. Usage: test_effects.py CLRT
import functools
import hashlib
import json
import pathlib
import re
import subprocess
import tempfile
import unittest

from models import ply
from pictures import pfm
from work import CLRT, ROOT, SCENE, main

PLAIN = [SCENE, "-s", "24x16", "-o", "a.pfm"]
# With specialize=auto, the kernel cache would decide whether the kernels are specialized.
PICTURE = PLAIN + ["--json=a.json", "--tune", "specialize=never"]
# The special kernels of a single ball compile fast.
BALL = [str(ROOT / "tests/cli/sphere.scn"), "-s", "24x16", "-o", "a.pfm", "--json=a.json", "--tune",
        "specialize=always", "--tune"]
FLAT = "flat.ply"
CHECK = ["check", FLAT]
MESH = [FLAT, "-s", "24x16", "-o", "a.pfm"]
CONE = [str(ROOT / "scenes/cone.ply"), "-s", "24x16", "-o", "a.pfm"]
COMPARE = ["compare", "black.pfm", "white.pfm"]

# Each option has two lists of arguments: one without the option or with another value, and one with
# the option. The effects of the two lists must differ. If the option changes the picture, the
# arguments write no statistics, because statistics repeat the settings.
TRIALS = {
    "output": (PLAIN, [SCENE, "-s", "24x16", "-o", "b.pfm"]),
    "format": (PLAIN, PLAIN + ["--format", "png"]),
    "encode": (PLAIN + ["--format", "png"], PLAIN + ["--format", "png", "--encode", "srgb"]),
    "exposure": (PLAIN + ["--format", "png"], PLAIN + ["--format", "png", "--exposure", "1"]),
    "aov": (PLAIN + ["--format", "exr"], PLAIN + ["--format", "exr", "--aov", "depth"]),
    "no-metadata": (PLAIN + ["--format", "png"], PLAIN + ["--format", "png", "--no-metadata"]),
    "hash": (PLAIN + ["--hash"], PLAIN + ["--hash=" + 32 * "0"]),
    "size": ([SCENE, "-o", "a.pfm"], [SCENE, "-o", "a.pfm", "-s", "24x16"]),
    "crop": (PLAIN, PLAIN + ["--crop", "4,4,20,12"]),
    "view": (PLAIN, PLAIN + ["--view", "2"]),
    "up": (MESH, MESH + ["--up", "x"]),
    "studio": (MESH, MESH + ["--studio", "soft"]),
    "normals": (CONE, CONE + ["--normals", "flat"]),
    "aa": (PLAIN, PLAIN + ["--aa=3"]),
    "aa-adaptive": (PLAIN, PLAIN + ["--aa-adaptive"]),
    "max-level": (PLAIN, PLAIN + ["--max-level", "1"]),
    "error": (PLAIN, PLAIN + ["--error", "0.1%"]),
    "time": (PLAIN, PLAIN + ["--time", "0.1"]),
    "precision": (PLAIN, PLAIN + ["--precision", "fp64"]),
    "tune": (BALL + ["kernel=wide:8"], BALL + ["kernel=wide:4"]),
    "tune kernel": (PICTURE + ["--tune", "kernel=packet"], PICTURE + ["--tune", "kernel=pair"]),
    "tune tile": (PICTURE, PICTURE + ["--tune", "tile=16x8"]),
    "tune group": (PICTURE, PICTURE + ["--tune", "group=4x2"]),
    "tune specialize": (PICTURE + ["--tune", "kernel=pair"], PICTURE + ["--tune", "kernel=pair,specialize=always"]),
    "tune bvh": (PICTURE, PICTURE + ["--tune", "bvh=midpoint"]),
    "turntable": (PLAIN, PLAIN + ["--turntable", "2"]),
    "frames": (PLAIN, PLAIN + ["--frames", "2-3"]),
    "part": (PLAIN + ["--format", "exr", "--tune", "tile=8x8"],
             PLAIN + ["--format", "exr", "--tune", "tile=8x8", "--part", "2/3"]),
    "resume": (PLAIN + ["-v"], PLAIN + ["-v", "--resume"]),
    "device": (PICTURE, PICTURE + ["--device", "no such device"]),
    "threads": (PICTURE + ["-v", "-j", "2"], PICTURE + ["-v", "-j", "1"]),
    "stats": (PLAIN, PLAIN + ["--stats"]),
    "reference": (PICTURE, PICTURE + ["--reference"]),
    "reference-samples": (PICTURE + ["--reference"], PICTURE + ["--reference-samples", "32"]),
    "repeat": (PICTURE, PICTURE + ["--repeat", "2"]),
    "bad-geometry": (MESH, MESH + ["--bad-geometry", "fail"]),
    "fail": (COMPARE, COMPARE + ["--fail", "max=0.5"]),
    "json": (PLAIN, PICTURE),
    "quiet": (CHECK, CHECK + ["-q"]),
    "verbose": (PICTURE, PICTURE + ["-v"]),
    "version": ([], ["--version"]),
    "help": ([], ["--help"]),
}

# These tests try the options that need a window.
IN_THE_WINDOW = {"keys": "tests/view/test_keys.py"}

# These values differ between two runs with the same arguments.
MEASURED = ("seconds", "frame_seconds", "bytes", "cached")


def listed_options():
    text = subprocess.run([CLRT, "--help"], capture_output=True, text=True, check=True).stdout
    options = re.findall(r"^  (?:-\w, |    )--([a-z-]+)", text, re.MULTILINE)
    return options + [f"tune {key}" for key in re.findall(r"^        ([a-z]+)=", text, re.MULTILINE)]


def statistics(path):
    report = json.loads(path.read_text())
    (report.get("reference") or {}).pop("seconds", None)
    frames = len(report.get("frame_seconds", []))
    return {key: value for key, value in report.items() if key not in MEASURED} | {"frames": frames}


@functools.cache
def observe_words(words):
    """Returns all visible effects of a run in its own folder, without times."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / FLAT).write_bytes(ply([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 1)]))
        for color, value in ("black", 0), ("white", 1):
            (folder / f"{color}.pfm").write_bytes(pfm([value] * 3))
        done = subprocess.run([CLRT, *words], cwd=folder, capture_output=True, timeout=300)
        streams = [re.sub(rb"\d+\.\d+ s", b"", stream) for stream in (done.stdout, done.stderr)]
        files = {file.name: statistics(file) if file.suffix == ".json"
                 else hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(folder.iterdir())}
        return done.returncode, streams, files


def observe(words):
    return observe_words(tuple(words))


class Effects(unittest.TestCase):
    def test_every_option_has_a_trial(self):
        self.assertEqual(sorted(listed_options()), sorted([*TRIALS, *IN_THE_WINDOW]))

    def test_the_same_words_show_the_same(self):
        self.assertEqual(observe(PICTURE), observe_words.__wrapped__(tuple(PICTURE)))

    def test_options_of_the_window_are_tried_there(self):
        for name, file in IN_THE_WINDOW.items():
            self.assertIn(f"--{name}", (ROOT / file).read_text())


def add_trial(name, without, with_it):
    def test(self):
        self.assertNotEqual(observe(without), observe(with_it))

    setattr(Effects, "test_" + re.sub("[- ]", "_", name) + "_has_an_effect", test)


for trial, (without_option, with_option) in TRIALS.items():
    add_trial(trial, without_option, with_option)

if __name__ == "__main__":
    main(1)
