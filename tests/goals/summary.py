# SPDX-License-Identifier: MIT
"""Prints tables of the files of hold.py, and judges whether the results keep the promise of
--error."""

import json
import math
import pathlib

# Errors up to this multiple of the goal meet the goal.
MARGIN = 1.1

# Bounds have 95 % confidence, so 5 % of the errors may exceed them. A larger share is a failure
# only if its probability is below CHANCE.
ABOVE_MOST = 0.05
CHANCE = 0.01

# The promise. At least HELD_LEAST of the pictures meet their goal, at most MISSED_MOST have status
# 1, and no bound is 0. Among the pictures with status 0, at most WIDE_MOST have an error above WIDE
# times the goal, and none has an error above WIDEST times the goal.
HELD_LEAST = 0.95
MISSED_MOST = 0.05
WIDE, WIDE_MOST = 1.3, 0.01
WIDEST = 1.5


def read(paths):
    return [json.loads(line) for path in paths for line in pathlib.Path(path).read_text().splitlines()]


def pictures_of(rows):
    """Returns a dictionary for each picture. Its `ratio` is the error divided by the goal."""
    return [{"scene": row["scene"], "seed": row["seed"], **goal,
             "ratio": goal["rmse"] / goal["goal"]} for row in rows for goal in row["goals"]]


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values)) if values else math.nan


def share(pictures, holds):
    return sum(map(holds, pictures)) / len(pictures) if pictures else 0.0


def chance_of(count, total, probability):
    """Returns the probability of at least count events among total."""
    def chance_of_exactly(i):
        ways = math.lgamma(total + 1) - math.lgamma(i + 1) - math.lgamma(total - i + 1)
        return math.exp(ways + i * math.log(probability) + (total - i) * math.log(1 - probability))

    return sum(map(chance_of_exactly, range(count, total + 1)))


def judge(pictures):
    """Returns the figures of the promise, each with whether it is kept."""
    done = [picture for picture in pictures if picture["status"] == 0]
    held = share(pictures, lambda picture: picture["ratio"] <= MARGIN)
    missed = 1 - len(done) / len(pictures)
    wide = share(done, lambda picture: picture["ratio"] > WIDE)
    widest = max((picture["ratio"] for picture in done), default=0.0)
    unbound = sum(picture["bound"] == 0 for picture in pictures)
    above = sum(picture["rmse"] > picture["bound"] for picture in pictures)
    return [(f"within {MARGIN} E", f"{held:.1%}", held >= HELD_LEAST),
            ("exit status 1", f"{missed:.1%}", missed <= MISSED_MOST),
            (f"status 0 and above {WIDE} E", f"{wide:.1%}", wide <= WIDE_MOST),
            ("largest with status 0", f"{widest:.2f} E", widest <= WIDEST),
            ("bounds of 0", f"{unbound}", unbound == 0),
            ("errors above their bound", f"{above / len(pictures):.1%}",
             chance_of(above, len(pictures), ABOVE_MOST) >= CHANCE)]


def print_groups(pictures, key, title):
    print(f"{title:12} pictures  held    max E  exit 1  samples/pixel")
    for value in sorted({picture[key] for picture in pictures}):
        group = [picture for picture in pictures if picture[key] == value]
        print(f"{value!s:12} {len(group):8}  {share(group, lambda p: p['ratio'] <= MARGIN):6.1%}"
              f"  {max(p['ratio'] for p in group):5.2f}  {share(group, lambda p: p['status']):6.1%}"
              f"  {geometric_mean([p['samples'] for p in group]):13.2f}")


def print_costs(pictures):
    """Prints the cost of --error relative to the cheapest fixed settings with that error."""
    print("goal    rival     pictures  samples     time  processor   (geometric means, --error / "
          "rival; the last figure is the largest)")
    for goal in sorted({picture["goal"] for picture in pictures}, reverse=True):
        for rival in ("uniform", "adaptive"):
            pairs = [(picture, picture[rival]) for picture in pictures
                     if picture["goal"] == goal and picture.get(rival)]
            if pairs:
                ratios = {key: [own[key] / other[key] for own, other in pairs]
                          for key in ("samples", "seconds", "processor")}
                means = [f"{geometric_mean(values):7.2f}" for values in ratios.values()]
                print(f"{goal:<7.2%} {rival:9} {len(pairs):8}  {'  '.join(means)}"
                      f"  {max(ratios['processor']):7.2f}")


def report(paths):
    """Prints the tables. Returns the exit status, which is 1 if the promise is broken."""
    pictures = pictures_of(read(paths))
    for picture in pictures:
        picture["kind"] = picture["scene"].split("-")[-1]
    for key in ("seed", "goal", "kind"):
        print_groups(pictures, key, key)
    print_costs(pictures)
    verdicts = judge(pictures)
    for name, figure, is_kept in verdicts:
        print(f"{name}: {figure}{'' if is_kept else ' (broken)'}")
    return 0 if all(is_kept for _, _, is_kept in verdicts) else 1
