#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests clrt explain: text, JSON, the pixel's color, compiled features and uploaded data.
# Usage: test_explain.py CLRT
import re

from models import ply
from pictures import read_pfm
from work import EVERY_FEATURE, ROOT, SharedWork, main

PAINTED = str(ROOT / "tests/image/painted.scn")
HEAD = ("size 5 5\nambient 0.1\nbackground 0 0 1\ndefine plain matte diffuse 0.8 0.8 0.8 kd 0.5\n"
        "define mirror matte diffuse 1 1 1 kd 0.5 reflectivity 0.5\n")
MIRRORS = (f"{HEAD}light 0 0 2 1\nmaterial mirror\nsphere 0 3 0 1\nsphere 0 -3 0 1\n"
           "camera 0 0 0 0 1 0 90\n")
BALL = "light 0 -5 0 0.5\nmaterial plain\nsphere 0 0 0 1\ncamera 0 -5 0 0 0 0 90\n"
# The first light is a point. Some points of the area lights are behind the ball.
AREAS = "size 8 8\nlight 4 -9 3 0.2\nlight 2 0 4 0.5 area 1.5 0 0 0 1.5 0 5\n" \
        "light -2 0 3 0.4 1 0.5 0.25 area 1 0 0 0 1 0 3\ndefine shiny blinn_phong diffuse 0.6 0.7 0.8 ks 0.5\n" \
        "material shiny\nsphere 0 0 0 0.7\nsphere 0 0 -100.7 100\ncamera 0 -5 2 0 0 -0.3 40\n"
LAMP = "light 0 0 4 1\nmaterial plain\nply_file floor.ply\nsphere 0 0 1 0.5\n"
# The face is turned away from both lights. The vertex normals are turned away only from the second light.
LEANING = "size 5 5\nlight 11 -2 -5 1\nlight -9 -2 -5 1\nmaterial 1\nply_file leaning.ply\nup 0 1 0\n" \
          "camera 1 -2 4 1 -2 0 90\n"


def sphere(number, distance, *lights, **more):
    return {"primitive": {"kind": "sphere", "number": number}, "distance": distance, "lights": [*lights], **more}


def floor(distance, *lights, **more):
    """Returns the expected hit of the floor's first triangle, where x > y."""
    return {"primitive": {"kind": "triangle", "number": 0}, "distance": distance, "lights": [*lights], **more}


def light(state, distance=None, cosine=None, **more):
    found = {"state": state, "distance": distance, "cosine": cosine, **more}
    return {name: value for name, value in found.items() if value is not None}


def mirror_ball(level, number, distance):
    """Returns an expected ray. The light is 2 above and 2 beside every hit, so the color is 0.1 + 0.5 * 0.707107."""
    return {"weight": 0.5**level, "hit": sphere(number, distance, light("reaches", cosine=0.707107),
                                                share=0.5 ** (level + 1), color=[0.453553] * 3)}


