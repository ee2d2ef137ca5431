# SPDX-License-Identifier: MIT
"""Plots error against time as SVG, both logarithmic. Settings on the Pareto front have filled
markers; other settings have hollow markers. A dotted line shows the oracle's limit, and a
horizontal line the reference's own error."""

import io
import math

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator  # noqa: E402

from tradeoff import labels  # noqa: E402

COLUMNS = 3
KINDS = [("uniform", "uniform samples", "#0b62c4", "o"),
         ("levels", "fewer reflections", "#c2410c", "v"),
         ("fp64", "fp64", "#6b7280", "s"), ("adaptive", "adaptive samples", "#15803d", "D"),
         ("error", "error goals", "#a21caf", "*"),
         ("time", "time goals", "#b45309", "P")]

# Within each of these kinds, settings differ only in one number. A line connects them.
SERIES = ["uniform", "adaptive", "error"]


def draw_line(axes, rows, **look):
    axes.plot([row["milliseconds"] for row in rows], [100 * row["rmse"] for row in rows], **look)


def draw_rows(axes, rows):
    for kind, label, color, marker in KINDS:
        size = 11 if marker == "*" else 7
        own = [row for row in rows if row["kind"] == kind]
        for row in own:
            axes.plot([row["fastest"], row["slowest"]], [100 * row["rmse"]] * 2, color=color,
                      linewidth=1, alpha=0.5, zorder=2)
            axes.plot(row["milliseconds"], 100 * row["rmse"], marker, color=color, markersize=size,
                      markerfacecolor=color if row["front"] else "white", zorder=3)
        if own:
            axes.plot([], [], marker, color=color, markersize=size, label=label)
        if kind in SERIES:
            draw_line(axes, sorted(own, key=lambda row: -row["rmse"]), color=color, linewidth=1,
                      alpha=0.5, zorder=1)


def named(row):
    return row["front"] or row["kind"] in ["uniform", "error", "time"]


def oracle_of(scene):
    """Returns the oracle's points, without errors below the reference's own."""
    floor = scene["reference"]["own_error"]
    return [point for point in scene.get("oracle", []) if point["rmse"] >= floor]


def on_page(axes, row):
    """Returns the position of a row in typographic points."""
    x, y = axes.transData.transform((row["milliseconds"], 100 * row["rmse"]))
    return x * 72 / axes.figure.dpi, y * 72 / axes.figure.dpi


def name_rows(axes, scene):
    """Names the settings on the front, the uniform settings and the goals. The axes must have their
    final position."""
    frame = [value * 72 / axes.figure.dpi for value in axes.bbox.extents]
    chosen = sorted(filter(named, scene["rows"]), key=lambda row: row["milliseconds"])
    names = [(on_page(axes, row), row["setting"].replace("max-level", "level")) for row in chosen]
    points = [on_page(axes, row) for row in scene["rows"] + oracle_of(scene)]
    places = labels.place(names, points, frame)
    for row, (point, text), (center, distance) in zip(chosen, names, places):
        line = {"arrowstyle": "-", "color": "#9ca3af", "linewidth": 0.6, "shrinkA": 0, "shrinkB": 4}
        axes.annotate(text, (row["milliseconds"], 100 * row["rmse"]),
                      xytext=(center[0] - point[0], center[1] - point[1]), ha="center", va="center",
                      textcoords="offset points", fontsize=labels.SIZE, zorder=5,
                      arrowprops=line if distance >= labels.FAR else None)


def style(axes, scene):
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5), numticks=20))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_locator(LogLocator(subs=()))
    axes.grid(color="#e5e7eb", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.set_xlabel(f"{scene['clock']} of a frame, ms")
    axes.set_ylabel("RMSE, % of full brightness")
    axes.set_title(scene["scene"])
    axes.margins(0.12)


def draw_scene(axes, scene):
    draw_rows(axes, scene["rows"])
    draw_line(axes, oracle_of(scene), color="#111827", linestyle=":",
              label="oracle: the best N x N in each pixel")
    axes.axhline(100 * scene["reference"]["own_error"], color="#9ca3af", linewidth=1,
                 linestyle="--", label="error of the reference itself")
    style(axes, scene)


def svg(scenes):
    """Returns an SVG with a plot per scene, three in a row."""
    columns = min(len(scenes), COLUMNS)
    lines = math.ceil(len(scenes) / columns)
    with pyplot.rc_context({"svg.hashsalt": "clrt", "svg.fonttype": "none",
                            "font.sans-serif": ["DejaVu Sans", "Arial"]}):
        figure, axes = pyplot.subplots(lines, columns, figsize=(5.6 * columns, 4.8 * lines),
                                       squeeze=False, layout="constrained")
        for place, scene in zip(axes.flat, scenes):
            draw_scene(place, scene)
        for place in axes.flat[len(scenes):]:
            place.set_axis_off()
        figure.legend(*axes.flat[0].get_legend_handles_labels(), loc="outside lower center",
                      ncols=5 * columns // 2, fontsize=labels.SIZE, frameon=False)
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
        for place, scene in zip(axes.flat, scenes):
            name_rows(place, scene)
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None})
        pyplot.close(figure)
    drawn = text.getvalue()
    return drawn[drawn.index("<svg"):]
