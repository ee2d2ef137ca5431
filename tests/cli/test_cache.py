#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that clrt draws the picture with damaged, missing and full kernel caches. If no folder has
# room, clrt must exit with status 4 and one message.
# Usage: test_cache.py CLRT NO_LOCKS [TEST...], with the library of tests/cli/no_locks.c
import shutil
import socket
import sys
import unittest

from cache_work import PICTURE, CacheWork
from work import has_private_disks, main, preload

NO_LOCKS = preload(sys.argv[2])


class Damage(CacheWork):
    def assert_heals(self, note):
        with self.subTest(note):
            self.assertEqual(self.draw(), self.expected)
            compiled = self.programs()
            self.assertEqual(self.draw(), self.expected)
            self.assertEqual(self.programs(), compiled)

    # test_cache_files.c tests that clrt reads no damaged file of any kind.
    def test_damage_heals(self):
        (path,) = self.programs()
        whole = path.read_bytes()
        damaged = whole[:-9] + bytes([whole[-9] ^ 1]) + whole[-8:]
        path.write_bytes(damaged)
        self.assert_heals("a flipped bit")
        self.assertNotEqual(path.read_bytes(), damaged)

    def test_a_killed_process_leaves_a_private_folder_that_the_next_one_removes(self):
        shutil.rmtree(self.cache / "clrt")
        killed = self.start_clrt(*PICTURE, "-o", "killed.pfm")
        self.wait_for(lambda: any(self.cache.glob("clrt/clrt-*/??/*")))
        killed.kill()
        killed.wait()
        self.assertEqual(len(self.private_folders()), 1)
        self.assert_heals("killed while it compiled")
        self.assertEqual(self.private_folders(), [])

    # On network file systems, a process cannot remove a folder that contains its open files, such as kernels.
    def test_the_rest_of_a_private_folder_is_removed_by_the_next_process(self):
        left = self.cache / "clrt" / f"clrt-{socket.gethostname()}-abcdef" / "IP" / "render_tile"
        others = self.cache / "clrt" / "clrt-another.host-abcdef" / "IP"
        left.mkdir(parents=True)
        others.mkdir(parents=True)
        self.assertEqual(self.draw(), self.expected)
        self.assertEqual(self.private_folders(), [others.parent])

    def test_a_running_process_keeps_its_private_folder(self):
        running = self.start_clrt(*PICTURE, "--aa=60", "-s", "800x600", "-o", "long.pfm")
        self.wait_for(lambda: any(self.cache.glob("clrt/clrt-*/**/*.so")))  # the kernels are loaded
        kept = self.private_folders()
        self.assertEqual(self.draw(), self.expected)
        self.assertEqual(self.private_folders(), kept)
        running.terminate()
        running.communicate()
        self.assertEqual(self.private_folders(), [])

    def test_eight_processes_that_start_at_once_draw_from_an_empty_cache(self):
        shutil.rmtree(self.cache / "clrt")
        names = [f"{i}.pfm" for i in range(8)]
        running = [self.start_clrt(*PICTURE, "-o", name) for name in names]
        self.assertEqual([process.communicate()[1] for process in running], [""] * 8)
        self.assertEqual({self.bytes_of(name) for name in names}, {self.expected})
        self.assertEqual([path.suffix for path in self.files()], [".bin"])

    def test_a_cache_on_a_disk_without_locks_stores_kernels(self):
        shutil.rmtree(self.cache / "clrt")
        (self.work / "tmp").mkdir()
        settings = {**NO_LOCKS, "CLRT_NO_LOCKS": f"{self.cache}/", "TMPDIR": str(self.work / "tmp")}
        self.assertEqual(self.draw(**settings), self.expected)
        self.assertEqual([path.suffix for path in self.files()], [".bin"])
        self.assertEqual(list((self.work / "tmp").iterdir()), [])
        compiled = self.programs()
        self.assertEqual(self.draw(**settings), self.expected)
        self.assertEqual(self.programs(), compiled)


