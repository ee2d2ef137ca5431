# SPDX-License-Identifier: MIT
"""Computes nearest hits in rational arithmetic. Python's fractions represent floats exactly."""
import math
from fractions import Fraction

import numpy as np


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _exact(values):
    return tuple(Fraction(float(value)) for value in values)


def _candidates(corners, origin, direction):
    """Returns the triangles that the ray may hit, by long doubles with a generous margin."""
    a, b, c = (corners[:, i].astype(np.longdouble) - origin.astype(np.longdouble) for i in range(3))
    direction = direction.astype(np.longdouble)
    sides = [np.cross(p, q) @ direction for p, q in ((b, c), (c, a), (a, b))]
    size = np.abs(np.stack((a, b, c))).max(axis=(0, 2))
    margin = 1e-12 * size**2 * np.abs(direction).max()
    low, high = np.min(sides, axis=0), np.max(sides, axis=0)
    return np.nonzero((low >= -margin) | (high <= margin))[0]


def _meeting(corners, origin, direction):
    """Returns the t of the hit and whether the hit is on the outline, or None."""
    a, b, c = (_minus(corner, origin) for corner in corners)
    sides = [_dot(_cross(p, q), direction) for p, q in ((b, c), (c, a), (a, b))]
    whole = sum(sides)
    if whole == 0 or min(sides) * whole < 0 or max(sides) * whole < 0:
        return None
    t = sum(side * _dot(corner, direction) for side, corner in zip(sides, (a, b, c)))
    return t / (whole * _dot(direction, direction)), 0 in sides


def _root(square):
    """Returns the square root with a relative error of at most 2^-200."""
    scale = 1 << (400 + 2 * max(0, square.denominator.bit_length() - square.numerator.bit_length()))
    return Fraction(math.isqrt(square.numerator * scale // square.denominator), math.isqrt(scale))


def _sphere_meeting(center, radius, origin, direction):
    """Returns the t of the hit and whether the ray is a tangent, or None."""
    apart, square = _minus(center, origin), _dot(direction, direction)
    middle = _dot(apart, direction) / square
    quarter = middle**2 - (_dot(apart, apart) - radius**2) / square
    if quarter < 0:
        return None
    half = _root(quarter) if quarter else Fraction(0)
    t = middle - half if middle - half >= 0 else middle + half
    return (t, half == 0) if t >= 0 else None


def nearest(corners, origin, direction, own=None, far=math.inf, spheres=()):
    """Returns the nearest primitive or None, and whether the hit is clear. A hit is not clear if several
    primitives are nearest, or if the ray passes through an outline. Spheres are (center, radius)."""
    found, start, way = [], _exact(origin), _exact(direction)
    for number, (center, radius) in enumerate(spheres):
        found.append((_sphere_meeting(_exact(center), Fraction(radius), start, way), number))
    for triangle in _candidates(corners, origin, direction):
        met = _meeting([_exact(corner) for corner in corners[triangle]], start, way)
        found.append((met, len(spheres) + triangle))
    found = [(*met, number) for met, number in found
             if met and number != own and 0 <= met[0] and met[0] <= far]
    if not found:
        return None, True
    first = min(found)
    ties = [hit for hit in found if hit[0] == first[0]]
    return min(hit[2] for hit in ties), len(ties) == 1 and not first[1]


def reach(corners, origin, direction, slack):
    """Returns the lowest and the highest t at which the ray is within `slack` of the triangle on each
    axis. These are the t of all triangles whose corners differ by at most `slack`. None: no such t."""
    corners, start, way = [_exact(corner) for corner in corners], _exact(origin), _exact(direction)
    edges = [_minus(corners[i], corners[i - 1]) for i in range(3)]
    axes = [tuple(map(Fraction, row)) for row in np.eye(3, dtype=int).tolist()]
    normals = axes + [_cross(*edges[:2])] + [_cross(edge, axis) for edge in edges for axis in axes]
    low, high = -math.inf, math.inf
    for normal in normals:  # of the planes that bound all places within `slack` of the triangle
        heights = [_dot(normal, _minus(corner, start)) for corner in corners]
        margin, speed = slack * sum(map(abs, normal)), _dot(normal, way)
        ends = min(heights) - margin, max(heights) + margin
        if speed:
            low = max(low, min(end / speed for end in ends))
            high = min(high, max(end / speed for end in ends))
        elif not ends[0] <= 0 <= ends[1]:
            return None
    return (low, high) if low <= high else None
