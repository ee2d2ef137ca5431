# SPDX-License-Identifier: MIT
# Runs of clrt with a separate kernel cache for each test. The first argument of these tests is
# CLRT.
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CLRT = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = str(ROOT / "scenes/reflections.scn")
# These kernels compile fastest.
PICTURE = [SCENE, "-s", "48x32", "-q", "--kernel=ray", "--nodes=pair", "--specialize=never"]
CHOSEN = ("POCL_CACHE_DIR", "XDG_CACHE_HOME", "TMPDIR", "CLRT_KERNEL_DIR")


# Each test gets a copy of a cache that contains PICTURE's kernels, and the expected picture.
class CacheWork(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if CacheWork.compiled is None:
            CacheWork.compiled = tempfile.TemporaryDirectory()
            made = cls("setUp")
            made.cache, made.work = (pathlib.Path(CacheWork.compiled.name),) * 2
            CacheWork.expected = made.draw()
            (made.work / "picture.pfm").unlink()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        self.cache = self.work / "cache"
        shutil.copytree(CacheWork.compiled.name, self.cache)

    compiled = expected = None

    def environment(self, **more):
        kept = {key: value for key, value in os.environ.items() if key not in CHOSEN}
        return {**kept, "XDG_CACHE_HOME": str(self.cache), **more}

    def run_clrt(self, *words, before=(), more=None, **others):
        picture = self.work / "picture.pfm"
        picture.unlink(missing_ok=True)
        command = [*before, str(CLRT), *(words or PICTURE), "-o", str(picture)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120,
                              env=self.environment(**(more or {})), **others)
        bytes_written = picture.read_bytes() if picture.exists() else None
        return done.returncode, done.stderr, bytes_written

    def draw(self, *words, **more):
        status, talk, picture = self.run_clrt(*words, **more)
        self.assertEqual((status, talk), (0, ""))
        return picture

    def assert_told(self, done, sentence):
        status, talk, picture = done
        self.assertEqual((status, picture), (4, None), talk)
        self.assertEqual(talk.count("\n"), 1, talk)
        self.assertRegex(talk, f"^clrt: {sentence}")

    def files(self):
        return sorted(path for path in self.cache.rglob("*") if path.is_file())

    def kernels(self):
        """Returns the modification time of each compiled kernel."""
        return {path: path.stat().st_mtime_ns for path in self.cache.rglob("*.so")}
