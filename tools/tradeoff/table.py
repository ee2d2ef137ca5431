# SPDX-License-Identifier: MIT
"""Writes the figures as CSV and as lines of text."""

import csv

from tradeoff import goals

COLUMNS = ["kind", "setting", "goal", "estimate", "front", "milliseconds", "fastest", "slowest",
           "rmse", "psnr", "maximum", "share_off_by_1", "share_off_by_4", "ssim", "flip",
           "megarays_per_second", "samples", "rays", "bytes", "pixel_hash"]


def write_csv(path, scenes):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["scene", *COLUMNS], extrasaction="ignore")
        writer.writeheader()
        for scene in scenes:
            for row in scene["rows"]:
                writer.writerow({"scene": scene["scene"], **row})


def show(scene):
    """Yields a heading and a line per setting, the fastest first, with a star on the front."""
    reference = scene["reference"]
    yield (f"{scene['scene']}: reference of {reference['samples']} samples, own RMSE "
           f"{reference['own_error']:.2g}; * marks settings that no other beats in time and RMSE")
    for row in sorted(scene["rows"], key=lambda row: row["milliseconds"]):
        yield (f"{'*' if row['front'] else ' '} {row['setting']:24} {row['milliseconds']:9.2f} ms "
               f"RMSE {row['rmse']:.2e}  largest {row['maximum']:.3f}  "
               f"off by more than 1/255: {100 * row['share_off_by_1']:.2f} %")


def rival_text(name, rival):
    if rival is None:
        return f"    {name:16} does not meet it"
    return (f"    {name:16} {rival['times']:6.2f} x its time, {rival['samples_ratio']:5.2f} x its "
            f"samples ({rival['setting']})")


def show_error_goal(scene, goal):
    """Yields a line for an error goal, and a line for each of its rivals."""
    yield (f"{'*' if goal['front'] else ' '} {scene}, E {100 * goal['goal']:g} %: RMSE "
           f"{goal['ratio']:.2f} E in {goal['milliseconds']:.2f} ms, compared with")
    yield rival_text("fastest setting", goal["fixed"])
    yield rival_text("fastest N x N", goal["uniform"])
    yield rival_text("doubling N", goal["doubling"])
    if "oracle_times" in goal:
        yield f"    {'the oracle':16} {goal['oracle_times']:6.2f} x its time"


def show_goals(scenes):
    """Yields lines for each error goal and each time goal, and a summary of the error goals."""
    for scene in scenes:
        for goal in scene["goals"]["errors"]:
            yield from show_error_goal(scene["scene"], goal)
        for goal in scene["goals"]["times"]:
            best = goal["fixed"]
            beside = f"{best['errors']:.2f} x the error of {best['setting']}" if best else "alone"
            yield (f"{'*' if goal['front'] else ' '} {scene['scene']}, {goal['goal']:g} s: "
                   f"took {goal['seconds_ratio']:.2f} of it, RMSE {goal['rmse']:.2e}, {beside}")
    if goals.summary(scenes):
        yield goals.summary(scenes)
