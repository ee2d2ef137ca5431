#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests the metadata in a picture's file and the options for the hash of its pixels.
# Usage: test_provenance.py CLRT FORMATS
import json
import os
import shutil
import struct

from pictures import read_header, read_png_texts
from work import HAS_EXR, ROOT, SCENE, Work, main, needs_exr

SMALL = [SCENE, "-s", "24x16"]
NAMES = ["Software", "clrt:version", "clrt:scene_hash", "clrt:mesh_hash", "clrt:settings", "clrt:device",
         "clrt:driver", "clrt:pixel_hash", "clrt:complete"]


def exr_texts(data):
    return {name: value.decode(errors="replace") for name, value in read_header(data)[0].items()}


def tiff_description(data):
    """Returns the text of tag 270 in the first directory of a little-endian TIFF file."""
    assert data[:4] == b"II*\0"
    (place,) = struct.unpack_from("<I", data, 4)
    (entries,) = struct.unpack_from("<H", data, place)
    for entry in range(entries):
        tag, kind, size, start = struct.unpack_from("<HHII", data, place + 2 + 12 * entry)
        if tag == 270:
            assert kind == 2
            return data[start : start + size - 1].decode()
    return ""


def jpeg_comment(data):
    place = 2
    while data[place + 1] != 0xDA:  # the start of the pixels
        (size,) = struct.unpack_from(">H", data, place + 2)
        if data[place + 1] == 0xFE:
            return data[place + 4 : place + 2 + size].rstrip(b"\0").decode()
        place += 2 + size
    return ""


DESCRIPTIONS = {"tif": tiff_description, "jpg": jpeg_comment} if HAS_EXR else {}


