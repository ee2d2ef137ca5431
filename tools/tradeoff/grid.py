# SPDX-License-Identifier: MIT
"""The settings to measure. Each has a kind, a name and arguments for clrt. The kinds error and time
are goals; all other kinds are fixed settings."""

import collections

from benchmark import common

KINDS = ["uniform", "levels", "fp64", "adaptive", "error", "time"]

# The setting of the course's assignment (docs/scenes.md), the base of comparisons.
BASE = "aa=2"

# The goals: root mean square errors, and seconds of tracing.
ERRORS = [0.02, 0.01, 0.005, 0.002]
SECONDS = [0.5, 2]

Setting = collections.namedtuple("Setting", "kind name words goal")


def setting(kind, *words, goal=None):
    name = " ".join(word.lstrip("-").replace("aa-adaptive", "adaptive") for word in words)
    return Setting(kind, name, [*words], goal)


def plain(sides):
    return [setting("uniform", f"--aa={side}") for side in sides]


def goals(errors, seconds):
    return ([setting("error", f"--error={100 * error:g}%", goal=error) for error in errors]
            + [setting("time", f"--time={time:g}", goal=time) for time in seconds])


def quick_settings():
    return (plain([1, 2, 4]) + [setting("levels", "--aa=2", "--max-level=1")]
            + goals([0.02, 0.01], [0.05]))


def many_settings():
    settings = plain([1, 2, 3, 4, 6, 8, 12])
    settings += [setting("levels", f"--aa={side}", f"--max-level={level}")
                 for side in [1, 2, 4, 8] for level in [1, 2]]
    settings += [setting("fp64", f"--aa={side}", "--precision=fp64") for side in [1, 2, 4, 8]]
    if common.has_option("--aa-adaptive"):
        settings += [setting("adaptive", f"--aa-adaptive={contrast:g}")
                     for contrast in [0.3, 0.2, 0.1, 0.05, 0.04, 0.02, 0.01, 0.005, 0.002]]
    if common.has_option("--error"):
        settings += goals(ERRORS, SECONDS)
    return settings


def all_settings(is_quick, kinds):
    """Returns the settings of these kinds. A quick grid has few settings."""
    settings = quick_settings() if is_quick else many_settings()
    return [chosen for chosen in settings if chosen.kind in kinds]
