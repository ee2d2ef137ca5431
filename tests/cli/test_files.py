#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests picture files: their pixels, identical bytes of identical runs, channels, and output to devices.
# Usage: test_files.py CLRT FORMATS
import math
import unittest

from pictures import read_exr, read_pfm, read_png, read_png_chunks
from work import FORMATS, HAS_EXR, ROOT, SCENE, SharedWork, main, needs_exr

SMALL = [SCENE, "-s", "48x32", "-o"]
SIMPLE = str(ROOT / "scenes/simple.scn")
FULL = "/dev/full: cannot be written: No space left on device"
NAMES = "R G B Z N.X N.Y N.Z P.X P.Y P.Z primitive material shadow bounces samples boxtests tritests"
CHANNELS = "depth,normal,position,primitive,material,shadow,bounces,samples,boxtests,tritests"
NOTHING = 2**32 - 1


def srgb(value):
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


class Files(SharedWork):
    def prepare(self):
        for name in "plain.pfm", "plain.png":
            self.clrt(*SMALL, name)

    def expect_png(self, png, pfm, encode=float):
        expected = [[int(encode(value) * 255 + 0.5) for value in row] for row in read_pfm(self.work / pfm)]
        self.assertTrue(read_png(self.bytes_of(png)) == expected, png)

    def test_png_holds_the_picture_in_either_encoding(self):
        self.expect_png("plain.png", "plain.pfm")
        self.clrt(*SMALL, "srgb.png", "--encode", "srgb")
        self.expect_png("srgb.png", "plain.pfm", srgb)

    def test_exposure_multiplies_colors_of_8_bit_files_alone(self):
        for stops in "1", "-1.5":
            self.clrt(*SMALL, "bright.png", "--exposure", stops, "--encode", "srgb")
            self.expect_png("bright.png", "plain.pfm", lambda value: srgb(min(1, value * 2 ** float(stops))))
        self.assertEqual(self.clrt(*SMALL, "bright.png", "--exposure", "2", "--hash"),
                         self.clrt(*SMALL, "plain.png", "--hash"))
        self.refuses(2, "--exposure is for 8-bit files: pfm holds the traced colors",
                     *SMALL, "bright.pfm", "--exposure", "1")
        self.refuses(2, "--exposure wants stops between -8 and 8, not '9'", *SMALL, "a.png", "--exposure", "9")

    def test_png_of_one_pixel_and_of_many_chunks_hold_the_picture(self):
        for name, words in (("one", ["-s", "1x1"]), ("many", ["-s", "801x603", "--aa"])):
            for ending in "png", "pfm":
                self.clrt(SCENE, *words, "-o", f"{name}.{ending}")
            self.expect_png(f"{name}.png", f"{name}.pfm")
        kinds = [kind for kind, _ in read_png_chunks(self.bytes_of("many.png"))]
        self.assertGreater(kinds.count(b"IDAT"), 1)

    def test_the_format_is_that_of_the_ending_unless_it_is_given(self):
        self.assertEqual(self.run_clrt(*SMALL, "-", content=b"").stdout, self.bytes_of("plain.png"))
        self.clrt(*SMALL, "odd.bin", "--format", "png")
        self.assert_same_bytes("odd.bin", "plain.png")

    def test_each_format_is_the_same_file_each_time(self):
        for ending in FORMATS:
            for name in "a", "b":
                self.clrt(*SMALL, f"{name}.{ending}")
            self.assert_same_bytes(f"a.{ending}", f"b.{ending}")

    def test_devices_take_pictures_or_are_full(self):
        words = [SCENE, "-s", "8x8", "-o"]
        self.clrt(*words, "/dev/null", "--format", "png")
        for ending in FORMATS[:1] + FORMATS[-1:]:
            self.refuses(5, FULL, *words, "/dev/full", "--format", ending)
        for ending in FORMATS[1:-1]:
            self.clrt(*words, "/dev/full", "--format", ending, code=5)

    @unittest.skipUnless(HAS_EXR, "this build is without OpenImageIO")
    def test_pictures_too_large_for_the_process_beside_are_whole(self):
        self.clrt(SIMPLE, "-s", "2400x2400", "-o", "large.tif", "--format", "hdr")
        self.assertIn(b"-Y 2400 +X 2400", self.bytes_of("large.tif")[:400])
        self.clrt(SIMPLE, "-s", "1600x1600", "-o", "large.exr", "--aov", "primitive,normal,position")
        channels = read_exr(self.work / "large.exr", 1590)[1]
        self.assertGreater(len(set(channels["primitive"])), 1)
        self.assertEqual(len(channels["P.Z"]) % 1600, 0)

    @needs_exr
    def test_encodings_leave_floats_alone(self):
        self.clrt(*SMALL, "raw.exr", "--encode", "raw")
        self.clrt(*SMALL, "plain.exr")
        self.assertEqual(read_exr(self.work / "raw.exr"), read_exr(self.work / "plain.exr"))
        self.refuses(2, "--encode srgb is for 8-bit files: exr holds the traced colors", *SMALL, "a.exr",
                     "--encode", "srgb")

    @needs_exr
    def test_a_picture_past_the_size_of_its_format_is_refused_before_it_is_drawn(self):
        jpg, gif = (f"a picture in the format {name} has at most {most} pixels a side"
                    for name, most in (("jpg", 65500), ("gif", 65535)))
        for size in "65536x1", "1x65536":
            words = SCENE, "-s", size
            self.refuses(5, jpg, *words, "-o", "a.jpg")
            self.refuses(5, gif, *words, "-o", "a.gif", "--turntable", "2")
            self.refuses(5, jpg, *words, "-o", "a.pfm", "--reference=a.jpg")
            self.refuses(5, gif, *words, "-o", "a.pfm", "--reference=a.gif")
        self.assertEqual(list(self.work.glob("a.*")), [])
        self.clrt(SCENE, "-s", "65536x1", "-o", "a.pfm")
        self.refuses(5, jpg, "compare", "a.pfm", "a.pfm", "-q", "-o", "a.jpg")
        self.clrt(SCENE, "-s", "65535x1", "--turntable", "2", "-o", "a.gif")
        self.assertEqual(self.bytes_of("a.gif")[6:10], bytes([255, 255, 1, 0]))


