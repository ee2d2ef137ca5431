#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that the Embree renderer of tools/bench draws clrt's picture with as many rays, in each
mode. Otherwise the comparison would be meaningless. Edges may differ, as Embree's arithmetic does.
Usage: test_agree.py CLRT EMBREE_PEER
"""

import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from benchmark.embree import MODES, share_of_differing_pixels  # noqa: E402

SCENE = ROOT / "tests" / "bench" / "agree.scn"
PIXELS_APART = 0.0005
RAYS_APART = 0.0005


def peer_draws(peer, mode, words, picture):
    done = subprocess.run([peer, str(SCENE), "-m", mode, "-f", "1", "-o", picture, *words],
                          check=True, capture_output=True, text=True)
    return json.loads(done.stdout)["modes"][mode]


def faults_of(mode, found, expected, share):
    """Yields a message for each fault of a mode."""
    if len(found["frame_seconds"]) != 1:
        yield f"{mode}: {len(found['frame_seconds'])} frames instead of 1"
    if share > PIXELS_APART:
        yield f"{mode}: {share:.2%} of the pixels differ"
    for kind, count in found["rays"].items():
        if abs(count - expected[kind]) > RAYS_APART * expected[kind]:
            yield f"{mode}: {count} {kind} rays, where clrt has {expected[kind]}"


def main(clrt, peer):
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        ours, theirs, report = (f"{folder}/{name}" for name in ("a.pfm", "b.pfm", "report.json"))
        subprocess.run([clrt, str(SCENE), "-q", "-o", ours, f"--json={report}"], check=True)
        expected = json.loads(pathlib.Path(report).read_text())["rays"]
        for mode in MODES:
            for words in (["-c", "csr"], ["-c", "", "-j", "2"], ["-r", "-q", "high"]):
                found = peer_draws(peer, mode, words, theirs)
                faults += faults_of(mode, found, expected, share_of_differing_pixels(ours, theirs))
    print("\n".join(faults) or f"{len(MODES)} modes agree with clrt")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
