#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that merged parts equal the whole picture, byte for byte, and that clrt merge rejects parts that
# do not fit together.
# Usage: test_parts.py CLRT
import os
import random
import zlib

from pictures import read_exr, read_exr_tiles, read_header
from work import ROOT, SCENE, SharedWork, main

SMALL = [SCENE, "-s", "61x43", "--tune", "tile=16x8"]
CHANNELS = ["--aov", "depth,normal,primitive,material,samples", "--tune", "bvh=sah"]


def part_of(column, row, parts):
    """Returns the number of a tile's part. The golden ratio shifts rows, so no part gets a whole column."""
    return (column - (row * 2654435769 % 2**32 * parts >> 32)) % parts


def flipped(data, place):
    """Returns the data with one bit flipped."""
    return data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :]


def damaged(data, start, end):
    """Returns the data with one flipped bit, so that the tile from start to end is undecodable."""
    for place in random.Random(start).sample(range(start + 20, end), end - start - 20):
        try:
            zlib.decompress(flipped(data, place)[start + 20 : end])
        except zlib.error:
            return flipped(data, place)


class Parts(SharedWork):
    def prepare(self):
        """Every EXR file costs half a second, so most tests share the picture and its three parts."""
        self.clrt(*SMALL, "-o", "small.exr")
        type(self).thirds = self.draw("third")

    def draw(self, name, *words, of=3, parts=None):
        """Draws the given parts or all parts. Returns the names of their files."""
        names = []
        for part in parts or range(1, of + 1):
            names.append(f"{name}{part}.exr")
            self.clrt(*(words or SMALL), "--part", f"{part}/{of}", "-o", names[-1])
        return names

    def expect_whole(self, names, *words):
        if words:
            self.clrt(*words, "-o", "whole.exr")
        self.clrt("merge", *names, "-o", "merged.exr")
        self.assert_same_bytes("merged.exr", "whole.exr" if words else "small.exr")

    def test_any_number_of_parts_makes_the_whole_in_any_order(self):
        self.expect_whole(self.draw("only", of=1))
        self.expect_whole(self.thirds[::-1])

    def test_compressed_tiles_are_copied(self):
        """Without --hash, clrt merge copies compressed tiles of the default size into EXR files."""
        for more in ([], ["--aov", "depth,primitive,boxtests", "--aa"], ["--crop", "30,20,290,190"],
                     ["--no-metadata"]):
            words, of = [SCENE, "-s", "300x200"], 3
            names = self.draw("copied", *words, *(more if "--no-metadata" not in more else []), of=of)
            self.clrt(*words, *more, "-o", "whole.exr")
            self.clrt("merge", *names, "-o", "merged.exr", *(more if "--no-metadata" in more else []))
            self.assert_same_bytes("merged.exr", "whole.exr", more)
            self.assertEqual(sum(len(list(read_exr_tiles(self.bytes_of(name)))) for name in names),
                             len(list(read_exr_tiles(self.bytes_of("whole.exr")))))
        self.clrt(*words, "-o", "whole.exr", SOURCE_DATE_EPOCH="86399")
        self.clrt("merge", *self.draw("copied", *words), "-o", "merged.exr", SOURCE_DATE_EPOCH="86399")
        self.assert_same_bytes("merged.exr", "whole.exr")

    def test_a_part_costs_its_own_size(self):
        """A part of 1/64 takes less than an eighth of the whole picture's memory and file size."""
        words = [SCENE, "-s", "2048x2048", "-q"]
        self.clrt(*words, "-o", "whole.exr")
        whole = self.peak_memory(*words, "-o", "whole.exr") - self.peak_memory(*words, "-s", "64x64", "-o", "a.exr")
        part = (self.peak_memory(*words, "--part", "1/64", "-o", "part.exr")
                - self.peak_memory(*words, "-s", "64x64", "-o", "a.exr"))
        self.assertLess(part, whole / 8)
        sizes = [(self.work / name).stat().st_size for name in ("part.exr", "whole.exr")]
        self.assertLess(sizes[0], sizes[1] / 8)

    def test_more_parts_than_tiles_make_the_whole(self):
        words = [SCENE, "-s", "20x9", "--tune", "tile=16x8"]
        self.expect_whole(self.draw("many", *words, of=5), *words)

    def test_the_whole_lists_each_device_of_its_parts_once(self):
        """The names of the second and third part's device are beginnings of the first one's name."""
        name = read_header(self.bytes_of(self.thirds[0]))[0]["clrt:device"]
        for part, length in (2, 5), (3, 3):
            short = name[:length].ljust(len(name), b"\0")
            self.write(**{f"device{part}_exr": self.bytes_of(self.thirds[part - 1]).replace(name, short)})
        self.clrt("merge", "device3.exr", self.thirds[0], "device2.exr", "-o", "devices.exr")
        found = read_header(self.bytes_of("devices.exr"))[0]["clrt:device"]
        self.assertEqual(found, b"; ".join([name[:3], name, name[:5]]))

    def test_tasks_of_an_array_draw_their_parts(self):
        for variable, first in ("SLURM_ARRAY_TASK_ID", 1), ("JOB_COMPLETION_INDEX", 0):
            for part in range(3):
                self.clrt(*SMALL, "--part", "auto/3", "-o", "auto.exr",
                          **{"SLURM_ARRAY_TASK_ID": None, variable: str(part + first)})
                self.assert_same_bytes("auto.exr", self.thirds[part])

    def test_parts_may_have_channels_crops_samples_and_fp64(self):
        for more in ([*CHANNELS, "--aa"], ["--crop", "5,3,50,40", "--precision", "fp64"], ["--aov", "certainty"]):
            self.expect_whole(self.draw("more", *SMALL, *more, of=2), *SMALL, *more)

    def test_parts_of_other_trees_and_kernels_make_the_same_file(self):
        scene = [str(ROOT / "scenes/cone.ply"), *SMALL[1:], "-q"]
        ways = ["--tune=bvh=sah"], ["--tune=bvh=midpoint,kernel=wide"], ["--tune=bvh=none,kernel=pair"]
        names = [self.draw("way", *scene, *way, parts=[part])[0] for part, way in enumerate(ways, 1)]
        self.expect_whole(names, *scene)

    def test_counts_of_tests_are_of_one_tree(self):
        scene = [str(ROOT / "scenes/cone.ply"), *SMALL[1:], "-q", "--aov", "boxtests", "--tune=kernel=packet,bvh=sah"]
        names = self.draw("count", *scene, of=2)
        self.expect_whole(names, *scene)
        for other in ["--tune", "bvh=midpoint"], ["--tune", "kernel=pair"]:
            mixed = [names[0], *self.draw("other", *scene, *other, of=2, parts=[2])]
            self.refuses_parts("other2.exr: has other settings than count1.exr", *mixed)

    def test_each_part_draws_its_tiles_alone(self):
        whole, rays = read_exr(self.work / "small.exr")[1], 0
        for part, name in enumerate(self.thirds):
            channels = read_exr(self.work / name)[1]
            for pixel in range(61 * 43):
                expected = whole["R"][pixel] if part_of(pixel % 61 // 16, pixel // 61 // 8, 3) == part else 0
                self.assertEqual(channels["R"][pixel], expected, (part, pixel))
            found = self.statistics(*SMALL, "--part", f"{part + 1}/3", "-o", "a.exr")
            self.expect(found, samples__per_pixel=1)
            rays += found["rays"]["camera"]
        self.assertEqual(rays, 61 * 43)

    def test_too_few_tiles_for_the_parts_are_noted(self):
        for words, advised in ((["-s", "1024x1024", "--part", "1/3"], 2), (["-s", "64x64", "--part", "2/2"], 1),
                               (["-s", "1024x1024", "--part", "1/2"], 0), (["-s", "64x64", "--part", "1/1"], 0),
                               (["-s", "64x64", "--part", "2/2", "-q"], 0)):
            note = ("clrt: a part of fewer than 128 tiles may take much longer than the others: for this "
                    f"picture, give at most N={advised}\n")
            done = self.run_clrt(SCENE, *words, "-o", "few.exr")
            self.assertEqual((done.returncode, done.stderr), (0, note if advised else ""), words)

    def test_the_whole_is_written_in_any_format(self):
        names = self.draw("srgb", *SMALL, "--encode", "srgb", of=2)
        for name in "a.png", "a.jpg":
            self.clrt(*SMALL, "--encode", "srgb", "-o", f"whole_{name}")
            self.clrt("merge", *names, "-o", f"merged_{name}")
            self.assert_same_bytes(f"whole_{name}", f"merged_{name}")

    def test_merge_prints_and_expects_the_hash_of_the_whole(self):
        right = self.clrt(*SMALL, "-o", "a.pfm", "--hash")
        self.assertEqual(self.clrt("merge", *self.thirds, "-o", "b.pfm", "--hash"), right)
        self.assert_same_bytes("a.pfm", "b.pfm")
        self.clrt("merge", *self.thirds, "-o", "b.pfm", "--hash=" + right.strip())
        self.clrt("merge", *self.thirds, "-o", "b.pfm", "--hash=" + 32 * "0", code=1)

    def test_merge_leaves_out_metadata_on_request(self):
        self.clrt("merge", *self.thirds, "-o", "a.exr", "--no-metadata")
        self.assertFalse([n for n in read_header(self.bytes_of("a.exr"))[0] if n.startswith("clrt:")])

    def refuses_parts(self, sentence, *words, name="m.exr"):
        done = self.run_clrt("merge", *words, "-o", name)
        self.assertEqual((done.returncode, done.stderr[: len(sentence) + 6]), (3, f"clrt: {sentence}"), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse((self.work / name).exists())

    def peak_memory(self, *words):
        """Returns the largest peak resident memory of clrt and its child processes, in KiB."""
        process = self.start(*words)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return usage.ru_maxrss

    def test_mixed_parts_are_refused_in_one_sentence(self):
        scene = (ROOT / "scenes/reflections.scn").read_text()
        scene = scene.replace("ply_file ", f"ply_file {ROOT}/scenes/")
        self.write(own_scn=scene + "\n", mesh_scn=scene.replace("plateau", "cube"))
        # The settings are compared as a whole. test_provenance.py tests what they contain.
        for words, of, thing in (
            (SMALL + ["--aa"], 3, "other settings"), (SMALL + ["--tune", "tile=8x16"], 3, "other settings"),
            (SMALL + ["--crop", "0,0,40,40"], 3, "other settings"), (SMALL, 2, "other settings"),
            (["own.scn", *SMALL[1:]], 3, "another scene"), (["mesh.scn", *SMALL[1:]], 3, "another mesh"),
            (SMALL + ["--aov", "depth"], 3, "other channels"),
        ):
            self.clrt(*words, "--part", f"2/{of}", "-o", "other.exr")
            self.refuses_parts(f"other.exr: has {thing} than third1.exr", self.thirds[0], "other.exr")
        self.refuses_parts("other.exr: has other channels than third1.exr", "no.exr", self.thirds[0], "other.exr")

    def test_missing_and_doubled_parts_are_refused(self):
        one, _, three = self.thirds
        self.refuses_parts("part 2 of 3 is missing", one, three)
        self.refuses_parts("parts 1,3 of 3 are missing: no.exr: cannot be read: No such file or directory",
                           "no.exr", self.thirds[1])
        self.refuses_parts(f"{one}: is part 1 of 3, as is {one}", one, one)

    def test_a_file_beside_all_parts_must_be_readable(self):
        self.write(empty_exr="")
        for name, cause in ("empty.exr", "it is not a tiled EXR file written by clrt"), ("no.exr", "No such file"), \
                (str(ROOT / "scenes/cube.ply"), "it is not a tiled EXR file written by clrt"):
            self.refuses_parts(f"{name}: cannot be read: {cause}", name, *self.thirds)
            self.refuses_parts(f"{name}: cannot be read: {cause}", *self.thirds, name)

    def test_files_that_are_no_parts_are_refused(self):
        self.clrt(*SMALL, "-o", "bare.exr", "--no-metadata")
        self.write(text_exr="no picture")
        self.refuses_parts("small.exr: is not a part drawn with --part", "small.exr")
        self.refuses_parts("bare.exr: is not a part drawn with --part", "bare.exr")
        self.refuses_parts("text.exr: cannot be read: it is not a tiled EXR file written by clrt", "text.exr")

    def test_damaged_parts_are_refused_with_their_number(self):
        names = self.draw("damaged", SCENE, "-s", "300x200", of=2)
        honest = self.bytes_of(names[1])
        table = read_header(honest)[1]
        tiles = [place for place in range(table, table + 8 * 20, 8) if honest[place : place + 8] != bytes(8)]
        starts = sorted(int.from_bytes(honest[place : place + 8], "little") for place in tiles)
        last = starts[-1]
        for bad in (*(damaged(honest, *ends) for ends in zip(starts, starts[1:] + [len(honest)])),
                    honest[:-1], honest[: last + 10],
                    honest[: tiles[0]] + bytes(8) + honest[tiles[0] + 8 :],
                    honest[: tiles[0]] + b"\xff" * 8 + honest[tiles[0] + 8 :],
                    honest[: last + 16] + b"\xff\xff\xff\x7f" + honest[last + 20 :]):
            self.write(bad_exr=bad)
            for name in "m.exr", "m.pfm":
                done = self.run_clrt("merge", names[0], "bad.exr", "-o", name)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertRegex(done.stderr, "clrt: bad.exr: part 2 of 2 cannot be used: it is damaged at pixel")
        self.write(bad_exr=flipped(honest, starts[0] + 16))  # the tile's size
        self.refuses_parts("bad.exr: part 2 of 2 cannot be used: it is damaged at pixel", names[0], "bad.exr")
        for end in range(0, table, 7):
            self.write(bad_exr=honest[:end])
            self.refuses_parts("bad.exr: cannot be read: it is not a tiled EXR file written by clrt", "bad.exr")

    def test_texts_that_lie_are_no_part(self):
        honest = self.bytes_of(self.thirds[0])
        for true, lie in ((b'"part":[1,3]', b'"part":[4,3]'), (b'"tile":[16,8]', b'"tile":[16,0]'),
                          (b'"width":61', b'"width":60'), (b'"part":[1,3]', b'"part":[1,"]'),
                          (b'"part":[1,3]', b'"part":[0,3]'), (b'"height":43', b'"height":-3')):
            self.assertIn(true, honest)
            self.write(lie_exr=honest.replace(true, lie))
            self.refuses_parts("lie.exr: is not a part drawn with --part", "lie.exr")

    def test_channels_need_a_file_that_holds_them(self):
        names = self.draw("channel", *SMALL, *CHANNELS, of=1)
        self.refuses(2, "the parts have channels, which the format png cannot store: give -o FILE.exr",
                     "merge", *names, "-o", "m.png")

    def test_options_that_exclude_parts_are_refused(self):
        for value in "0/3", "4/3", "1", "1/0", "a/3", "1/65537", "auto", "auto/0", "auto/65537", "auto3":
            self.refuses(2, f"--part wants I/N or auto/N, I from 1 to N and N up to 65536, not '{value}'",
                         *SMALL, "-o", "a.exr", "--part", value)
        for words, sentence in (
            (["-o", "a.png"], "--part needs an EXR file (-o FILE.exr), which clrt merge reads"),
            (["-o", "a.exr", "--error", "1%"], "--part and --error exclude each other"),
            (["-o", "a.exr", "--reference"], "--part and --reference exclude each other"),
            (["-o", "a.exr", "--no-metadata"], "--part and --no-metadata exclude each other"),
        ):
            self.refuses(2, sentence, *SMALL, "--part", "1/2", *words)
        self.refuses(5, "the picture has too many tiles of 1 x 2 for --part: give larger ones", SCENE, "-s",
                     "65536x65536", "--tune", "tile=1x2", "--part", "1/1", "-o", "a.exr")
        self.refuses(2, "clrt merge needs a file for the whole picture: give -o FILE", "merge", "a.exr")
        self.refuses(2, "a name is missing", "merge", "-o", "a.exr")


if __name__ == "__main__":
    main(1)
