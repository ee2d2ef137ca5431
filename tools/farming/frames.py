# SPDX-License-Identifier: MIT
"""The numbers and names of many pictures, as clrt chooses them."""

import pathlib
import re


def numbers(turntable, text):
    """Returns the numbers of --turntable and --frames: empty without options, None if invalid."""
    if text is None:
        return range(1, (turntable or 0) + 1)
    found = re.fullmatch(r"(\d+)-(\d+)(?::(\d+))?", text)
    first, last, step = (int(part or 1) for part in found.groups()) if found else (0, 0, 0)
    is_valid = 1 <= first <= last <= (turntable or last) and step >= 1
    return range(first, last + 1, step) if is_valid else None


def share(all_numbers, task, tasks):
    """Returns the numbers of one task's pictures. Tasks are numbered from 1 to `tasks`."""
    count = len(all_numbers)
    return all_numbers[count * (task - 1) // tasks:count * task // tasks]


def name(pattern, number):
    """Returns the file's name: the number replaces the last run of '#', or precedes the ending."""
    path = pathlib.PurePath(pattern)
    if crosses := re.fullmatch(r"(.*?)(#+)([^#]*)", path.name):
        before, digits, after = crosses[1], len(crosses[2]), crosses[3]
    else:
        before, digits, after = f"{path.stem}.", 4, path.suffix
    return str(path.with_name(f"{before}{number:0{digits}}{after}"))
