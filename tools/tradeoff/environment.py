# SPDX-License-Identifier: MIT
"""Installs Python packages of fixed versions in a virtual environment under build/. The perceptual
figures and the page need these packages."""

import hashlib
import os
import pathlib
import subprocess
import sys

from benchmark import common

REQUIREMENTS = pathlib.Path(__file__).with_name("requirements.txt")
FOLDER = common.ROOT / "build" / "trade-venv"


def is_inside():
    return pathlib.Path(sys.prefix) == FOLDER


def install():
    """Creates the environment. Returns the reason on failure, None on success."""
    stamp = FOLDER / "installed"
    wanted = hashlib.sha256(REQUIREMENTS.read_bytes()).hexdigest()
    if stamp.exists() and stamp.read_text() == wanted:
        return None
    # Python compiles the modules that it imports. Without --no-compile, pip would compile 4,000.
    steps = [[sys.executable, "-m", "venv", "--clear", str(FOLDER)],
             [str(FOLDER / "bin" / "pip"), "install", "-q", "--disable-pip-version-check", "--no-compile",
              "--only-binary", ":all:", "-r", str(REQUIREMENTS)]]
    for step in steps:
        try:
            done = subprocess.run(step, capture_output=True, text=True, check=False)
        except OSError as fault:
            return str(fault)
        if done.returncode != 0:
            return (done.stderr or done.stdout).strip().splitlines()[-1]
    stamp.write_text(wanted)
    return None


def enter():
    """Restarts the program in the environment. Returns None if it already runs there, or the reason
    if installation fails."""
    if is_inside():
        return None
    reason = install()
    if reason is None:
        python = str(FOLDER / "bin" / "python")
        os.execv(python, [python, *sys.argv])
    return reason