# Pictures have 5 x 5 pixels and a field of view of 90 degrees. The ray through pixel (2, 2) points at
# the camera's target. Each row has the scene, the pixel, the rays and parts of the report.
BY_HAND = [
    # The eye and the light are at a distance of 5 from a sphere's center. The color is 0.8 * (0.1 + 0.5 * 0.5).
    (BALL, "2,2", [{"hit": sphere(1, 4, light("reaches", 4, 1, diffuse=0.25), point=[0, -1, 0],
                                  normal=[0, -1, 0])}], {"color": [0.28] * 3}),
    # The direction (-0.8, 1, 0.8) misses the sphere.
    (BALL, "0,0", [{"hit": None, "direction": [-0.529813, 0.662266, 0.529813]}], {"color": [0, 0, 1]}),
    # The light is 4 units above the hit point, with a ball between them. From the hit point, the
    # distance to the ball's lowest point is 0.5, and the distance to the eye is sqrt(16 + 0.16).
    (LAMP + "camera 1e-3 -4 0.4 1e-3 0 0 90\n", "2,2",
     [{"hit": floor(4.019950, light("blocked", 4, 1, blocker={"kind": "sphere", "number": 1},
                                    blocker_distance=0.5), normal=[0, 0, 1])}], {"color": [0.08] * 3}),
    # The half angle of the ball's shadow cone has the sine 0.5 / 3. The shadow's radius on the floor is
    # 4 * 0.169031 = 0.676123. At x = 0.65, the distance to the light is sqrt(0.65^2 + 16). The distance of
    # the ball's center from the shadow ray is 0.481188. The point of this ray that is nearest to the
    # center is 1.091310 along the ray. The ray meets the ball sqrt(0.25 - 0.481188^2) before this point.
    (LAMP + "camera 0.65 -4 0.4 0.65 0 0 90\n", "2,2",
     [{"hit": floor(4.019950, light("blocked", 4.052468, 0.987053, blocker={"kind": "sphere", "number": 1},
                                    blocker_distance=0.955450))}], {}),
    # At x = 0.7, nothing occludes the light. The light's distance is sqrt(0.49 + 16), and the cosine is
    # 4 / 4.060788.
    (LAMP + "camera 0.7 -4 0.4 0.7 0 0 90\n", "2,2",
     [{"hit": floor(4.019950, light("reaches", 4.060788, 0.985030))}], {"color": [0.474012] * 3}),
    # Each mirror ball halves the weight, and rays of level 3 see the background. The balls add 0.453553 with
    # weights 1/2, 1/4 and 1/8. The background adds 1/8 of blue.
    (MIRRORS, "2,2", [mirror_ball(0, 1, 2), {**mirror_ball(1, 2, 4), "direction": [0, -1, 0]},
                      mirror_ball(2, 1, 4)], {"color": [0.396859, 0.396859, 0.521859]}),
    # The line x = 0 is at a distance of 0.999 from the ball's center. Half the chord is sqrt(1 - 0.999^2), so
    # the ray from y = -5 hits at a distance of 4.955290. The light is 4 units to the left of the hit point.
    ("light -4 -0.0447102 0 1\nmaterial plain\nsphere 0.999 0 0 1\ncamera 0 -5 0 0 0 0 90\n", "2,2",
     [{"hit": sphere(1, 4.955290, light("reaches", 4, 0.999), normal=[-0.999, -0.0447102, 0])}], {}),
    # The eye is 0.001 above the floor. The ray meets the floor at a distance of 4.
    ("light 1 0 4 1\nmaterial plain\nply_file floor.ply\ncamera 1 -4 0.001 1 0 0 90\n", "2,2",
     [{"hit": floor(4, light("reaches", 4, 1), point=[1, 0, 0])}], {}),
    # Triangle 0 of the file has two equal corners and is left out.
    ("light 1 0 4 1\nmaterial plain\nply_file dropped.ply\ncamera 1 -4 0.001 1 0 0 90\n", "2,2",
     [{"hit": floor(4, light("reaches", 4, 1), primitive={"kind": "triangle", "id": 0, "number": 1})}], {}),
    # The eye is in the center of a mirror ball. The light is in the ball too, so normals face away from the light.
    ("light 0 0 0.5 1\nmaterial mirror\nsphere 0 0 0 1\ncamera 0 0 0 0 1 0 90\n", "2,2",
     [{"hit": sphere(1, 1, light("behind"), normal=[0, 1, 0])},
      {"hit": sphere(1, 2, light("behind"), point=[0, -1, 0])}, {"hit": sphere(1, 2, light("behind"))}],
     {"color": [0.0875, 0.0875, 0.2125]}),
    # From below, the one-sided floor is invisible. The two-sided floor is one unit higher and visible, and
    # its normal is turned down. The light is below both floors. The one-sided floor occludes it, because
    # the shadow ray meets this floor's front.
    ("light 1 -2 -1 1\nmaterial plain\nply_file floor.ply\nsides two\nmesh floor.ply translate 0 0 1\n"
     "up 0 1 0\ncamera 1 -2 -2 1 -2 0 90\n", "2,2",
     [{"hit": floor(3, light("blocked", 2, blocker={"kind": "triangle", "id": 0}, blocker_distance=1),
                    primitive={"kind": "triangle", "id": 2, "number": 0}, point=[1, -2, 1],
                    normal=[0, 0, -1])}], {"color": [0.08] * 3}),
    # The light is 10 units to the side of the hit point and 5 units below it. The normal faces the light, and
    # the cosine is (0.6 * 10 - 0.8 * 5) / sqrt(125). The face points up, away from the light.
    ("light 11 -2 -5 1\nmaterial plain\nply_file leaning.ply\nup 0 1 0\ncamera 1 -2 4 1 -2 0 90\n", "2,2",
     [{"hit": floor(4, light("behind_face", 11.180340, 0.178885), normal=[0.6, 0, 0.8])}],
     {"color": [0.08] * 3}),
]
PIXEL = ["explain", "mirrors.scn", "2,2"]
FORMS = ["", "--aa=3", "--tune kernel=pair", "--tune kernel=wide", "--precision fp64", "--precision fp64 --aa",
         "--tune bvh=none", "--max-level 1", "--max-level 0", "-j 1"]


