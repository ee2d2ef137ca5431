#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws generated scenes with --error and measures the true error of every picture.

Writes a line for each scene to SEED-WIDTHxHEIGHT.jsonl, in a folder named after the program's hash.
A scene file can take the place of a seed. References, which all programs share, are beside this
folder. Skips scenes that have a line, so that an interrupted run resumes. Prints a summary. The
exit status is 1 if the results break the promise of --error."""

import argparse
import hashlib
import json
import math
import pathlib
import resource
import subprocess
import sys
import tempfile

import generate
import hidden
import summary

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GOALS = "0.02,0.01,0.005,0.002"

# A reference takes samples until its error is at most this fraction of the smallest goal, but at
# most REFERENCE_SAMPLES per pixel.
REFERENCE_PART = 0.2
REFERENCE_SAMPLES = 65536

# The largest N of --aa=N to compare with. The thresholds of --aa-adaptive are as in tools/trade.
LARGEST_SIDE = 24
THRESHOLDS = [0.3, 0.2, 0.1, 0.05, 0.04, 0.02, 0.01, 0.005, 0.002]

# Goals are compared with fixed settings (--aa and --aa-adaptive). With these options, fixed
# settings follow rays at least as far as the picture of the smallest goal does.
LEVELS = ["--max-level", "auto", "--encode", "raw"]

# The number of pictures that a timed process draws. The fastest picture counts. Processes that
# measure processor time instead draw pictures for about PROCESS_SECONDS.
FRAMES = 3
PROCESS_SECONDS = 0.5


class Clrt:
    """Runs of clrt for one scene at one size, with outputs in a folder."""

    def __init__(self, program, scene, size, folder):
        self.program, self.scene, self.size, self.folder = program, scene, size, folder

    def run(self, *words, statuses=(0,)):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True,
                              check=False)
        if done.returncode not in statuses:
            sys.exit(f"clrt {' '.join(map(str, words))}: status {done.returncode}: {done.stderr}")
        return done

    def draw(self, *words, statuses=(0,)):
        """Draws a.pfm. Returns the exit status and the statistics."""
        report = self.folder / "a.json"
        done = self.run(self.scene, "-q", "-s", self.size, "-o", self.folder / "a.pfm",
                        f"--json={report}", *words, statuses=statuses)
        return done.returncode, json.loads(report.read_text())

    def rmse(self, reference):
        done = self.run("compare", reference, self.folder / "a.pfm", "--json")
        return json.loads(done.stdout)["rmse"]

    def measure(self, reference, *words, statuses=(0,), frames=1):
        """Returns the picture's figures, with the time of the fastest frame."""
        status, report = self.draw("--repeat", frames, *words, statuses=statuses)
        samples = report["samples"]
        return {"status": status, "rmse": self.rmse(reference), "samples": samples["per_pixel"],
                "estimate": samples["error_estimate"], "bound": samples["error_bound"],
                "seconds": min(report["frame_seconds"]), "words": words}

    def processor_seconds(self, frames, *words):
        """Returns the processor time of a process that draws this number of pictures."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.draw("--repeat", frames, *words, statuses=(0, 1))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def add_processor_seconds(self, rivals):
        """Adds the processor time per picture to the figures of each rival. The rivals alternate.
        The time of a process with one picture is subtracted, and the fastest run counts."""
        for figures in rivals * FRAMES:
            frames = 1 + max(1, round(PROCESS_SECONDS / figures["seconds"]))
            seconds = (self.processor_seconds(frames, *figures["words"]) -
                       self.processor_seconds(1, *figures["words"])) / (frames - 1)
            figures["processor"] = min(figures.get("processor", math.inf), seconds)


def draw_reference(options, scene, path, wanted):
    """Draws a reference with an own error of at most `wanted`, or with REFERENCE_SAMPLES samples per
    pixel. Returns its figures."""
    words = [options.reference, scene, *options.size.split("x"), wanted, REFERENCE_SAMPLES, path]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return json.loads(done.stdout)


def cheapest_side(clrt, reference, goal, sides):
    """Returns the figures of the smallest N whose --aa=N meets the goal, or None."""
    low, high = 0, LARGEST_SIDE + 1
    while high - low > 1:
        side = (low + high) // 2
        if side not in sides:
            sides[side] = clrt.measure(reference, f"--aa={side}", *LEVELS, frames=FRAMES)
        low, high = (low, side) if sides[side]["rmse"] <= goal else (side, high)
    return sides.get(high)


def measure_rivals(clrt, reference, goals):
    """Returns for each goal the smallest --aa=N and the fastest --aa-adaptive=T that meet it."""
    sides = {}
    adaptive = [clrt.measure(reference, f"--aa-adaptive={threshold}", *LEVELS, frames=FRAMES)
                for threshold in THRESHOLDS]
    rivals = []
    for goal in goals:
        holding = [figures for figures in adaptive if figures["rmse"] <= goal]
        rivals.append({"uniform": cheapest_side(clrt, reference, goal, sides),
                       "adaptive": min(holding, key=lambda figures: figures["seconds"],
                                       default=None)})
    return rivals


def is_file(seed):
    return seed.endswith(".scn")


def name_of(options, seed):
    """Returns the name of the file and folder of a seed's results."""
    stem = pathlib.Path(seed).stem if is_file(seed) else seed
    return f"{'hidden-' * options.hidden}{stem}-{options.size}"


