# SPDX-License-Identifier: MIT
"""Functions for all comparisons: paths, runs of clrt, and figures as text."""

import json
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
COURSE = ROOT.parent / "shared" / "course" / "scenes"
BUILD = ROOT / "build" / "release"
CLRT = os.environ.get("CLRT", str(BUILD / "clrt"))


def compile_ahead():
    """Compiles the kernels. Otherwise clrt would draw small pictures with kernels that compile
    faster."""
    subprocess.run([CLRT, "warm", "-q"], check=True)


def draw(scene, options, folder, frames=1):
    """Draws a scene `frames` times in one run of clrt. Returns the seconds of each picture."""
    frames = ["--repeat", str(frames)] if frames > 1 else []
    done = subprocess.run([CLRT, str(scene), "-v", "-o", f"{folder}/clrt.pfm", *frames,
                           *options], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return [float(text) for text in re.findall(r"traced in ([0-9.]+) s", done.stderr)]


def report(scene, options, folder):
    """Returns the statistics of one picture, including rays and tests."""
    path = pathlib.Path(folder) / "clrt.json"
    subprocess.run([CLRT, str(scene), "-q", "-o", f"{folder}/clrt.pfm", f"--json={path}",
                    *options], check=True)
    return json.loads(path.read_text())


def has_option(name):
    return name in subprocess.run([CLRT, "--help"], capture_output=True, text=True,
                                  check=True).stdout


def threads_of_machine():
    return len(os.sched_getaffinity(0))


def machine():
    cpu = platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            cpu = line.split(":", 1)[1].strip()
            break
    return {"cpu": cpu, "threads": threads_of_machine()}


def show(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def milliseconds(times):
    return statistics.median(times) * 1e3


def write_json(path, value):
    if path:
        pathlib.Path(path).write_text(json.dumps(value, indent=2, sort_keys=True) + "\n")