NUMBER = r"(-?[\d.]+(?:e[-+]\d+)?)"
VECTOR = rf"\({NUMBER}, {NUMBER}, {NUMBER}\)"


def numbers_after(name, line, default):
    """Returns the number or vector after the name in a line of text."""
    found = re.search(rf"\b{name} (?:{VECTOR}|{NUMBER})", line)
    values = [float(part) for part in found.groups() if part is not None] if found else default
    return values if len(values) > 1 else values[0]


def shaded(factors, lights):
    """Computes a surface's color from its factors and from its lights' factors."""
    if factors["shader"] == "silhouette":
        return factors["diffuse_color"]
    sums = [[sum(light[part] * light["color"][i] for light in lights) for i in range(3)]
            for part in ("diffuse", "highlight")]
    return [min(1, factors["diffuse_color"][i] * (factors["ambient"] + sums[0][i]) +
                factors["specular_color"][i] * sums[1][i]) for i in range(3)]


def received(factors, light):
    """Computes diffuse and highlight of a light that reaches the surface."""
    return {**light, "diffuse": factors["kd"] * light["intensity"] * light["cosine"],
            "highlight": factors["ks"] * light["intensity"] * light["shine"]}


def color_of_json(report):
    """Computes the pixel's color from the factors of its lights, surfaces and samples."""
    total = [0, 0, 0]
    for sample in report["samples"]:
        parts = [(sample["background_weight"], report["background"])]
        for hit in (ray["hit"] for ray in sample["rays"] if ray["hit"]):
            lights = [received(hit["factors"], light) for light in hit["lights"] if light["state"] == "reaches"]
            parts.append((hit["share"], shaded(hit["factors"], lights)))
        total = [sum(weight * color[i] for weight, color in parts) + total[i] for i in range(3)]
    return [value / len(report["samples"]) for value in total]


def color_of_text(text):
    """Computes the pixel's color from the factors in the printed lines."""
    total, samples = [0, 0, 0], text.count("the sample's color")
    for line in text.splitlines():
        part = None
        if line.startswith("    meets"):
            lights, areas = [], []
        if line.startswith("    light") and "reaches it" in line:
            lights.append({name: numbers_after(name, line, default) for name, default in
                           (("cosine", [0]), ("intensity", [0]), ("shine", [0]))})
            lights[-1]["color"] = numbers_after("light color", line, [1, 1, 1])
        if line.startswith("    lights"):
            areas.append({name: numbers_after(name, line, [0]) for name in ("diffuse", "highlight")})
            areas[-1]["color"] = numbers_after("light color", line, [1, 1, 1])
        if line.startswith("    factors"):
            factors = {name.replace(" ", "_"): numbers_after(name, line, default) for name, default in
                       (("diffuse color", None), ("kd", [0]), ("ambient", [0]), ("specular color", [0, 0, 0]),
                        ("ks", [0]))}
            factors["shader"] = "silhouette" if "ambient" not in line else "shaded"
        if line.startswith("    color"):
            part = shaded(factors, [received(factors, light) for light in lights] + areas)
        if line.startswith("  the background"):
            part = numbers_after("background", line, None)
        if part:
            total = [total[i] + numbers_after("weight", line, None) * part[i] / samples for i in range(3)]
    return total


