#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that the Embree renderers of tools/bench draw clrt's picture with the same number of rays, in
each mode and for each target. A few pixels and rays at edges may differ, because Embree's arithmetic
differs. Usage: test_agree.py CLRT EMBREE_PEER...
"""

import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from benchmark import generated  # noqa: E402
from benchmark.embree import MODES, share_of_differing_pixels  # noqa: E402

SCENE = ROOT / "tests" / "bench" / "agree.scn"
GENERATED = ["sky", "gear-6k", "balls-10"]
WORDS = [["-c", "csr"], ["-c", "", "-j", "2"], ["-r", "-q", "high"]]
PIXELS_APART = 0.0005
RAYS_APART = 0.0005


def peer_draws(peer, scene, mode, words, picture):
    done = subprocess.run([peer, str(scene), "-m", mode, "-f", "1", "-o", picture, *words],
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


def faults_in(scene, size, clrt, peers, folder):
    """Yields a message for each fault of a scene."""
    ours, theirs, report = (f"{folder}/{name}" for name in ("a.pfm", "b.pfm", "report.json"))
    subprocess.run([clrt, str(scene), "-q", "-o", ours, f"--json={report}", *size], check=True)
    expected = json.loads(pathlib.Path(report).read_text())["rays"]
    for peer in peers:
        for mode in MODES:
            for words in WORDS:
                found = peer_draws(peer, scene, mode, words + size, theirs)
                yield from faults_of(f"{peer} {scene} {mode}", found, expected,
                                     share_of_differing_pixels(ours, theirs))


def main(clrt, *peers):
    has_avx2 = " avx2 " in pathlib.Path("/proc/cpuinfo").read_text()
    peers = [peer for peer in peers if has_avx2 or not peer.endswith("avx2")]
    with tempfile.TemporaryDirectory() as folder:
        faults = list(faults_in(SCENE, [], clrt, peers, folder))
        for scene in generated.write(folder, GENERATED):
            faults += faults_in(scene, ["-s", "96x96"], clrt, peers, folder)
    print("\n".join(faults) or f"{len(peers)} renderers agree with clrt in {len(MODES)} modes")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
