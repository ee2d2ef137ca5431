#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests the program's output: data on standard output, messages on standard error, JSON that follows
# its schemas, and an exit status for every outcome.
# Usage: test_talk.py CLRT
import json
import os
import pathlib
import pty
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import jsonschema
except ImportError:
    jsonschema = None

CLRT = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = str(ROOT / "scenes/reflections.scn")
SMALL = [SCENE, "-s", "16x12"]
LONG = [SCENE, "-s", "1500x1500", "--aa=16", "-j", "1"]
OPEN_MESH = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 1\n"
)


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        (self.work / "open.ply").write_text(OPEN_MESH)

    def clrt(self, *words, **environment):
        return subprocess.run(
            [CLRT, *words],
            cwd=self.work,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            env=dict(os.environ, **environment),
            timeout=120,
        )


class Streams(Run):
    def test_pictures_and_reports_go_to_standard_output_alone(self):
        for words in (
            SMALL + ["-o", "-"],
            ["--list-devices"],
            ["--help"],
            ["--version"],
            ["--list-devices=json"],
            ["check", "open.ply", "--json"],
        ):
            done = self.clrt(*words)
            self.assertTrue(done.stdout, words)
            self.assertEqual(done.stderr, b"", words)

    def test_talk_goes_to_standard_error_alone(self):
        for words in (["-v"], ["--stats"], ["-v", "--repeat", "2"]):
            done = self.clrt(*SMALL, "-o", "a.pfm", *words)
            self.assertTrue(done.stderr, words)
            self.assertEqual(done.stdout, b"", words)

    def test_a_picture_on_standard_output_is_whole_beside_talk(self):
        done = self.clrt(*SMALL, "-o", "-", "--format", "pfm", "-v")
        self.assertEqual(len(done.stdout), len(b"PF\n16 12\n-1.0\n") + 16 * 12 * 12)
        self.assertIn(b"traced in", done.stderr)

    def test_quiet_says_nothing_but_errors(self):
        self.assertEqual(self.clrt("open.ply", "-s", "8x8", "-o", "a.pfm", "-q").stderr, b"")
        self.assertNotEqual(self.clrt("open.ply", "-s", "8x8", "-o", "a.pfm").stderr, b"")
        self.assertNotEqual(self.clrt("none.scn", "-o", "a.pfm", "-q").stderr, b"")


class StandardInput(Run):
    def feed(self, content, *words):
        return subprocess.run([CLRT, "-", *words], cwd=self.work, input=content,
                              capture_output=True, timeout=120)

    def test_a_scene_on_standard_input_is_the_picture_of_its_file(self):
        folder = ROOT / "scenes"
        (self.work / "cube.ply").write_bytes((folder / "cube.ply").read_bytes())
        (self.work / "a.scn").write_text("light 4 -4 4 1\nmesh cube.ply\nsphere 2 0 0 1\n")
        for name in "a.scn", "cube.ply":
            content = (self.work / name).read_bytes()
            words = ["-s", "16x12", "-o", "-", "--format", "pfm"]
            told = self.feed(content, *words)
            self.assertEqual((told.returncode, told.stderr), (0, b""))
            self.assertTrue(told.stdout == self.clrt(name, *words).stdout, name)

    def test_check_and_convert_read_it_too(self):
        content = (ROOT / "scenes/cube.ply").read_bytes()
        for command in ["check", "-", "-q"], ["convert", "-", "b.ply"]:
            done = subprocess.run([CLRT, *command], cwd=self.work, input=content,
                                  capture_output=True, timeout=120)
            self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertTrue((self.work / "b.ply").read_bytes().startswith(b"ply"))

    def test_its_faults_are_told_by_name_and_line(self):
        told = self.feed(b"light 0 0 5 1\nspheer 0 0 0 1\n", "-o", "a.pfm")
        self.assertEqual(told.returncode, 3)
        self.assertEqual(told.stderr, b"clrt: standard input:2:1: unknown statement (did you mean 'sphere'?): "
                                      b"found 'spheer'\n")

    def test_the_window_does_not_take_it(self):
        told = self.feed(b"")
        self.assertEqual(told.returncode, 2)
        self.assertIn(b"-o FILE", told.stderr)


