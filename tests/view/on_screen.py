#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a command with its own display. Usage: on_screen.py COMMAND..."""

import subprocess
import sys

from screen import Screen

screen = Screen()
code = subprocess.run(sys.argv[1:], env=screen.environment(), check=False).returncode
screen.close()
sys.exit(code)
