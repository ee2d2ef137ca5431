# SPDX-License-Identifier: MIT
"""A scene and settings -> rows of figures: time, and error against one reference."""

import json
import pathlib
import re
import statistics
import subprocess
import sys

from benchmark import common
from tradeoff import front, grid

# Pictures that a process draws: the first pays for what comes late, the others are timed.
FRAMES = 3


def run_clrt(words):
    done = subprocess.run([common.CLRT, *map(str, words)], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"clrt {' '.join(map(str, words))}: {done.stderr}")
    return done


def draw_reference(scene, options, folder):
    """The report of a run with a reference, which is written to folder."""
    report = folder / "reference.json"
    run_clrt([scene, "-q", "-o", folder / "unused.pfm", *options.clrt_words,
              f"--reference={folder / 'reference.pfm'}",
              f"--reference-samples={options.reference_samples}", f"--stats={report}"])
    return json.loads(report.read_text())


def compare(picture, reference, picture_map=None):
    words = ["-o", picture_map] if picture_map else []
    return json.loads(run_clrt(["compare", reference, picture, "--json", *words]).stdout)


def first_row(place, name, words, scene, options, folder):
    """Draws a setting's picture, with statistics of a run of its own, and judges it."""
    picture, report = folder / f"{place}.pfm", folder / f"{place}.json"
    run_clrt([scene, "-q", "-o", picture, *options.clrt_words, *words])
    run_clrt([scene, "-q", "-o", folder / "unused.pfm", f"--stats={report}", *options.clrt_words,
              *words])
    told = compare(picture, folder / "reference.pfm", folder / f"{place}-map.png")
    statistics_of = json.loads(report.read_text())
    return {"setting": name, "words": words, "rmse": told["rmse"], "psnr": told["psnr"],
            "maximum": told["maximum"]["value"], "share_off_by_1": told["off_by_1"]["share"],
            "share_off_by_4": told["off_by_4"]["share"],
            "rays": statistics_of["rays"]["total"], "bytes": statistics_of["bytes"]["uploaded"],
            "pixel_hash": statistics_of["pixel_hash"], "picture": picture.name,
            "map": f"{place}-map.png", "times": []}


def time_row(row, scene, options, folder):
    done = run_clrt([scene, "-q", "-v", "--repeat", FRAMES, "-o", folder / "unused.pfm",
                     *options.clrt_words, *row["words"]])
    frames = [float(text) for text in re.findall(r"traced in ([0-9.]+) s", done.stderr)]
    row["times"].append(min(frames[1:]))


def finish_row(row):
    times = [1e3 * seconds for seconds in row["times"]]
    row["milliseconds"] = statistics.median(times)
    row["fastest"], row["slowest"] = min(times), max(times)
    row["megarays_per_second"] = row["rays"] / row["milliseconds"] / 1e3


def measure_scene(scene, options, folder):
    """All figures of one scene.  Settings alternate, so that none has the quiet hours."""
    folder.mkdir(parents=True, exist_ok=True)
    report = draw_reference(scene, options, folder)
    rows = [first_row(place, name, words, scene, options, folder)
            for place, (name, words) in enumerate(grid.all_settings(options.quick))]
    for turn in range(options.runs):
        for row in rows if turn % 2 == 0 else reversed(rows):
            time_row(row, scene, options, folder)
        print(f"{scene}: round {turn + 1} of {options.runs}", file=sys.stderr)
    for row in rows:
        finish_row(row)
    front.mark(rows)
    return {"scene": pathlib.Path(scene).stem, "path": str(scene), "rows": rows,
            "reference": report["reference"], "device": report["device"],
            "version": report["version"], "settings": report["settings"],
            "triangles": report["scene"]["triangles"]}
