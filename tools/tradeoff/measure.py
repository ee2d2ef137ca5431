# SPDX-License-Identifier: MIT
"""Measures the settings of a scene. Each gets a row of figures: times, and errors relative to one
reference."""

import json
import pathlib
import re
import resource
import statistics
import subprocess
import sys

from benchmark import common
from tradeoff import front, goals, grid, uniform

# The number of pictures that a process draws. With a time goal, the process draws one picture
# fewer. The first picture includes late initialization, so only the later pictures are timed.
FRAMES = 3

# With --processor-time, the frames after a process's first frame together take at least this number
# of seconds. However, no process draws more than MOST_FRAMES.
PROCESSOR_SECONDS = 0.5
MOST_FRAMES = 1000


def names_of(paths):
    """Returns the files' names without endings. Repeated names get a number."""
    names = []
    for path in paths:
        stem = pathlib.Path(path).stem
        same = sum(name == stem or name.startswith(f"{stem}-") for name in names)
        names.append(f"{stem}-{same + 1}" if same else stem)
    return names


def run_clrt(words, may_miss=False):
    """Runs clrt. With may_miss, exit status 1 is allowed, because clrt may miss an error goal."""
    done = subprocess.run([common.CLRT, *map(str, words)], capture_output=True, text=True,
                          check=False)
    if done.returncode not in ([0, 1] if may_miss else [0]):
        sys.exit(f"clrt {' '.join(map(str, words))}: {done.stderr}")
    return done


def draw_reference(scene, options, folder):
    """Writes a reference to folder. Returns the report of the run."""
    report = folder / "reference.json"
    run_clrt([scene, "-q", "-o", folder / "unused.pfm", *options.clrt_words,
              f"--reference={folder / 'reference.pfm'}",
              f"--reference-samples={options.reference_samples}", f"--json={report}"])
    return json.loads(report.read_text())


def compare(picture, reference, picture_map=None):
    words = ["-o", picture_map] if picture_map else []
    return json.loads(run_clrt(["compare", reference, picture, "--json", *words]).stdout)


def draw(setting, scene, options, picture, *more):
    """Draws the scene with a setting. Returns the finished process."""
    return run_clrt([scene, "-q", "-o", picture, *options.clrt_words, *setting.words, *more],
                    may_miss=setting.kind == "error")


def first_row(place, setting, scene, options, folder):
    """Draws a setting's picture with statistics, and compares it with the reference."""
    picture, report = folder / f"{place}.pfm", folder / f"{place}.json"
    # Compiles the kernels first. Otherwise, settings with few samples would select kernels that
    # compile sooner.
    kernels = [word for word in setting.words if not word.startswith(("--aa=", "--max-level"))]
    run_clrt(["warm", "-q", scene, *kernels])
    draw(setting, scene, options, picture, f"--json={report}")
    if setting.kind == "time":  # counting is slow, so a time goal would give another picture
        draw(setting, scene, options, picture)
    told = compare(picture, folder / "reference.pfm", folder / f"{place}-map.png")
    statistics_of = json.loads(report.read_text())
    return {"kind": setting.kind, "setting": setting.name, "words": setting.words,
            "goal": setting.goal, "rmse": told["rmse"], "psnr": told["psnr"],
            "maximum": told["maximum"]["value"], "share_off_by_1": told["off_by_1"]["share"],
            "share_off_by_4": told["off_by_4"]["share"],
            "samples": statistics_of["samples"]["total"],
            "estimate": statistics_of["samples"]["error_estimate"] if setting.goal else None,
            "rays": statistics_of["rays"]["total"], "bytes": statistics_of["bytes"]["uploaded"],
            "pixel_hash": statistics_of["pixel_hash"], "picture": picture.name,
            "map": f"{place}-map.png", "times": []}


def holding_settings(rows, scene, options, folder):
    """Returns uniform settings that rows do not contain: the fewest samples that meet each error
    goal, and the last trial of a user who doubles N."""
    tried = {uniform.side_of(row): row["rmse"] for row in rows if row["kind"] == "uniform"}
    known = set(tried)

    def rmse_of(side):
        draw(grid.plain([side])[0], scene, options, folder / "unused.pfm")
        return compare(folder / "unused.pfm", folder / "reference.pfm")["rmse"]

    sides = {uniform.side_that_holds(row["goal"], tried, rmse_of) for row in rows
             if row["kind"] == "error"} - {None}
    sides |= {uniform.next_power(side) for side in sides}
    return grid.plain(sorted(sides - known))


