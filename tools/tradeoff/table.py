# SPDX-License-Identifier: MIT
"""The figures as CSV and as lines of text."""

import csv

COLUMNS = ["setting", "front", "milliseconds", "fastest", "slowest", "rmse", "psnr", "maximum",
           "share_off_by_1", "share_off_by_4", "ssim", "flip", "megarays_per_second", "rays",
           "bytes", "pixel_hash"]


def write_csv(path, scenes):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["scene", *COLUMNS], extrasaction="ignore")
        writer.writeheader()
        for scene in scenes:
            for row in scene["rows"]:
                writer.writerow({"scene": scene["scene"], **row})


def show(scene):
    """Lines of what matters, the fastest setting first, with a star on the front."""
    reference = scene["reference"]
    yield (f"{scene['scene']}: reference of {reference['samples']} samples, "
           f"RMSE {reference['own_error']:.2g} by itself")
    for row in sorted(scene["rows"], key=lambda row: row["milliseconds"]):
        yield (f"{'*' if row['front'] else ' '} {row['setting']:24} {row['milliseconds']:9.2f} ms "
               f"RMSE {row['rmse']:.2e}  largest {row['maximum']:.3f}  "
               f"off {100 * row['share_off_by_1']:.2f} %")
