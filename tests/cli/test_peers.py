#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that docs/peers.md names an existing test for every feature that clrt has.
# Usage: test_peers.py CTEST BUILD_FOLDER
import json
import pathlib
import re
import sys
import unittest

from skips import ctest_output

CTEST, BUILD = sys.argv[1:3]
PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/peers.md"
PEERS = ["POV-Ray", "c-ray", "LuxCoreRender", "Mitsuba 3", "Cycles", "pbrt-v4", "OSPRay Studio", "Embree",
         "F3D", "Radiance", "tinybvh", "appleseed", "nobody", "all but"]
LOSSES = ["textures", "instancing", "Windows and macOS"]
# Easily overlooked features, with peers that have them.
OVERLOOKED = {
    "more samples where pixels differ": ["Cycles (by default, threshold 0.01)"],
    "transparency where nothing is hit": ["F3D (`--no-background`)"],
    "explaining a pixel's color": ["Radiance (`trace` in `rvu`"],
    "no gaps between triangles": ["pbrt-v4", "Mitsuba 3"],
    "counting the leaks of a mesh": ["Embree (`verify`"],
}


def rows():
    """Returns the cells of every row of the tables of features. Heads of tables are left out."""
    tables = PAGE.read_text().split("\n## Sources of the tables\n")[1]
    lines = [line for line in tables.splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [row for row in cells if row[0] != "what" and set(row[0]) != {"-"}]


class Table(unittest.TestCase):
    def test_every_row_has_a_feature_peers_and_an_answer(self):
        self.assertGreater(len(rows()), 60)
        for row in rows():
            self.assertEqual(len(row), 4, row)
            what, who, answer, tests = row
            self.assertTrue(what, row)
            self.assertTrue(any(peer in who for peer in PEERS), row)
            self.assertRegex(answer, r"^yes$|^(yes|no|by design not): \S")
            self.assertEqual(answer.startswith("yes"), bool(tests), row)
            self.assertRegex(tests, r"^(`\w+`(, `\w+`)*)?$")

    def test_the_page_states_what_clrt_lacks(self):
        answers = {row[0]: row[2] for row in rows()}
        for what in LOSSES:
            self.assertRegex(answers.get(what, "no row"), "^no: ", what)

    def test_no_peer_s_feature_is_overlooked(self):
        peers = {row[0]: row[1] for row in rows()}
        for what, names in OVERLOOKED.items():
            for name in names:
                self.assertIn(name, peers[what])

    def test_no_row_comes_twice(self):
        names = [row[0] for row in rows()]
        self.assertEqual(sorted(set(names)), sorted(names))

    def test_every_test_that_is_named_exists(self):
        listed = json.loads(ctest_output(CTEST, BUILD, "--show-only=json-v1"))
        existing = {test["name"] for test in listed["tests"]}
        for row in rows():
            missing = set(re.findall(r"`(\w+)`", row[3])) - existing
            self.assertFalse(missing, f"{row[0]}: there is no such test")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
