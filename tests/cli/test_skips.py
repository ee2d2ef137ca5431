#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests that ctest reports a test as skipped, with its reason, if the machine lacks its programs. Usage:
# test_skips.py CTEST BUILD_FOLDER
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CTEST, BUILD = sys.argv[1:3]
PRESENT = "bash", "dirname", "env", "id", "python3", "readlink"


class Skips(unittest.TestCase):
    def run_label(self, label):
        """Returns ctest's output on a machine with few programs. The log is separate from the build's."""
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "CTestTestfile.cmake").write_text(f'subdirs("{BUILD}/tests")\n')
            programs = pathlib.Path(folder, "bin")
            programs.mkdir()
            for name in PRESENT:
                (programs / name).symlink_to(shutil.which(name))
            command = [CTEST, "--test-dir", folder, "-V", "-C", label, "-L", f"^{label}$"]
            return subprocess.run(command, env={**os.environ, "PATH": str(programs)}, capture_output=True,
                                  check=True, text=True).stdout

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
