# SPDX-License-Identifier: MIT
"""Compares the times of clrt and POV-Ray 3.7 from file to PNG. Their processes run alternately.

Converts the scene to POV-Ray input. Meshes become text, because POV-Ray does not read PLY. Both
renderers use the same shading formula and number of reflections, and one sample per pixel. There is
no ratio of times for pictures whose mean difference exceeds 1 %.
"""

import math
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import time

from benchmark import common, ply, scenes

MOST_APART = 0.01
# clrt's defaults for the statements that a scene omits.
SETTINGS = {"size": ["512", "512"], "background": ["1", "1", "1"], "ambient": ["0.05"],
            "max_level": ["3"]}


def refuse(words):
    sys.exit(f"tools/bench cannot translate '{words}' for POV-Ray")


def vector(numbers):
    return "<" + ",".join(f"{float(number):.7g}" for number in numbers) + ">"


def statements(text):
    for line in text.splitlines():
        words = re.split("#|//", line)[0].split()
        if words:
            yield words[0], words[1:]


def settings_of(text):
    return {**SETTINGS, **{name: words for name, words in statements(text) if name in SETTINGS}}


def properties_of(words, figures):
    """Returns the properties of a define statement. `figures` contains the defaults."""
    name = None
    for word in words:
        if word in figures:
            name, figures[word] = word, []
        else:
            figures[name].append(word)
    return figures


def glass_of(words):
    """Returns the texture and the interior of glass. POV-Ray measures ior against a vacuum. clrt
    measures it against the space around the surface, so nested glass would differ."""
    figures = properties_of(words, {"ior": ["1.5"], "color": ["1", "1", "1"]})
    return (f"texture {{ pigment {{ rgb {vector(figures['color'])} filter 1 }} finish {{ ambient 0 "
            f"diffuse 0 reflection {{ 0, 1 fresnel }} conserve_energy }} }} "
            f"interior {{ ior {figures['ior'][0]} }}")


def finish_of(words, ambient):
    """Returns the texture of a define statement, and the interior of glass. Ambient and diffuse light are
    scaled by 1 - reflectivity, as in clrt. In both renderers, a cube of a checker's first color begins
    at the origin."""
    if words[0] == "glass":
        return glass_of(words[1:])
    if words[0] != "matte":
        refuse(words[0])
    figures = properties_of(words[1:], {"diffuse": ["1", "1", "1"], "kd": ["1"],
                                        "reflectivity": ["0"], "checker": None})
    mirror, kd = float(figures["reflectivity"][0]), float(figures["kd"][0])
    pigment = f"rgb {vector(figures['diffuse'])}"
    if checker := figures["checker"]:
        pigment = f"checker rgb {vector(checker[1:4])} rgb {vector(checker[4:])} scale {checker[0]}"
    return (f"texture {{ pigment {{ {pigment} }} finish {{ "
            f"ambient {ambient * (1 - mirror):.7g} diffuse {kd * (1 - mirror):.7g} "
            f"reflection {mirror:.7g} }} }}")


def mesh_of(path, texture):
    positions, normals, corners = ply.read(path)
    parts = [f"vertex_vectors {{ {len(positions)}, {','.join(map(vector, positions))} }}"]
    if normals:
        parts.append(f"normal_vectors {{ {len(normals)}, {','.join(map(vector, normals))} }}")
    faces = ",".join("<%d,%d,%d>" % corner for corner in corners)
    parts.append(f"face_indices {{ {len(corners)}, {faces} }}")
    return "mesh2 {\n" + "\n".join(parts) + f"\n{texture} }}"


def camera_of(words, up, width, height):
    """Returns POV-Ray's camera. clrt's angle is vertical, POV-Ray's is horizontal. POV-Ray's space
    is left-handed unless `right` points left."""
    eye, target, angle = words[:3], words[3:6], float(words[6])
    across = 2 * math.degrees(math.atan(math.tan(math.radians(angle) / 2) * width / height))
    across = max([across, *map(float, words[7:8])])
    return (f"camera {{ perspective location {vector(eye)} sky {vector(up)} up y "
            f"right -x*{width / height:.9g} angle {across:.9g} look_at {vector(target)} }}")


def light_of(words):
    color = [float(words[3]) * float(part) for part in words[4:7] or [1, 1, 1]]
    return f"light_source {{ {vector(words[:3])} rgb {vector(color)} }}"


def sun_of(words):
    length = math.dist((0, 0, 0), list(map(float, words[:3])))
    far = [f"{1e6 * float(word) / length:.9g}" for word in words[:3]]
    return f"{light_of([*far, *words[3:]])[:-1]} parallel point_at 0 }}"


def objects_of(text, ambient):
    """Yields POV-Ray's lights, meshes and spheres. POV-Ray shows both sides of all meshes."""
    textures, texture = {}, None
    for name, words in statements(text):
        if name == "light":
            yield light_of(words)
        elif name == "sun":
            yield sun_of(words)
        elif name == "define":
            textures[words[0]] = finish_of(words[1:], ambient)
        elif name == "material" and words[0] in textures:
            texture = textures[words[0]]
        elif name == "ply_file" and texture:
            yield mesh_of(words[0], texture)
        elif name == "sphere" and texture:
            yield f"sphere {{ {vector(words[:3])}, {words[3]} {texture} }}"
        elif name not in (*SETTINGS, "camera", "up", "sides"):
            refuse(" ".join([name, *words[:1]]))


