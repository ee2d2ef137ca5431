#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the extremes with ctest and writes a table of all cases.

Usage: tests/extremes/gather.py BUILD_FOLDER [-o FILE] [--tiers 2,1,0]
The table goes to FILE, or to extremes.md in the build folder. Tier 0 counts only for tests without
another tier. Exits with ctest's status: 0 if every test passed.
"""
import argparse
import datetime
import os
import re
import subprocess
import sys

LINE = re.compile(r"^(?:\d+: )?(T-\d\d) form=(\S+) (.*)$")
FIELD = re.compile(r"^(rays|fail|limit|embree_default|embree_robust)=(\d+)$")
FORMS = ["packet", "wide", "pair"]
PEERS = ("embree_default", "embree_robust")


def titles():
    """Returns the title of each test, from the table in README.md."""
    found = {}
    with open(os.path.join(sys.path[0], "README.md"), encoding="utf-8") as readme:
        for line in readme:
            row = re.match(r"^\| (\d+) \| ([^|]+) \| ([^|]+) \|", line)
            if row:
                found[f"T-{int(row[1]):02}"] = (row[2].strip(), row[3].strip())
    return found


def run_tier(build, tier):
    """Returns the verbose output of a tier and ctest's status."""
    label = "extremes" if tier == 0 else f"extremes{tier}"
    done = subprocess.run(["ctest", "--test-dir", build, "-V", "-L", f"^{label}$", "-C", label],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False)
    return done.stdout, done.returncode


def machine():
    """Returns the names of the processor and PoCL."""
    with open("/proc/cpuinfo", encoding="utf-8") as info:
        names = re.findall(r"^model name\s*: (.*)$", info.read(), re.MULTILINE) or ["unknown"]
    packages = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "libpocl2-common"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                              check=False).stdout or "unknown"
    return f"{names[0]} with {os.cpu_count()} processors, PoCL {packages.split('-')[0]}"


class Results:
    """All cases by test and details, with the figures of each form of the kernels."""

    def __init__(self):
        self.cases = {}

    def read(self, tier, output):
        known = {test for test, _ in self.cases} if tier == 0 else set()
        for line in output.splitlines():
            match = LINE.match(line)
            if not match or match[1] in known:
                continue
            test, form, rest = match.groups()
            self.add(test, form, rest.split(" "))

    def add(self, test, form, words):
        figures = {m[1]: int(m[2]) for m in map(FIELD.match, words) if m}
        measured = ("ulp=", "rmse=", "error=", "times=", "leaks=", "hits=", "blocked=", "depth=",
                    "largest_leaf=", "met=", "refused=", "seeds=")
        details = [w for w in words if not FIELD.match(w)]
        key = " ".join(w for w in details if not any(m in w for m in measured))
        case = self.cases.setdefault((test, key), {"forms": {}, "notes": {}})
        kept = case["forms"].get(form)
        # If several tiers run a case, the one with the most rays counts.
        if kept is None or figures["rays"] >= kept["rays"]:
            case["forms"][form] = figures
            case["notes"][form] = " ".join(w for w in details if any(m in w for m in measured))

    def of_test(self, test):
        return [(key, case) for (name, key), case in self.cases.items() if name == test]


def summed(cases, form, field):
    figures = [case["forms"].get(form, {}).get(field) for _, case in cases]
    figures = [f for f in figures if f is not None]
    return sum(figures) if figures else None


def cell(value):
    return "" if value is None else f"{value:,}"


def verdict(cases):
    fails = any(f["fail"] > f["limit"] for _, case in cases for f in case["forms"].values())
    return "**fails**" if fails else "holds"


def summary_row(results, test, title):
    cases = results.of_test(test)
    if not cases:
        return f"| {test} | {title} | not run ||||||||"
    rays = max((summed(cases, form, "rays") or 0) for form in FORMS)
    cells = [verdict(cases), cell(len(cases)), cell(rays)]
    cells += [cell(summed(cases, form, "fail")) for form in FORMS]
    cells += [cell(summed(cases, "packet", mode)) for mode in PEERS]
    return f"| {test} | {title} | " + " | ".join(cells) + " |"


def case_row(test, key, case):
    first = next((case["forms"][f] for f in FORMS if f in case["forms"]), None)
    note = next((case["notes"][f] for f in FORMS if case["notes"].get(f)), "")
    cells = [cell(first["rays"]), cell(first["limit"])]
    cells += [cell(case["forms"].get(form, {}).get("fail")) for form in FORMS]
    cells += [cell(case["forms"].get("packet", {}).get(mode)) for mode in PEERS]
    return f"| {test} | {key} | " + " | ".join(cells) + f" | {note} |"


def write(results, path):
    asked = titles()
    date = datetime.date.today()
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"""# The extremes, measured

Made by `tests/extremes/gather.py` on {date}, on an {machine()}.

tests/extremes/README.md describes the tests. `rays` counts the rays, pixels, boxes or files that a
test judges. The columns packet, wide and pair contain the failures of the kernels' three forms. The
columns of Embree contain the failures of Embree 3.13.5 on the same rays and triangles, in its
default and robust modes. An empty cell means that the case was not run. A test holds if no case has
more failures than its limit.

## Summary

| test | what | | cases | rays | packet | wide | pair | Embree default | Embree robust |
|---|---|---|---|---|---|---|---|---|---|
""")
        for test, (title, _) in sorted(asked.items()):
            out.write(summary_row(results, test, title) + "\n")
        out.write("""
## All cases

| test | case | rays | limit | packet | wide | pair | Embree default | Embree robust | measured |
|---|---|---|---|---|---|---|---|---|---|
""")
        for test in sorted(asked):
            for key, case in results.of_test(test):
                out.write(case_row(test, key, case) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build")
    parser.add_argument("-o", dest="output")
    parser.add_argument("--tiers", default="2,1,0")
    options = parser.parse_args()
    results, status = Results(), 0
    for tier in sorted(map(int, options.tiers.split(",")), reverse=True):
        output, code = run_tier(options.build, tier)
        results.read(tier, output)
        status = status or code
    write(results, options.output or os.path.join(options.build, "extremes.md"))
    return status


if __name__ == "__main__":
    sys.exit(main())
