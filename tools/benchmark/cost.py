# SPDX-License-Identifier: MIT
"""Measures how long clrt takes for each scene of the project's set.

The rate of each kind of ray comes from three pictures of a scene. The first has neither lights nor
reflections, so it has only camera rays. The second has lights, and the third is complete. A rate is
the number of rays that a picture adds to the previous one, divided by the added time, including
shading. Times are medians of pictures without counters. Counts come from one run with counters.
Scenes alternate within a round, so that drift of the machine affects all scenes.
"""

import pathlib
import statistics

from benchmark import common, scenes

OWN = ["silhouette", "matte", "blinn_phong", "reflections", "simple", "creature", "figure", "coral",
       "showcase"]
FROM_COURSE = ["cow", "buddha"]


def scene_paths(names):
    if names:
        return [pathlib.Path(name).resolve() for name in names]
    paths = [common.ROOT / "scenes" / f"{name}.scn" for name in OWN]
    return paths + [common.COURSE / f"{name}.scn" for name in FROM_COURSE
                    if (common.COURSE / f"{name}.scn").exists()]


def without_lights(scene, folder):
    dark = pathlib.Path(folder) / f"{scene.parent.name}-{scene.name}"
    lines = [line for line in scenes.with_absolute_paths(scene).splitlines()
             if line.split()[:1] not in (["light"], ["sun"])]
    dark.write_text("\n".join(lines) + "\n")
    return dark


class Picture:
    """The counts and measured times of a scene with some options."""

    def __init__(self, scene, options, frames, folder):
        self.scene, self.options, self.frames, self.folder = scene, options, frames, folder
        self.report = common.report(scene, options, folder)
        self.times = []

    def measure(self):
        times = common.draw(self.scene, self.options, self.folder, self.frames)
        self.times.append(statistics.median(times))

    def seconds(self):
        return statistics.median(self.times)

    def rays(self):
        return self.report["rays"]["total"]


def rate(more, less):
    """Returns the Mray/s of the rays that picture `more` has in addition to `less`, or None if it
    has no more rays or takes no more time."""
    rays = more.rays() - (less.rays() if less else 0)
    seconds = more.seconds() - (less.seconds() if less else 0)
    return rays / seconds / 1e6 if rays > 0 and seconds > 0 else None


def pictures_of(scene, options, folder):
    frames = options.frames or 1
    words = options.clrt_words
    camera = Picture(without_lights(scene, folder), [*words, "--max-level", "1"], frames, folder)
    lit = Picture(scene, [*words, "--max-level", "1"], frames, folder)
    whole = Picture(scene, words, frames, folder)
    return scene, camera, lit, whole


def summary(scene, camera, lit, whole):
    report = whole.report
    return {
        "scene": str(scene),
        "triangles": report["scene"]["triangles"],
        "trace_seconds": whole.seconds(),
        "trace_seconds_runs": whole.times,
        "mray_per_second": {"camera": rate(camera, None), "shadow": rate(lit, camera),
                            "reflected": rate(whole, lit), "all": rate(whole, None)},
        "tests_per_ray": {"triangle": report["tests"]["triangle_per_ray"],
                          "box": report["tests"]["box_per_ray"]},
        "stage_seconds": report["seconds"],
        "peak_memory_bytes": report["bytes"]["peak_memory"],
        "device": report["device"],
        "rays": report["rays"],
        "pixel_hash": report["pixel_hash"],
    }


def print_table(results):
    show = common.show
    print(f"{'scene':<14}{'triangles':>10}{'trace ms':>9}  {'Mray/s':>6} camera shadow  refl. "
          f"{'tri/ray':>8}{'box/ray':>8}{'MB':>6}   stages, ms: parse load build upload kernels write")
    for result in results:
        rates, tests = result["mray_per_second"], result["tests_per_ray"]
        stages = result["stage_seconds"]
        print(f"{pathlib.Path(result['scene']).stem:<14}{result['triangles']:>10}"
              f"{result['trace_seconds'] * 1e3:>9.1f}  {show(rates['all'], 2):>6} "
              f"{show(rates['camera'], 2):>6} {show(rates['shadow'], 2):>6} "
              f"{show(rates['reflected'], 2):>6} {tests['triangle']:>8.2f}{tests['box']:>8.2f}"
              f"{result['peak_memory_bytes'] / 1e6:>6.0f}   "
              + " ".join(f"{stages[name] * 1e3:.1f}" for name in
                         ("parse", "load", "build", "upload", "kernel_build", "write")))


def run(options, folder):
    drawn = [pictures_of(scene, options, folder) for scene in scene_paths(options.scenes)]
    for _ in range(options.runs):
        for _, *pictures in drawn:
            for picture in pictures:
                picture.measure()
    results = [summary(*scene) for scene in drawn]
    print_table(results)
    return results
