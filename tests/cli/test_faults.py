#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests faults of the system: full or read-only disks, files that change during reading, and
# exhausted memory. clrt must print one message, exit with the documented status and leave no
# partial file. Usage: test_faults.py CLRT FORMATS FAIL_MEMORY FAIL_DEVICE SET_ENVIRONMENT [TEST...],
# with the libraries of tests/cli/fail_memory.c, fail_device.c and set_environment.c
import os
import random
import re
import subprocess
import sys
import threading
import time
import unittest

import bombs
from cache_work import PICTURE
from work import FORMATS, NO_OPENCL, ROOT, SCENE, Work, has_private_disks, main, needs_exr

FAIL_MEMORY, FAIL_DEVICE, SET_ENVIRONMENT = (os.path.abspath(word) for word in sys.argv[3:6])
# LARGE's picture does not fit on a disk of DISK_SIZE bytes in any format. Its --tune fixes the
# choice of kernels, which otherwise depends on the kernel cache.
LARGE = [SCENE, "-s", "400x300", "-q", "--tune=kernel=wide,specialize=never"]
DISK_SIZE = 8192


class Faults(Work):
    def setUp(self):
        super().setUp()
        self.target = self.work / "target"
        self.target.mkdir()

    # Runs clrt once without a fault, because runs that fail do not store the kernels that they compiled.
    def compile_kernels(self, *words):
        self.clrt(*words)
        for name in os.listdir(self.target):
            os.remove(self.target / name)

    # Runs clrt with a private disk at `target`, and then lists the disk's files.
    def clrt_on_disk(self, options, *words, **environment):
        script = 'mount -t tmpfs -o "$1" clrt-test target && shift && echo old >target/old && \
            { [ "$1" != ro ] || mount -o remount,ro target; } && shift && "$@"; code=$?; \
            ls -A target; exit $code'
        size, mode = options
        before = ["unshare", "-m", "sh", "-c", script, "sh", f"size={size}", mode]
        return self.run_clrt(*words, before=before, **environment)

    def assert_fails(self, run, status, sentence):
        text = run.stderr
        self.assertEqual(run.returncode, status, text)
        self.assertEqual(text.count("\n"), 1, text)
        self.assertRegex(text, "^clrt: " + sentence)


@unittest.skipUnless(has_private_disks(), "disks cannot be mounted here")
class Disks(Faults):
    def test_a_full_disk_is_reported_and_keeps_no_part_of_the_picture(self):
        for format in FORMATS:
            run = self.clrt_on_disk((DISK_SIZE, "rw"), *LARGE, "-o", f"target/a.{format}")
            self.assert_fails(run, 5, f"target/a.{format}: cannot be written: ")
            self.assertEqual(run.stdout, "old\n")

    def test_a_full_disk_keeps_the_picture_that_was_there(self):
        run = self.clrt_on_disk((DISK_SIZE, "rw"), *LARGE, "--format", "png", "-o", "target/old")
        self.assert_fails(run, 5, "target/old: cannot be written: No space left on device")
        self.assertEqual(run.stdout, "old\n")

    def test_a_full_disk_for_temporary_files_is_named(self):
        for output, name in ("-", "standard output"), ("/dev/null", "/dev/null"):
            words = [*LARGE, "--format", "pfm", "-o", output]
            run = self.clrt_on_disk((DISK_SIZE, "rw"), *words, TMPDIR=str(self.target))
            self.assert_fails(run, 5, f"{name}: cannot be written: No space left on device; "
                              f"the temporary file was in {self.target}\n")
            self.assertEqual(run.stdout, "old\n")

    def test_a_full_disk_keeps_no_part_of_a_report(self):
        words = [SCENE, "-s", "8x8", "-q", "-o", "a.pfm", "--json=target/a.json"]
        run = self.clrt_on_disk((os.sysconf("SC_PAGE_SIZE"), "rw"), *words)
        self.assert_fails(run, 5, "target/a.json: cannot be written: No space left on device")
        self.assertEqual(run.stdout, "old\n")

    def test_a_full_disk_for_the_journal_is_no_fault_of_the_scene(self):
        size = os.sysconf("SC_PAGE_SIZE")  # holds the file "old" alone
        words = [SCENE, "-s", "8x8", "-q", "--resume", "-o", "target/a.pfm"]
        self.assert_fails(self.clrt_on_disk((size, "rw"), *words), 5,
                          "target/a.pfm.part: cannot be written: No space left on device")

    def test_a_read_only_disk_is_reported_before_any_work(self):
        run = self.clrt_on_disk((DISK_SIZE, "ro"), "nowhere.scn", "-o", "target/a.png")
        self.assert_fails(run, 5, "target/a.png: cannot be written: Read-only file system")


