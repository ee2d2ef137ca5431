# SPDX-License-Identifier: MIT
# Tests that this machine cannot run, and ctest's reports on them.
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77  # ctest reports a test with this exit status as skipped


def leave(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def ctest_output(ctest, build, *words, **settings):
    """Returns the output of ctest for the tests of a build. Its log is separate, because ctest replaces
    the log even if it only lists tests, and tools/test reads the log."""
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "CTestTestfile.cmake").write_text(f'subdirs("{build}/tests")\n')
        command = [ctest, "--test-dir", folder, *words]
        return subprocess.run(command, capture_output=True, check=True, text=True, **settings).stdout


def has_terminals():
    try:
        for end in os.openpty():
            os.close(end)
    except OSError:
        return False
    return True


needs_terminal = unittest.skipUnless(has_terminals(), "this machine has no terminals (/dev/pts)")
