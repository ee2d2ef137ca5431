#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests the program's output: data on standard output, messages on standard error, JSON and its
# schemas, and the output of stopped runs.
# Usage: test_talk.py CLRT FORMATS
import json
import os
import pty
import signal
import threading
import time
import unittest

from models import ply
from skips import needs_terminal
from work import NO_OPENCL, ROOT, SCENE, Work, main, needs_exr

try:
    import jsonschema
except ImportError:
    jsonschema = None

SMALL = [SCENE, "-s", "16x12"]
# Stopped runs do not store kernels, so specialized ones would be compiled in each run.
LONG = [SCENE, "-s", "1500x1500", "--aa=16", "-j", "1", "--tune", "specialize=never"]


class Talk(Work):
    def setUp(self):
        super().setUp()
        self.write(open_ply=ply([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 1)]), empty_scn="")

    def start_on_terminal(self, *words, **environment):
        """Returns a run of clrt, and the terminal's side that receives clrt's messages."""
        ours, theirs = pty.openpty()
        process = self.start(*words, stderr=theirs, env={**os.environ, **environment})
        os.close(theirs)
        return process, ours

    def read_terminal(self, terminal):
        """Returns the terminal's output until the program closes its side."""
        text = b""
        try:
            while chunk := os.read(terminal, 4096):
                text += chunk
        except OSError:  # the program has closed the terminal
            pass
        os.close(terminal)
        return text


class Streams(Talk):
    def test_pictures_and_reports_go_to_standard_output_alone(self):
        for words in (SMALL + ["-o", "-"], ["devices"], ["--help"], ["--version"],
                      ["devices", "--json"], ["check", "open.ply", "--json"]):
            done = self.run_clrt(*words, content=b"")
            self.assertTrue(done.stdout, words)
            self.assertEqual(done.stderr, b"", words)

    def test_talk_goes_to_standard_error_alone_without_control_characters(self):
        for words in (["-v"], ["--stats"], ["-v", "--repeat", "2"]):
            done = self.run_clrt(*SMALL, "-o", "a.pfm", *words, content=b"", TERM="xterm")
            self.assertTrue(done.stderr, words)
            self.assertEqual(done.stdout, b"", words)
            self.assertNotRegex(done.stderr, rb"[\x1b\r]")

    def test_names_are_printed_without_control_characters(self):
        for control in "\33", "\x9b":
            scene, mesh = f"a{control}31m.scn", f"c{control}.ply"
            (self.work / scene).write_text(f"define b{control} matte\nmaterial b{control}\n"
                                           "mesh open.ply\n", encoding="utf-8")
            (self.work / mesh).write_bytes(self.bytes_of("open.ply"))
            for words in (["check", scene], ["convert", scene, f"d{control}.ply", "-v"],
                          ["explain", mesh, "4,4", "-s", "8x8"], [f"none{control}.scn", "--hash"],
                          [scene, "-s", "8x8", "-o", f"d{control}.pfm", "-v", "--frames", "1-1"]):
                done = self.run_clrt(*words, content=b"")
                self.assertIn(b"?", done.stdout + done.stderr, words)
                self.assertNotIn(control.encode(), done.stdout + done.stderr, words)

    def test_a_picture_on_standard_output_is_whole_beside_talk(self):
        done = self.run_clrt(*SMALL, "-o", "-", "--format", "pfm", "-v", content=b"")
        self.assertEqual(len(done.stdout), len(b"PF\n16 12\n-1.0\n") + 16 * 12 * 12)
        self.assertIn(b"traced in", done.stderr)

    def test_a_closed_stream_is_not_another_file(self):
        for words, stream, status in ((["-", "--hash"], "<&-", 3), ([*SMALL, "-o", "-"], ">&-", 5),
                                      ([*SMALL, "--hash"], ">&-", 5), ([*SMALL, "-o", "a.png"], "2>&-", 0)):
            done = self.run_clrt(*words, before=["sh", "-c", f'exec "$@" {stream}', "sh"])
            self.assertEqual((done.returncode, done.stdout), (status, ""), words)
            self.assertEqual("standard" in done.stderr, status > 0, done.stderr)

    def test_a_reader_that_stops_early_causes_no_message(self):
        for output, told in ((">(:); wait $!", b""), ("/dev/full", b"clrt: standard output cannot be written\n")):
            command = ["bash", "-c", f'exec 3> {output}; exec "$@" >&3 3>&-', "bash"]
            done = self.run_clrt("--help", before=command, content=b"")
            self.assertEqual((done.returncode, done.stderr), (5, told), output)

    def test_a_temporary_file_that_cannot_be_created_is_named(self):
        self.refuses(5, "/nonexistent/clrt-", *SMALL, "-o", "-", TMPDIR="/nonexistent")

    def test_quiet_says_nothing_but_errors(self):
        words = ["open.ply", "-s", "8x8", "-o", "a.pfm"]
        self.assertEqual(self.run_clrt(*words, "-q").stderr, "")
        self.assertNotEqual(self.run_clrt(*words).stderr, "")
        self.assertNotEqual(self.run_clrt("none.scn", "-o", "a.pfm", "-q").stderr, "")

    def test_reports_without_a_device_print_nothing_and_are_exit_4(self):
        done = self.run_clrt("devices", "--json", **NO_OPENCL)
        self.assertEqual((done.returncode, done.stdout), (4, ""))


