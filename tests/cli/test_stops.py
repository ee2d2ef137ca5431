#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Stops clrt by signals at any moment, while it compiles kernels or draws tiles. Drivers cannot stop
# compiling. clrt must print one message and exit with 128 + the signal's number. It must write no
# picture, or a picture that it reports as incomplete. Usage: test_stops.py CLRT FORMATS
import array
import fcntl
import json
import os
import random
import signal
import subprocess
import sys
import termios
import time

from pictures import read_header
from work import HAS_EXR, SCENE, Work, main

NAME = "a.exr" if HAS_EXR else "a.pfm"
# LONG takes minutes and has many tiles. ONE_TILE takes as long, but has only one tile. Stopped runs do not store
# kernels, so specialized ones would be compiled in each run.
LONG = [SCENE, "-s", "3000x3000", "--aa=16", "--tune", "specialize=never"]
ONE_TILE = [*LONG, "--tune", "tile=3000x3000"]
EARLY = "clrt: stopped before the first tile: no picture is written\n"
LATE = rf"^clrt: stopped: {NAME} is incomplete, with \d+ of 576 tiles\n$"


class Stops(Work):
    def setUp(self):
        super().setUp()
        self.chance = random.Random(1)
        self.caches = 0

    def start_picture(self, *words, cold, **more):
        """Starts a picture, and waits until clrt handles signals. If `cold` is true, the kernel cache is empty."""
        environment = dict(os.environ)
        if cold:
            self.caches += 1
            environment["XDG_CACHE_HOME"] = f"{self.work}/caches/{self.caches}"
            environment.pop("POCL_CACHE_DIR", None)
        (self.work / "out").mkdir(exist_ok=True)
        process = self.start(*words, "-o", NAME, "-q", cwd=self.work / "out", env=environment, **more)
        while not self.catches(process):
            self.assertIsNone(process.poll())
        return process

    def expect_stopped(self, process, number):
        """Expects the exit status and a message. Returns whether clrt has written a picture."""
        talk = process.communicate(timeout=30)[1]
        self.assertEqual(process.returncode, 128 + number, talk)
        if talk == EARLY:
            self.assertEqual(os.listdir(self.work / "out"), [])
            return False
        self.assertRegex(talk, LATE)
        self.assertEqual(os.listdir(self.work / "out"), [NAME])
        picture = self.work / "out" / NAME
        if NAME.endswith(".exr"):
            texts = read_header(picture.read_bytes())[0]
            self.assertEqual(texts["clrt:complete"], b"no")
            done = json.loads(texts["clrt:settings"])["tiles_done"]
            self.assertIn(f"with {done} of 576 tiles", talk)
        picture.unlink()
        return True

    def stop_often(self, moments, **more):
        pictures = 0
        for moment in moments:
            number = self.chance.choice((signal.SIGINT, signal.SIGTERM, signal.SIGHUP))
            process = self.start_picture(*LONG, **more)
            time.sleep(moment)
            process.send_signal(number)
            pictures += self.expect_stopped(process, number)
        return pictures

    def test_while_kernels_are_compiled_it_ends_at_once_without_a_picture(self):
        self.assertEqual(self.stop_often((0, 0.02, 0.1, 0.2), cold=True), 0)

    def test_at_any_moment_of_a_cold_start_under_load(self):
        load = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(2)]
        try:
            self.stop_often([self.chance.uniform(0, 3) for _ in range(3)], cold=True)
        finally:
            for process in load:
                process.kill()
                process.wait()

    def test_once_tiles_are_drawn_there_is_a_picture(self):
        # Compiles LONG's kernels, because a run that is stopped while it compiles stores none.
        self.clrt(*LONG, "-s", "8x8", "--tune", "kernel=packet", "-o", "/dev/null", "--format", "pfm")
        moment = 1
        while self.stop_often([moment], cold=False) == 0:  # a busy machine draws its first tile later
            moment *= 2
        self.stop_often([self.chance.uniform(0, 0.3) for _ in range(5)], cold=False)

    def test_a_second_signal_ends_it_at_once_at_any_moment(self):
        for moment in 0, 0.05, 0.3, 1, 2:
            process = self.start_picture(*ONE_TILE, cold=moment < 1)
            time.sleep(moment)
            process.send_signal(signal.SIGINT)
            time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=20)
            self.assertIn(process.returncode, (128 + signal.SIGINT, -signal.SIGINT))
            self.assertEqual(os.listdir(self.work / "out"), [])

    def test_a_terminals_signal_to_all_processes_is_reported_once(self):
        for moment in 0, 0.05, 1:
            process = self.start_picture(*LONG, cold=moment < 1, start_new_session=True)
            time.sleep(moment)
            os.killpg(process.pid, signal.SIGINT)
            self.expect_stopped(process, signal.SIGINT)

    def test_a_signal_between_pictures_reports_how_many_are_drawn(self):
        words = [SCENE, "-s", "8x8", "--turntable", "100000", "--hash"]
        hashes = open(self.work / "hashes", "w+")
        self.addCleanup(hashes.close)
        process = self.start_picture(*words, cold=False, stdout=hashes)
        out = self.work / "out"
        while len(os.listdir(out)) < 3:
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        talk = process.communicate(timeout=30)[1]
        self.assertEqual(process.returncode, 128 + signal.SIGINT)
        self.assertRegex(talk, r"^clrt: stopped: (\d+ of 100000 pictures are drawn|a\.\d+\.\w+ is complete)\n$")
        hashes.seek(0)
        # The last picture has no hash if the signal arrived while it was drawn.
        self.assertIn(len(os.listdir(out)) - len(hashes.readlines()), (0, 1))

    def test_a_signal_does_not_interrupt_a_write_to_a_full_pipe(self):
        words = [SCENE, "-s", "300x300", "--format", "pfm", "-o", "-"]
        process = self.start(*words, stdout=subprocess.PIPE, text=False)
        pipe = process.stdout.fileno()
        room = fcntl.fcntl(pipe, fcntl.F_GETPIPE_SZ)
        waiting = array.array("i", [0])
        self.wait_for(lambda: fcntl.ioctl(pipe, termios.FIONREAD, waiting) == 0 and waiting[0] == room)
        process.send_signal(signal.SIGTERM)
        time.sleep(0.2)  # otherwise, a read would let the write return before the signal arrives
        picture, talk = process.communicate(timeout=30)
        self.assertEqual((process.returncode, talk), (0, b""))
        self.assertEqual(len(picture), len("PF\n300 300\n-1.0\n") + 12 * 300 * 300)


if __name__ == "__main__":
    main(2)
