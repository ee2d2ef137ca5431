# SPDX-License-Identifier: MIT
"""Finds the Pareto front of settings, and the fastest setting for an error."""


def mark(rows):
    """Sets "front" of each row: false if another row is at least as fast and as accurate, and
    better in time or accuracy."""
    for row in rows:
        row["front"] = not any(
            other["milliseconds"] <= row["milliseconds"] and other["rmse"] <= row["rmse"]
            and (other["milliseconds"], other["rmse"]) != (row["milliseconds"], row["rmse"])
            for other in rows)


def front(rows):
    """Returns the rows on the front, the fastest first."""
    return sorted((row for row in rows if row["front"]), key=lambda row: row["milliseconds"])


def time_at(rows, rmse):
    """Returns the fastest row with at most this error, or None."""
    within = [row for row in rows if row["rmse"] <= rmse]
    return min(within, key=lambda row: row["milliseconds"], default=None)
