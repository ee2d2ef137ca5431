# SPDX-License-Identifier: MIT
"""Places the names of points. Each name takes the position around its point that covers the least
of other names and points, and among equal positions the nearest. A thin line leads to a distant
name."""

import math

SIZE = 8  # of letters, in typographic points
GAP = 6  # between a point and its name
FAR = 18  # from this distance on, a line leads to the name
DIRECTIONS = [(1, 1), (-1, -1), (1, -1), (-1, 1), (0, 1), (0, -1), (1, 0), (-1, 0)]
DISTANCES = [GAP, 14, 24, 36, 50, 66, 84]


def extent(text):
    """Returns approximately half the width and half the height of a name, in typographic points."""
    return 0.29 * SIZE * len(text) + 1, 0.62 * SIZE


def box_at(center, half):
    return (center[0] - half[0], center[1] - half[1], center[0] + half[0], center[1] + half[1])


def overlap(one, other):
    width = min(one[2], other[2]) - max(one[0], other[0])
    height = min(one[3], other[3]) - max(one[1], other[1])
    return max(width, 0) * max(height, 0)


def candidates(point, half):
    for distance in DISTANCES:
        for x, y in DIRECTIONS:
            scale = distance / math.hypot(x, y)
            yield distance, (point[0] + x * (scale + half[0]), point[1] + y * (scale + half[1]))


def outside(box, frame):
    return max(frame[0] - box[0], frame[1] - box[1], box[2] - frame[2], box[3] - frame[3], 0)


def cost(candidate, half, taken, frame):
    """Returns (covered area plus a penalty outside the frame, distance). The least is best."""
    distance, center = candidate
    box = box_at(center, half)
    covered = sum(overlap(box, other) for other in taken)
    return covered + 100 * outside(box, frame), distance


def place(names, points, frame):
    """Returns (center, distance) of each name. A name is ((x, y), text); all lengths are
    typographic points."""
    taken = [(x - 4, y - 4, x + 4, y + 4) for x, y in points]
    placed = []
    for point, text in names:
        half = extent(text)
        distance, center = min(candidates(point, half),
                               key=lambda candidate: cost(candidate, half, taken, frame))
        taken.append(box_at(center, half))
        placed.append((center, distance))
    return placed