def first_camera(text, width, height):
    up = ["0", "0", "1"]
    for name, words in statements(text):
        if name == "camera":
            return camera_of(words, up, width, height)
        up = words if name == "up" else up
    return sys.exit("tools/bench --peer povray needs scenes with a camera")


def translate(text, width, height):
    """Returns the scene's first view as POV-Ray input."""
    known = settings_of(text)
    # adc_bailout 0 follows even rays with a low weight, as clrt does.
    out = ["#version 3.7;",
           f"global_settings {{ assumed_gamma 1 adc_bailout 0 "
           f"max_trace_level {known['max_level'][0]} }}",
           f"background {{ rgb {vector(known['background'])} }}",
           first_camera(text, width, height), *objects_of(text, float(known["ambient"][0]))]
    return "\n".join(out) + "\n"


class Contest:
    """The times of clrt and POV-Ray for one scene, from file to picture."""

    def __init__(self, name, variant, scene, options, folder):
        text = scene.read_text()
        width, height = options.size.split("x") if options.size else settings_of(text)["size"]
        threads = options.threads or common.threads_of_machine()
        self.name, self.variant = name, variant
        self.folder = pathlib.Path(folder)
        source = self.folder / f"{name}-{variant}.pov"
        source.write_text(translate(text, int(width), int(height)))
        self.picture_bytes = 3 * int(width) * int(height)
        self.clrt = [common.CLRT, str(scene), "-q", *options.clrt_words]
        # File_Gamma=1 writes raw values, as clrt does.
        self.povray = ["povray", f"+I{source}", f"+W{width}", f"+H{height}", f"+WT{threads}", "-D",
                       "-A", "-P", "-V", "File_Gamma=1"]
        self.times = {"clrt": [], "povray": []}
        self.trace_times = []
        self.difference = None

    def run(self, ending):
        """Draws with both renderers to files with this ending. Returns the seconds of each, and
        POV-Ray's messages."""
        kind = {"png": "N", "ppm": "P"}[ending]
        start = time.monotonic()
        subprocess.run([*self.clrt, "-o", self.path("clrt", ending)], check=True)
        middle = time.monotonic()
        # The messages contain the seconds of tracing.
        done = subprocess.run([*self.povray, f"+F{kind}8", f"+O{self.path('povray', ending)}"],
                              check=True, capture_output=True, text=True)
        return middle - start, time.monotonic() - middle, done.stderr

    def path(self, who, ending):
        return str(self.folder / f"{self.name}-{self.variant}-{who}.{ending}")

    def prepare(self):
        """Draws once without timing, and compares the pictures."""
        self.run("ppm")
        first, second = (pathlib.Path(self.path(who, "ppm")).read_bytes()[-self.picture_bytes:]
                         for who in ("clrt", "povray"))
        self.difference = sum(abs(a - b) for a, b in zip(first, second)) / len(first) / 255

    def round(self):
        clrt, povray, messages = self.run("png")
        self.times["clrt"].append(clrt)
        self.times["povray"].append(povray)
        traced = re.search(r"Trace Time:.*\(([0-9.]+) seconds\)", messages)
        self.trace_times.append(float(traced.group(1)) if traced else 0)

    def summary(self):
        ratios = [theirs / ours for theirs, ours in zip(self.times["povray"], self.times["clrt"])]
        return {"scene": self.name, "variant": self.variant, "process_seconds_rounds": self.times,
                "process_seconds": {who: statistics.median(t) for who, t in self.times.items()},
                "povray_trace_seconds": statistics.median(self.trace_times),
                "ratio_povray_to_clrt": (statistics.median(ratios)
                                         if self.difference <= MOST_APART else None),
                "mean_difference": self.difference}


def print_table(results):
    print("Seconds of the whole process, from file to PNG. apart: mean difference of the pictures"
          "\n")
    print(f"{'scene':<10}{'variant':<9}{'clrt':>8}{'povray':>9}{'(traces)':>10}{'povray/clrt':>13}"
          f"{'apart':>9}")
    for result in results:
        times = result["process_seconds"]
        print(f"{result['scene']:<10}{result['variant']:<9}{times['clrt']:>8.3f}"
              f"{times['povray']:>9.3f}{result['povray_trace_seconds']:>10.3f}"
              f"{common.show(result['ratio_povray_to_clrt'], 2):>13}"
              f"{result['mean_difference']:>9.2%}")
    if any(result["ratio_povray_to_clrt"] is None for result in results):
        print("\nPictures more than 1 % apart have no ratio, because the renderers do different work.")


def run(options, folder):
    if shutil.which("povray") is None:
        print("The comparison with POV-Ray is skipped: povray is not installed.")
        return None
    contests = [Contest(name, variant, scenes.write(text, name, variant, folder), options, folder)
                for name, text in scenes.texts(options.scenes).items()
                for variant in options.variants]
    for contest in contests:
        contest.prepare()
    for _ in range(options.runs):
        for contest in contests:
            contest.round()
    results = [contest.summary() for contest in contests]
    print_table(results)
    return {"machine": common.machine(), "frames": results}
