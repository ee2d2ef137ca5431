# SPDX-License-Identifier: MIT
"""What goals hold and cost: each beside the fastest fixed setting that holds the same error, and
the fastest of those that take N x N samples everywhere."""

from tradeoff import front

# Errors up to this times the goal count as held, as in tests/image/test_goals.c.
MARGIN = 1.1


def rival(row, rows):
    """The fastest of the rows within the goal of the row, and what the row costs beside it."""
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
    """A time's rival is the least wrong fixed setting that takes no longer."""
    within = [other for other in rows
              if other["goal"] is None and other["milliseconds"] <= row["milliseconds"]]
    best = min(within, key=lambda other: other["rmse"], default=None)
    return {"setting": row["setting"], "goal": row["goal"], "rmse": row["rmse"],
            "estimate": row["estimate"], "milliseconds": row["milliseconds"],
            "seconds_ratio": row["milliseconds"] / 1e3 / row["goal"], "front": row["front"],
            "fixed": best and {"setting": best["setting"], "rmse": best["rmse"],
                               "errors": row["rmse"] / best["rmse"]}}


def judge(rows):
    """The goals of a scene: {"errors": [...], "times": [...]}, in the order of the rows."""
    return {"errors": [judge_error(row, rows) for row in rows if row["kind"] == "error"],
            "times": [judge_time(row, rows) for row in rows if row["kind"] == "time"]}


def all_errors(scenes):
    return [goal for scene in scenes for goal in scene["goals"]["errors"]]


def summary(scenes):
    """One sentence on all errors that were asked for, None where none was."""
    errors = all_errors(scenes)
    if not errors:
        return None
    held = sum(goal["held"] for goal in errors)
    strictly = sum(goal["ratio"] <= 1 for goal in errors)
    on_front = sum(goal["front"] for goal in errors)
    return (f"of {len(errors)} errors asked for {held} are held within {MARGIN:g} E, {strictly} "
            f"within E; {on_front} lie on their scene's front")
