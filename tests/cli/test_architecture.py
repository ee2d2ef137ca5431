#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that the functions on the paths in docs/architecture.md are in the files that the page names.
# Usage: test_architecture.py
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILES = [file for folder in ("host", "kernels") for file in sorted((ROOT / folder).rglob("*.*"))
         if file.suffix in (".c", ".h", ".cl", ".py")]


def paths():
    """Returns the rows of the tables of paths."""
    page = (ROOT / "docs/architecture.md").read_text()
    section = page.split("\n## The path of a pixel\n")[1].split("\n## ")[0]
    return [line for line in section.splitlines() if line.startswith("|") and "`" in line]


def named_files(row):
    """Yields each file name in a row, with the files of this name. A .c file includes its header."""
    for name in re.findall(r"`([^`]+\.(?:c|cl|py))`", row):
        ends = "/" + name, "/" + name.removesuffix(".c") + ".h"
        yield name, [file for file in FILES if file.as_posix().endswith(ends)]


def defines(file, function):
    """Returns whether the file defines the function, at the start of a line or as a method."""
    return re.search(rf"^(?:[A-Za-z][^;=\n]*[ *]|\s*def ){function}\(", file.read_text(), re.MULTILINE)


class Paths(unittest.TestCase):
    def test_every_file_exists(self):
        self.assertGreater(len(paths()), 40)
        for row in paths():
            for name, files in named_files(row):
                self.assertTrue(files, name)

    def test_every_function_is_in_a_file_of_its_row(self):
        folders = {file.parent.name for file in FILES}
        for row in paths():
            files = [file for _, named in named_files(row) for file in named]
            for name in re.findall(r"`(?:Renderer\.)?([a-z_0-9]+)`", row):
                if name not in folders:
                    self.assertTrue(any(defines(file, name) for file in files), name)


if __name__ == "__main__":
    unittest.main()
