# SPDX-License-Identifier: MIT
"""Creates the tables of error and time goals for trade.html."""

import html

from tradeoff import goals


def table(head, rows):
    cells = "".join(f"<th>{word}</th>" for word in head)
    body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in rows)
    return f'<div class="wide"><table><tr>{cells}</tr>{body}</table></div>'


def beside(rival):
    """Returns a goal's cost as multiples of a rival's time and samples."""
    if rival is None:
        return "no setting meets it"
    return (f"{rival['times']:.2f} x time, {rival['samples_ratio']:.2f} x samples<br>"
            f"of {html.escape(rival['setting'])}, {rival['milliseconds']:.1f} ms")


def oracle_times(goal):
    return f"{goal['oracle_times']:.2f} x time" if "oracle_times" in goal else "-"


def error_row(goal):
    verdict = "" if goal["held"] else " (missed)"
    return [f"{100 * goal['goal']:g} %", f"{100 * goal['rmse']:.4f} %",
            f"{goal['ratio']:.2f} E{verdict}", f"{100 * goal['estimate']:.4f} %",
            f"{goal['milliseconds']:.1f}", "yes" if goal["front"] else "no",
            beside(goal["fixed"]), beside(goal["uniform"]), beside(goal["doubling"]),
            oracle_times(goal)]


def time_row(goal):
    best = goal["fixed"]
    rival = (f"{best['errors']:.2f} x the error of {html.escape(best['setting'])}, "
             f"{100 * best['rmse']:.4f} %" if best else "no setting is as fast")
    return [f"{goal['goal']:g} s", f"{goal['milliseconds'] / 1e3:.2f} s",
            f"{100 * goal['rmse']:.4f} %", f"{100 * goal['estimate']:.4f} %",
            "yes" if goal["front"] else "no", rival]


ERROR_HEAD = ["goal E", "true RMSE", "in units of E", "estimated", "ms", "on the front",
              "compared with the best fixed setting", "compared with the best uniform setting",
              "compared with doubling N", "compared with the oracle"]
TIME_HEAD = ["goal", "time", "true RMSE", "estimated", "on the front",
             "compared with the best fixed setting that takes no longer"]
NOTE = ('<p class="note">The estimate includes the largest possible effect of rays beyond the '
        "highest level. An error goal lowers this effect; a time goal does not.</p>")


def of_scene(scene):
    """Returns the tables of one scene's goals."""
    told = scene["goals"]
    tables = [table(head, map(row, goals_of_kind))
              for head, row, goals_of_kind in [(ERROR_HEAD, error_row, told["errors"]),
                                               (TIME_HEAD, time_row, told["times"])]
              if goals_of_kind]
    return f"<h3>Goals</h3>{''.join(tables)}{NOTE}" if tables else ""


def short(goal):
    def ratio(rival):
        return "none" if rival is None else f"{rival['times']:.2f}"
    return f"{goal['ratio']:.2f} E<br>{ratio(goal['fixed'])}, {ratio(goal['uniform'])}"


def of_all(scenes):
    """Returns a table with a row per scene and a column per error."""
    asked = [goal["goal"] for goal in scenes[0]["goals"]["errors"]]
    rows = [[html.escape(scene["scene"]), *map(short, scene["goals"]["errors"])]
            for scene in scenes]
    return (table(["scene", *(f"E = {100 * goal:g} %" for goal in asked)], rows)
            + f'<p class="note">{goals.summary(scenes)}.</p>')
