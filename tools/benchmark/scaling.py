# SPDX-License-Identifier: MIT
"""Measures frame times for meshes of growing size and for pictures of growing size."""

import pathlib
import statistics

from benchmark import chart, common, scenes, shapes

TRIANGLES = [10 ** power for power in range(3, 8)]
PIXELS_WITH = 10 ** 5  # triangles of the mesh for the series of picture sizes
SIZES = [256, 512, 1024, 2048, 4096, 8192]
CAMERA = "2.1 -1.3 1.5  0 0 0.26  32"


def scene_of(count, folder):
    """Writes a mesh and its scene. Returns the scene's path and the mesh's number of triangles."""
    mesh = pathlib.Path(folder) / f"torus-{count}.ply"
    made = shapes.write(mesh, "torus", count)
    text = scenes.with_absolute_paths(scenes.FOLDER / "creature.scn")
    return scenes.write(scenes.with_mesh(text, mesh, CAMERA), mesh.stem, "mirrors", folder), made


class Step:
    """One picture of a series: a scene at a size."""

    def __init__(self, scene, triangles, size, options):
        self.scene, self.triangles, self.size = scene, triangles, size
        self.words = [*options.clrt_words, "-s", f"{size}x{size}"]
        # Large pictures take long enough for a single measurement.
        self.frames = (options.frames or 3) + 1 if size <= 2048 else 1
        self.times = []
        self.report = None

    def measure(self, folder):
        times = common.draw(self.scene, self.words, folder, self.frames)
        self.times.append(statistics.median(times[1:] or times))

    def count(self, folder):
        """Gets the number of rays and the build time from a small picture, because counting is
        slow."""
        self.report = common.report(self.scene, [*self.words, "-s", "256x256"], folder)

    def summary(self):
        rays = self.report["rays"]["total"] / 256 ** 2
        seconds = statistics.median(self.times)
        return {"triangles": self.triangles, "size": self.size, "frame_seconds": seconds,
                "frame_seconds_rounds": self.times, "rays_per_pixel": rays,
                "nanoseconds_per_pixel": seconds / self.size ** 2 * 1e9,
                "mray_per_second": rays * self.size ** 2 / seconds / 1e6,
                "build_seconds": self.report["seconds"]["build"],
                "peak_memory_bytes": self.report["bytes"]["peak_memory"]}


def print_table(title, results):
    print(f"{title}\n{'triangles':>10}{'size':>7}{'frame ms':>11}{'ns/pixel':>10}{'rays/pixel':>12}"
          f"{'Mray/s':>8}{'build ms':>10}")
    for result in results:
        print(f"{result['triangles']:>10}{result['size']:>7}{result['frame_seconds'] * 1e3:>11.1f}"
              f"{result['nanoseconds_per_pixel']:>10.0f}{result['rays_per_pixel']:>12.2f}"
              f"{result['mray_per_second']:>8.2f}{result['build_seconds'] * 1e3:>10.1f}")
    print()


def run(options, folder):
    made = {count: scene_of(count, folder) for count in TRIANGLES}
    by_triangles = [Step(*made[count], 1024, options) for count in TRIANGLES]
    by_pixels = [Step(*made[PIXELS_WITH], size, options) for size in SIZES]
    for step in by_triangles + by_pixels:
        step.count(folder)
    for _ in range(options.runs):
        for step in by_triangles + by_pixels:
            step.measure(folder)
    results = {"triangles": [step.summary() for step in by_triangles],
               "pixels": [step.summary() for step in by_pixels]}
    print_table("Triangles", results["triangles"])
    print_table("Pixels", results["pixels"])
    if options.plot:
        chart.write(options.plot, [
            ("A picture of 1024 x 1024", "triangles", "milliseconds a frame",
             [(r["triangles"], r["frame_seconds"] * 1e3) for r in results["triangles"]]),
            (f"A mesh of {by_pixels[0].triangles} triangles", "pixels", "milliseconds a frame",
             [(r["size"] ** 2, r["frame_seconds"] * 1e3) for r in results["pixels"]])])
    return {"machine": common.machine(), **results}
