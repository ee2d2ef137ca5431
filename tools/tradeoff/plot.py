# SPDX-License-Identifier: MIT
"""Rows -> an SVG: log error against log time.  Settings on the front are filled and joined, the
others hollow; a line across shows how far the reference is to be trusted."""

import io

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator  # noqa: E402

from tradeoff import front, grid  # noqa: E402

KINDS = [("uniform samples", "#0b62c4", "o"), ("rays followed less far", "#c2410c", "v"),
         ("fp64", "#6b7280", "s"), ("adaptive samples", "#15803d", "D")]


def kind_of(row):
    """Place in KINDS."""
    name = row["setting"]
    return (3 if "adaptive" in name else 2 if "fp64" in name else 1 if "max-level" in name else 0)


def draw_rows(axes, rows):
    for kind, (label, color, marker) in enumerate(KINDS):
        own = [row for row in rows if kind_of(row) == kind]
        for row in own:
            axes.plot([row["fastest"], row["slowest"]], [100 * row["rmse"]] * 2, color=color,
                      linewidth=1, alpha=0.5, zorder=2)
            axes.plot(row["milliseconds"], 100 * row["rmse"], marker, color=color, markersize=7,
                      markerfacecolor=color if row["front"] else "white", zorder=3)
        if own:
            axes.plot([], [], marker, color=color, markersize=7, label=label)


def name_rows(axes, rows):
    """Names what is on the front, and the base."""
    named = [row for row in rows if row["front"] or row["setting"] == grid.BASE]
    for place, row in enumerate(sorted(named, key=lambda row: row["milliseconds"])):
        above = place % 2 == 0  # by turns, as neighbors on the front are close
        axes.annotate(row["setting"].replace("max-level", "level"),
                      (row["milliseconds"], 100 * row["rmse"]),
                      xytext=(7, 5) if above else (-7, -5), ha="left" if above else "right",
                      va="bottom" if above else "top",
                      textcoords="offset points", fontsize=8)


def style(axes, scene):
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5), numticks=20))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_locator(LogLocator(subs=()))
    axes.grid(color="#e5e7eb", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.set_xlabel("time of a frame, ms")
    axes.set_ylabel("RMSE, % of full brightness")
    axes.set_title(scene["scene"])
    axes.margins(0.12)


def draw_scene(axes, scene):
    rows = scene["rows"]
    best = front.front(rows)
    axes.plot([row["milliseconds"] for row in best], [100 * row["rmse"] for row in best],
              color="#111827", linewidth=1, alpha=0.6, zorder=1)
    draw_rows(axes, rows)
    name_rows(axes, rows)
    floor = 100 * scene["reference"]["own_error"]
    axes.axhline(floor, color="#9ca3af", linewidth=1, linestyle="--",
                 label="error of the reference itself")
    style(axes, scene)


def svg(scenes):
    """All scenes beside each other, as the text of an SVG."""
    with pyplot.rc_context({"svg.hashsalt": "clrt", "svg.fonttype": "none",
                            "font.family": "sans-serif"}):
        figure, axes = pyplot.subplots(1, len(scenes), figsize=(6.6 * len(scenes), 4.8),
                                       squeeze=False, layout="constrained")
        for place, scene in zip(axes[0], scenes):
            draw_scene(place, scene)
        axes[0][0].legend(fontsize=8, framealpha=1)
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None})
        pyplot.close(figure)
    drawn = text.getvalue()
    return drawn[drawn.index("<svg"):]
