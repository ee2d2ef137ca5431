# SPDX-License-Identifier: MIT
"""The numbers and names of many pictures, as clrt chooses them."""

import re

TURNTABLE_MOST = 1000000


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
    folder, slash, file = pattern.rpartition("/")
    if crosses := re.fullmatch(r"(.*?)(#+)([^#]*)", file, re.DOTALL):
        before, digits, after = crosses[1], len(crosses[2]), crosses[3]
    else:
        end = file.rfind(".") if "." in file else len(file)
        before, digits, after = f"{file[:end]}.", 4, file[end:]
    return f"{folder}{slash}{before}{number:0{digits}}{after}"
