# SPDX-License-Identifier: MIT
# Skips tests that this machine cannot run, and reads ctest's reports.
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
    """Returns the output of ctest for the tests of a build. Even if ctest only lists tests, it
    replaces its log. tools/test reads the build's log, so this function uses a separate log."""
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
