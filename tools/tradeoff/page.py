# SPDX-License-Identifier: MIT
"""Writes all results as one HTML page that needs no other file."""

import base64
import datetime
import html
import importlib.metadata
import io

import matplotlib.image
import numpy

from benchmark import common
from tradeoff import front, goal_tables, goals, grid, perception, plot

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #111827; margin: 2rem auto; max-width: 76rem;
       padding: 0 1rem; }
h1, h2, h3 { line-height: 1.2; } h2 { margin-top: 3rem; border-top: 1px solid #e5e7eb;
       padding-top: 1.5rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 0.85rem;
       margin-bottom: 1rem; }
th, td { padding: 0.2rem 0.7rem; text-align: right; border-bottom: 1px solid #e5e7eb; }
th:first-child, td:first-child { text-align: left; }
td:first-child, .spread { white-space: nowrap; }
tr.beaten { color: #6b7280; } tr.front td:first-child { font-weight: 600; }
.wide { overflow-x: auto; } .wide svg { max-width: 100%; height: auto; }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem; } figure { margin: 0; width: 17.5rem; }
figure img { width: 100%; box-sizing: border-box; border: 1px solid #e5e7eb;
       image-rendering: pixelated; display: block; margin-bottom: 0.3rem; }
figcaption, .note { font-size: 0.85rem; color: #4b5563; }
"""

# For each clock, the text that explains how a round measures times.
ROUNDS = {
    "time": "In each round, the tracing time of the faster of two frames counts (time goals: of "
            "one), after an uncounted frame.",
    "processor time": "Times are the processor time of a frame, over all threads. In each round, "
                      "the frames after the first count.",
}

ERRORS = [0.02, 0.01, 0.005, 0.002, 0.001]

COLUMNS = [
    ("setting", "setting", str),
    ("ms", "milliseconds", lambda v: f"{v:.2f}"),
    ("spread, ms", None, None),
    ("RMSE %", "rmse", lambda v: f"{100 * v:.4f}"),
    ("PSNR dB", "psnr", lambda v: "-" if v is None else f"{v:.1f}"),
    ("largest", "maximum", lambda v: f"{v:.3f}"),
    ("off &gt; 1/255, %", "share_off_by_1", lambda v: f"{100 * v:.2f}"),
    ("off &gt; 4/255, %", "share_off_by_4", lambda v: f"{100 * v:.2f}"),
    ("SSIM", "ssim", lambda v: f"{v:.5f}"),
    ("mean FLIP", "flip", lambda v: f"{v:.5f}"),
    ("Mrays/s", "megarays_per_second", lambda v: f"{v:.1f}"),
    ("kB on the device", "bytes", lambda v: f"{v / 1e3:.1f}"),
]


def cell(row, column):
    _, key, words = column
    if key is None:
        return f'<span class="spread">{row["fastest"]:.2f}&ndash;{row["slowest"]:.2f}</span>'
    return words(row[key]) if key != "setting" else html.escape(row[key])


def table(rows):
    head = "".join(f"<th>{column[0]}</th>" for column in COLUMNS)
    body = "".join(
        f'<tr class="{"front" if row["front"] else "beaten"}">'
        + "".join(f"<td>{cell(row, column)}</td>" for column in COLUMNS) + "</tr>"
        for row in sorted(rows, key=lambda row: row["milliseconds"]))
    return f'<div class="wide"><table><tr>{head}</tr>{body}</table></div>'


def embed(data):
    return "data:image/png;base64," + base64.b64encode(data).decode("ascii")


def png_of_pfm(path):
    data = io.BytesIO()
    values = numpy.round(perception.read_pfm(path) * 255).astype("uint8")
    matplotlib.image.imsave(data, values, format="png")
    return data.getvalue()


def shown_rows(rows):
    """Returns the rows whose pictures the page shows. These are the fastest row, the row of
    grid.BASE, the most accurate row that is not slower than BASE, the second row of --error, and
    the most accurate row."""
    best = front.front(rows)
    base = next((row for row in rows if row["setting"] == grid.BASE), best[0])
    rival = [row for row in best if row["milliseconds"] <= base["milliseconds"]]
    goal = [row for row in rows if row["kind"] == "error"]
    chosen = [best[0], base, *rival[-1:], *goal[1:2], best[-1]]
    return [row for place, row in enumerate(chosen) if row not in chosen[:place]]


def pictures(scene, folder):
    reference = embed(png_of_pfm(folder / "reference.pfm"))
    parts = [f'<figure><img alt="the reference" src="{reference}">'
             "<figcaption>the reference</figcaption></figure>"]
    for row in shown_rows(scene["rows"]):
        picture = embed(png_of_pfm(folder / row["picture"]))
        difference = embed((folder / row["map"]).read_bytes())
        name = html.escape(row["setting"])
        parts.append(f'<figure><img alt="{name}" src="{picture}">'
                     f'<img alt="difference of {name}" src="{difference}">'
                     f"<figcaption>{name}: {row['milliseconds']:.1f} ms, RMSE "
                     f"{100 * row['rmse']:.3f} %</figcaption></figure>")
    return f'<div class="pictures">{"".join(parts)}</div>'


def price_cell(scene, error):
    row = front.time_at(scene["rows"], error)
    if row is None:
        return "<td>none</td>"
    base = next((r for r in scene["rows"] if r["setting"] == grid.BASE), None)
    times = f", {row['milliseconds'] / base['milliseconds']:.2f} x" if base else ""
    return f"<td>{row['milliseconds']:.1f} ms{times}<br>{html.escape(row['setting'])}</td>"


def prices(scenes):
    """Returns a table of the fastest setting for each error."""
    head = "".join(f"<th>RMSE &le; {100 * error:g} %</th>" for error in ERRORS)
    body = "".join(f"<tr><td>{html.escape(scene['scene'])}</td>"
                   + "".join(price_cell(scene, error) for error in ERRORS) + "</tr>"
                   for scene in scenes)
    return f"<table><tr><th>scene</th>{head}</tr>{body}</table>"


def section(scene, folder):
    reference, settings = scene["reference"], scene["settings"]
    beaten = sum(not row["front"] for row in scene["rows"])
    return (
        f"<h2>{html.escape(scene['scene'])}</h2>"
        f"<p>{scene['triangles']} triangles, {settings['width']} x {settings['height']} pixels, "
        f"rays up to level {settings['max_level']}. The reference has {reference['samples']} "
        f"samples per pixel in fp64. Its own RMSE, estimated from two independent halves, is "
        f"{100 * reference['own_error']:.4f} %. {beaten} of the "
        f"{len(scene['rows'])} settings are shown in gray, because another setting is better in "
        "time or error and not worse in the other.</p>"
        f'<div class="wide">{plot.svg([scene])}</div>{table(scene["rows"])}'
        f"{goal_tables.of_scene(scene)}"
        "<h3>Pictures, and where they differ from the reference</h3>"
        '<p class="note">The brightness of a difference is proportional to its square root: 1/255 '
        f"appears as 1/8, 4/255 as 1/4, and 64/255 or more as 1.</p>{pictures(scene, folder)}")


def goal_section(scenes):
    if not goals.all_errors(scenes):
        return ""
    return (
        "<h2>The results and costs of error goals</h2><p>For each goal E of <code>--error</code>, "
        "the first line is the true RMSE against the reference, in units of E. The second line is "
        "the time, divided by the time of the fastest fixed setting that meets E, and by the time "
        "of the fewest N x N samples per pixel that meet E. Users must find such a setting by "
        "trial; an error goal finds the samples by itself.</p>"
        f"{goal_tables.of_all(scenes)}")


def method(scenes):
    device, machine = scenes[0]["device"], common.machine()
    packages = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in
                         ["flip-evaluator", "scikit-image", "matplotlib", "numpy"])
    runs = len(scenes[0]["rows"][0]["times"])
    return (
        f"<p>clrt {html.escape(scenes[0]['version'])} on {html.escape(device['name'])} "
        f"({html.escape(device['driver'])}); {html.escape(machine['cpu'])}, {machine['threads']} "
        f"threads; {packages}; {datetime.date.today()}.</p>"
        f'<p class="note">Times are medians of {runs} rounds in which the settings alternate. '
        f"{ROUNDS[scenes[0]['clock']]} The oracle knows the error of each pixel in each N x N "
        "picture and gives each pixel the best N. A pixel costs its share of the time of the "
        "picture with this N. RMSE covers the stored values of all three colors. SSIM and "
        "FLIP (mean, 67 pixels per degree) estimate the visible difference. A factor below 1 means "
        f"faster than the base ({html.escape(grid.BASE)}, the course's setting).</p>")


def write(path, scenes, folder):
    """Writes the page; folder holds a folder of pictures for each scene."""
    sections = "".join(section(scene, folder / scene["scene"]) for scene in scenes)
    path.write_text(
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width"><title>clrt: time against error</title>'
        f"<style>{STYLE}</style></head><body><h1>Time against error</h1>{method(scenes)}"
        "<h2>The cost of an error</h2><p>The fastest setting within each error, and its time "
        f"divided by the base's.</p>{prices(scenes)}{goal_section(scenes)}{sections}"
        "</body></html>\n",
        encoding="utf-8")
    (folder / "trade.svg").write_text(plot.svg(scenes) + "\n", encoding="utf-8")