class Terminals(Run):
    def talk_on_terminal(self, **environment):
        """Returns the terminal output of a stopped picture."""
        talk, terminal = pty.openpty()
        process = subprocess.Popen(
            [CLRT, *LONG, "-o", "a.pfm"],
            cwd=self.work,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=terminal,
            env=dict(os.environ, **environment),
        )
        os.close(terminal)
        text = b""
        end = time.monotonic() + 60
        while b"left" not in text and time.monotonic() < end:
            text += os.read(talk, 4096)
        process.send_signal(signal.SIGINT)
        try:
            while chunk := os.read(talk, 4096):
                text += chunk
        except OSError:  # the program has closed the terminal
            pass
        process.wait()
        os.close(talk)
        return text

    def test_progress_is_one_line_that_is_cleared(self):
        text = self.talk_on_terminal(TERM="xterm")
        self.assertTrue(text.startswith(b"\r\x1b[Ktracing "), text)
        line, stopped = text.split(b"\r\x1b[Kclrt: ")
        self.assertNotIn(b"\n", line)
        self.assertRegex(stopped, rb"^stopped: a\.pfm is incomplete, with \d+ of 144 tiles\r\n$")

    def test_a_dumb_terminal_gets_plain_lines(self):
        text = self.talk_on_terminal(TERM="dumb")
        self.assertNotIn(b"\x1b", text)
        self.assertNotIn(b"\r\x1b", text)
        self.assertRegex(text, rb"^tracing \d+ %, \d+ s left\r\n")

    def test_nothing_is_colored(self):
        for setting in ({}, {"NO_COLOR": "1"}):
            self.assertNotRegex(self.talk_on_terminal(TERM="xterm", **setting), rb"\x1b\[[0-9;]*m")

    def test_a_pipe_gets_no_control_characters(self):
        done = self.clrt(*SMALL, "-o", "a.pfm", "-v", "--stats", TERM="xterm")
        self.assertNotIn(b"\x1b", done.stderr)
        self.assertNotIn(b"\r", done.stderr)


