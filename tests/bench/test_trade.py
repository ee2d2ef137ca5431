#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests tools/trade with a small picture: the fronts, the figures and the page. Usage:
test_trade.py FOLDER"""

import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# This scene uses every feature of the general kernels, which other tests compile too.
SCENE = ROOT / "tests" / "image" / "painted.scn"
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests/cli")]
from pictures import read_pfm  # noqa: E402
from tradeoff import front, goals, labels, measure, uniform  # noqa: E402


def row(milliseconds, rmse):
    return {"milliseconds": milliseconds, "rmse": rmse}


class Front(unittest.TestCase):
    def test_only_unbeaten_settings_are_on_the_front(self):
        rows = [row(1, 9), row(2, 5), row(3, 5), row(2, 6), row(4, 1), row(5, 2)]
        front.mark(rows)
        self.assertEqual([r["front"] for r in rows], [True, True, False, False, True, False])
        self.assertEqual(front.front(rows), [rows[0], rows[1], rows[4]])

    def test_equals_do_not_beat_each_other(self):
        rows = [row(1, 1), row(1, 1)]
        front.mark(rows)
        self.assertTrue(all(r["front"] for r in rows))

    def test_the_fastest_setting_within_an_error_gives_its_cost(self):
        rows = [row(1, 9), row(4, 1), row(3, 5)]
        self.assertIs(front.time_at(rows, 5), rows[2])
        self.assertIsNone(front.time_at(rows, 0.5))


def setting(kind, milliseconds, rmse, samples, goal=None, name=None):
    return {"kind": kind, "setting": name or f"{kind} {samples}", "milliseconds": milliseconds,
            "rmse": rmse, "samples": samples, "goal": goal, "estimate": rmse, "front": False}


class Goals(unittest.TestCase):
    ROWS = [setting("uniform", 4, 0.05, 100, name="aa=1"),
            setting("uniform", 11, 0.02, 400, name="aa=2"),
            setting("uniform", 20, 0.009, 900, name="aa=3"),
            setting("uniform", 35, 0.006, 1600, name="aa=4"),
            setting("adaptive", 5, 0.008, 200), setting("error", 10, 0.0105, 300, 0.01),
            setting("error", 10, 0.0012, 300, 0.001), setting("time", 6, 0.016, 300, 0.008)]

    def test_a_goal_is_compared_with_the_fastest_fixed_and_uniform_settings_that_hold_it(self):
        goal = goals.judge(self.ROWS)["errors"][0]
        self.assertEqual((goal["fixed"]["setting"], goal["fixed"]["times"]), ("adaptive 200", 2))
        self.assertEqual(goal["uniform"]["setting"], "aa=3")
        self.assertEqual(goal["uniform"]["times"], 0.5)
        self.assertEqual(goal["uniform"]["samples_ratio"], 300 / 900)

    def test_a_user_who_doubles_n_pays_for_every_trial(self):
        doubling = goals.judge(self.ROWS)["errors"][0]["doubling"]
        self.assertEqual(doubling["setting"], "aa=1, aa=2, aa=4")
        self.assertEqual((doubling["milliseconds"], doubling["samples"]), (50, 2100))
        self.assertEqual(doubling["times"], 10 / 50)

    def test_a_goal_that_nothing_fixed_holds_has_no_rival(self):
        goal = goals.judge(self.ROWS)["errors"][1]
        self.assertIsNone(goal["fixed"])
        self.assertIsNone(goal["uniform"])
        self.assertIsNone(goal["doubling"])

    def test_a_time_is_compared_with_the_smallest_error_at_its_speed(self):
        goal = goals.judge(self.ROWS)["times"][0]
        self.assertEqual((goal["fixed"]["setting"], goal["fixed"]["errors"]), ("adaptive 200", 2))
        self.assertEqual(goal["seconds_ratio"], 0.75)

    def test_errors_are_held_within_a_tenth(self):
        self.assertEqual(
            goals.summary([{"goals": goals.judge(self.ROWS)}]),
            "1 of 2 error goals are met within 1.1 E, 0 within E; 0 lie on their scene's front")


class Names(unittest.TestCase):
    def test_scenes_of_one_name_are_numbered(self):
        self.assertEqual(measure.names_of(["a/cow.scn", "b/cow.scn", "c.scn", "d/cow.scn"]),
                         ["cow", "cow-2", "c", "cow-3"])


class Uniform(unittest.TestCase):
    def side(self, error, tried):
        return uniform.side_that_holds(error, tried, lambda side: 1 / side)

    def test_the_fewest_samples_that_hold_an_error_are_found(self):
        for wanted in (1, 2, 5, 7, 11, 12, 29, 64):
            tried = {side: 1 / side for side in (2, 4, 12)}
            self.assertEqual(self.side(1 / wanted, tried), wanted)

    def test_the_fewest_samples_are_found_without_earlier_trials(self):
        self.assertEqual(self.side(0.1, {}), 10)

    def test_doubling_ends_at_the_next_power_of_two(self):
        self.assertEqual([uniform.next_power(side) for side in (1, 2, 3, 4, 5, 9)],
                         [1, 2, 4, 4, 8, 16])

    def test_none_is_returned_if_no_side_holds_the_error(self):
        self.assertIsNone(self.side(1 / 65, {1: 1}))


class ProcessorTime(unittest.TestCase):
    def test_enough_frames_are_drawn_and_the_start_is_subtracted(self):
        for seconds in (0.001, 0.1, 9):
            drawn = []

            def seconds_of(frames):
                drawn.append(frames)
                return 3 + seconds * frames

            self.assertAlmostEqual(measure.frame_seconds(seconds_of), seconds)
            self.assertGreaterEqual(seconds * (drawn[-1] - 1), measure.PROCESSOR_SECONDS)
            self.assertLessEqual(len(drawn), 4)

    def test_frames_without_measurable_time_end_the_search(self):
        self.assertEqual(measure.frame_seconds(lambda frames: 1), 0)

    def test_a_row_gets_the_processor_time_of_a_frame(self):
        options = argparse.Namespace(clrt_words=["-s", "64x48"], processor_time=True)
        row = {"kind": "uniform", "words": ["--aa=8"], "times": []}
        with tempfile.TemporaryDirectory() as folder, \
                unittest.mock.patch.object(measure, "PROCESSOR_SECONDS", 0.05):
            measure.time_row(row, SCENE, options, pathlib.Path(folder))
        self.assertTrue(0 < row["times"][0] < 1)


class Labels(unittest.TestCase):
    def test_no_name_lies_on_another_or_on_a_point(self):
        points = [(100 + 7 * i, 200 - 5 * i) for i in range(12)]
        names = [(point, f"setting={place}") for place, point in enumerate(points)]
        places = labels.place(names, points, (0, 0, 400, 400))
        boxes = [labels.box_at(center, labels.extent(text))
                 for (center, _), (_, text) in zip(places, names)]
        for place, box in enumerate(boxes):
            self.assertFalse(any(labels.overlap(box, other) for other in boxes[:place]))
            self.assertFalse(any(labels.overlap(box, (x, y, x, y)) for x, y in points))


class Trade(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(FOLDER)
        (cls.folder / "trade.html").unlink(missing_ok=True)
        done = subprocess.run(
            [ROOT / "tools" / "trade", SCENE, "--quick", "--runs", "2", "-s", "64x48",
             "--reference-samples", "256", "-o", cls.folder],
            capture_output=True, text=True, check=False)
        cls.said, cls.told = done.stderr, done.stdout
        assert done.returncode == 0, done.stderr
        cls.figures = json.loads((cls.folder / "trade.json").read_text())["scenes"][0]
        cls.rows = {row["setting"]: row for row in cls.figures["rows"]}

    def test_more_samples_are_less_wrong_and_fewer_bounces_more(self):
        rmse = {name: row["rmse"] for name, row in self.rows.items()}
        self.assertGreater(rmse["aa=1"], rmse["aa=2"])
        self.assertGreater(rmse["aa=2"], rmse["aa=4"])
        self.assertGreater(rmse["aa=2 max-level=1"], 2 * rmse["aa=2"])
        self.assertLess(self.figures["reference"]["own_error"], rmse["aa=4"])

    def test_goals_are_settings_whose_errors_are_judged(self):
        told = self.figures["goals"]
        self.assertEqual([goal["goal"] for goal in told["errors"]], [0.02, 0.01])
        for goal in told["errors"]:
            self.assertEqual(goal["rmse"], self.rows[goal["setting"]]["rmse"])
            self.assertTrue(0.2 < goal["ratio"] < 1.5)
            self.assertLessEqual(goal["uniform"]["rmse"], goal["goal"])
            self.assertLessEqual(goal["fixed"]["milliseconds"], goal["uniform"]["milliseconds"])
            self.assertIn(f"E {100 * goal['goal']:g} %: RMSE {goal['ratio']:.2f} E", self.told)
            for name, rival in ("fastest setting", "fixed"), ("fastest N x N", "uniform"):
                self.assertRegex(self.told, rf"{name} +{goal[rival]['times']:.2f} x its time, +"
                                 rf"{goal[rival]['samples_ratio']:.2f} x its samples \({goal[rival]['setting']}\)")
        self.assertTrue(0.5 < told["times"][0]["seconds_ratio"] < 2)
        self.assertIn("aa=3", self.rows)  # added because it meets 1 %

    def test_the_grid_runs_as_tasks_of_an_array_and_resumes(self):
        with tempfile.TemporaryDirectory() as folder:
            words = [ROOT / "tools" / "trade", SCENE, "--quick", "--runs", "1", "-s", "64x48", "--plain",
                     "--reference-samples", "256", "-o", folder, "--on", "local"]
            for stages in (["reference 1", "setting 1-7", "report"], ["setting 3", "report"]):
                done = subprocess.run(words, capture_output=True, text=True, check=True)
                self.assertEqual(re.findall(r"^(.*); logs: ", done.stderr, re.M), stages)
                rows = json.loads(pathlib.Path(folder, "trade.json").read_text())["scenes"][0]["rows"]
                rmse = {row["setting"]: row["rmse"] for row in rows if row["kind"] != "time"}
                self.assertEqual(rmse, {name: row["rmse"] for name, row in self.rows.items() if name in rmse})
                self.assertEqual(len(rows), len(self.rows))
                pathlib.Path(folder, "painted", "2.row").unlink()

    def squares_of(self, name):
        """Returns the squared errors of a setting's pixels."""
        pictures = [sum(read_pfm(self.folder / "painted" / file), [])
                    for file in ("reference.pfm", self.rows[name]["picture"])]
        squares = [(a - b) ** 2 for a, b in zip(*pictures)]
        return [sum(squares[i:i + 3]) / 3 for i in range(0, len(squares), 3)]

    def test_the_oracle_is_never_worse_than_a_uniform_setting(self):
        if "oracle" not in self.figures:
            self.skipTest("numpy is missing")
        points, rows = self.figures["oracle"], [self.rows[f"aa={side}"] for side in (1, 2, 3, 4)]
        for uniform_row in rows:
            best = front.time_at(points, 1.001 * uniform_row["rmse"])
            self.assertLessEqual(best["milliseconds"], 1.01 * uniform_row["milliseconds"])
        least = [min(squares) for squares in zip(*(self.squares_of(row["setting"]) for row in rows))]
        self.assertAlmostEqual(points[-1]["rmse"], (sum(least) / len(least)) ** 0.5, delta=1e-5)
        for goal in self.figures["goals"]["errors"]:
            best = front.time_at(points, goal["goal"])
            self.assertEqual(goal["oracle_times"], goal["milliseconds"] / best["milliseconds"])

    def test_each_step_is_announced(self):
        steps = ["reference", *(f"setting {number} of 7" for number in range(1, 8)),
                 "round 1 of 2", "round 2 of 2"]
        self.assertEqual(re.findall(r"painted\.scn: (\w+.*)", self.said), steps)

    def test_every_setting_is_timed_in_every_round(self):
        for row in self.rows.values():
            self.assertEqual(len(row["times"]), 2)
            self.assertTrue(0 < row["fastest"] <= row["milliseconds"] <= row["slowest"])

    def test_the_csv_has_the_same_rows(self):
        with open(self.folder / "trade.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["setting"] for row in rows], [*self.rows])
        for row in rows:
            self.assertEqual(float(row["rmse"]), self.rows[row["setting"]]["rmse"])
            self.assertEqual(row["pixel_hash"], self.rows[row["setting"]]["pixel_hash"])

    def test_the_page_stands_alone_and_has_every_figure(self):
        page = self.folder / "trade.html"
        if not page.exists():
            self.assertIn("tools/trade: no page, no SSIM, no FLIP and no oracle: ", self.said)
            print(f"skipped: {self.said.strip().splitlines()[-1]}", file=sys.stderr)
            return
        text = page.read_text(encoding="utf-8")
        for source in re.findall(r'(?:src|href|xlink:href)="([^"]*)"', text):
            self.assertRegex(source, r"^(data:|#)")
        for name, row in self.rows.items():
            self.assertIn(f"<td>{name}</td>", text)
            self.assertIn(f"{100 * row['rmse']:.4f}", text)
        for goal in self.figures["goals"]["errors"]:
            self.assertIn(f"<td>{goal['ratio']:.2f} E", text)
            self.assertIn(f"<td>{goal['oracle_times']:.2f} x time", text)
        self.assertIn("oracle: the best N x N in each pixel", text)
        self.assertGreater(self.rows["aa=4"]["ssim"], self.rows["aa=1"]["ssim"])
        self.assertLess(self.rows["aa=4"]["flip"], self.rows["aa=1"]["flip"])
        self.assertTrue(all(0 <= row["flip"] < 0.2 < row["ssim"] <= 1
                            for row in self.rows.values()))


if __name__ == "__main__":
    FOLDER = sys.argv.pop(1)
    unittest.main(verbosity=2)