class StandardInput(Talk):
    def test_a_scene_on_standard_input_is_the_picture_of_its_file(self):
        self.write(cube_ply=(ROOT / "scenes/cube.ply").read_bytes(),
                   a_scn="light 4 -4 4 1\nmesh cube.ply\nsphere 2 0 0 1\n")
        for name in "a.scn", "cube.ply":
            words = ["-s", "16x12", "-o", "-", "--format", "pfm"]
            done = self.run_clrt("-", *words, content=self.bytes_of(name))
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            self.assertTrue(done.stdout == self.run_clrt(name, *words, content=b"").stdout, name)

    def test_check_and_convert_read_it_too(self):
        content = (ROOT / "scenes/cube.ply").read_bytes()
        for words in ["check", "-", "-q"], ["convert", "-", "b.ply"]:
            done = self.run_clrt(*words, content=content)
            self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertTrue(self.bytes_of("b.ply").startswith(b"ply"))

    def test_faults_on_standard_input_are_reported_with_their_line(self):
        done = self.run_clrt("-", "-o", "a.pfm", content="light 0 0 5 1\nspheer 0 0 0 1\n")
        blank = self.run_clrt("-", "-o", "a.pfm", content="")
        self.assertIn("clrt: standard input: there is nothing to draw", blank.stderr)
        fault = "clrt: standard input:2:1: unknown statement (did you mean 'sphere'?): found 'spheer'\n"
        self.assertEqual((done.returncode, done.stderr), (3, fault))

    def test_the_window_does_not_take_it(self):
        self.assertIn("-o FILE", self.clrt("-", code=2))


@needs_terminal
class Terminal(Talk):
    def on_terminal(self, *words, **environment):
        """Returns clrt's output on a terminal."""
        process, terminal = self.start_on_terminal(*words, TERM="xterm", **environment)
        text = self.read_terminal(terminal)
        self.assertEqual(process.wait(), 0, text)
        return text

    def test_compiling_is_announced_once_and_written_files_always(self):
        compiling, wrote = b"\r\x1b[Kcompiling kernels, 0 s", rb"(?m)^wrote a\.pfm \(16x12, \d+\.\d\d s\)\r$"
        picture, empty = [*SMALL, "-o", "a.pfm"], {"POCL_CACHE_DIR": str(self.work)}
        text = self.on_terminal(*picture, **empty)
        self.assertEqual(text.count(compiling), 1, text)
        self.assertRegex(text.split(b"\x1b[K")[-1], wrote)
        text = self.on_terminal(*picture, **empty)
        self.assertNotIn(b"compiling", text)
        self.assertRegex(text.split(b"\x1b[K")[-1], wrote)
        self.assertEqual(self.on_terminal(*picture, "-q"), b"")

    def test_a_scene_that_loads_slowly_is_announced_within_a_second(self):
        scene = "sphere 0 0 0 1\nlight 5 5 5 1\n"
        os.mkfifo(self.work / "slow.scn")

        def write_slowly():
            with open(self.work / "slow.scn", "w", encoding="utf-8") as pipe:  # waits for the reader
                time.sleep(1)
                pipe.write(scene)

        for quiet in [], ["-q"]:
            writer = threading.Thread(target=write_slowly)
            writer.start()
            text = self.on_terminal("slow.scn", "-s", "8x8", "-o", "a.pfm", *quiet)
            writer.join()
            self.assertEqual(b"\r\x1b[Kloading the scene, 0 s\r\x1b[K" in text, not quiet, text)
        self.write(a_scn=scene)
        words = "a.scn", "-s", "8x8", "-o", "a.pfm"
        # Repeated, because a busy machine may load slowly.
        self.assertTrue(any(b"loading" not in self.on_terminal(*words) for _ in range(9)))

    def test_every_command_announces_compiling(self):
        # Each command has kernels of its own. Another test draws a picture.
        for words in ["warm"], ["check", SCENE, "--json"], ["explain", *SMALL, "3,3"]:
            text = self.on_terminal(*words, "--tune=kernel=pair", POCL_CACHE_DIR=str(self.work))
            self.assertIn(b"compiling kernels, 0 s", text, words)


