# SPDX-License-Identifier: MIT
"""Judges whether clrt meets goals, and at which cost. Compares each error goal with three
rivals: the fastest fixed setting that meets the goal, the fastest setting of N x N samples per
pixel, and a user who doubles N until a picture meets the goal."""

from tradeoff import front, uniform

# Errors up to this multiple of the goal meet the goal, as in tests/goals/summary.py.
MARGIN = 1.1


def rival(row, trials):
    """Returns the total cost of the trials, and the row's cost relative to it, or None without
    trials. The last trial meets the row's goal."""
    if not trials:
        return None
    milliseconds = sum(trial["milliseconds"] for trial in trials)
    samples = sum(trial["samples"] for trial in trials)
    return {"setting": ", ".join(trial["setting"] for trial in trials),
            "milliseconds": milliseconds, "samples": samples, "rmse": trials[-1]["rmse"],
            "times": row["milliseconds"] / milliseconds,
            "samples_ratio": row["samples"] / samples}


def fastest(row, rows):
    best = front.time_at(rows, row["goal"])
    return [best] if best else []


def doubling(row, rows):
    """Returns the uniform settings 1 x 1, 2 x 2, 4 x 4 and so on, up to the first that meets the
    row's goal. Returns an empty list if rows lack one of these settings."""
    by_side = {uniform.side_of(other): other for other in rows}
    trials, side = [], 1
    while side in by_side:
        trials.append(by_side[side])
        if trials[-1]["rmse"] <= row["goal"]:
            return trials
        side *= 2
    return []


def judge_error(row, rows):
    fixed = [other for other in rows if other["goal"] is None]
    plain = [other for other in fixed if other["kind"] == "uniform"]
    return {"setting": row["setting"], "goal": row["goal"], "rmse": row["rmse"],
            "ratio": row["rmse"] / row["goal"], "held": row["rmse"] <= MARGIN * row["goal"],
            "estimate": row["estimate"], "milliseconds": row["milliseconds"],
            "samples": row["samples"], "front": row["front"],
            "fixed": rival(row, fastest(row, fixed)), "uniform": rival(row, fastest(row, plain)),
            "doubling": rival(row, doubling(row, plain))}


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