@needs_exr
class Channels(SharedWork):
    def prepare(self):
        self.clrt(*SMALL, "all.exr", "--aa", "--tune", "bvh=sah", "--aov", CHANNELS)
        type(self).types, type(self).all = read_exr(self.work / "all.exr")

    def draw(self, *words):
        self.clrt(*SMALL, "a.exr", *words)
        return read_exr(self.work / "a.exr")[1]

    def test_names_follow_conventions_and_only_names_of_things_are_integers(self):
        self.assertEqual(sorted(self.types), sorted(NAMES.split()))
        integers = {name for name, kind in self.types.items() if kind == "uint"}
        self.assertEqual(integers, {"primitive", "material"})

    def test_every_channel_has_an_effect(self):
        for name, values in self.all.items():
            self.assertEqual(len(set(values)) > 1, name != "samples", name)
        self.assertEqual(set(self.all["samples"]), {4})

    def test_the_background_is_infinitely_far_and_otherwise_zero(self):
        first = {name: values[0] for name, values in self.all.items()}
        self.assertEqual((first["Z"], first["primitive"], first["material"]), (math.inf, NOTHING, NOTHING))
        for name in "N.X N.Y N.Z P.X P.Y P.Z shadow bounces".split():
            self.assertEqual(first[name], 0, name)

    def test_channels_are_of_one_sample_with_any_aa(self):
        single = self.draw("--aov", "depth,primitive,normal")
        self.assertTrue(all(single[name] == self.all[name] for name in ("Z", "primitive", "N.X")))

    def test_adaptive_samples_are_counted_pixel_by_pixel(self):
        samples = self.draw("--tune=kernel=pair", "--aa-adaptive", "--aov", "samples", "--json=a.json")["samples"]
        self.assertLessEqual({1, 9}, set(samples))
        self.expect(self.json_of("a.json"), samples__total=sum(samples))

    def test_refusals(self):
        self.refuses(2, "--aov boxtests,tritests and --aa-adaptive exclude each other",
                     SCENE, "-o", "a.exr", "--aa-adaptive", "--aov", "tritests")
        self.refuses(2, "--aov needs an EXR file (-o FILE.exr): png holds colors alone",
                     SCENE, "-o", "a.png", "--aov", "depth")


if __name__ == "__main__":
    main(2)
