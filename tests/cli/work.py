# SPDX-License-Identifier: MIT
# Gives each test a folder, and runs clrt in this folder. Tests that import this module take CLRT as
# their first argument.
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

CLRT = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = str(ROOT / "scenes/reflections.scn")
EVERY_FEATURE = str(ROOT / "tests/image/every_feature.scn")
# The formats of this build, if they are the test's second argument. For other tests, the list is
# empty.
FORMATS = sys.argv[2].split(", ") if len(sys.argv) > 2 and "pfm" in sys.argv[2] else []
HAS_EXR = "jpg" in FORMATS  # a build with JPEG has OpenImageIO, by which clrt compare reads EXR
NO_OPENCL = {"OCL_ICD_VENDORS": "/nonexistent"}

needs_exr = unittest.skipUnless(HAS_EXR, "this build is without OpenImageIO")


def main(words):
    """Runs the tests that the command line names after `words` arguments, or all tests."""
    # Background jobs ignore SIGINT, and clrt would inherit this setting.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    unittest.main(module="__main__", argv=[sys.argv[0], *sys.argv[words + 1 :]], verbosity=2)


def preload(library):
    """Returns the environment that loads a library before all others."""
    # With this option, AddressSanitizer accepts libraries that are loaded before its own.
    sanitizer = "verify_asan_link_order=0:" + os.environ.get("ASAN_OPTIONS", "")
    return {"LD_PRELOAD": os.path.abspath(library), "ASAN_OPTIONS": sanitizer}


def has_private_disks():
    command = ["unshare", "-m", "mount", "-t", "tmpfs", "clrt-test", "/mnt"]
    try:
        return subprocess.run(command, capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


class Work(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)

    def write(self, **files):
        """Writes files. The last underscore of a name stands for a dot."""
        for name, content in files.items():
            content = content.encode() if isinstance(content, str) else content
            path = self.work / ".".join(name.rsplit("_", 1))
            path.write_bytes(content)

    def bytes_of(self, name):
        return (self.work / name).read_bytes()

    def json_of(self, name):
        return json.loads(self.bytes_of(name))

    def assert_same_bytes(self, one, other, words=()):
        """Compares two files without printing their bytes."""
        self.assertTrue(self.bytes_of(one) == self.bytes_of(other), f"{one} and {other} differ: {words}")

    def start(self, *words, before=(), **settings):
        settings = {"cwd": self.work, "stderr": subprocess.PIPE, "text": True, **settings}
        for stream in "stdin", "stdout":
            settings.setdefault(stream, subprocess.DEVNULL)
        process = subprocess.Popen([*before, CLRT, *words], **settings)
        self.addCleanup(process.__exit__, None, None, None)  # closes the streams and waits
        self.addCleanup(process.kill)
        return process

    @staticmethod
    def catches(process):
        """Returns whether the process handles SIGINT. clrt handles only the first one."""
        lines = pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines()
        caught = next(line for line in lines if line.startswith("SigCgt:"))
        return int(caught.split()[1], 16) >> signal.SIGINT - 1 & 1 == 1

    def wait_for(self, condition, seconds=300):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end, "the condition never holds")
            time.sleep(0.002)

    def run_clrt(self, *words, before=(), content="", **environment):
        """Runs clrt with `content` as its standard input. `before` is a command that runs clrt. A
        variable of the environment is unset if its value is None."""
        text = isinstance(content, str)
        environment = {**os.environ, **environment}
        kept = {name: value for name, value in environment.items() if value is not None}
        return subprocess.run([*before, CLRT, *words], cwd=self.work, env=kept, input=content, text=text,
                              capture_output=True, timeout=600)

    def run_within(self, seconds, megabytes, *words, **settings):
        """Runs clrt and returns its exit status and standard error. Fails if clrt and its child
        processes exceed the processor time together, or if one of them exceeds the memory."""
        process = self.start(*words, **settings)
        text = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertLess(usage.ru_utime + usage.ru_stime, seconds, (words, text))
        self.assertLess(usage.ru_maxrss, 1000 * megabytes, (words, text))
        return process.returncode, text

    def clrt(self, *words, code=0, **environment):
        """Expects that clrt exits with `code`. Returns standard output or, if `code` is not 0,
        standard error."""
        done = self.run_clrt(*words, **environment)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        return done.stderr if code else done.stdout

    def report(self, *words, code=0, **environment):
        """Expects that clrt exits with `code`. Returns the JSON on standard output."""
        done = self.run_clrt(*words, **environment)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        return json.loads(done.stdout)

    def statistics(self, *words, code=0, **environment):
        self.clrt(*words, "--json=stats.json", code=code, **environment)
        return self.json_of("stats.json")

    def expect(self, report, **values):
        """Compares parts of a report. In the names of arguments, two underscores separate nested keys."""
        for name, expected in values.items():
            found = report
            for key in name.split("__"):
                found = found[key]
            self.assertEqual(found, expected, name)

    def picture(self, scene, *words, says=""):
        done = self.run_clrt(scene, "-o", "picture.pfm", "-s", "96x64", *words)
        self.assertEqual((done.stderr, done.returncode), (says, 0))
        return self.bytes_of("picture.pfm")

    def expect_same(self, one, other, *words):
        """Expects that two scenes give the same picture."""
        self.assertTrue(self.picture(one, *words) == self.picture(other, *words), (one, other, words))

    def refuses(self, code, keyword, *words, **environment):
        """Expects that clrt exits with `code` and prints one message that contains the keyword."""
        message = self.clrt(*words, code=code, **environment)
        self.assertIn(keyword, message, words)
        self.assertRegex(message, r"^clrt: .*\n$", words)

    def fails(self, sentence, *words):
        self.refuses(3, sentence, *words, "-o", "picture.pfm")


class SharedWork(Work):
    """All tests of a class share one folder. prepare() writes the files that the tests read."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.work = pathlib.Path(folder.name)
        cls("prepare").prepare()

    def setUp(self):
        """Does nothing, because the folder exists already."""