class Explain(SharedWork):
    def prepare(self):
        corners = [(-10, -10, 0), (10, -10, 0), (10, 10, 0), (-10, 10, 0)]
        self.write(mirrors_scn=MIRRORS, leaning_scn=LEANING, floor_ply=ply(corners, [(0, 1, 2), (0, 2, 3)]),
                   dropped_ply=ply(corners, [(0, 0, 1), (0, 1, 2), (0, 2, 3)]),
                   leaning_ply=ply(corners[:3], [(0, 1, 2)], [(0.6, 0, 0.8)] * 3),
                   areas_scn=AREAS, ball_scn="size 8 8\nlight 0 0 9 1\nmaterial 1\nsphere 0 0 0 1\n",
                   flat_scn=f"size 8 8\nmaterial 0\nply_file {ROOT}/scenes/cube.ply\n")


class Pixels(Explain):
    def test_the_documentation_shows_the_text(self):
        done = self.run_clrt(*PIXEL)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"```\n{done.stdout}```\n", (ROOT / "docs/explaining.md").read_text())
        color = "\nthe pixel's color (0.396859199, 0.396859199, 0.521859169), in 8 bits "
        self.assertTrue(done.stdout.endswith(color + "101 101 133\n"))
        self.assertTrue(self.clrt(*PIXEL, "--encode", "srgb").endswith(color + "169 169 191\n"))

    def test_the_printed_factors_add_up_to_the_pixels_color(self):
        shaders = set()
        for scene, pixels in (EVERY_FEATURE, ("70,60", "90,70", "64,90")), \
                (PAINTED, ("40,50", "60,45", "70,68", "104,68")), ("mirrors.scn", ("2,2",)), \
                ("flat.scn", ("4,4",)), ("lamps.scn", ("150,190",)), \
                ("areas.scn", ("4,3", "4,6", "2,5")):
            for pixel in pixels:
                words = ["explain", str(ROOT / "scenes" / scene) if scene == "lamps.scn" else scene, pixel, "--aa=2"]
                found = self.report(*words, "--json")
                hits = [ray["hit"] for sample in found["samples"] for ray in sample["rays"] if ray["hit"]]
                shaders |= {hit["factors"]["shader"] for hit in hits}
                for mine, color in zip(color_of_json(found), found["color"]):
                    self.assertAlmostEqual(mine, color, delta=4e-7, msg=words)
                for mine, color in zip(color_of_text(self.clrt(*words)), found["color"]):
                    self.assertAlmostEqual(mine, color, delta=1e-5, msg=words)
                self.assertEqual(found["bytes"], [round(255 * value) for value in found["color"]])
        self.assertEqual(shaders, {"silhouette", "matte", "blinn_phong"})

    def test_an_area_light_has_one_line(self):
        found = self.report("explain", "areas.scn", "4,6", "--json")["samples"][0]["rays"][0]["hit"]["lights"]
        lines = [line for line in self.clrt("explain", "areas.scn", "4,6").splitlines() if "light" in line]
        self.assertEqual(len(lines), 3)
        for line, points, name in (lines[1], found[1:26], "2 to 26"), (lines[2], found[26:], "27 to 35"):
            counts = {state: [light["state"] for light in points].count(state) for state in ("reaches", "blocked")}
            self.assertIn(f"lights {name}, an area: {counts['reaches']} of {len(points)} points reach it", line)
            self.assertEqual(f"; {counts['blocked']} blocked, the first by sphere 1" in line, counts["blocked"] > 1)
            self.assertAlmostEqual(numbers_after("diffuse", line, [0]),
                                   sum(light["diffuse"] for light in points if light["state"] == "reaches"), delta=1e-6)

    def test_a_corner_meets_nothing(self):
        self.assertIn("meets      nothing", self.clrt("explain", "mirrors.scn", "0,4"))

    def expect_near(self, found, expected, place=""):
        """Compares parts of a report. Expected numbers are rounded to six digits."""
        if isinstance(expected, dict):
            for name, part in expected.items():
                self.expect_near(found[name], part, f"{place}.{name}")
        elif isinstance(expected, list):
            self.assertEqual(len(found), len(expected), place)
            for number, part in enumerate(expected):
                self.expect_near(found[number], part, f"{place}[{number}]")
        elif isinstance(expected, (int, float)):
            self.assertAlmostEqual(found, expected, delta=2e-6 * max(1, abs(expected)), msg=place)
        else:
            self.assertEqual(found, expected, place)

    def test_pixels_agree_with_values_computed_by_hand(self):
        for text, pixel, rays, parts in BY_HAND:
            self.write(hand_scn=text if text.startswith(HEAD) else HEAD + text)
            found = self.report("explain", "hand.scn", pixel, "--json")
            weight = 0.5 ** len(rays) if "mirror" in text else float(not rays[0]["hit"])
            self.expect_near(found, {"schema": 1, "pixel": list(map(int, pixel.split(","))), "size": [5, 5],
                                     "samples": [{"rays": rays, "background_weight": weight}], **parts}, text)
            for ray in found["samples"][0]["rays"]:
                self.assertTrue(not ray["hit"] or 0 <= ray["hit"]["distance_error"] < 1e-4, text)
        self.assertEqual([ray["kind"] for ray in self.report(*PIXEL, "--json")["samples"][0]["rays"]],
                         ["camera", "reflected", "reflected"])

    def test_lights_behind_a_face_and_behind_a_normal_differ(self):
        words = ["explain", "leaning.scn", "2,2"]
        told = self.clrt(*words)
        self.assertIn("the face is turned away; cosine 0.1788", told)
        self.assertIn("the normal is turned away; cosine -0.8944", told)
        lights = self.report(*words, "--json")["samples"][0]["rays"][0]["hit"]["lights"]
        self.assertEqual([light["state"] for light in lights], ["behind_face", "behind"])

    def test_the_color_is_the_pictures_and_each_blocker_is_named(self):
        for form in FORMS:
            found = self.report("explain", EVERY_FEATURE, "70,60", "--json", *form.split())
            self.clrt(EVERY_FEATURE, "--crop", "70,60,71,61", "-o", "a.pfm", *form.split())
            self.assertEqual([found["color"]], read_pfm(self.work / "a.pfm"), form)
            hits = [ray["hit"] for sample in found["samples"] for ray in sample["rays"] if ray["hit"]]
            for blocker in (light["blocker"] for hit in hits for light in hit["lights"] if light["blocker"]):
                self.assertTrue(blocker["kind"] == "sphere" or blocker["file"].endswith(".ply"), blocker)

    def test_refusals(self):
        for code, sentence, words in (
            (2, "pixel 2,9: the picture has 5 x 5 pixels", ["explain", "mirrors.scn", "2,9"]),
            (2, "'2' is no pixel: explain wants X,Y", ["explain", "mirrors.scn", "2"]),
            (2, "clrt explain SCENE X,Y takes no --output", [*PIXEL, "-o", "a.pfm"]),
            (2, "clrt explain SCENE takes no --output", ["explain", "ball.scn", "-o", "a.pfm"]),
            (3, "nowhere.scn: cannot be opened: No such file or directory",
             ["explain", "nowhere.scn", "0,0"]),
            (5, "/dev/full: cannot be written: No space left on device", [*PIXEL, "--json=/dev/full"]),
        ):
            self.refuses(code, sentence, *words)