class Provenance(Work):
    def draw(self, *words, name="a.png", **environment):
        self.clrt(*(words or SMALL), "-o", name, **environment)
        return read_png_texts(self.bytes_of(name))

    def test_every_name_is_there_and_says_something(self):
        texts = self.draw()
        self.assertEqual(list(texts), NAMES)
        self.assertTrue(all(texts.values()), texts)
        self.assertEqual(texts["clrt:complete"], "yes")
        self.assertIn(texts["clrt:version"], texts["Software"])

    @needs_exr
    def test_exr_has_the_metadata_of_png(self):
        self.clrt(*SMALL, "-o", "a.exr", "--precision", "fp64")
        texts, expected = exr_texts(self.bytes_of("a.exr")), self.draw(*SMALL, "--precision", "fp64")
        # EXR files have no pixel hash, because clrt merge copies compressed tiles without decoding
        # them.
        del expected["clrt:pixel_hash"]
        self.assertEqual({name: texts[name] for name in NAMES if name in texts}, expected)
        self.assertNotIn("capDate", texts)

    def test_the_description_of_tiff_and_jpeg_has_the_metadata_of_png(self):
        expected = self.draw(*SMALL, "--aa=3")
        for ending, description in DESCRIPTIONS.items():
            name = f"a.{ending}"
            self.clrt(*SMALL, "--aa=3", "-o", name)
            lines = description(self.bytes_of(name)).splitlines()
            self.assertEqual([line.split("=", 1) for line in lines],
                             [[key, value] for key, value in expected.items() if ":" in key])
            self.assertIn(expected["Software"].encode(), self.bytes_of(name))

    def test_settings_are_json_of_what_the_picture_depends_on(self):
        settings = json.loads(self.draw(*SMALL, "--aa=3", "--view", "2", "--tune", "tile=8x8")["clrt:settings"])
        self.assertEqual(settings, {"view": 2, "width": 24, "height": 16, "samples": 3, "max_level": 3,
                                    "encode": "raw", "precision": "fp32"})
        settings = json.loads(self.draw(*SMALL, "--aa-adaptive=0.1")["clrt:settings"])
        self.assertEqual((settings["samples"], settings["contrast"]), ("adaptive", 0.1))
        settings = json.loads(self.draw(*SMALL, "--error", "5%")["clrt:settings"])
        self.assertEqual((settings["samples"], settings["error"]), ("adaptive", 0.05))

    def test_options_that_change_no_bit_change_no_byte_of_the_file(self):
        first = self.draw()
        for words in (["--tune", "tile=5x7"], ["-j", "1"], ["--tune", "bvh=midpoint"], ["--tune", "kernel=wide"]):
            self.assertEqual(self.draw(*SMALL, *words, name="b.png"), first)
            self.assert_same_bytes("a.png", "b.png")

    def test_the_scene_hash_follows_every_file_and_the_mesh_hash_the_meshes(self):
        shutil.copy(ROOT / "scenes/cube.ply", self.work / "cube.ply")
        scene = self.work / "own.scn"
        scene.write_text("light 0 0 9 1\nmaterial 1\nply_file cube.ply\n")
        words = ["own.scn", "-s", "8x8"]
        before = self.draw(*words)
        scene.write_text("light 0 0 9 1\nmaterial 2\nply_file cube.ply\n")
        other_scene = self.draw(*words)
        self.assertNotEqual(before["clrt:scene_hash"], other_scene["clrt:scene_hash"])
        self.assertEqual(before["clrt:mesh_hash"], other_scene["clrt:mesh_hash"])
        shutil.copy(ROOT / "scenes/cone.ply", self.work / "cube.ply")
        other_mesh = self.draw(*words)
        self.assertNotEqual(other_scene["clrt:scene_hash"], other_mesh["clrt:scene_hash"])
        self.assertNotEqual(other_scene["clrt:mesh_hash"], other_mesh["clrt:mesh_hash"])
        scene.write_text("sphere 0 0 0 1\n")
        self.assertEqual(self.draw(*words)["clrt:mesh_hash"], 32 * "0")

    def test_pictures_are_dated_by_source_date_epoch_alone(self):
        self.assertNotIn("DateTime", self.draw())
        self.assertEqual(self.draw(SOURCE_DATE_EPOCH="86399")["DateTime"], "1970:01:01 23:59:59")
        if HAS_EXR:
            self.clrt(*SMALL, "-o", "a.exr", SOURCE_DATE_EPOCH="951782400")
            self.assertIn("2000:02:29 00:00:00", exr_texts(self.bytes_of("a.exr"))["capDate"])
        for wrong in "soon", "-1", "":
            self.refuses(2, f"SOURCE_DATE_EPOCH must be seconds since 1970, not '{wrong}'",
                         *SMALL, "-o", "b.png", SOURCE_DATE_EPOCH=wrong)

    def test_no_metadata_leaves_out_all_metadata(self):
        environment = {"SOURCE_DATE_EPOCH": "0"}
        self.assertEqual(self.draw(*SMALL, "--no-metadata", **environment), {})
        for ending in ["exr", *DESCRIPTIONS] if HAS_EXR else []:
            self.clrt(*SMALL, "-o", f"a.{ending}", "--no-metadata", **environment)
            data = self.bytes_of(f"a.{ending}")
            told = [name for name in [*NAMES, "1970:01:01", "clrt", "OpenImageIO"] if name.encode() in data]
            self.assertEqual(told, [], ending)

    def test_the_hash_is_that_of_the_pixels_whatever_the_file(self):
        texts = self.draw(*SMALL, "--json=a.json")
        found = {texts["clrt:pixel_hash"], self.json_of("a.json")["pixel_hash"]}
        for words in (["-o", "b.pfm"], ["-o", "b.png", "--encode", "srgb"], ["-o", "b.png", "-j", "1"]):
            done = self.run_clrt(*SMALL, *words, "--hash")
            self.assertEqual((done.stderr, done.returncode), ("", 0))
            found.add(done.stdout.removesuffix("\n"))
        self.assertEqual(len(found), 1, found)
        other = self.clrt(*SMALL, "-o", "b.pfm", "--hash", "--aa").removesuffix("\n")
        self.assertNotIn(other, found)

    def test_another_hash_than_expected_is_exit_1_and_the_picture_is_there(self):
        right = self.clrt(*SMALL, "-o", "a.pfm", "--hash").removesuffix("\n")
        for same in right, right.upper():
            self.clrt(*SMALL, "-o", "a.pfm", "--hash=" + same)
        wrong = right[:-1] + ("1" if right[-1] == "0" else "0")
        self.refuses(1, f"the hash of the pixels is {right}, not the expected {wrong}",
                     *SMALL, "-o", "b.pfm", "--hash=" + wrong)
        self.assert_same_bytes("a.pfm", "b.pfm")
        self.refuses(2, "--hash= wants 32 hexadecimal digits, not 'abc'",
                     *SMALL, "-o", "b.pfm", "--hash=abc")

    def test_one_thing_at_most_goes_to_standard_output(self):
        for words, thing in ((["-o", "-"], "picture"), (["-o", "a.pfm", "--json=-"], "statistics")):
            self.refuses(2, f"the hash goes to standard output: write the {thing} to a file", *SMALL, *words, "--hash")

    def test_json_replaces_a_file_whole_or_not_at_all(self):
        self.write(a_json="what was there")
        (self.work / "other.json").hardlink_to(self.work / "a.json")
        self.clrt(*SMALL, "-o", "a.pfm", "--json=a.json")
        self.assertEqual(self.bytes_of("other.json"), b"what was there")
        self.assertEqual(self.json_of("a.json")["schema"], 1)
        self.assertEqual(sorted(os.listdir(self.work)), ["a.json", "a.pfm", "other.json"])


if __name__ == "__main__":
    main(2)
