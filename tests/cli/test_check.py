#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Tests clrt check and --bad-geometry: findings as text and JSON, exit statuses, and dropped triangles.
# Usage: test_check.py CLRT
from models import knot, ply
from work import NO_OPENCL, ROOT, SharedWork, main

CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
CLOSED = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
STEP = 16777216  # adjacent floats differ by 2 from here on
MESHES = {"closed": (CORNERS, CLOSED), "open": (CORNERS, CLOSED[:3]), "turned": (CORNERS, [*CLOSED[:3], (1, 3, 2)]),
          "equal": (CORNERS, [*CLOSED[:2], (0, 0, 2), *CLOSED[2:], (1, 1, 1)]),
          "line": ([*CORNERS, (2, 0, 0)], [*CLOSED[:2], (0, 1, 4)]),
          "late": ([*CORNERS, (2, 0, 0)], [(0, 0, 1), *CLOSED[:2], (3, 3, 3), (0, 1, 4)]),
          "nan": ([*CORNERS[:2], (0, float("nan"), 0), (0, 0, 1), (1, 1, 1)], [*CLOSED[:3], (1, 4, 3)]),
          "twice": (CORNERS, [*CLOSED, (2, 3, 1)]),
          "far": ([(STEP, 0, 0), (STEP + 2, 0, 0), (STEP, 2, 0), (STEP, 0, 2)], CLOSED),
          "inside": (CORNERS, [(a, c, b) for a, b, c in CLOSED])}
KNOT, TUBE = knot()  # a closed tube that hides some of its own parts
A, B, C = TUBE[200]
# The middle of the edge AB, moved into triangle ABC by a fiftieth of the triangle's height.
CRACK = tuple(0.49 * a + 0.49 * b + 0.02 * c for a, b, c in zip(KNOT[A], KNOT[B], KNOT[C]))
MESHES |= {"knot": (KNOT, TUBE), "gap": (KNOT, TUBE[:-1]),
           "crack": ([*KNOT, CRACK], [*TUBE[:200], (A, len(KNOT), C), (len(KNOT), B, C), *TUBE[201:]]),
           "away": ([(x + 1024, y - 2048, z + 4096) for x, y, z in KNOT], [(a, c, b) for a, b, c in TUBE])}
FORMS = ["--tune kernel=pair", "--tune kernel=wide", "--tune kernel=packet", "--precision fp64",
         "--tune bvh=midpoint", "--tune bvh=none"]
NEAR = "camera 3 -6 1 0 0 0 30\nlight 9 -9 9 1\nmesh closed.ply\n"
SCENES = {"scene": "ply_file inside.ply\nsphere 0 0 0 1\nsphere 0 0 0 1\ndefine red matte\n",
          "mixed": "ply_file closed.ply\nmesh closed.ply scale 1e8\n",
          # The first camera is outside the balls. The other cameras are inside.
          "eyes": "camera 0 -9 0 0 0 0 45\ncamera 0.5 0.5 0 9 0 0 45\ncamera 3 0 0 0 0 0 45\n"
                  "sphere 0 0 0 1\nsphere 3 0 0 1\nlight 9 9 9 1\n",
          "within": "camera 0.2 0.2 0.2 1 0 0 45\nmesh closed.ply\nsides two\nlight 9 9 9 1\nmesh open.ply\n",
          # The camera is in the bounding box of the tetrahedron, but not in the tetrahedron.
          "beside": "camera 0.6 0.6 0.6 0 0 0 45\nmesh closed.ply\nlight 9 9 9 1\n",
          # The first camera looks away from the mesh. The other cameras look past the mesh. At a
          # distance of 1 unit, they see a width of 4 units.
          "behind": "size 40 20\ncamera 5 0.5 0.5 9 0.5 0.5 90\ncamera 0.5 -3 0.5 9 -3 0.5 90\n"
                    "camera 5.1 -1 0 5.1 9 0 90\nmesh closed.ply\nlight 9 9 9 1\n",
          # The camera sees a width of 2 units at any distance.
          "parallel": "size 40 20\ncamera 2.6 -9 0 2.6 9 0 orthographic 1\nmesh closed.ply\nlight 9 9 9 1\n",
          "touched": "size 40 20\ncamera 1.9 -9 0 1.9 9 0 orthographic 1\nmesh closed.ply\nlight 9 9 9 1\n",
          "edge": "size 40 20\ncamera 3.9 -1 0 3.9 9 0 90\nmesh closed.ply\nlight 9 9 9 1\n",
          "glass": "camera 0 -9 0 0 0 0 45\ndefine clear glass\nmaterial clear\nmesh closed.ply\n"
                   "mesh open.ply translate 3 0 0\n",
          "distant": NEAR + "mesh closed.ply translate 1e7 0 0\n",
          "apart": "ply_file closed.ply\nsphere 1e20 0 0 1\n"}
