#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the extremes with ctest and writes a table of the tests and a list of all cases.

Usage: tests/extremes/gather.py BUILD_FOLDER [-o FILE] [--tiers 2,1,0]
The output goes to FILE, or to extremes.md in the build folder. Results of tier 0 count only for
tests that no other tier runs. Exits with ctest's status: 0 if every test passed.
"""
import argparse
import datetime
import os
import pathlib
import re
import subprocess
import sys

CASE = re.compile(r"^(?:\d+: )?((T-\d\d) form=(\S+) .*?)(rays=.*)$", re.MULTILINE)
COLUMNS = [("packet", "fail"), ("wide", "fail"), ("pair", "fail"), ("packet", "embree_default"),
           ("packet", "embree_robust")]
HEAD = """# The extremes, measured

Made by `tests/extremes/gather.py` on {date}, on an {machine}.

tests/extremes/README.md describes the tests and the lines of cases. `rays` counts the rays, pixels
or boxes of a test in one form of the kernels. The columns packet, wide and pair contain the
failures of the three forms. The columns of Embree contain the failures of Embree 3.13.5 on the same
rays and triangles, in its default and robust modes. An empty cell means that no case was run. A
test holds if no case has more failures than its limit.

| test | what | | cases | rays | packet | wide | pair | Embree default | Embree robust |
|---|---|---|---|---|---|---|---|---|---|
"""


def titles():
    """Returns the title of each test, from the first table of tests in README.md."""
    readme = (pathlib.Path(__file__).parent / "README.md").read_text(encoding="utf-8")
    readme = readme.partition("Other tests contain the missing numbers")[0]
    rows = re.findall(r"^\| (\d+) \| ([^|]+) \| [^|]+ \|$", readme, re.MULTILINE)
    return {f"T-{int(number):02}": title.strip() for number, title in rows}


def run_tier(build, tier):
    """Returns the verbose output of a tier and ctest's status."""
    label = "extremes" if tier == 0 else f"extremes{tier}"
    done = subprocess.run(["ctest", "--test-dir", build, "-V", "-L", f"^{label}$", "-C", label],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False)
    return done.stdout, done.returncode


def machine():
    """Returns the name and the number of the processors."""
    info = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    names = re.findall(r"^model name\s*: (.*)$", info, re.MULTILINE) or ["unknown"]
    return f"{names[0]} with {os.cpu_count()} processors"


def figures(line):
    return {name: int(value) for name, value in re.findall(r"\b(\w+)=(\d+)(?= |$)", line)}


def row(test, title, cases):
    """Returns a row of the table. cases are pairs of a form and a line that a test printed."""
    def total(form, field):
        found = [figures(line).get(field) for its, line in cases if its == form]
        return sum(filter(None, found)) if any(value is not None for value in found) else None

    if not cases:
        return f"| {test} | {title} | not run ||||||||"
    holds = all(figures(line)["fail"] <= figures(line)["limit"] for _, line in cases)
    forms = [form for form, _ in cases]
    cells = [max(map(forms.count, forms)), max(total(form, "rays") for form in forms),
             *(total(form, field) for form, field in COLUMNS)]
    texts = [f"{value:,}" if value is not None else "" for value in cells]
    return " | ".join([f"| {test} | {title}", "holds" if holds else "**fails**", *texts]) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build")
    parser.add_argument("-o", dest="output")
    parser.add_argument("--tiers", default="2,1,0")
    options = parser.parse_args()
    cases, status = {}, 0
    for tier in sorted(map(int, options.tiers.split(",")), reverse=True):
        output, code = run_tier(options.build, tier)
        known = set(cases) if tier == 0 else set()
        for case, test, form, counts in CASE.findall(output):
            if test not in known:  # setdefault keeps the first line of a case that two tiers share
                cases.setdefault(test, {}).setdefault(case, (form, case + counts))
        status = status or code
    with open(options.output or os.path.join(options.build, "extremes.md"), "w", encoding="utf-8") as out:
        out.write(HEAD.format(date=datetime.date.today(), machine=machine()))
        for test, title in sorted(titles().items()):
            out.write(row(test, title, [*cases.get(test, {}).values()]) + "\n")
        out.write("\n".join(["\n## All cases\n\n```", *(line for test in sorted(cases)
                                                      for _, line in cases[test].values()), "```\n"]))
    return status


if __name__ == "__main__":
    sys.exit(main())
