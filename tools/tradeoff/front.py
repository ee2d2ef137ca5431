# SPDX-License-Identifier: MIT
"""Which settings nothing beats, and what an error costs."""


def mark(rows):
    """Sets "front" of each row: no other is as fast and as right, and better in one of the two."""
    for row in rows:
        row["front"] = not any(
            other["milliseconds"] <= row["milliseconds"] and other["rmse"] <= row["rmse"]
            and (other["milliseconds"], other["rmse"]) != (row["milliseconds"], row["rmse"])
            for other in rows)


def front(rows):
    """The rows on the front, the fastest first."""
    return sorted((row for row in rows if row["front"]), key=lambda row: row["milliseconds"])


def time_at(rows, rmse):
    """The fastest row within an error, None where no setting is."""
    within = [row for row in rows if row["rmse"] <= rmse]
    return min(within, key=lambda row: row["milliseconds"], default=None)
