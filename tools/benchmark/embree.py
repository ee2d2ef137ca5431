# SPDX-License-Identifier: MIT
"""Compares the frame times of clrt and of an Embree renderer of the same pictures (tools/embree).

Each round draws with clrt and with every mode of Embree, so that drift of the machine affects all
of them. A ratio is the median of the rounds' ratios. Embree gets its best settings: before the
rounds, embree_peer finds the fastest coherent flags of each mode.
"""

import array
import json
import statistics
import subprocess

from benchmark import common, scenes

MODES = ["single", "packet4", "packet8", "packet16", "stream"]
QUALITIES = ["low", "medium", "high"]


def program(target):
    """Returns the path of the Embree renderer for a target, or for this machine if target is
    None."""
    return common.BUILD / ("embree_peer" + (f"_{target}" if target else ""))


def peer(target, scene, *words):
    done = subprocess.run([str(program(target)), str(scene), *words], capture_output=True,
                          text=True, check=True)
    return json.loads(done.stdout)


def read_pfm(path):
    with open(path, "rb") as file:
        for _ in range(3):
            file.readline()
        values = array.array("f")
        values.frombytes(file.read())
    return values


def share_of_differing_pixels(first, second):
    """Returns the share of pixels of two pictures that differ by more than one 8-bit step."""
    a, b = read_pfm(first), read_pfm(second)
    apart = [abs(x - y) > 1 / 255 for x, y in zip(a, b)]
    return sum(map(any, zip(apart[::3], apart[1::3], apart[2::3]))) / (len(a) / 3)


class Contest:
    """The seconds of every contestant in every round, for one scene and number of threads."""

    def __init__(self, name, variant, scene, threads, columns, options):
        self.name, self.variant, self.scene, self.threads = name, variant, scene, threads
        self.columns, self.frames, self.target = columns, options.frames or 3, options.target
        self.size = ["-s", options.size] if options.size else []
        self.times = {contestant: [] for contestant in [*columns, *MODES]}
        self.rays = self.triangles = self.differing = None
        self.coherent, self.all_coherent, self.embree_rays = {}, {}, {}

    def prepare(self, folder):
        picture = f"{folder}/embree.pfm"
        found = peer(self.target, self.scene, "-j", str(self.threads), "-f", "1", "-o", picture,
                     *self.size)
        for mode, figures in found["modes"].items():
            self.coherent[mode] = figures["coherent"]
            self.all_coherent[mode] = figures["all_coherent_seconds"]
            self.embree_rays[mode] = figures["rays"]
        self.rays = common.report(self.scene, self.size, folder)["rays"]
        self.triangles = found["triangles"]
        self.differing = share_of_differing_pixels(f"{folder}/clrt.pfm", picture)

    def round(self, folder):
        for column, words in self.columns.items():
            times = common.draw(self.scene, ["-j", str(self.threads), *self.size, *words], folder,
                                self.frames + 1)
            self.times[column].append(statistics.median(times[1:]))
        for letters in sorted(set(self.coherent.values())):
            modes = [mode for mode in MODES if self.coherent[mode] == letters]
            found = peer(self.target, self.scene, "-j", str(self.threads), "-f", str(self.frames),
                         "-c", letters, "-m", ",".join(modes), *self.size)
            for mode in modes:
                self.times[mode].append(statistics.median(found["modes"][mode]["frame_seconds"]))

    def ratio(self, first, second):
        return statistics.median(a / b for a, b in zip(self.times[first], self.times[second]))

    def best(self):
        return min(MODES, key=lambda mode: statistics.median(self.times[mode]))

    def rate(self, contestant):
        return self.rays["total"] / statistics.median(self.times[contestant]) / 1e6

    def summary(self):
        contestants = [*self.columns, *MODES]
        return {
            "scene": self.name, "variant": self.variant, "threads": self.threads,
            "triangles": self.triangles, "rays": self.rays, "embree_rays": self.embree_rays,
            "frame_seconds_rounds": self.times,
            "frame_seconds": {c: statistics.median(self.times[c]) for c in contestants},
            "mray_per_second": {c: self.rate(c) for c in contestants},
            "best_mode": self.best(),
            "ratio_to_best": {c: self.ratio(c, self.best()) for c in self.columns},
            "ratio_to_single": {c: self.ratio(c, "single") for c in self.columns},
            "coherent": self.coherent, "all_coherent_seconds": self.all_coherent,
            "share_of_differing_pixels": self.differing,
        }


