#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that the window shows as many boxes of a level as the tree has nodes on this level.
Compares the window's text and picture with the statistics.
Usage: CLRT=path/to/clrt test_boxes.py"""

import json
import os
import subprocess

from screen import is_blue, is_red, opened, planes_of, run_tests
from models import ply

SIDE = 4  # clusters along a side of the scene


def statistics(scene, *options):
    done = subprocess.run([os.environ["CLRT"], str(scene), "-q", "-s", "8x8", "-o", "/dev/null",
                           "--format", "pfm", "--json=-", *options], check=True,
                          capture_output=True, text=True)
    return json.loads(done.stdout)["bvh"]


def write_clusters(folder):
    """Writes a scene of small clusters of triangles in a plane, with gaps between the clusters. The
    camera is above the plane."""
    corners, faces = [], []
    for cluster in range(SIDE * SIDE):
        # The gaps have different sizes. Otherwise, the order of the tree's splits would be arbitrary.
        x, y = (place + 0.05 * place * place for place in divmod(cluster, SIDE))
        for part in range(6):
            first = len(corners)
            corners += [(x + 0.1 * part, y, 0), (x + 0.1 * part + 0.03, y, 0),
                        (x + 0.1 * part, y + 0.5, 0)]
            faces.append((first, first + 1, first + 2))
    (folder / "clusters.ply").write_bytes(ply(corners, faces))
    (folder / "clusters.scn").write_text("background 1 1 1\nmaterial 1\nply_file clusters.ply\n"
                                         "up 0 1 0\ncamera 2 2 6  2 2 0  45\n")
    return folder / "clusters.scn"


def count_shapes(shown, size, wanted):
    """Returns the number of connected groups of wanted pixels. Diagonal neighbors are connected."""
    blue, green, red = planes_of(shown)
    left = {place for place, color in enumerate(zip(red, green, blue)) if wanted(*color)}
    steps = [right + down * size[0] for right in (-1, 0, 1) for down in (-1, 0, 1)]
    shapes = 0
    while left:
        shapes += 1
        waiting = [left.pop()]
        while waiting:
            place = waiting.pop()
            for step in steps:
                if place + step in left:
                    left.remove(place + step)
                    waiting.append(place + step)
    return shapes


def the_window_shows_as_many_boxes_as_it_reports(screen, folder):
    size = (600, 600)
    scene = write_clusters(folder)
    for options in ([], ["--tune", "bvh=midpoint"], ["--tune", "kernel=pair"]):
        tree = statistics(scene, *options)
        inner = tree["inner_nodes"]
        assert sum(inner) == tree["nodes"] - tree["leaves"], "the statistics contradict themselves"
        window = opened(screen, scene, *options, size=size)
        window.press("B", f"boxes of leaves: {tree['leaves']},")
        seen = count_shapes(window.read(), size, is_blue)
        assert seen == tree["leaves"], f"{seen} leaves are seen, {tree['leaves']} are there"
        for level, count in enumerate(inner, start=1):
            window.press("bracketright", f"boxes at level {level}: {count},")
            seen = count_shapes(window.read(), size, is_red)
            assert seen == count, f"level {level}: {seen} boxes are seen, {count} are there"
        window.press("bracketright")
        window.close()
        print(f"         {options}: {tree['leaves']} leaves, inner {inner} seen")


if __name__ == "__main__":
    run_tests(globals())