@unittest.skipUnless(jsonschema, "Python's jsonschema is not installed")
class Schemas(Run):
    def validate(self, name, text):
        schema = json.loads((ROOT / f"tools/manual/{name}.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.validate(json.loads(text), schema, cls=jsonschema.Draft202012Validator)

    def test_statistics_are_as_their_schema_says(self):
        for words in ([], ["--no-bvh"], ["--precision", "fp64"], ["--repeat", "3", "--aa"], ["--reference"],
                      ["--aa-adaptive"]):
            done = self.clrt(*SMALL, "-o", "a.pfm", "--stats=-", *words)
            self.validate("statistics", done.stdout)
        mesh = ["open.ply", "-s", "8x8", "-o", "a.pfm", "--stats=-"]
        self.validate("statistics", self.clrt(*mesh).stdout)

    def test_checks_are_as_their_schema_says(self):
        self.validate("check", self.clrt("check", "open.ply", "--json").stdout)
        self.validate("check", self.clrt("check", SCENE, "--json").stdout)
        without = {"OCL_ICD_VENDORS": "/nonexistent"}
        self.validate("check", self.clrt("check", "open.ply", "--json", **without).stdout)
        (self.work / "empty.scn").write_text("")
        self.validate("check", self.clrt("check", "empty.scn", "--json").stdout)

    def test_comparisons_are_as_their_schema_says(self):
        for file, words in ("a.pfm", []), ("b.pfm", ["--aa"]):
            self.clrt(*SMALL, "-o", file, *words)
        limits = ["--json", "--fail", "rmse=1,psnr=99,max=0,share1=0,share4=0"]
        for other in "a.pfm", "b.pfm":
            self.validate("compare", self.clrt("compare", "a.pfm", other, *limits).stdout)

    def test_comparisons_by_cause_are_as_their_schema_says(self):
        channels = ["--aov", "primitive,shadow,bounces"]
        if self.clrt(*SMALL, "-o", "a.exr", *channels).returncode == 2:
            self.skipTest("this build writes no EXR files")
        self.clrt(*SMALL, "-o", "b.exr", "--aa", *channels)
        told = self.clrt("compare", "a.exr", "b.exr", "--json").stdout
        self.assertIsNotNone(json.loads(told)["causes"])
        self.validate("compare", told)

    def test_devices_are_as_their_schema_says(self):
        self.validate("devices", self.clrt("--list-devices=json").stdout)

    def test_explanations_are_as_their_schema_says(self):
        for pixel in ("0,0", "8,6", "7,9"):
            words = [*SMALL, "--explain-pixel", pixel, "--json"]
            self.validate("explanation", self.clrt(*words).stdout)

    def test_explanations_of_scenes_are_as_their_schema_says(self):
        (self.work / "empty.scn").write_text("")
        for words in ([*SMALL, "--stats"], [*SMALL, "--specialize", "always"], ["empty.scn"]):
            told = self.clrt(*words, "--explain", "--json").stdout
            self.validate("explanation-scene", told)

    def test_what_the_schemas_do_not_name_is_refused(self):
        statistics = json.loads(self.clrt(*SMALL, "-o", "a.pfm", "--stats=-").stdout)
        statistics["rays"]["lost"] = 1
        with self.assertRaises(jsonschema.ValidationError):
            self.validate("statistics", json.dumps(statistics))


class ExitStatus(Run):
    def test_0_is_done(self):
        self.assertEqual(self.clrt(*SMALL, "-o", "a.pfm").returncode, 0)

    def test_1_is_a_check_that_found_faults(self):
        self.assertEqual(self.clrt("check", "open.ply").returncode, 1)

    def test_1_is_a_comparison_whose_limits_are_broken(self):
        for file, words in ("a.pfm", []), ("b.pfm", ["--aa"]):
            self.clrt(*SMALL, "-o", file, *words)
        self.assertEqual(self.clrt("compare", "a.pfm", "b.pfm", "--fail", "max=0").returncode, 1)

    def test_2_is_a_command_line_that_is_not_understood(self):
        self.assertEqual(self.clrt("--nonsense").returncode, 2)

    def test_3_is_a_scene_or_mesh(self):
        (self.work / "bad.scn").write_text("ply_file nowhere.ply\n")
        self.assertEqual(self.clrt("bad.scn", "-o", "a.pfm").returncode, 3)

    def test_4_is_the_device(self):
        done = self.clrt(*SMALL, "-o", "a.pfm", OCL_ICD_VENDORS="/nonexistent")
        self.assertEqual(done.returncode, 4)
        done = self.clrt("--list-devices=json", OCL_ICD_VENDORS="/nonexistent")
        self.assertEqual((done.returncode, done.stdout), (4, b""))

    def test_5_is_the_output(self):
        self.assertEqual(self.clrt(*SMALL, "-o", "nowhere/a.pfm").returncode, 5)

    def test_128_and_the_signal_is_a_stop_that_leaves_what_is_done(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            words = [CLRT, *LONG, "-o", "a.pfm"]
            process = subprocess.Popen(words, cwd=self.work, stderr=subprocess.PIPE)
            self.assertIn(b"tracing", process.stderr.readline())
            process.send_signal(number)
            process.stderr.read()
            process.stderr.close()
            self.assertEqual(process.wait(), 128 + number)
            self.assertEqual((self.work / "a.pfm").stat().st_size, 1500 * 1500 * 12 + 18)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