class Outputs(Faults):
    def test_a_file_above_the_size_limit_is_reported_and_removed(self):
        # PoCL writes preprocessed kernels of slightly more than 1 MiB in each run.
        limit = ["prlimit", f"--fsize={5 << 18}"]
        large = [*LARGE, "-s", "800x600"]
        for format in {"pfm", "ppm"} & set(FORMATS):
            self.run_clrt(*large, "-o", "warm." + format)  # the limit also applies to compiled kernels
            run = self.run_clrt(*large, "-o", f"target/a.{format}", before=limit)
            self.assert_fails(run, 5, f"target/a.{format}: cannot be written: ")
            self.assertEqual(os.listdir(self.target), [])

    def test_a_journal_whose_name_is_too_long_is_no_fault_of_the_scene(self):
        name = "a" * 247 + ".pfm"
        self.assert_fails(self.run_clrt(SCENE, "-s", "8x8", "-q", "--resume", "-o", name), 5,
                          f"{name}.part: cannot be opened: File name too long")

    def test_a_folder_is_no_output(self):
        (self.target / "a.pfm").mkdir()
        for words in (["-o", "target/a.pfm"], ["-o", "a.png", "--reference=target/a.pfm"]):
            run = self.run_clrt("nowhere.scn", *words)
            self.assert_fails(run, 5, "target/a.pfm: cannot be written: it is a folder")


