#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Compares clrt with the course's pictures and counts of rays. The course's tracer uses floats and another
# triangle test, so a few pixels on edges differ. tests/image/test_oracle.c compares the same
# scenes with the tests' own tracer.
# Usage: test_references.py CLRT FORMATS
import os
import pathlib
import unittest

from skips import leave
from work import ROOT, Work, main, needs_exr

COURSE = pathlib.Path(os.environ.get("CLRT_COURSE", ROOT.parent / "shared/course"))
# The course's numbers of camera rays that hit, shaded points, reflected rays and shadow rays. The
# course's tracer also casts shadow rays toward lights behind the surface.
COUNTS = {"silhouette": (95935, 95935, 0, 0), "matte": (95935, 95935, 0, 191870),
          "blinn_phong": (95935, 95935, 0, 191870), "simple": (98036, 98036, 0, 196072),
          "reflections": (95935, 118573, 114328, 237146), "cow": (95935, 95935, 0, 191870),
          "buddha": (95935, 95935, 0, 191870)}


class References(Work):
    def draw(self, name, *words):
        return self.statistics(COURSE / f"scenes/{name}.scn", "-s", "512x512", "-o", "a.pfm", *words)

    @needs_exr
    def test_few_pixels_differ_from_the_courses_pictures(self):
        for name, words, most in (("silhouette", [], 30), ("matte", [], 30), ("blinn_phong", [], 30),
                                  ("reflections", [], 30), ("reflections-aa", ["--aa=2"], 120)):
            self.draw(name.removesuffix("-aa"), *words)
            found = self.report("compare", "a.pfm", COURSE / f"references/{name}.exr", "--json")
            self.assertLessEqual(found["off_by_1"]["pixels"], most, name)

    def test_rays_are_as_many_as_the_courses(self):
        for name, (hits, points, reflected, shadow) in COUNTS.items():
            if (COURSE / f"scenes/{name}.scn").exists():
                rays = self.draw(name)["rays"]
                self.assertEqual(rays["camera"], 512 * 512)
                # Rays along an edge may fall on either side.
                for kind, count in ("camera_hits", hits), ("shaded_points", points), ("reflected", reflected):
                    self.assertAlmostEqual(rays[kind], count, delta=1 + 2e-4 * count, msg=(name, kind))
                self.assertLessEqual(rays["shadow"], shadow, name)


if __name__ == "__main__":
    if not COURSE.is_dir():
        leave("the course's files are missing (CLRT_COURSE names their folder)")
    main(2)
