#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tools/trade on a small picture: its fronts, its figures and its page: test_trade.py FOLDER."""

import csv
import json
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCENE = ROOT / "scenes" / "reflections.scn"
sys.path.insert(0, str(ROOT / "tools"))
from tradeoff import front  # noqa: E402


def row(milliseconds, rmse):
    return {"milliseconds": milliseconds, "rmse": rmse}


class Front(unittest.TestCase):
    def test_only_what_nothing_beats_is_on_the_front(self):
        rows = [row(1, 9), row(2, 5), row(3, 5), row(2, 6), row(4, 1), row(5, 2)]
        front.mark(rows)
        self.assertEqual([r["front"] for r in rows], [True, True, False, False, True, False])
        self.assertEqual(front.front(rows), [rows[0], rows[1], rows[4]])

    def test_equals_do_not_beat_each_other(self):
        rows = [row(1, 1), row(1, 1)]
        front.mark(rows)
        self.assertTrue(all(r["front"] for r in rows))

    def test_an_error_costs_what_its_fastest_setting_takes(self):
        rows = [row(1, 9), row(4, 1), row(3, 5)]
        self.assertIs(front.time_at(rows, 5), rows[2])
        self.assertIsNone(front.time_at(rows, 0.5))


class Trade(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(FOLDER)
        (cls.folder / "trade.html").unlink(missing_ok=True)
        done = subprocess.run(
            [ROOT / "tools" / "trade", SCENE, "--quick", "--runs", "2", "-s", "64x48",
             "--reference-samples", "256", "-o", cls.folder],
            capture_output=True, text=True, check=False)
        cls.said = done.stderr
        assert done.returncode == 0, done.stderr
        cls.figures = json.loads((cls.folder / "trade.json").read_text())["scenes"][0]
        cls.rows = {row["setting"]: row for row in cls.figures["rows"]}

    def test_more_samples_are_less_wrong_and_fewer_bounces_more(self):
        rmse = {name: row["rmse"] for name, row in self.rows.items()}
        self.assertGreater(rmse["aa=1"], rmse["aa=2"])
        self.assertGreater(rmse["aa=2"], rmse["aa=4"])
        self.assertGreater(rmse["aa=2 max-level=1"], 2 * rmse["aa=2"])
        self.assertLess(self.figures["reference"]["own_error"], rmse["aa=4"])

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
            self.assertIn("tools/trade: no page, no SSIM and no FLIP: ", self.said)
            print(f"passed over: {self.said.strip().splitlines()[-1]}", file=sys.stderr)
            return
        text = page.read_text(encoding="utf-8")
        for source in re.findall(r'(?:src|href|xlink:href)="([^"]*)"', text):
            self.assertRegex(source, r"^(data:|#)")
        for name, row in self.rows.items():
            self.assertIn(f"<td>{name}</td>", text)
            self.assertIn(f"{100 * row['rmse']:.4f}", text)
        self.assertGreater(self.rows["aa=4"]["ssim"], self.rows["aa=1"]["ssim"])
        self.assertLess(self.rows["aa=4"]["flip"], self.rows["aa=1"]["flip"])
        self.assertTrue(all(0 <= row["flip"] < 0.2 < row["ssim"] <= 1
                            for row in self.rows.values()))


if __name__ == "__main__":
    FOLDER = sys.argv.pop(1)
    unittest.main(verbosity=2)
