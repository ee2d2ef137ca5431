#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests runs that are killed or stopped at any moment and then resumed. The final file must equal the file of an
# uninterrupted run. Only an EXR file that is marked incomplete may be incomplete under its final name.
# Usage: [CLRT_KILLS=N] [CLRT_SEED=N] test_resume.py CLRT FORMATS [TEST...]
import ctypes
import fcntl
import json
import os
import random
import shutil
import signal
import sys
import time
from pathlib import Path

from pictures import read_exr, read_header
from work import HAS_EXR, SCENE, Work, main, needs_exr

KILLS, SEED = (int(os.environ.get(f"CLRT_{name}", default)) for name, default in (("KILLS", 10), ("SEED", 1)))
NAME = "a.exr" if HAS_EXR else "a.pfm"
# LONG has many small tiles and takes some seconds. ONE_TILE has one tile and takes much longer.
WIDTH, HEIGHT, TILE = 400, 300, 20
TILES = WIDTH // TILE * HEIGHT // TILE
LONG = [SCENE, "-s", f"{WIDTH}x{HEIGHT}", "--aa=6", "--tune", f"tile={TILE}x{TILE}", "-j", "1"]
ONE_TILE = [SCENE, "-s", "2000x2000", "--aa=16", "--tune", "tile=2000x2000,specialize=never", "-j", "1"]
SMALL = [SCENE, "-s", "61x43", "--tune", "tile=16x8"]
OTHER = "belongs to another scene, other settings or another version of clrt: remove it to begin again"


class Resume(Work):
    pictures = {}  # bytes of uninterrupted runs' files

    def setUp(self):
        super().setUp()
        self.journal = self.work / f"{NAME}.part"

    def whole(self, *words):
        """Returns the bytes of an uninterrupted run's file. Tests with the same words share the run."""
        path = self.work / f"whole-{NAME}"
        if words not in Resume.pictures:
            self.clrt(*words, "-o", path)
            Resume.pictures[words] = path.read_bytes()
        path.write_bytes(Resume.pictures[words])
        return Resume.pictures[words]

    def tiles(self):
        try:
            return (self.journal.stat().st_size - 24) // (24 + TILE * TILE * 12)
        except FileNotFoundError:
            return 0

    def pause(self, tiles, *words):
        """Returns a run that is paused by SIGSTOP after some tiles. On a busy machine, a run may draw too many tiles
        before the signal arrives, and is repeated."""
        for _ in range(9):
            process = self.start(*words, "-o", self.journal.stem, "--resume", "-q")
            self.wait_for(lambda: self.tiles() >= tiles or process.poll() is not None)
            process.send_signal(signal.SIGSTOP)
            if process.poll() is None:
                os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
            if tiles <= self.tiles() < tiles + 50:
                return process
            process.kill()
            process.wait()
            for path in self.journal, self.work / self.journal.stem:
                path.unlink(missing_ok=True)
        return self.fail("each run drew too many tiles before it was paused")

    def stop(self, *words, number=signal.SIGINT):
        """Sends a signal to a run with 40 tiles in its journal."""
        process = self.pause(40, *words)
        process.send_signal(number)
        process.send_signal(signal.SIGCONT)
        process.communicate(timeout=600)
        self.assertEqual(process.returncode, -number if number == signal.SIGKILL else 128 + number)

    def resumed_tiles(self, *words):
        """Resumes a run until its end. Returns the number of tiles that were already finished."""
        talk = self.run_clrt(*words, "-o", NAME, "--resume", "-v").stderr
        line = next(line for line in talk.splitlines() if line.startswith("resumed: "))
        return int(line.split()[1])