class Places(CacheWork):
    def test_clrt_makes_a_folder_of_its_own_in_a_chosen_cache(self):
        chosen = self.work / "chosen"
        others = chosen / "AA" / ("B" * 37) / "program.bc"
        others.parent.mkdir(parents=True)
        others.write_text("another program's")
        before = self.programs()
        self.assertEqual(self.draw(POCL_CACHE_DIR=str(chosen)), self.expected)
        self.assertEqual(len(list((chosen / "clrt").glob("*.bin"))), 1)
        self.assertEqual(others.read_text(), "another program's")
        self.assertEqual(self.programs(), before)

    def test_settings_of_pocl_that_change_the_code_have_programs_of_their_own(self):
        self.assertEqual(self.draw(POCL_KERNELLIB_NAME="sse2"), self.expected)
        self.assertEqual(len(self.programs()), 2)
        self.assertEqual(self.draw(POCL_MAX_PTHREAD_COUNT="1"), self.expected)
        self.assertEqual(len(self.programs()), 2)

    def test_clrt_draws_without_a_folder_for_kernels(self):
        (self.work / "file").write_text("")
        for cache in str(self.work / "file"), "/proc":
            picture = self.draw(XDG_CACHE_HOME=cache, HOME="/proc", TMPDIR=str(self.work))
            self.assertEqual(picture, self.expected)
            self.assertEqual(list(self.work.glob("clrt-*")), [])

    def test_warm_reports_a_missing_folder(self):
        done = self.run_clrt("warm", "-q", "--tune=kernel=pair",
                             **self.environment(XDG_CACHE_HOME="/proc", HOME="/proc"))
        self.assertEqual(done.returncode, 5)
        self.assertEqual(done.stderr, "clrt: no folder can store the compiled kernels: set POCL_CACHE_DIR\n")


@unittest.skipUnless(has_private_disks(), "only root can mount disks")
class Disks(CacheWork):
    MODES = ("size=700k", "size=700k,ro", "size=64m,noexec")
    MOUNT = 'mount -t tmpfs -o "$3,rw" clrt-test "$1" && cp -r "$2"/. "$1" && mount -o "remount,$3" "$1" && \
        shift 3 && exec "$@"'

    def disk(self, mode):
        """Returns a command that mounts a disk with a copy of the cache, and the environment for clrt."""
        disk = self.work / "disk"
        disk.mkdir(exist_ok=True)
        before = ["unshare", "-m", "sh", "-c", self.MOUNT, "sh", str(disk), str(self.cache), mode]
        return before, self.environment(XDG_CACHE_HOME=str(disk), HOME="/proc", TMPDIR=str(self.work))

    def on_disk(self, mode, **more):
        before, environment = self.disk(mode)
        done = self.run_picture(before=before, **{**environment, **more})
        self.assertEqual(list(self.work.glob("clrt-*")), [])
        return done

    def test_clrt_draws_with_a_cache_on_a_disk_that_pocl_cannot_use(self):
        for mode in self.MODES:
            self.assertEqual(self.on_disk(mode), (0, "", self.expected))

    def test_warm_reports_new_kernels_that_it_cannot_store(self):
        before, environment = self.disk("size=700k,ro")
        done = self.run_clrt("warm", *PICTURE[:1], *PICTURE[3:], before=before, **environment)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = self.run_clrt("warm", "-q", "--tune=kernel=pair", before=before, **environment)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (5, 1), done.stderr)
        self.assertRegex(done.stderr, "^clrt: .*disk/clrt: the compiled kernels cannot be stored")

    def test_no_room_anywhere_is_reported(self):
        for mode in self.MODES:
            done = self.on_disk(mode, TMPDIR=str(self.work / "disk"))
            self.assert_told(done, "no OpenCL device was found: .* 16 MB of free space")


if __name__ == "__main__":
    main(2)