# Each row has a file, the exit status of clrt check, and words of the report.
FINDINGS = [
    ("closed.ply", 0, ["closed.ply: 4 triangles, 4 vertices, closed", "10 edges and points: 0 hidden",
                       "\nclosed.ply: 1 mesh, 4 triangles\n", "\nfine\n"]),
    ("open.ply", 0, ["note: 3 edges of a single triangle", "triangle 0", "not closed\n", "\nno faults, 1 note\n"]),
    ("glass.scn", 0, ["open.ply: 3 triangles", "note: it is glass but not closed", "\nno faults, 2 notes\n"]),
    ("eyes.scn", 0, ["note: 2 cameras are inside an object, the first is view 2 in sphere 1\nno faults, 1 note\n"]),
    ("within.scn", 0, ["note: 1 camera is inside an object: view 1 in closed.ply\n"]),
    ("beside.scn", 0, ["\nfine\n"]),
    ("behind.scn", 0, ["closed.ply: 4 triangles", "note: it is outside every camera's view", "\nno faults, 1 note\n"]),
    ("edge.scn", 0, ["\nfine\n"]),
    ("parallel.scn", 0, ["note: it is outside every camera's view", "\nno faults, 1 note\n"]),
    ("touched.scn", 0, ["\nfine\n"]),
    ("turned.ply", 0, ["note: 3 edges whose triangles face opposite sides", "triangle 0"]),
    ("equal.ply", 1, ["FAULT: 2 triangles with two equal corners", "first triangle 2", "\n1 fault, 0 notes\n"]),
    ("line.ply", 1, ["FAULT: 1 triangle without area (corners on a line): triangle 2"]),
    ("late.ply", 1, ["FAULT: 2 triangles with two equal corners", "first triangle 0",
                     "FAULT: 1 triangle without area (corners on a line): triangle 4"]),
    ("nan.ply", 1, ["FAULT: 1 vertex with a coordinate that is not finite or past 1e30: vertex 2",
                    "FAULT: 2 triangles with such a vertex", "first triangle 0"]),
    ("twice.ply", 1, ["FAULT: 1 triangle with the corners of another: triangle 4"]),
    ("far.ply", 0, ["note: recenter it"]),
    ("mixed.scn", 0, ["note: the scale is too mixed", "1e+08 times"]),
    ("distant.scn", 0, ["note: view 1 shows objects 6.78 away, but the coordinates of its eye are rounded to "
                        "multiples of 0.5, because the scene's center is 5e+06 away: "]),
    ("apart.scn", 1, ["FAULT: the scene cannot be drawn: sphere 1", "5e11 times"]),
    ("scene.scn", 1, ["FAULT: 1 sphere that is the same as another", "note: its fronts face inwards",
                      "note: 1 material that is defined and not used",
                       "scene.scn: 1 mesh, 4 triangles, 2 spheres, 0 lights\n"]),
]


class Meshes(SharedWork):
    def prepare(self):
        for name, mesh in MESHES.items():
            (self.work / f"{name}.ply").write_bytes(ply(*mesh))
        for name, text in SCENES.items():
            (self.work / f"{name}.scn").write_text(text)
        # The first file announces more vertices than it contains. The second file is noise.
        self.write(lie_ply="ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\n",
                   noise_ply=b"\0\xffply")

    def mesh(self, *words, code=0, **environment):
        """Returns the report and its first mesh."""
        found = self.report("check", *words, "--json", code=code, **environment)
        return found, found["meshes"][0]