def processor_seconds():
    """Returns the processor time of this program's ended child processes."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def time_frames(row, frames, scene, options, folder):
    """Draws a row's picture several times in one process. Returns the tracing times of the frames
    and the processor time of the process."""
    before = processor_seconds()
    done = run_clrt([scene, "-v", "--repeat", frames, "-o", folder / "unused.pfm",
                     *options.clrt_words, *row["words"]], may_miss=row["kind"] == "error")
    traced = [float(text) for text in re.findall(r"traced in ([0-9.]+) s", done.stderr)]
    return traced, processor_seconds() - before


def frame_seconds(seconds_of):
    """Returns the processor time of a frame. seconds_of(N) is the processor time of a process that
    draws N frames."""
    start, frames = seconds_of(1), 2
    while True:
        seconds = seconds_of(frames) - start
        if seconds >= PROCESSOR_SECONDS or frames == MOST_FRAMES:
            return seconds / (frames - 1)
        growth = max(2, 1.2 * PROCESSOR_SECONDS / max(seconds, 0.01))
        frames = min(1 + round(growth * (frames - 1)), MOST_FRAMES)


def time_row(row, scene, options, folder):
    if options.processor_time:
        seconds = frame_seconds(
            lambda frames: time_frames(row, frames, scene, options, folder)[1])
    else:
        frames = FRAMES - 1 if row["kind"] == "time" else FRAMES
        seconds = min(time_frames(row, frames, scene, options, folder)[0][1:])
    row["times"].append(seconds)


def finish_row(row):
    times = [1e3 * seconds for seconds in row["times"]]
    row["milliseconds"] = statistics.median(times)
    row["fastest"], row["slowest"] = min(times), max(times)
    row["megarays_per_second"] = row["rays"] / row["milliseconds"] / 1e3


def report_progress(scene, text):
    print(f"{scene}: {text}", file=sys.stderr)


def first_rows(scene, options, folder):
    rows, settings = [], grid.all_settings(options.quick, options.kinds)
    for place, setting in enumerate(settings):
        report_progress(scene, f"setting {place + 1} of {len(settings)}")
        rows.append(first_row(place, setting, scene, options, folder))
    more = holding_settings(rows, scene, options, folder)
    return rows + [first_row(len(rows) + place, setting, scene, options, folder)
                   for place, setting in enumerate(more)]


def tasks_of(options):
    """Returns the tasks of the grid: place in its scene's grid, setting, scene and folder."""
    settings = grid.all_settings(options.quick, options.kinds)
    return [(place, setting, scene, options.output / name)
            for scene, name in zip(options.scenes, names_of(options.scenes))
            for place, setting in enumerate(settings)]


def missing_references(options):
    return [number for number, name in enumerate(names_of(options.scenes), 1)
            if not (options.output / name / "reference.json").exists()]


def missing_settings(options):
    return [number for number, (place, *_, folder) in enumerate(tasks_of(options), 1)
            if not (folder / f"{place}.row").exists()]


def run_task(options):
    """Draws one reference, or measures one setting and stores its row."""
    kind, number = options.task.split("-")
    if kind == "reference":
        scene = options.scenes[int(number) - 1]
        folder = options.output / names_of(options.scenes)[int(number) - 1]
        folder.mkdir(parents=True, exist_ok=True)
        draw_reference(scene, options, folder)
        return
    place, setting, scene, folder = tasks_of(options)[int(number) - 1]
    row = first_row(place, setting, scene, options, folder)
    for _ in range(options.runs):
        time_row(row, scene, options, folder)
    partial = folder / f"{place}.row.part"
    partial.write_text(json.dumps(row))
    partial.rename(folder / f"{place}.row")


def stored_rows(scene, options, folder):
    """Returns the rows of run_task, and rows of more uniform settings that meet the error goals."""
    places = range(len(grid.all_settings(options.quick, options.kinds)))
    rows = [json.loads((folder / f"{place}.row").read_text()) for place in places]
    more = [first_row(len(rows) + place, setting, scene, options, folder)
            for place, setting in enumerate(holding_settings(rows, scene, options, folder))]
    for row in more * options.runs:
        time_row(row, scene, options, folder)
    return rows + more


def measured_rows(scene, options, folder):
    """Measures all settings of a scene. The settings alternate, so that drift of the machine
    affects all of them."""
    rows = first_rows(scene, options, folder)
    for turn in range(options.runs):
        report_progress(scene, f"round {turn + 1} of {options.runs}")
        for row in rows if turn % 2 == 0 else reversed(rows):
            time_row(row, scene, options, folder)
    return rows


def measure_scene(scene, name, options, folder):
    """Returns all figures of one scene."""
    folder.mkdir(parents=True, exist_ok=True)
    if options.task:
        report = json.loads((folder / "reference.json").read_text())
        rows = stored_rows(scene, options, folder)
    else:
        report_progress(scene, "reference")
        report, rows = draw_reference(scene, options, folder), measured_rows(scene, options, folder)
    for row in rows:
        finish_row(row)
    front.mark(rows)
    return {"scene": name, "path": str(scene), "rows": rows, "goals": goals.judge(rows),
            "clock": "processor time" if options.processor_time else "time",
            "reference": report["reference"], "device": report["device"],
            "version": report["version"], "settings": report["settings"],
            "triangles": report["scene"]["triangles"]}
