# SPDX-License-Identifier: MIT
"""The settings that are tried: names and clrt's words for them."""

from benchmark import common

# The assignment's own setting, which others are compared with.
BASE = "aa=2"


def setting(*words):
    return " ".join(word.lstrip("-").replace("aa-adaptive", "adaptive") for word in words), [*words]


def plain(sides):
    return [setting(f"--aa={side}") for side in sides]


def all_settings(is_quick):
    """(name, words) of each; a quick grid has few."""
    if is_quick:
        return plain([1, 2, 4]) + [setting("--aa=2", "--max-level=1")]
    settings = plain([1, 2, 3, 4, 6, 8, 12])
    settings += [setting(f"--aa={side}", f"--max-level={level}") for side in [1, 2, 4, 8]
                 for level in [1, 2]]
    settings += [setting(f"--aa={side}", "--precision=fp64") for side in [1, 2, 4, 8]]
    if common.has_option("--aa-adaptive"):
        settings += [setting(f"--aa-adaptive={contrast}")
                     for contrast in [0.3, 0.1, 0.05, 0.02, 0.01, 0.005]]
    return settings
