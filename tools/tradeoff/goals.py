# SPDX-License-Identifier: MIT
"""Judges whether clrt meets goals, and at which cost. Compares each error goal with the fastest
fixed setting that meets it, and with the fastest setting of N x N samples per pixel."""

from tradeoff import front

# Errors up to this multiple of the goal meet the goal, as in tests/goals/summary.py.
MARGIN = 1.1


def rival(row, rows):
    """Returns the fastest of rows that meets the row's goal, with the row's relative cost, or
    None."""
    best = front.time_at(rows, row["goal"])
    if best is None:
        return None
    return {"setting": best["setting"], "milliseconds": best["milliseconds"],
            "samples": best["samples"], "rmse": best["rmse"],
            "times": row["milliseconds"] / best["milliseconds"],
            "samples_ratio": row["samples"] / best["samples"]}


def judge_error(row, rows):
    fixed = [other for other in rows if other["goal"] is None]
    uniform = [other for other in fixed if other["kind"] == "uniform"]
    return {"setting": row["setting"], "goal": row["goal"], "rmse": row["rmse"],
            "ratio": row["rmse"] / row["goal"], "held": row["rmse"] <= MARGIN * row["goal"],
            "estimate": row["estimate"], "milliseconds": row["milliseconds"],
            "samples": row["samples"], "front": row["front"],
            "fixed": rival(row, fixed), "uniform": rival(row, uniform)}


def judge_time(row, rows):
    """Compares a time goal with the most accurate fixed setting that is not slower."""
    within = [other for other in rows
              if other["goal"] is None and other["milliseconds"] <= row["milliseconds"]]
    best = min(within, key=lambda other: other["rmse"], default=None)
    return {"setting": row["setting"], "goal": row["goal"], "rmse": row["rmse"],
            "estimate": row["estimate"], "milliseconds": row["milliseconds"],
            "seconds_ratio": row["milliseconds"] / 1e3 / row["goal"], "front": row["front"],
            "fixed": best and {"setting": best["setting"], "rmse": best["rmse"],
                               "errors": row["rmse"] / best["rmse"]}}


def judge(rows):
    """Returns the goals of a scene as {"errors": [...], "times": [...]}, in the order of the
    rows."""
    return {"errors": [judge_error(row, rows) for row in rows if row["kind"] == "error"],
            "times": [judge_time(row, rows) for row in rows if row["kind"] == "time"]}


def all_errors(scenes):
    return [goal for scene in scenes for goal in scene["goals"]["errors"]]


def summary(scenes):
    """Returns a sentence about all error goals, or None without error goals."""
    errors = all_errors(scenes)
    if not errors:
        return None
    held = sum(goal["held"] for goal in errors)
    strictly = sum(goal["ratio"] <= 1 for goal in errors)
    on_front = sum(goal["front"] for goal in errors)
    return (f"{held} of {len(errors)} error goals are met within {MARGIN:g} E, {strictly} within "
            f"E; {on_front} lie on their scene's front")
