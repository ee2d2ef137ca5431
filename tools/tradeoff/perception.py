# SPDX-License-Identifier: MIT
"""Computes SSIM and FLIP of PFM files. Both estimate visible differences. Both interpret the values
as display values. FLIP assumes 67 pixels per degree, its default."""

import flip_evaluator
import numpy
from skimage.metrics import structural_similarity


def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n"
        width, height = map(int, file.readline().split())
        file.readline()
        values = numpy.fromfile(file, "<f4", width * height * 3)
    return numpy.ascontiguousarray(values.reshape(height, width, 3)[::-1])


def judge(rows, folder):
    """Adds "ssim" and "flip" to each row."""
    reference = read_pfm(folder / "reference.pfm")
    for row in rows:
        picture = read_pfm(folder / row["picture"])
        row["ssim"] = float(structural_similarity(reference, picture, channel_axis=2,
                                                  data_range=1.0))
        row["flip"] = float(flip_evaluator.evaluate(reference, picture, "LDR")[1])
