#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Follows docs/tutorial.md: writes its scenes, runs its commands and compares the pictures with the
# pictures on the page. Usage: test_tutorial.py CLRT 1|0, with 0 for a build without Assimp
import pathlib
import re
import subprocess
import sys
import unittest

from skips import leave
from work import CLRT, ROOT, SharedWork, main

PAGE = ROOT / "docs/tutorial.md"
SHOWCASE = ROOT / "scenes/showcase.scn"
STEPS = 13 if sys.argv[2] == "1" else 10  # the last three need Assimp
TEXT = PAGE.read_text().partition(f"\n## {STEPS + 1}.")[0]
SCRIPT = re.findall(r"^```(\w+)\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
PICTURES = re.findall(r"\]\((tutorial/[^)]+\.png)\)", TEXT)


def shell_text(kind, text):
    """Returns the shell commands for a block of the page. Scene text that starts with a file's name
    or with the size replaces the file. Other scene text is appended to the file."""
    if kind == "sh":
        return text
    name = re.match(r"// (\w+\.scn)\n", text)
    is_whole = name or text.startswith("size")
    return f"cat {'>' if is_whole else '>>'}{name[1] if name else 'studio.scn'} <<'END'\n{text}END\n"


def statements(scene):
    """Returns the statements of a scene without comments and without the size."""
    lines = (line.partition("#")[0].split() for line in scene.read_text().splitlines())
    return [line for line in lines if line and line[0] != "size"]


class Tutorial(SharedWork):
    def prepare(self):
        home = self.work / "clrt"
        (home / "build").mkdir(parents=True)
        (home / "build/release").symlink_to(CLRT.parent)
        (home / "scenes").symlink_to(ROOT / "scenes")
        script = "set -eu\n" + "".join(shell_text(*block) for block in SCRIPT)
        done = subprocess.run(["bash", "-c", script], cwd=home, capture_output=True, text=True, timeout=1200)
        if done.returncode != 0:
            raise AssertionError(f"the tutorial's commands fail:\n{done.stderr}")

    def test_each_step_has_a_picture(self):
        self.assertEqual(PICTURES, [f"tutorial/step{step}.png" for step in range(1, STEPS + 1)])
        for picture in PICTURES:
            self.assertLess((ROOT / "docs" / picture).stat().st_size, 65e3, picture)

    def test_the_page_shows_the_pictures_of_its_commands(self):
        for picture in PICTURES:
            mine = f"studio/{pathlib.Path(picture).name}"
            self.clrt("compare", mine, ROOT / "docs" / picture, "--fail", "max=0")

    def test_the_last_scene_is_the_showcase(self):
        mine, its = statements(self.work / "studio/studio.scn"), statements(SHOWCASE)
        self.assertEqual(sorted(mine), sorted(its))
        self.clrt(SHOWCASE, "--aa", "-s", "320x180", "-o", "showcase.png", "-q")
        self.clrt("compare", "showcase.png", "studio/step9.png", "--fail", "max=0")

    def test_the_readme_shows_the_showcase(self):
        self.clrt("compare", "studio/showcase.png", ROOT / "scenes/showcase.png", "--fail", "max=0")


if __name__ == "__main__":
    if not (ROOT / "scenes/models/coral.ply").exists():
        leave("the models of scenes/ are not built")
    main(2)