class Kills(Resume):
    def wait_for_tile(self, process):
        size = self.journal.stat().st_size if self.journal.exists() else 24
        self.wait_for(lambda: (self.journal.exists() and self.journal.stat().st_size > size)
                      or process.poll() is not None)

    def test_a_run_killed_at_random_moments_ends_with_the_same_file(self):
        begin = time.monotonic()
        self.clrt(*LONG, "-o", f"timed-{NAME}")
        seconds, chance = time.monotonic() - begin, random.Random(SEED)
        whole = self.bytes_of(f"timed-{NAME}")
        kills = midway = pictures = 0
        while kills < KILLS:
            process = self.start(*LONG, "-o", NAME, "--resume")
            if kills % 4 == 0:
                time.sleep(chance.uniform(0, seconds))
            else:
                self.wait_for_tile(process)
                time.sleep(chance.uniform(0, 0.05))
            process.kill()
            killed = process.wait() == -signal.SIGKILL
            kills += killed
            midway += killed and self.journal.exists() and self.journal.stat().st_size > 10000
            if (self.work / NAME).exists():
                self.assertTrue(self.bytes_of(NAME) == whole, f"after {kills} kills")
                self.clrt(*LONG, "-o", NAME, "--resume")
                self.assertTrue(self.bytes_of(NAME) == whole, f"after {kills} kills")
                (self.work / NAME).unlink()
                pictures += 1
        print(f"{kills} kills, {midway} with tiles in the journal, {pictures} pictures finished", file=sys.stderr)
        self.clrt(*LONG, "-o", NAME, "--resume")
        self.assertTrue(self.bytes_of(NAME) == whole)
        self.assertFalse(self.journal.exists())
        self.assertEqual(list(self.work.glob(".clrt-*")), [])
        self.assertGreater(midway, KILLS // 4)

    def test_finished_tiles_are_not_drawn_again(self):
        whole = self.whole(*LONG)
        self.stop(*LONG, number=signal.SIGKILL)
        self.assertGreaterEqual(self.resumed_tiles(*LONG), 40)
        self.assertTrue(self.bytes_of(NAME) == whole)
        self.assertFalse(self.journal.exists())

    def test_a_torn_or_damaged_journal_costs_the_tiles_from_there_on(self):
        whole = self.whole(*LONG)
        self.stop(*LONG, number=signal.SIGKILL)
        journal, chance = self.journal.read_bytes(), random.Random(2)
        record = 24 + TILE * TILE * 12
        for _ in range(2):
            place = chance.randrange(24, 40 * record)
            torn = journal[:place]
            damaged = journal[:place] + bytes([journal[place] ^ 1]) + journal[place + 1 :]
            for bad in torn, damaged:
                self.journal.write_bytes(bad)
                self.assertEqual(self.resumed_tiles(*LONG), (place - 24) // record)
                self.assertTrue(self.bytes_of(NAME) == whole)
                (self.work / NAME).unlink()
        for size in 0, 23, 24:
            self.journal.write_bytes(journal[:size])
            self.assertEqual(self.resumed_tiles(*LONG), 0)
            (self.work / NAME).unlink()

    @needs_exr
    def test_runs_with_channels_parts_and_crops_resume(self):
        for more in (["--aov", "depth,primitive,certainty"], ["--part", "2/3"],
                     ["--crop", "30,20,390,290"], ["--precision", "fp64"]):
            more += ["--aa=4"]
            whole = self.whole(*LONG, *more)
            self.stop(*LONG, *more, number=signal.SIGKILL)
            self.assertGreaterEqual(self.resumed_tiles(*LONG, *more), 30)
            self.assertTrue(self.bytes_of(NAME) == whole, more)
            (self.work / NAME).unlink()

    def test_statistics_count_only_the_tiles_of_this_run(self):
        whole = self.statistics(*LONG, "-o", f"whole-{NAME}")
        self.assertEqual(whole["tiles"], {"total": TILES, "found": 0, "drawn": TILES})
        self.stop(*LONG, number=signal.SIGKILL)
        rest = self.statistics(*LONG, "-o", NAME, "--resume")
        self.assert_same_bytes(NAME, f"whole-{NAME}")
        drawn = rest["tiles"]["drawn"]
        self.assertEqual(rest["tiles"], {"total": TILES, "found": TILES - drawn, "drawn": drawn})
        self.assertLess(drawn, TILES - 39)
        samples = drawn * TILE * TILE * 36
        self.expect(rest, rays__camera=samples, samples__total=samples, samples__per_pixel=36)

    def test_statistics_as_text_say_that_found_tiles_do_not_count(self):
        self.clrt(*SMALL, "-o", NAME)
        talk = self.run_clrt(*SMALL, "-o", NAME, "--resume", "--stats").stderr.splitlines()
        found = 24 if HAS_EXR else 0
        self.assertEqual(talk[0], f"{found} of 24 tiles were finished before: time and counts cover the others")
        self.assertIn(f"{0 if HAS_EXR else 2623} samples, ", talk[2])

    def test_any_format_resumes(self):
        for name in "b.png", "b.pfm":
            self.clrt(*LONG, "-o", f"whole-{name}")
            self.journal = self.work / f"{name}.part"
            self.stop(*LONG, number=signal.SIGKILL)
            self.assertFalse((self.work / name).exists())
            self.clrt(*LONG, "-o", name, "--resume")
            self.assert_same_bytes(name, f"whole-{name}")


class LostLocks(Resume):
    def lose_lock(self, process):
        """Unlocks the journal of a process, as a file server does when it loses the host."""
        handle = os.pidfd_open(process.pid)
        for link in Path(f"/proc/{process.pid}/fd").iterdir():
            if os.path.realpath(link) == str(self.journal.resolve()):
                copy = ctypes.CDLL(None).syscall(438, handle, int(link.name), 0)  # pidfd_getfd
                if copy < 0:
                    self.skipTest("pidfd_getfd is not permitted")
                fcntl.flock(copy, fcntl.LOCK_UN)
                os.close(copy)
        os.close(handle)

    def test_a_host_that_comes_back_cannot_damage_its_successors_file(self):
        whole = self.whole(*LONG)
        for ends in False, True:
            lost = self.pause(30, *LONG)
            self.lose_lock(lost)
            before = self.tiles()
            successor = self.pause(before + 10, *LONG)
            successor.kill()
            successor.wait()
            journal = self.journal.read_bytes()
            lost.send_signal(signal.SIGCONT)
            if ends:
                self.assertEqual(lost.wait(), 0)
                self.assertTrue(self.bytes_of(NAME) == whole)
            else:
                time.sleep(0.5)
                lost.kill()
                lost.wait()
            self.assertTrue(self.journal.read_bytes() == journal)
            self.assertGreater(self.resumed_tiles(*LONG), before)
            self.assertTrue(self.bytes_of(NAME) == whole)
            (self.work / NAME).unlink()


class Stops(Resume):
    @needs_exr
    def test_the_first_signal_writes_whole_tiles_marked_incomplete(self):
        self.whole(*LONG)
        whole = read_exr(self.work / f"whole-{NAME}")[1]
        for number in signal.SIGINT, signal.SIGTERM:
            self.stop(*LONG, number=number)
            texts = read_header(self.bytes_of(NAME))[0]
            self.assertEqual(texts["clrt:complete"], b"no")
            done = json.loads(texts["clrt:settings"])["tiles_done"]
            self.assertTrue(0 < done < TILES, done)
            stopped = read_exr(self.work / NAME)[1]
            for pixel in range(WIDTH * HEIGHT):
                tile = pixel // WIDTH // TILE * (WIDTH // TILE) + pixel % WIDTH // TILE
                expected = whole["G"][pixel] if tile < done else 0
                self.assertEqual(stopped["G"][pixel], expected)
            self.journal.unlink()
            (self.work / NAME).unlink()

    @needs_exr
    def test_a_stopped_exr_without_a_journal_is_drawn_again(self):
        whole = self.whole(*LONG)
        self.stop(*LONG)
        self.journal.unlink()
        self.assertEqual(self.resumed_tiles(*LONG), 0)
        self.assertTrue(self.bytes_of(NAME) == whole)

    @needs_exr
    def test_a_whole_exr_is_all_there(self):
        for more, tiles in ([], 24), (["--tune", "tile=128x128"], 1), (["--part", "1/2"], 12), (["--aov", "depth"], 24):
            whole = self.whole(*SMALL, *more)
            shutil.copy(self.work / f"whole-{NAME}", self.work / NAME)
            self.assertEqual(self.resumed_tiles(*SMALL, *more), tiles)
            self.assertTrue(self.bytes_of(NAME) == whole, more)

    def test_the_second_signal_ends_it_at_once_and_writes_nothing(self):
        for moment in 0.5, 2, 8, 32:  # busy machines begin the tile later
            process = self.start(*ONE_TILE, "-o", NAME, "-v")
            while "kernels:" not in process.stderr.readline():
                self.assertIsNone(process.poll())
            time.sleep(moment)
            process.send_signal(signal.SIGINT)
            self.wait_for(lambda: process.poll() is not None or not self.catches(process))
            time.sleep(0.2)  # a run that has no tile now ends
            if process.poll() is None:
                break
        self.assertIsNone(process.poll(), "the first signal ended each run")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertFalse((self.work / NAME).exists())


class Refusals(Resume):
    def test_journals_of_other_settings_are_refused_and_kept(self):
        self.stop(*LONG, number=signal.SIGKILL)
        journal = self.journal.read_bytes()
        (self.work / "own.scn").write_text("light 0 0 5 1\nsphere 0 0 0 1\n")
        for words in (LONG + ["--aa=11"], LONG + ["--view", "2"], LONG + ["--tune", "tile=40x20"],
                      LONG + ["--max-level", "1"], LONG + ["--precision", "fp64"], ["own.scn", *LONG[1:]]):
            self.refuses(3, f"{NAME}.part: {OTHER}", *words, "-o", NAME, "--resume")
            self.assertTrue(self.journal.read_bytes() == journal)
        self.journal.write_bytes(b"something else, of some length")
        self.refuses(3, f"{NAME}.part: is not a journal of clrt", *LONG, "-o", NAME, "--resume")

    def test_a_pipe_in_the_journals_place_is_refused(self):
        os.mkfifo(self.journal)
        self.refuses(3, f"{NAME}.part: is not a journal of clrt", *SMALL, "-o", NAME, "--resume")

    @needs_exr
    def test_an_exr_that_was_drawn_otherwise_is_refused(self):
        self.clrt(*SMALL, "-o", "bare.exr", "--no-metadata")
        self.clrt(*SMALL, "-o", "aa.exr", "--aa")
        for name in "bare.exr", "aa.exr":
            before = self.bytes_of(name)
            self.refuses(3, f"{name}: {OTHER}", *SMALL, "-o", name, "--resume")
            self.assertTrue(self.bytes_of(name) == before)
            self.assertFalse((self.work / f"{name}.part").exists())

    @needs_exr
    def test_a_run_that_ends_meanwhile_with_other_settings_is_refused(self):
        text = "light 0 0 5 1\nsphere 0 0 0 1\n"
        (self.work / "own.scn").write_text(text)
        os.mkfifo(self.work / "late.scn")
        late = self.start("late.scn", *SMALL[1:], "--aa=3", "-o", NAME, "--resume", "-q")
        with open(self.work / "late.scn", "w") as pipe:  # opens once clrt reads it
            self.clrt("own.scn", *SMALL[1:], "-o", NAME, "--resume", "-q")
            picture = self.bytes_of(NAME)
            pipe.write(text)
        self.assertEqual(late.communicate()[1], f"clrt: {NAME}: {OTHER}\n")
        self.assertEqual(late.returncode, 3)
        self.assertTrue(self.bytes_of(NAME) == picture)
        self.assertFalse(self.journal.exists())

    def test_two_processes_do_not_draw_one_picture(self):
        self.pause(1, *LONG)
        sentence = f"{NAME}.part: another process draws this picture: try again later"
        self.refuses(75, sentence, *LONG, "-o", NAME, "--resume")

    def test_a_journal_that_cannot_grow_is_exit_5(self):
        limit = ["bash", "-c", "trap '' XFSZ; ulimit -f 1200; exec \"$@\"", "bash"]
        done = self.run_clrt(*LONG, "-o", NAME, "-q", "--resume", before=limit)
        self.assertEqual((done.returncode, done.stderr),
                         (5, f"clrt: {NAME}.part: cannot be written: File too large\n"))
        self.assertFalse((self.work / NAME).exists())

    def test_outputs_that_cannot_be_resumed_are_refused(self):
        for words, sentence in (
            (["-o", "-"], "--resume needs a file: give -o FILE"),
            (["-o", "a.pfm", "--aa-adaptive"],
             "--resume does not go with --aa-adaptive, --error and --time, which refine the picture as a "
             "whole: give --aa"),
        ):
            self.refuses(2, sentence, SCENE, "-s", "61x43", "--resume", *words)
        os.mkfifo(self.work / "pipe.pfm")
        self.refuses(3, "pipe.pfm: cannot be resumed: not a regular file", *SMALL, "--resume", "-o", "pipe.pfm")


if __name__ == "__main__":
    main(2)
