#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Devices without fp64 can compile the kernels: without CLRT_FP64, no line names a double.
# Usage: test_doubles.py C_COMPILER
import itertools
import pathlib
import subprocess
import sys
import unittest

KERNELS = pathlib.Path(__file__).resolve().parents[2] / "kernels"
SWITCHES = "CLRT_WIDE_NODES", "CLRT_PACKET", "CLRT_SIGNATURES", "CLRT_STATISTICS"


def count_doubles(file, *switches):
    command = [sys.argv[1], "-E", "-P", "-xc", *(f"-D{switch}=1" for switch in switches), file]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.count("double")


class Doubles(unittest.TestCase):
    def test_kernels_without_fp64_name_no_double(self):
        files = [file for file in KERNELS.glob("*.cl") if not file.name.startswith("certify")]  # fp64 alone
        chosen = [[name for name, is_on in zip(SWITCHES, values) if is_on]
                  for values in itertools.product([0, 1], repeat=len(SWITCHES))]
        for file, switches in [*((KERNELS / "render.cl", some) for some in chosen), *((file, []) for file in files)]:
            self.assertEqual(count_doubles(file, *switches), 0, (file, switches))
        self.assertGreater(count_doubles(KERNELS / "render.cl", "CLRT_FP64"), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
