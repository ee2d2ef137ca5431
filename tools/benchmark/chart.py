# SPDX-License-Identifier: MIT
"""Draws curves on logarithmic axes as SVG."""

import html
import math

WIDTH, HEIGHT = 420, 320
LEFT, RIGHT, TOP, BOTTOM = 64, 16, 36, 48


def decades(values):
    """Returns the exponents of the powers of ten that enclose the values."""
    low = math.floor(math.log10(min(values)) + 1e-9)
    return low, max(math.ceil(math.log10(max(values)) - 1e-9), low + 1)


def text(x, y, words, anchor="middle", extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{extra}>'
            f'{html.escape(words)}</text>')


class Axis:
    """A logarithmic axis: maps values to positions from start to end."""

    def __init__(self, values, start, end):
        self.low, self.high = decades(values)
        self.start, self.end = start, end

    def place(self, value):
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def ticks(self):
        return [(self.place(10 ** power), f"{10.0 ** power:g}" if power < 5 else f"1e{power}")
                for power in range(self.low, self.high + 1)]


def panel(title, across, upward, points, left):
    """Returns the SVG of one curve with its title and the names of its axes."""
    x = Axis([p[0] for p in points], left + LEFT, left + WIDTH - RIGHT)
    y = Axis([p[1] for p in points], HEIGHT - BOTTOM, TOP)
    parts = [text(left + WIDTH / 2, 20, title, extra=' font-weight="bold"'),
             text(left + WIDTH / 2, HEIGHT - 10, across),
             text(0, 0, upward, extra=f' transform="translate({left + 16} {HEIGHT / 2}) '
                                      'rotate(-90)"')]
    for place, label in x.ticks():
        parts.append(f'<path d="M{place:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        parts.append(text(place, HEIGHT - BOTTOM + 16, label))
    for place, label in y.ticks():
        parts.append(f'<path d="M{x.start} {place:.1f}H{x.end}" stroke="#ddd"/>')
        parts.append(text(x.start - 6, place + 4, label, "end"))
    places = [(x.place(a), y.place(b)) for a, b in points]
    parts.append('<polyline fill="none" stroke="#06c" stroke-width="2" points="'
                 + " ".join(f"{a:.1f},{b:.1f}" for a, b in places) + '"/>')
    parts += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3.5" fill="#06c"/>' for a, b in places]
    return "\n".join(parts)


def write(path, panels):
    """Writes panels side by side. A panel is (title, name of x, name of y, points)."""
    width = WIDTH * len(panels)
    drawn = [panel(*each, WIDTH * i) for i, each in enumerate(panels)]
    with open(path, "w", encoding="ascii") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{HEIGHT}" '
                   f'viewBox="0 0 {width} {HEIGHT}" font-family="sans-serif" font-size="12">\n'
                   f'<rect width="{width}" height="{HEIGHT}" fill="#fff"/>\n'
                   + "\n".join(drawn) + "\n</svg>\n")