class Inputs(Faults):
    def test_a_mesh_that_changes_while_it_is_read_is_a_mesh_or_a_fault(self):
        mesh = self.work / "mesh.ply"
        whole = (ROOT / "scenes/models/creature.ply").read_bytes()
        mesh.write_bytes(whole)
        done = threading.Event()

        def change():
            while not done.is_set():
                for size in (0, len(whole) // 2, len(whole)):
                    with open(mesh, "r+b") as file:
                        file.truncate(size)
                        file.write(whole[:size])
                    time.sleep(random.random() / 1000)  # otherwise, a read may never see the whole mesh

        writer = threading.Thread(target=change)
        writer.start()
        try:
            runs = [self.run_clrt("check", "mesh.ply", **NO_OPENCL) for _ in range(40)]
        finally:
            done.set()
            writer.join()
        self.assertEqual({run.returncode for run in runs}, {0, 3})
        for run in runs:
            if run.returncode == 3:
                self.assert_fails(run, 3, "mesh.ply")


# Without limits, endless inputs and even some small inputs could take hours or all memory.
class Sizes(Faults):
    SECONDS, MEGABYTES = 10, 1000
    PICTURE = ["-s", "8x8", "-q", "-o", "a.pfm"]

    def within(self, *words, code=0, says="", **settings):
        status, text = self.run_within(self.SECONDS, self.MEGABYTES, *words, **settings)
        self.assertEqual(status, code, text)
        self.assertRegex(text, rf"^clrt: {re.escape(says)}.*\n$" if says else "^$")

    def test_names_are_found_in_constant_time(self):
        names = range(100000)
        self.write(
            a_scn="".join(f"define m{i} matte\nmaterial m{i}\nsphere {i} 0 0 1\n" for i in names) + "light 1 1 1 1\n"
        )
        self.within("a.scn", *self.PICTURE)
        self.within("convert", "a.scn", "b.scn")
        self.assertIn('define "m99999" matte', (self.work / "b.scn").read_text())

    def test_pipes_and_devices_end_at_a_limit(self):
        limit = "a pipe may hold at most 512 MiB"
        with open("/dev/zero", "rb") as zero:
            self.within("-", *self.PICTURE, code=3, says=f"standard input: {limit}", stdin=zero)
        os.mkfifo(self.work / "a.ply")
        self.write(a_scn="ply_file a.ply\n")
        # The shell keeps the pipe open until clrt ends.
        reader = ["sh", "-c", 'exec 3<>a.ply; cat /dev/zero >&3 & "$@"; code=$?; kill $!; exit $code', "sh"]
        self.within("a.scn", *self.PICTURE, code=3, says=f"a.scn:1:10: a.ply: {limit}", before=reader)

    def test_a_file_with_holes_is_refused(self):
        with open(self.work / "a.scn", "wb") as file:
            file.truncate(9 << 30)
        self.within(
            "a.scn", *self.PICTURE, code=3, says="a.scn: cannot be read: its bytes are missing from byte 0 on"
        )

    @needs_exr
    def test_few_bytes_hold_no_vast_picture(self):
        side = 8192
        self.write(a_png=bombs.png(side, side), a_exr=bombs.exr(side, side))
        words = f"cannot be read: {side} x {side} pixels of 3 channels"
        self.within("compare", "a.png", "a.png", code=3, says="a.png: " + words)
        self.within("compare", "a.exr", "a.exr", code=3, says="a.exr: cannot be read: it is too large")

    def test_texts_of_a_png_are_limited(self):
        self.write(a_png=bombs.png(8, 8, texts=1500))
        status, text = self.run_within(self.SECONDS, 200, "compare", "a.png", "a.png", "-q")
        self.assertEqual((status, text), (0, ""))

    def test_a_merge_takes_memory_only_after_it_has_found_all_tiles(self):
        settings = {"width": 16384, "height": 16384, "part": [1, 1], "tile": [4096, 4096]}
        self.write(a_exr=bombs.exr_part(settings))
        says = "a.exr: part 1 of 1 cannot be used: it is damaged at pixel 0,0"
        self.within("merge", "a.exr", "-o", "m.png", code=3, says=says)

    def test_a_header_of_many_attributes_is_refused(self):
        settings = {"width": 8, "height": 8, "part": [1, 1], "tile": [4, 4]}
        self.write(a_exr=bombs.exr_part(settings, attributes=200000))
        says = "a.exr: cannot be read: it is not a tiled EXR file"
        self.within("merge", "a.exr", "-o", "m.exr", code=3, says=says)

    def test_check_lists_many_findings(self):
        mesh = (
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n"
        )
        self.write(t_ply=mesh, a_scn="ply_file t.ply\n" * 60000)
        with open(self.work / "report", "w") as report:
            self.within("check", "a.scn", code=1, stdout=report)
        self.assertEqual((self.work / "report").read_text().count("FAULT"), 60000)


class Device(Faults):
    TILES = [SCENE, "-s", "64x48", "-q", "--tune=tile=16x16,kernel=wide,specialize=never"]

    def fail(self, name, call, *words):
        return self.run_clrt(*words, LD_PRELOAD=FAIL_DEVICE, CLRT_FAIL_NAME=name, CLRT_FAIL_CALL=str(call))

    def count_failures(self, name, sentence, *words):
        self.compile_kernels(*words)
        for call in range(1, 1000):
            run = self.fail(name, call, *words)
            if run.returncode == 0:
                return call - 1
            self.assert_fails(run, 4, sentence)
            self.assertEqual(os.listdir(self.target), [], call)
        return None

    def test_a_device_that_rounds_wrongly_is_refused_before_its_first_program(self):
        for macro, operation in (("fma(a, b, c) ((a) * (b) + (c))", "fma"), ("rint floor", "rint"),
                                 ("max min", "min and max")):
            name = macro.split("(")[0].split(" ")[0]
            lines = f"#undef {name}\n#define {macro}\n"
            run = self.run_clrt(*PICTURE, "-o", "target/a.pfm", LD_PRELOAD=FAIL_DEVICE, CLRT_FIRST_LINES=lines,
                                POCL_CACHE_DIR=str(self.work)) # an empty cache
            self.assert_fails(run, 4, f".* calculates wrongly, so clrt cannot use it: .* {operation} has the bits ")
            self.assertEqual(os.listdir(self.target), [])

    def test_every_failed_allocation_on_the_device_is_reported(self):
        sentence = r"cannot (allocate|upload) [\w' ]+: CL_MEM_OBJECT_ALLOCATION_FAILURE \(-4\)$"
        count = self.count_failures("clCreateBuffer", sentence, *self.TILES, "-o", "target/a.pfm")
        self.assertGreater(count, 5)

    def test_a_device_lost_at_any_tile_is_reported_and_leaves_no_picture(self):
        for name, sentence in (
            ("clEnqueueNDRangeKernel", r"cannot run .*: CL_OUT_OF_RESOURCES"),
            ("clWaitForEvents", r"cannot .*: CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST"),
        ):
            count = self.count_failures(name, sentence, *self.TILES, "-o", "target/a.pfm")
            self.assertGreaterEqual(count, 12)
            os.remove(self.target / "a.pfm")

    def test_tiles_drawn_before_a_device_is_lost_are_kept_for_resuming(self):
        words = [*self.TILES, "-o", "a.pfm", "--resume"]
        self.clrt(*self.TILES, "-o", "whole.pfm")
        self.assert_fails(self.fail("clWaitForEvents", 9, *words), 4, "cannot trace a tile: ")
        talk = self.run_clrt(*words[:3], *words[4:], "-v").stderr
        self.assertIn("resumed: 8 of 12 tiles were finished before", talk)
        self.assert_same_bytes("a.pfm", "whole.pfm")

    def test_all_frames_and_their_references_share_a_device(self):
        words = [SCENE, "-s", "8x8", "-q", "--frames", "1-3", "-o", "a.pfm", "--reference", "--reference-samples=2"]
        self.assertEqual(self.fail("clCreateContext", 2, *words).returncode, 0)
        self.assert_fails(self.fail("clCreateContext", 1, *words), 4, "cannot create an OpenCL context: ")

    def test_a_driver_may_change_the_environment_while_others_read_it(self):
        for _ in range(3):
            run = self.run_clrt(SCENE, "-s", "8x8", "-q", "-o", "a.pfm", LD_PRELOAD=SET_ENVIRONMENT)
            self.assertTrue(run.returncode == 0 and run.stderr == "", run.stderr)


class Memory(Faults):
    # Repeats runs in which allocation number `first` and all later allocations fail. Increases
    # `first` by growing steps until clrt succeeds. Returns the number of failed runs.
    def count_failures(self, *words):
        first, failures = 1, 0
        self.compile_kernels(*words)
        while True:
            run = self.run_clrt(*words, LD_PRELOAD=FAIL_MEMORY, CLRT_FAIL_MEMORY=str(first))
            if run.returncode == 0:
                return failures
            self.assertIn(run.returncode, (3, 4, 5), f"{first}: {run.stderr}")
            self.assert_fails(run, run.returncode, ".*out of memory")
            self.assertEqual(os.listdir(self.target), [])
            failures += 1
            first += 1 + first // 6

    def test_a_picture_that_is_too_large_names_the_remedies(self):
        limit = ["prlimit", f"--as={100 << 30}"]
        run = self.run_clrt(SCENE, "-s", "131072x131072", "-o", "target/a.pfm", before=limit)
        self.assert_fails(run, 3, "out of memory: the pixels need 206159 MB: give a smaller --size, or draw parts "
                          "of an EXR file with --part")

    def test_every_failed_allocation_is_reported(self):
        (self.work / "mesh.scn").write_text(
            f"ply_file {ROOT}/scenes/cone.ply\nlight 4 4 4 1\nmaterial 3\nsphere 0 0 0 1\n"
        )
        picture = ["mesh.scn", "-s", "8x8", "-q"]
        self.clrt(*picture, "-o", "a.pfm")
        refined = ["--aa-adaptive", "--reference", "--reference-samples=2"]
        self.assertGreater(self.count_failures(*picture, "-o", "target/a.png", *refined), 10)
        os.remove(self.target / "a.png")
        self.assertGreater(self.count_failures("explain", *picture, "3,3"), 10)
        self.assertGreater(self.count_failures("check", "mesh.scn"), 10)
        self.assertGreater(self.count_failures("compare", "a.pfm", "a.pfm"), 1)


if __name__ == "__main__":
    main(5)