class Scenes(Explain):
    """Specialized kernels omit features that a scene lacks. General kernels contain most features anyway."""

    def expect_parts(self, words, **parts):
        """Expects each part's need, its presence in the program and the reason. Returns the report."""
        found = self.report("explain", *words, "--json")
        by_name = {part["name"]: part for part in found["parts"]}
        for name, expected in parts.items():
            part = by_name[name]
            self.assertEqual((part["needed"], part["compiled"], part["reason"]), expected, name)
        return found

    def test_the_text_lists_compiled_and_omitted_features_and_uploads(self):
        told = self.clrt("explain", "ball.scn", "--tune", "specialize=always,kernel=pair")
        left_out = told.split("\nleft out\n")[1].split("\nuploaded")[0]
        self.assertEqual(left_out.count("\n  ") + 1, 7, told)
        self.assertIn("  tree        there are no triangles to find", left_out)
        self.assertIn("  triangles   there are none", left_out)
        for part in "  spheres     1 of them", "  spheres     48 bytes", " nodes triangles looks normals colors":
            self.assertIn(part, told)

    def test_special_kernels_have_only_the_features_of_the_scene(self):
        found = self.expect_parts(["ball.scn", "--tune", "specialize=always,kernel=pair"],
                                  spheres=(True, True, "1 of them"), triangles=(False, False, "there are none"),
                                  mirrors=(False, False, "no material in use reflects: no reflected rays"))
        self.assertEqual(found["program"], {"special": True, "reason": "--tune specialize=always"})

    def test_general_kernels_have_all_but_counters_that_nobody_requests(self):
        general = ["ball.scn", "--tune", "specialize=never"]
        self.expect_parts(general, triangles=(False, True, "there are none"),
                          statistics=(False, False, "not requested: no --stats"))
        self.expect_parts([*general, "--stats"], statistics=(True, True, "--stats counts rays and tests"))

    def test_only_scenes_that_show_colors_of_vertices_compile_and_upload_them(self):
        special = ["--tune", "specialize=always,kernel=pair"]
        found = self.expect_parts([PAINTED, *special], colors=(True, True, "240 triangles have colors of vertices"))
        self.assertEqual(found["uploaded_bytes"]["colors"], 240 * 40)
        self.write(gray_scn="material 1\nmesh painted.ply\n",
                   painted_ply=(ROOT / "tests/image/painted.ply").read_bytes())
        found = self.expect_parts(["gray.scn", *special], colors=(False, False, "no mesh shows colors of vertices"))
        self.assertEqual(found["uploaded_bytes"]["colors"], 0)

    def test_only_scenes_with_checkers_or_glass_compile_them(self):
        general = ["--tune", "specialize=never,kernel=pair"]
        self.expect_parts(["ball.scn", *general], glass=(False, False, "no material in use is glass"))
        self.write(glass_scn="define a glass\nmaterial a\nsphere 0 0 0 1\n")
        self.expect_parts(["glass.scn", *general], glass=(True, True, "a material in use is glass"))
        self.expect_parts(["ball.scn", *general], checkers=(False, False, "no material in use has a checker"))
        self.write(checks_scn="define a matte checker 1 1 1 1 0 0 0\nmaterial a\nsphere 0 0 0 1\n")
        self.expect_parts(["checks.scn", *general], checkers=(True, True, "a material in use has a checker"))

    def test_silhouettes_are_not_lit_and_few_triangles_get_no_tree(self):
        self.expect_parts(["flat.scn", "--tune", "specialize=always"],
                          lights=(False, False, "no material in use is shaded: no shadow rays"),
                          tree=(False, False, "testing all 10 triangles is faster"))

    def test_spheres_are_there_in_every_layout_of_nodes(self):
        for nodes in "pair", "wide":
            found = self.expect_parts(["ball.scn", "--tune", f"kernel={nodes}"], spheres=(True, True, "1 of them"))
            self.assertEqual(found["uploaded_bytes"]["spheres"], 48)

    def test_requested_trees_and_kernels_are_there(self):
        words = ["flat.scn", "--tune", "bvh=sah,kernel=pair"]
        found = self.expect_parts(words)
        self.assertTrue(next(part for part in found["parts"] if part["name"] == "tree")["needed"])
        self.assertGreater(found["uploaded_bytes"]["nodes"], 0)
        self.assertEqual(found["kernels"], {"family": "ray", "nodes": "pair", "precision": "fp32",
                                            "reason": "--tune kernel requests it"})


if __name__ == "__main__":
    main(1)
