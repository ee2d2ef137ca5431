# SPDX-License-Identifier: MIT
# A folder for each test and runs of clrt in it, for tests whose words are CLRT 1|0, the latter for a
# build without Assimp.
import pathlib
import subprocess
import sys
import tempfile
import unittest

CLRT, ASSIMP = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2] == "1"


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

    def clrt(self, *words):
        return subprocess.run(
            [CLRT, *words], cwd=self.work, capture_output=True, text=True, timeout=300
        )

    def picture(self, scene, *words, says=""):
        done = self.clrt(scene, "-o", "picture.pfm", "-s", "96x64", *words)
        self.assertEqual((done.stderr, done.returncode), (says, 0))
        return (self.work / "picture.pfm").read_bytes()

    def fails(self, sentence, *words):
        done = self.clrt(*words, "-o", "picture.pfm")
        self.assertEqual((done.stderr, done.returncode), (f"clrt: {sentence}\n", 3))
