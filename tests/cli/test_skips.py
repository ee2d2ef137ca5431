#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that ctest reports a test as skipped, with the reason, if the machine lacks the test's
# programs. Usage: test_skips.py CTEST BUILD_FOLDER
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

from skips import ctest_output

CTEST, BUILD = sys.argv[1:3]
PRESENT = "bash", "dirname", "env", "id", "python3", "readlink"


class Skips(unittest.TestCase):
    def run_label(self, label):
        """Returns ctest's output for the tests with this label on a machine with few programs."""
        with tempfile.TemporaryDirectory() as folder:
            for name in PRESENT:
                pathlib.Path(folder, name).symlink_to(shutil.which(name))
            return ctest_output(CTEST, BUILD, "-V", "-C", label, "-L", f"^{label}$",
                                env={**os.environ, "PATH": folder})

    def test_lists_of_tests_keep_the_log_of_the_build(self):
        logs = pathlib.Path(BUILD, "Testing/Temporary").glob("LastTest.log*")
        before = {path: path.read_bytes() for path in logs}
        ctest_output(CTEST, BUILD, "--show-only")
        for path, text in before.items():
            self.assertTrue(path.read_bytes().startswith(text), path)

    def test_tests_by_label_are_skipped_with_their_reasons(self):
        root = os.geteuid() == 0
        for label, reason in (("farm", "missing (tools/setup farm): slurmctld, " if root else "only root"),
                              ("fresh", "mmdebstrap is not installed" if root else "only root")):
            output = self.run_label(label)
            self.assertIn(f"skipped: {reason}", output)
            self.assertIn("***Skipped", output)
            self.assertNotIn("   Passed", output)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
