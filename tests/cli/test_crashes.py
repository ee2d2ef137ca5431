#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# If a driver crashes or ends the process, clrt prints one message and exits with status 4. The next
# run draws the picture. Usage: test_crashes.py CLRT CRASH_DEVICE [TEST...], with the library of
# tests/cli/crash_device.c
import itertools
import os
import pathlib
import platform
import shutil
import signal
import sys
import time
import unittest

from cache_work import PICTURE, CacheWork
from work import ROOT, main

CRASH_DEVICE = os.path.abspath(sys.argv[2])


class Crashes(CacheWork):
    def crash(self, kind):
        return self.run_picture(LD_PRELOAD=CRASH_DEVICE, CLRT_CRASH=kind)

    def test_a_driver_that_crashes_is_reported(self):
        crashes = itertools.product(("abort", "segv", "bus", "ill"), ("", "-thread", "-two"))
        for kind, place in (*crashes, ("fpe", "")):
            name = "SIG" + kind.upper().replace("ABORT", "ABRT")
            library = "libc.so.6" if kind == "abort" else CRASH_DEVICE.rpartition("/")[2]
            self.assert_told(self.crash(kind + place), rf"crashed in {library} \({name}\): ")
        self.assertEqual(self.draw(), self.expected)

    def test_a_crash_of_the_c_library_names_it_and_blames_no_driver(self):
        told = self.crash("libc")
        self.assert_told(told, r"crashed in libc.so.6 \(SIGSEGV\): run clrt again; ")
        self.assertNotIn("driver", told[1])

    @unittest.skipUnless(platform.machine() == "x86_64", "the crash is an instruction of x86-64")
    def test_a_crash_of_clrt_is_reported_and_ends_clrt_by_the_signal(self):
        told = "clrt: clrt itself crashed (SIGSEGV): please report it\n"
        self.assertEqual(self.crash("own"), (-signal.SIGSEGV, told, None))

    def test_an_abort_names_a_limit_or_a_missing_path_that_may_be_its_cause(self):
        abort = {"LD_PRELOAD": CRASH_DEVICE, "CLRT_CRASH": "abort"}
        limit = ["sh", "-c", 'ulimit -f 100000 && exec "$@"', "sh"]
        self.assert_told(self.run_picture(before=limit, **abort), r"crashed in libc.so.6 \(SIGABRT\): the limit on ")
        self.assert_told(self.run_picture(**abort, PATH=None), r"crashed in libc.so.6 \(SIGABRT\): PATH is not set")

    def test_a_driver_that_ends_the_program_is_reported(self):
        for kind in ("exit", "exit-thread"):
            self.assert_told(self.crash(kind), "a driver ended the program")
        self.assertEqual(self.draw(), self.expected)

    def test_a_limit_on_the_size_of_files_is_reported(self):
        for blocks in (100, 400):
            shutil.rmtree(self.cache / "clrt")
            limit = ["sh", "-c", f'ulimit -f {blocks} && exec "$@"', "sh"]
            status, talk, _ = self.run_picture(before=limit)
            self.assertEqual(status, 4, talk)
            self.assertEqual(talk.count("clrt: "), 1, talk)
            self.assertEqual(self.draw(), self.expected)

    def test_kernels_damaged_while_they_run_are_reported(self):
        running = self.start_clrt(*PICTURE, "-s", "2000x2000", "--aa=4", "-o", "large.pfm")
        maps = pathlib.Path(f"/proc/{running.pid}/maps")
        kernels = lambda: [path for path in self.cache.rglob("*.so") if str(path) in maps.read_text()]
        self.wait_for(kernels)
        for path in kernels():
            os.truncate(path, 0)
        talk = running.communicate()[1]
        self.assertEqual((running.returncode, talk.count("\n")), (4, 1), talk)
        self.assertEqual(self.draw(), self.expected)

    def test_a_signal_that_is_sent_is_no_crash(self):
        words = [*PICTURE, "-s", "4000x4000", "--aa=4", "-o", "/dev/null", "--format=pfm"]
        for number in (signal.SIGABRT, signal.SIGKILL):
            running = self.start_clrt(*words)
            time.sleep(0.3)
            running.send_signal(number)
            self.assertEqual(running.wait(), -number)

    def test_small_stacks_suffice(self):
        small = ["sh", "-c", 'ulimit -s 64 && exec "$@"', "sh"]
        shutil.rmtree(self.cache / "clrt")
        self.assertEqual(self.draw(before=small), self.expected)
        self.assertEqual(self.draw(*PICTURE[:4], before=small), self.expected)
        done = self.run_clrt("check", ROOT / "scenes/cone.ply", before=small, **self.environment())
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    main(2)
