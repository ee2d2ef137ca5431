# SPDX-License-Identifier: MIT
# Runs of clrt in a separate folder for each test. The first argument of these tests is CLRT.
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

CLRT = pathlib.Path(sys.argv[1]).resolve()


class Work(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)

    def write(self, **files):
        """Writes files. In their names, the last underscore means a dot."""
        for name, content in files.items():
            content = content.encode() if isinstance(content, str) else content
            path = self.work / ".".join(name.rsplit("_", 1))
            path.write_bytes(content)

    def bytes_of(self, name):
        return (self.work / name).read_bytes()

    def run_clrt(self, *words, **environment):
        return subprocess.run(
            [CLRT, *words],
            cwd=self.work,
            capture_output=True,
            text=True,
            env=dict(os.environ, **environment),
            timeout=300,
        )

    def clrt(self, *words, code=0, **environment):
        """Runs clrt. Returns its standard output, or its standard error if it must fail with
        code."""
        done = self.run_clrt(*words, **environment)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr if code else done.stdout

    def picture(self, scene, *words, says=""):
        done = self.run_clrt(scene, "-o", "picture.pfm", "-s", "96x64", *words)
        self.assertEqual((done.stderr, done.returncode), (says, 0))
        return self.bytes_of("picture.pfm")

    def fails(self, sentence, *words):
        self.assertEqual(self.clrt(*words, "-o", "picture.pfm", code=3), f"clrt: {sentence}\n")