class Stopped(Talk):
    def talk_on_terminal(self, **environment):
        """Returns the terminal output of a stopped picture."""
        process, terminal = self.start_on_terminal(*LONG, "-o", "a.pfm", **environment)
        text = b""
        while b"left" not in text:
            text += os.read(terminal, 4096)
        process.send_signal(signal.SIGINT)
        text += self.read_terminal(terminal)
        process.wait()
        return text

    @needs_terminal
    def test_progress_is_one_line_that_is_cleared_and_never_colored(self):
        for setting in {}, {"NO_COLOR": "1"}:
            text = self.talk_on_terminal(TERM="xterm", **setting)
            self.assertNotRegex(text, rb"\x1b\[[0-9;]*m")
        self.assertRegex(text, rb"^(\r\x1b\[K((loading the scene|compiling kernels), \d+ s)?)*\r\x1b\[Ktracing ")
        line, stopped = text.split(b"\r\x1b[Kclrt: ")
        self.assertNotIn(b"\n", line)
        self.assertRegex(stopped, rb"^stopped: a\.pfm is incomplete, with \d+ of 144 tiles\r\n$")

    @needs_terminal
    def test_a_dumb_terminal_gets_plain_lines(self):
        text = self.talk_on_terminal(TERM="dumb")
        self.assertNotIn(b"\x1b", text)
        self.assertRegex(text, rb"^tracing \d+ %, \d+ s left\r\n")

    def test_a_signal_exits_with_128_plus_its_number_and_keeps_finished_tiles(self):
        for number in signal.SIGINT, signal.SIGTERM:
            process = self.start(*LONG, "-o", "a.pfm", "--json=a.json")
            self.assertIn("tracing", process.stderr.readline())
            process.send_signal(number)
            process.communicate()
            self.assertEqual(process.returncode, 128 + number)
            self.assertEqual(len(self.bytes_of("a.pfm")), 1500 * 1500 * 12 + 18)
            self.expect(self.json_of("a.json"), complete=False)


@unittest.skipUnless(jsonschema, "Python's jsonschema is not installed")
class Schemas(Talk):
    def validate(self, name, *words, code=0, **environment):
        """Checks the JSON on standard output against its schema. Returns the schema and the JSON."""
        found = self.report(*words, code=code, **environment)
        schema = json.loads((ROOT / f"tools/manual/{name}.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(found, schema, cls=jsonschema.Draft202012Validator)
        return schema, found

    def test_statistics(self):
        picture = ["-o", "a.pfm", "--json=-"]
        for words in ([], ["--tune=bvh=none"], ["--precision", "fp64"], ["--repeat", "3", "--aa"], ["--reference"],
                      ["--aa-adaptive", "--tune=kernel=pair"]):
            schema, found = self.validate("statistics", *SMALL, *picture, *words)
        self.validate("statistics", "open.ply", "-s", "8x8", *picture)
        found["rays"]["lost"] = 1
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.validate(found, schema, cls=jsonschema.Draft202012Validator)

    def test_checks(self):
        for environment in {}, NO_OPENCL:
            self.validate("check", "check", "open.ply", "--json", code=1, **environment)
        for scene in SCENE, "empty.scn":
            self.validate("check", "check", scene, "--json")

    def test_comparisons(self):
        for file, words in ("a.pfm", []), ("b.pfm", ["--aa"]):
            self.clrt(*SMALL, "-o", file, *words)
        limits = ["--json", "--fail", "rmse=1,psnr=99,max=0,share1=0,share4=0"]
        for code, other in enumerate(["a.pfm", "b.pfm"]):
            self.validate("compare", "compare", "a.pfm", other, *limits, code=code)

    @needs_exr
    def test_comparisons_by_cause(self):
        for file, words in ("a.exr", []), ("b.exr", ["--aa"]):
            self.clrt(*SMALL, "-o", file, "--aov", "primitive,shadow,bounces", *words)
        self.assertIsNotNone(self.validate("compare", "compare", "a.exr", "b.exr", "--json")[1]["causes"])

    def test_devices(self):
        self.validate("devices", "devices", "--json")

    def test_explanations(self):
        for pixel in "0,0", "8,6", "7,9":
            self.validate("explanation", "explain", *SMALL, pixel, "--json")
        for words in [*SMALL, "--stats"], [*SMALL, "--tune", "specialize=always,kernel=pair"], ["empty.scn"]:
            self.validate("explanation-scene", "explain", *words, "--json")


if __name__ == "__main__":
    main(2)