def scene_path(options, seed, number, folder):
    """Returns the path of a scene. Generates the scene, unless the seed is a scene file."""
    if is_file(seed):
        return pathlib.Path(seed)
    if options.hidden:
        return hidden.generate(seed, number, folder, list(map(int, options.size.split("x"))))
    return generate.generate(seed, number, folder)


def measure_scene(options, seed, number, folder):
    scene = scene_path(options, seed, number, folder / "scene")
    clrt = Clrt(options.clrt, scene, options.size, folder)
    references = options.output.parent / "references" / name_of(options, seed)
    references.mkdir(parents=True, exist_ok=True)
    reference = references / f"{scene.stem}.pfm"
    notes = reference.with_suffix(".json")
    if not notes.exists():
        notes.write_text(json.dumps(
            draw_reference(options, scene, reference, REFERENCE_PART * min(options.goals))))
    frames = FRAMES if options.costs else 1
    goals = [{"goal": goal, **clrt.measure(reference, "--error", goal, statuses=(0, 1),
                                           frames=frames)} for goal in options.goals]
    if options.costs:
        for goal, rivals in zip(goals, measure_rivals(clrt, reference, options.goals)):
            goal.update(rivals)
            clrt.add_processor_seconds([goal, *filter(None, rivals.values())])
    return {"seed": seed, "scene": scene.stem, "size": options.size,
            "reference": json.loads(notes.read_text()), "goals": goals}


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seeds", nargs="+", metavar="SEED|FILE.scn",
                        help="seeds of the generated scenes, or scene files")
    parser.add_argument("--scenes", type=int, default=40, help="scenes of each seed (40)")
    parser.add_argument("--size", default="160x120", help="size of the pictures (160x120)")
    parser.add_argument("--goals", default=GOALS, help=f"values of --error ({GOALS})")
    parser.add_argument("--costs", action="store_true",
                        help="also measure the cost of --aa and --aa-adaptive for each error")
    parser.add_argument("--hidden", action="store_true",
                        help="draw scenes of dots and lines that no center of a pixel sees")
    parser.add_argument("--clrt", default=ROOT / "build" / "release" / "clrt", help="the program")
    parser.add_argument("--reference", default=ROOT / "build" / "release" / "goal_reference",
                        help="the program that draws references")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "build" / "goals")
    options = parser.parse_args()
    options.goals = [float(goal) for goal in options.goals.split(",")]
    return options


def measure_seed(options, seed):
    """Measures the scenes of a seed that are not in its file. Returns the file's path."""
    path = options.output / f"{name_of(options, seed)}.jsonl"
    done = len(summary.read([path])) if path.exists() else 0
    for number in range(done, 1 if is_file(seed) else options.scenes):
        with tempfile.TemporaryDirectory() as folder:
            row = measure_scene(options, seed, number, pathlib.Path(folder))
        with open(path, "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
        print(row["scene"], row["reference"]["samples"],
              *(f"{goal['rmse'] / goal['goal']:.2f}" for goal in row["goals"]), flush=True)
    return path


def main():
    options = parse()
    program = hashlib.sha256(pathlib.Path(options.clrt).read_bytes()).hexdigest()
    options.output /= program[:12]
    options.output.mkdir(parents=True, exist_ok=True)
    return summary.report([measure_seed(options, seed) for seed in options.seeds])


if __name__ == "__main__":
    sys.exit(main())
