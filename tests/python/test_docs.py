#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the Python examples of the modules, of the documentation and of the README, and the notebook.

usage: test_docs.py CHECKOUT"""
import doctest
import importlib
import json
import os
import pathlib
import re
import sys
import unittest

try:
    import cffi  # pylint: disable=unused-import
    import numpy  # pylint: disable=unused-import
except ImportError as missing:
    print(f"skipped: {missing}; tools/setup python installs it")
    sys.exit(77)

CHECKOUT = pathlib.Path(sys.argv[1])
NOTEBOOK = CHECKOUT / "docs" / "python.ipynb"
FENCE = re.compile("^```.*$", re.MULTILINE)


class Examples(unittest.TestCase):
    def run_examples(self, test):
        runner = doctest.DocTestRunner()
        runner.run(test)
        self.assertGreater(runner.tries, 0, test.name)
        self.assertEqual(runner.failures, 0, test.name)

    def test_pages(self):
        for name in ("python.md", "python-pictures.md"):
            text = FENCE.sub("", (CHECKOUT / "docs" / name).read_text())
            self.run_examples(doctest.DocTestParser().get_doctest(text, {}, name, name, 0))

    def test_modules(self):
        for name in ("clrt", "clrt.scene"):
            module = importlib.import_module(name)
            for test in doctest.DocTestFinder(exclude_empty=True).find(module):
                if test.examples:
                    self.run_examples(test)

    def test_readme(self):
        blocks = re.findall("```python\n(.*?)```", (CHECKOUT / "README.md").read_text(), re.DOTALL)
        self.assertTrue(blocks)
        for block in blocks:
            names = {}
            exec(block, names)  # pylint: disable=exec-used
            self.assertEqual(names["picture"].ndim, 3)
            self.assertTrue(names["hits"].hit.all())


class Notebook(unittest.TestCase):
    def test_cells_run_as_a_program(self):
        cells = json.loads(NOTEBOOK.read_text())["cells"]
        names = {}
        for cell in cells:
            if cell["cell_type"] == "code":
                self.assertEqual(cell["outputs"], [], "the notebook is stored without outputs")
                exec("".join(cell["source"]), names)  # pylint: disable=exec-used
        self.assertLess(names["openness"].min(), names["openness"].max())

    def test_jupyter_shows_pictures(self):
        try:
            import ipykernel  # pylint: disable=unused-import
            import nbclient
            import nbformat
        except ImportError as missing:
            print(f"skipped: test_jupyter_shows_pictures: {missing}; tools/setup test installs it")
            self.skipTest(str(missing))
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
        outputs = [output for cell in notebook.cells if cell.cell_type == "code"
                   for output in cell.outputs]
        pictures = [output for output in outputs if "image/png" in output.get("data", {})]
        self.assertEqual(len(pictures), 2)
        self.assertTrue(any("faces are visible" in str(output) for output in outputs))


os.chdir(CHECKOUT)
unittest.main(argv=sys.argv[:1])
