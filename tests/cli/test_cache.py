#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests damaged, missing and full kernel caches: clrt draws the picture. Only if no folder has room,
# it exits with status 4 and one message.
# Usage: test_cache.py CLRT SHARED_DISK [TEST...]; SHARED_DISK is the library of tests/cli/shared_disk.c
import os
import random
import shutil
import socket
import sys
import unittest

from cache_work import PICTURE, CacheWork
from work import has_private_disks, main

OTHERS = [*PICTURE, "--precision=fp64"]


def flip(data):
    bits, places = bytearray(data), random.Random(1)
    for place in (places.randrange(8 * len(data)) for _ in range(100)):
        bits[place // 8] ^= 1 << place % 8
    return bytes(bits)


DAMAGES = {"zero": lambda data: b"", "half": lambda data: data[: len(data) // 2], "flip": flip}


class Damage(CacheWork):
    def assert_heals(self, note):
        with self.subTest(note):
            self.assertEqual(self.draw(), self.expected)
            compiled = self.kernels()
            self.assertEqual(self.draw(), self.expected)
            self.assertEqual(self.kernels(), compiled)

    def test_any_damaged_file_heals(self):
        files = [path for path in self.files() if path.stat().st_size]
        self.assertEqual(len(files), 3)  # the record of a build, its program and its machine code
        for path in files:
            whole = path.read_bytes()
            for kind, damage in DAMAGES.items():
                path.write_bytes(damage(whole))
                self.assert_heals(f"{kind} {path}")

    def test_all_files_damaged_at_once_heal(self):
        for path in filter(lambda path: path.stat().st_size, self.files()):
            path.write_bytes(flip(path.read_bytes()))
        self.assert_heals("all")

    def test_kernels_that_are_whole_stay(self):
        others = self.draw(*OTHERS)
        compiled = self.kernels()
        self.assertEqual(len(compiled), 2)
        next(self.cache.glob("clrt/pocl/*/*/program.bc")).write_bytes(b"")
        self.assertEqual(self.draw(), self.expected)
        self.assertEqual(self.draw(*OTHERS), others)
        self.assertEqual(sum(compiled[path] == made for path, made in self.kernels().items()), 1)

    def kill_while_compiling(self):
        shutil.rmtree(self.cache / "clrt")
        killed = self.start_clrt(*PICTURE, "-o", "killed.pfm")
        self.wait_for(lambda: any(self.cache.glob("clrt/pocl/??/*")))
        killed.kill()
        killed.wait()

    def test_files_of_an_interrupted_build_are_not_used(self):
        compiled = self.kernels()
        for path in compiled:
            path.write_bytes(flip(path.read_bytes()))
        for path in self.cache.glob("clrt/built-*"):
            path.unlink()
        self.assert_heals("damaged and without a manifest")
        self.kill_while_compiling()
        for path in filter(lambda path: path.stat().st_size, self.files()):
            path.write_bytes(flip(path.read_bytes()))
        self.assert_heals("killed while it compiled")

    def test_processes_that_start_at_once_all_draw_from_a_damaged_cache(self):
        for path in self.kernels():
            path.write_bytes(path.read_bytes()[:5000])
        names = [f"{i}.pfm" for i in range(4)]
        running = [self.start_clrt(*PICTURE, "-o", name) for name in names]
        self.assertEqual([process.wait() for process in running], [0] * 4)
        self.assertEqual({self.bytes_of(name) for name in names}, {self.expected})


class Places(CacheWork):
    def test_clrt_makes_a_folder_of_its_own_in_a_chosen_cache(self):
        chosen = self.work / "chosen"
        others = chosen / "AA" / ("B" * 37) / "program.bc"
        others.parent.mkdir(parents=True)
        others.write_text("another program's")
        before = self.kernels()
        self.assertEqual(self.draw(POCL_CACHE_DIR=str(chosen)), self.expected)
        kernel = next((chosen / "clrt").rglob("*.so"))
        kernel.write_bytes(flip(kernel.read_bytes()))
        self.assertEqual(self.draw(POCL_CACHE_DIR=str(chosen)), self.expected)
        self.assertEqual(others.read_text(), "another program's")
        self.assertEqual(self.kernels(), before)

    def test_clrt_draws_without_a_folder_for_kernels(self):
        shutil.rmtree(self.cache / "clrt/pocl")
        (self.cache / "clrt/pocl").write_text("")
        for cache in str(self.cache), "/proc":
            picture = self.draw(XDG_CACHE_HOME=cache, HOME="/proc", TMPDIR=str(self.work))
            self.assertEqual(picture, self.expected)
            self.assertEqual(list(self.work.glob("clrt-*")), [])


    def test_each_host_has_its_own_folder_on_a_shared_disk(self):
        shared = {"LD_PRELOAD": os.path.abspath(sys.argv[2]),
                  "ASAN_OPTIONS": "verify_asan_link_order=0:" + os.environ.get("ASAN_OPTIONS", "")}
        hosts, home = self.work / "hosts", self.work / "home"
        for folder, more in ((hosts, {"XDG_CACHE_HOME": str(hosts)}),
                             (home / ".cache", {"XDG_CACHE_HOME": None, "HOME": str(home)})):
            self.assertEqual(self.draw(**more, **shared), self.expected)
            self.assertEqual([path.name for path in folder.iterdir()], ["clrt-hosts"])
            self.assertTrue((folder / "clrt-hosts" / socket.gethostname() / "clrt/lock").exists())
            self.assertTrue(list(folder.rglob("*.so")))
        chosen = self.work / "chosen"
        self.assertEqual(self.draw(POCL_CACHE_DIR=str(chosen), **shared), self.expected)
        self.assertTrue((chosen / "clrt/lock").exists())


@unittest.skipUnless(has_private_disks(), "only root can mount disks")
class Disks(CacheWork):
    MOUNT = 'mount -t tmpfs -o size=700k clrt-test "$1" && cp -r "$2"/. "$1" && \
        { [ "$3" != ro ] || mount -o remount,ro "$1"; } && shift 3 && exec "$@"'

    def on_disk(self, mode, **more):
        disk = self.work / "disk"
        disk.mkdir(exist_ok=True)
        before = ["unshare", "-m", "sh", "-c", self.MOUNT, "sh", str(disk), str(self.cache), mode]
        more = {"XDG_CACHE_HOME": str(disk), "HOME": "/proc", "TMPDIR": str(self.work), **more}
        done = self.run_picture(before=before, **more)
        self.assertEqual(list(self.work.glob("clrt-*")), [])
        return done

    def test_clrt_draws_with_a_cache_on_a_full_or_read_only_disk(self):
        for mode in ("rw", "ro"):
            self.assertEqual(self.on_disk(mode), (0, "", self.expected))

    def test_no_room_anywhere_is_reported(self):
        for mode in ("rw", "ro"):
            done = self.on_disk(mode, TMPDIR=str(self.work / "disk"))
            self.assert_told(done, "no OpenCL device was found: .* 16 MB of free space")


if __name__ == "__main__":
    main(2)
