# SPDX-License-Identifier: MIT
# A folder for each test and runs of clrt in it, for tests whose first word is CLRT.
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
        """Files by name, in which the last underscore stands for the point."""
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
        """Returns its standard output or, if it shall fail with code, its standard error."""
        done = self.run_clrt(*words, **environment)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr if code else done.stdout

    def picture(self, scene, *words, says=""):
        done = self.run_clrt(scene, "-o", "picture.pfm", "-s", "96x64", *words)
        self.assertEqual((done.stderr, done.returncode), (says, 0))
        return self.bytes_of("picture.pfm")

    def fails(self, sentence, *words):
        self.assertEqual(self.clrt(*words, "-o", "picture.pfm", code=3), f"clrt: {sentence}\n")
