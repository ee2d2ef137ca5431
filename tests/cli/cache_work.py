# SPDX-License-Identifier: MIT
# Runs clrt with a separate kernel cache for each test. Tests that import this module take CLRT as
# their first argument.
import os
import pathlib
import shutil
import tempfile

from work import ROOT, Work

# PICTURE uses the kernels that compile fastest.
PICTURE = [str(ROOT / "tests/cli/sphere.scn"), "-s", "48x32", "-q", "--tune=kernel=pair,specialize=always"]
CHOSEN = ("POCL_CACHE_DIR", "XDG_CACHE_HOME", "TMPDIR", "CLRT_KERNEL_DIR")


# Each test gets a copy of a cache with PICTURE's compiled kernels. `expected` is PICTURE's file.
class CacheWork(Work):
    compiled = expected = None

    @classmethod
    def setUpClass(cls):
        if CacheWork.compiled is None:
            CacheWork.compiled = tempfile.TemporaryDirectory()
            made = cls("setUp")
            made.cache, made.work = (pathlib.Path(CacheWork.compiled.name),) * 2
            CacheWork.expected = made.draw()
            (made.work / "picture.pfm").unlink()

    def setUp(self):
        super().setUp()
        self.cache = self.work / "cache"
        shutil.copytree(CacheWork.compiled.name, self.cache)

    def environment(self, **more):
        return dict.fromkeys(CHOSEN) | {"XDG_CACHE_HOME": str(self.cache)} | more

    def start_clrt(self, *words, **settings):
        kept = {name: value for name, value in os.environ.items() if name not in CHOSEN}
        return self.start(*words, env={**kept, "XDG_CACHE_HOME": str(self.cache)}, **settings)

    def run_picture(self, *words, before=(), **more):
        """Returns the exit status, standard error, and the picture or None."""
        picture = self.work / "picture.pfm"
        picture.unlink(missing_ok=True)
        done = self.run_clrt(*(words or PICTURE), "-o", picture, before=before, **self.environment(**more))
        return done.returncode, done.stderr, picture.read_bytes() if picture.exists() else None

    def draw(self, *words, **more):
        status, talk, picture = self.run_picture(*words, **more)
        self.assertEqual((status, talk), (0, ""))
        return picture

    def assert_told(self, done, sentence):
        status, talk, picture = done
        self.assertEqual((status, picture), (4, None), talk)
        self.assertEqual(talk.count("\n"), 1, talk)
        self.assertRegex(talk, f"^clrt: {sentence}")

    def files(self):
        return sorted(path for path in self.cache.rglob("*") if path.is_file())

    def programs(self):
        """Returns the modification time of each cached program."""
        return {path: path.stat().st_mtime_ns for path in self.cache.glob("clrt/*.bin")}

    def private_folders(self):
        return list(self.cache.glob("clrt/clrt-*"))