class Check(Meshes):
    def prepare(self):
        super().prepare()
        type(self).done = {name: self.run_clrt("check", name, f"--json={name}.json") for name, _, _ in FINDINGS}

    def test_each_finding_is_reported_beside_json_and_faults_are_exit_1(self):
        for name, code, parts in FINDINGS:
            done = self.done[name]
            self.assertEqual((done.returncode, done.stderr), (code, ""), name)
            for part in parts:
                self.assertIn(part, done.stdout)

    def test_options_may_stand_before_the_command_and_quiet_prints_nothing(self):
        self.assertEqual(self.clrt("-j", "1", "check", "closed.ply", "-q"), "")

    def test_a_scene_called_check_is_reached_by_its_path(self):
        self.write(check=SCENES["mixed"])
        self.clrt("./check", "-s", "4x4", "-o", "a.pfm", "-q")

    def test_every_form_finds_holes_and_no_others(self):
        for form in FORMS:
            found = self.mesh("knot.ply", *form.split())[1]
            self.expect(found, closed=True, leak_test__leaks__count=0, leak_test__aimed_at=720 + 240,
                        leak_test__hidden=0)
            self.assertGreater(found["leak_test"]["rays"], 960)  # hidden edges and points need several rays
            for name in "gap", "crack":
                found = self.mesh(f"{name}.ply", *form.split())[1]
                self.expect(found, closed=False, faults__open_edges__count=3)
                self.assertTrue(3 <= found["leak_test"]["leaks"]["count"] <= 10, (name, form))

    def test_a_mesh_far_away_and_turned_inside_out_leaks_nothing(self):
        found = self.mesh("away.ply")[1]
        self.expect(found, closed=True, leak_test__leaks__count=0, leak_test__aimed_at=960)

    def test_models_are_closed_and_leak_nothing(self):
        for name in "creature", "figure", "coral":
            path = ROOT / f"scenes/models/{name}.ply"
            with self.subTest(name):
                if not path.exists():
                    self.skipTest(f"{path.name} is missing")
                mesh = self.mesh(path)[1]
                self.expect(mesh, closed=True, leak_test__leaks__count=0)
                self.assertGreater(mesh["leak_test"]["aimed_at"], 13000)

    def test_json_has_every_count_a_verdict_and_the_findings(self):
        found = self.json_of("equal.ply.json")
        self.expect(found, schema=1, fine=False)
        (mesh,) = found["meshes"]
        self.expect(mesh, closed=True, faults__equal_corners={"count": 2, "first": 2},
                    faults__open_edges={"count": 0, "first": None})
        self.assertEqual([f["kind"] for f in found["findings"] if f["fails"]], ["equal_corners"])

    def test_json_counts_edges_and_rays_through_gaps_and_lengths_in_steps_of_float(self):
        (mesh,) = self.json_of("open.ply.json")["meshes"]
        self.expect(mesh, edges=6, faults__open_edges__count=3, closed=False, leak_test__cap=1048576)
        self.assertGreaterEqual(mesh["leak_test"]["leaks"]["count"], 3)
        (mesh,) = self.json_of("far.ply.json")["meshes"]
        self.expect(mesh, shortest_written_edge__steps=1)
        self.assertGreater(mesh["shortest_edge"]["steps"], 1e6)

    def test_without_a_device_the_rest_is_checked(self):
        done = self.run_clrt("check", "equal.ply", "--json=none.json", **NO_OPENCL)
        self.assertEqual(done.returncode, 1)
        self.assertIn("leaks were not tested: ", done.stdout)
        found = self.json_of("none.json")
        self.assertIsNone(found["device"])
        self.expect(found["meshes"][0], leak_test=None, closed=True)

    def test_files_that_cannot_be_read_or_written_are_one_message(self):
        self.refuses(3, "nowhere.scn: cannot be opened", "check", "nowhere.scn")
        for name in "lie.ply", "noise.ply":
            self.assertRegex(self.clrt("check", name, code=3), rf"^clrt: {name}.*\n$")
        self.refuses(5, "/dev/full: cannot be written",
                     "check", "closed.ply", "--json=/dev/full")


class BadGeometry(Meshes):
    def test_drop_is_the_default_and_reported_once_unless_quiet(self):
        done = self.run_clrt("equal.ply", "-s", "8x8", "-o", "a.pfm")
        self.assertRegex(done.stderr, r"^clrt: equal.ply: triangle 2 has two equal corners .*\n$")
        self.assertEqual(done.returncode, 0)
        done = self.run_clrt("equal.ply", "-s", "8x8", "-o", "b.pfm", "-q", "--bad-geometry", "drop")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assert_same_bytes("a.pfm", "b.pfm")

    def test_fail_draws_only_sound_meshes(self):
        words = ["-s", "8x8", "--bad-geometry", "fail", "-o"]
        for name, fault in (("equal", "has two equal corners (triangles with this fault: 2)"),
                            ("line", "has its corners on a line (triangles with this fault: 1)")):
            self.refuses(3, f"{name}.ply: triangle 2 {fault}", f"{name}.ply", *words, "c.pfm")
            self.assertFalse((self.work / "c.pfm").exists())
        self.clrt("closed.ply", *words, "d.pfm")

    def test_a_vertex_that_is_not_finite_is_refused_either_way(self):
        for choice in "drop", "fail":
            self.clrt("nan.ply", "-s", "8x8", "-o", "e.pfm", "--bad-geometry", choice, code=3)

    def test_another_word_is_refused(self):
        self.refuses(2, "--bad-geometry wants drop or fail, not 'keep'", "closed.ply", "--bad-geometry", "keep")


if __name__ == "__main__":
    main(1)
