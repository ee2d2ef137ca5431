# SPDX-License-Identifier: MIT
"""Finds the Pareto front of settings, and the fastest setting for an error."""


def mark(rows):
    """Sets "front" of each row to whether no other row beats it: at least as fast and accurate, and
    better in one of them."""
    for row in rows:
        row["front"] = not any(
            other["milliseconds"] <= row["milliseconds"] and other["rmse"] <= row["rmse"]
            and (other["milliseconds"], other["rmse"]) != (row["milliseconds"], row["rmse"])
            for other in rows)


def front(rows):
    """Returns the rows on the front, the fastest first."""
    return sorted((row for row in rows if row["front"]), key=lambda row: row["milliseconds"])


def time_at(rows, rmse):
    """Returns the fastest row with at most that error, or None."""
    within = [row for row in rows if row["rmse"] <= rmse]
    return min(within, key=lambda row: row["milliseconds"], default=None)
