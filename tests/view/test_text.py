#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the text in the window at two densities of the screen. The line at the top and the help
must fit any window. A hint must lead to the help, and a note must name what a scene lacks.
Usage: CLRT=path/to/clrt test_text.py"""

import time

from screen import SCENE, Window, opened, run_tests

HINT_SECONDS = 5


def extent(plain, shown, size):
    """Returns the width and height of the area, from the upper left corner, where the pictures differ."""
    width = 4 * size[0]
    rows = [(plain[y * width:(y + 1) * width], shown[y * width:(y + 1) * width])
            for y in range(size[1])]
    lower = max(y + 1 for y, (one, other) in enumerate(rows) if one != other)
    right = max(x // 4 + 1 for one, other in rows if one != other
                for x in range(width) if one[x] != other[x])
    return right, lower


def measure(screen, size):
    """Returns the extents of the text line and of the help in a window of this size."""
    window = opened(screen, SCENE, size=size)
    plain = window.read()
    window.press("t", "text on")
    window.until(lambda shown: shown != plain, "shows the line")
    line = extent(plain, window.read(), size)
    window.press("t", "text off")
    window.press("h", "help on")
    window.until(lambda shown: shown != plain, "shows the help")
    help_panel = extent(plain, window.read(), size)
    window.close()
    return line, help_panel


def text_grows_with_the_density_and_fits_the_window(screen):
    measured = {}
    for density in (1, 2):
        screen.set_density(density)
        for size in ((960, 540), (320, 240)):
            line, help_panel = measured[density, size] = measure(screen, size)
            print(f"         density {density}, {size}: line {line}, help {help_panel}")
            assert line[0] <= size[0] and line[1] < 30 * density, "the line has several rows"
            assert help_panel[0] < size[0] and help_panel[1] < size[1], "the help is cut off"
            assert help_panel[1] > 0.5 * size[1], "the help is small"
    screen.set_density(1)
    large = (960, 540)
    assert measured[2, large][0][1] == 2 * measured[1, large][0][1], "the line has no double size"
    assert measured[2, large][1][0] > measured[1, large][1][0], "the help is no larger"


def a_hint_at_the_help_is_shown_for_some_seconds(screen):
    window = Window(screen, SCENE, size=(960, 540))
    window.wait("ray traced, view 1")
    first = window.read()
    later = window.until(lambda shown: shown != first, "hides the hint")
    lines = 4 * 960 * 40
    assert first[lines:] == later[lines:], "the hint is not in the line"


def scenes_that_lack_something_say_so_in_the_line(screen, folder):
    """The window is narrow, so the note fills the line once the hint at the help is hidden."""
    size, widths = (320, 240), {}
    scenes = {"whole": "light 9 -4 10 0.7\nmaterial 1\nsphere 0 0 0 1\n",
              "dark": "material 1\nsphere 0 0 0 1\n", "empty": ""}
    for name, text in scenes.items():
        scene = folder / f"{name}.scn"
        scene.write_text(text)
        window = opened(screen, scene, size=size)
        plain = window.read()
        time.sleep(HINT_SECONDS)
        window.press("t", "text on")
        window.until(lambda shown, before=plain: shown != before, "shows the line")
        widths[name] = extent(plain, window.read(), size)[0]
        window.close()
    assert widths["whole"] < 285 < min(widths["dark"], widths["empty"]), widths


if __name__ == "__main__":
    run_tests(globals())
