#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests tools/gpu in its short mode on the CPU. Usage: test_gpu_tool.py BUILD_FOLDER
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv[1])
TOOL = pathlib.Path(__file__).resolve().parent.parent.parent / "tools" / "gpu"


def report_of(*words, **variables):
    """Returns the exit status and the report of tools/gpu."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "report.md"
        done = subprocess.run([TOOL, "--short", "-o", path, *words], capture_output=True, text=True,
                              env={**os.environ, "CLRT": str(BUILD / "clrt"), **variables})
        return done.returncode, path.read_text() if path.exists() else done.stderr


class Tool(unittest.TestCase):
    def test_report_of_a_cpu(self):
        status, report = report_of("--device", "cpu", "--build-options=-Dkernel=none",
                                   "--build-options=-DUNUSED")
        self.assertIn("**pair, -Dkernel=none failed**", report)
        self.assertTrue(status == 1 and report.endswith("\n1 faults.\n"), report)
        self.assertIn("The device's arithmetic is exact.", report)
        self.assertRegex(report, r"\| pair, as on a GPU \| passed \| \d+ pictures checked, 0 have")
        self.assertRegex(report, r"\| test_launch_faults \| passed ")
        for setting in ("pair", "pair, tile 128x128", "pair, group 8x4", "pair, -DUNUSED"):
            row = re.search(rf"\| {setting} \| [\d.]+ \| ([\d.]+) \| ([\d.]+)% \| ([\d.]+)% \|", report)
            self.assertIsNotNone(row, setting)
            self.assertTrue(all(float(figure) > 0 for figure in row.groups()), row[0])
        self.assertIn("## Counters", report)

    def test_wrong_arithmetic_ends_the_run(self):
        status, report = report_of("--device", "cpu", LD_PRELOAD=str(BUILD / "libfail_device.so"),
                                   CLRT_FIRST_LINES="#define fma(a, b, c) ((a) * (b) + (c))\n")
        self.assertEqual(status, 1)
        self.assertIn("**The first picture failed.**", report)
        self.assertNotIn("## Hashes", report)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
