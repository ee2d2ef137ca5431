#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests --reference: the errors that it measures, and the estimate of the reference's own error.
# Usage: test_reference.py CLRT FORMATS
from pictures import read_exr
from work import EVERY_FEATURE, SCENE, SharedWork, Work, main, needs_exr

SMALL = [SCENE, "-s", "96x72", "-o"]
# One triangle fills the picture, so colors change slowly. fp32 and fp64 differ only by rounding.
FLAT = """up 0 1 0
camera 0 0 5 0 0 0 10
ambient 0.7
light 0 0 900 0.37
define wall matte diffuse 0.31 0.77 0.93
material wall
ply_file wall.ply
"""
WALL = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
-90 -90 0
90 -90 0
0 90 0
3 0 1 2
"""
COLORED = [EVERY_FEATURE, "-s", "96x72", "-o", "a.exr"]


class Reference(SharedWork):
    def measure(self, *words, to="a.pfm"):
        """Returns the statistics of the reference."""
        return self.statistics(*SMALL, to, *words)["reference"]

    def prepare(self):
        done = self.run_clrt(*SMALL, "one.pfm", "--reference=one-reference.pfm", "--json=one.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        type(self).talk, type(self).one = done.stderr, self.json_of("one.json")["reference"]
        type(self).four = self.measure("--aa=4", "--reference")
        type(self).fine = self.measure("--aa=4", "--reference=fine.pfm", "--reference-samples", "2048")

    def compare(self, one, other):
        return self.report("compare", one, other, "--json")

    def test_the_error_is_reported_with_the_references_own(self):
        self.assertRegex(self.talk, "(?m)^RMSE .* largest difference .* 1/255: .* 4/255: ")
        self.assertRegex(self.talk, "(?m)^reference: for fp64, 256 samples a pixel, RMSE of the reference ")

    def test_the_picture_stays_as_it_is_without_a_reference(self):
        found = self.statistics(*SMALL, "plain.pfm", "-q")
        self.assertIsNone(found["reference"])
        self.assert_same_bytes("one.pfm", "plain.pfm")

    def test_the_error_is_the_difference_of_the_two_files(self):
        found = self.compare("one.pfm", "one-reference.pfm")
        self.assertAlmostEqual(self.one["rmse"], found["rmse"], delta=1e-12)
        self.assertAlmostEqual(self.one["maximum"], found["maximum"]["value"], delta=1e-12)
        for share in "off_by_1", "off_by_4":
            self.assertEqual(self.one[f"share_{share}"], found[share]["share"])

    def test_the_error_falls_as_samples_grow_and_the_reference_is_better(self):
        two = self.measure("--aa=2", "--reference=two-reference.pfm")
        self.assert_same_bytes("one-reference.pfm", "two-reference.pfm")
        self.assertTrue(self.one["rmse"] > 1.8 * two["rmse"] > 3 * self.four["rmse"] > 0)
        self.assertLess(self.four["own_error"], 0.4 * self.four["rmse"])

    def test_refined_pictures_are_measured_against_the_same_reference(self):
        held = self.measure("--error", "0.5%", "--reference")
        self.assertLess(held["rmse"], 0.0055)
        adaptive = self.measure("--aa-adaptive=0.01", "--reference=adaptive-reference.pfm")
        self.assert_same_bytes("one-reference.pfm", "adaptive-reference.pfm")
        self.assertLess(adaptive["rmse"], 0.3 * self.one["rmse"])

    def test_a_finer_reference_reports_the_same_error_and_less_of_its_own(self):
        self.assertEqual(self.fine["samples"], 2048)
        self.assertAlmostEqual(self.fine["rmse"] / self.four["rmse"], 1, delta=0.08)
        self.assertLess(self.fine["own_error"], 0.4 * self.four["own_error"])

    def test_its_reported_own_error_is_its_true_error(self):
        found = self.compare("one-reference.pfm", "fine.pfm")["rmse"]
        self.assertTrue(0.6 < found / self.one["own_error"] < 1.6, (found, self.one["own_error"]))

    def test_a_reference_has_the_rounding_of_fp64_although_most_samples_are_in_fp32(self):
        self.write(flat_scn=FLAT, wall_ply=WALL)
        for precision in "fp32", "fp64":
            self.clrt("flat.scn", "-q", "-s", "16x16", "-o", f"{precision}.pfm", "--precision", precision,
                      "--reference=flat.pfm")
        fp32, fp64 = (self.compare("flat.pfm", f"{precision}.pfm")["rmse"] for precision in ("fp32", "fp64"))
        self.assertTrue(0 < 4 * fp64 < fp32, (fp32, fp64))

    def test_another_grid_of_samples_agrees_within_the_error_of_both(self):
        self.clrt(*SMALL, "grid.pfm", "-q", "--aa=24", "--precision", "fp64")
        self.clrt("compare", "grid.pfm", "fine.pfm", "--fail", "rmse=0.0006")

    def test_bounces_left_out_are_an_error_that_is_seen(self):
        level = self.measure("--aa=4", "--max-level", "1", "--reference")
        self.assertGreater(level["rmse"], 3 * self.four["rmse"])

    def test_quiet_prints_nothing(self):
        done = self.run_clrt(*SMALL, "a.pfm", "-q", "--reference", "--reference-samples", "2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_references_file_and_ending_are_checked_before(self):
        self.clrt("none.scn", "-o", "a.pfm", "--reference=none/a.pfm", code=5)
        self.clrt("none.scn", "-o", "a.pfm", "--reference=a.nothing", code=2)


@needs_exr
class Channel(Work):
    def expect_errors(self, *words):
        """Compares the errors of all pixels with the statistics, and returns the channels."""
        found = self.statistics(*COLORED, *words)["reference"]
        types, channels = read_exr(self.work / "a.exr")
        errors = channels["error"]
        self.assertEqual(types["error"], "float")
        self.assertAlmostEqual(max(errors), found["maximum"], delta=1e-7)
        off = sum(error > 1 / 255 + 2**-22 for error in errors)
        self.assertEqual(off / len(errors), found["share_off_by_1"])
        return types, channels

    def test_an_exr_file_has_every_pixels_error(self):
        self.expect_errors("--reference")

    def test_aov_error_draws_a_reference(self):
        self.expect_errors("--aov", "error,depth")

    def test_errors_leave_other_channels_alone(self):
        types, channels = self.expect_errors("--aov", "primitive,depth", "--reference")
        self.assertEqual(types["primitive"], "uint")
        self.assertGreater(len(set(channels["primitive"])), 3)
        self.assertLess(max(channels["error"]), 1)


if __name__ == "__main__":
    main(2)