def columns_of(options):
    """Returns clrt's contestants: each --clrt-options, or the default kernels and single rays."""
    if options.clrt_options:
        return {f"clrt {words}".strip(): words.split() for words in options.clrt_options}
    columns = {"clrt": []}
    if common.has_option("--tune"):
        columns["clrt ray"] = ["--tune", "kernel=wide"]
    return columns


def print_table(results, columns):
    heads = [*columns, *MODES]
    print("Milliseconds per frame. x best and x single are clrt's time divided by the time of "
          "Embree's\nbest mode and of its single rays. differ: pixels that differ by more than "
          "1/255.\n")
    print(f"{'scene':<12}{'variant':<9}{'threads':>7}"
          + "".join(f"{head:>{max(10, len(head) + 2)}}" for head in heads)
          + f"  {'best':<9}"
          + "".join(f"{'x best':>8}{'x single':>10}" for _ in columns) + "  Mray/s   differ")
    for result in results:
        times, rates = result["frame_seconds"], result["mray_per_second"]
        best = result["best_mode"]
        print(f"{result['scene']:<12}{result['variant']:<9}{result['threads']:>7}"
              + "".join(f"{times[head] * 1e3:>{max(10, len(head) + 2)}.1f}" for head in heads)
              + f"  {best:<9}"
              + "".join(f"{result['ratio_to_best'][column]:>8.2f}"
                        f"{result['ratio_to_single'][column]:>10.2f}" for column in columns)
              + "  " + "/".join(f"{rates[head]:.1f}" for head in [*columns, "single", best])
              + f"  {result['share_of_differing_pixels']:.2%}")


def builds_of(name, scene, options, folder):
    """Returns the seconds for building the tree on all threads, for clrt and for each quality of
    Embree."""
    threads = str(common.threads_of_machine())
    times = {"clrt": [], **{quality: [] for quality in QUALITIES}}
    for _ in range(min(options.runs, 3)):
        times["clrt"].append(common.report(scene, ["-s", "64x64"], folder)["seconds"]["build"])
        for quality in QUALITIES:
            built = peer(options.target, scene, "-j", threads, "-q", quality, "-m", "none")
            times[quality].append(built["build_seconds"])
    return {"scene": name, "build_seconds": {who: statistics.median(t) for who, t in times.items()}}


def print_builds(builds):
    print(f"\nMilliseconds to build the tree (for clrt, including its arrays), "
          f"{common.threads_of_machine()} threads\n")
    print(f"{'scene':<12}{'clrt':>10}" + "".join(f"{q:>10}" for q in QUALITIES))
    for build in builds:
        times = build["build_seconds"]
        print(f"{build['scene']:<12}" + "".join(f"{t * 1e3:>10.1f}" for t in times.values()))


def run(options, folder):
    if not program(options.target).exists():
        print(f"The comparison with Embree is skipped: {program(options.target)} does not exist. It "
              "needs Embree 3 (libembree-dev of Debian 12).")
        return None
    columns = columns_of(options)
    counts = [options.threads] if options.threads else sorted({1, common.threads_of_machine()})
    texts = scenes.texts(options.scenes)
    contests = [Contest(name, variant, scenes.write(text, name, variant, folder), threads, columns,
                        options)
                for name, text in texts.items() for variant in options.variants
                for threads in counts]
    for contest in contests:
        contest.prepare(folder)
    for _ in range(options.runs):
        for contest in contests:
            contest.round(folder)
    results = [contest.summary() for contest in contests]
    builds = [builds_of(name, scenes.write(text, name, "mirrors", folder), options, folder)
              for name, text in texts.items()]
    print_table(results, columns)
    print_builds(builds)
    return {"machine": common.machine(), "frames": results, "builds": builds}
