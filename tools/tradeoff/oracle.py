# SPDX-License-Identifier: MIT
"""Computes the least time in which samples can reach an error, from measured pictures of N x N
samples per pixel. An oracle knows the squared error of each pixel in each picture, and gives each
pixel its own N. The cost of a pixel is the time of the picture with this N, divided by the number
of pixels. The oracle minimizes the time plus the squared error times a weight, pixel by pixel.
Larger weights lead to smaller errors."""

import numpy

from tradeoff import front, perception

# Weights of the squared error, in units of the slowest picture's time.
WEIGHTS = numpy.array([0, *numpy.geomspace(0.05, 1e6, 100)])


def limit(milliseconds, squares):
    """Returns the oracle's pictures, the fastest first, as rows with "milliseconds" and "rmse".
    squares[i] are the squared errors of all pixels in the picture that takes milliseconds[i]."""
    milliseconds = numpy.asarray(milliseconds)
    points = set()
    for weight in WEIGHTS * milliseconds.max():
        chosen = numpy.argmin(milliseconds[:, None] + weight * squares, axis=0)
        square = numpy.take_along_axis(squares, chosen[None], axis=0).mean()
        points.add((float(milliseconds[chosen].mean()), float(numpy.sqrt(square))))
    return [{"milliseconds": time, "rmse": rmse} for time, rmse in sorted(points)]


def squares_of(picture, reference):
    return ((perception.read_pfm(picture) - reference) ** 2).mean(axis=2).ravel()


def add(scene, folder):
    """Adds the points of limit() to a scene as "oracle". Adds "oracle_times" to each error goal:
    the goal's time divided by the oracle's time. folder contains the pictures."""
    rows = [row for row in scene["rows"] if row["kind"] == "uniform"]
    if not rows:
        return
    reference = perception.read_pfm(folder / "reference.pfm")
    squares = numpy.stack([squares_of(folder / row["picture"], reference) for row in rows])
    scene["oracle"] = limit([row["milliseconds"] for row in rows], squares)
    for goal in scene["goals"]["errors"]:
        best = front.time_at(scene["oracle"], goal["goal"])
        if best:
            goal["oracle_times"] = goal["milliseconds"] / best["milliseconds"]
