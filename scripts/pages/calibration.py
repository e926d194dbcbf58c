# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/calibration.md, from calibration-*.csv of bench/calibration/run, which have one row per case."""
from pages.data import rows, table
from pages.marks import mark

DOCUMENT = "docs/calibration.md"
SCENES = {"ac14_ms_ico_fine": "ac14_ms_ico_fine (clusters)"}


def found():
    return [r for file in ("cpu", "gpu") for r in rows(f"calibration-{file}.csv")]


def where(row):
    return f"{row['device']}, {row['threads']:.0f} threads" if row["device"] else \
        f"{row['machine']}, {row['threads']:.0f} threads"


@mark
def times():
    lines = [(SCENES.get(r["scene"], r["scene"]), f"{r['specimens']:.0f} of {r['particles']:,.0f}",
              r["free"].replace(" ", ", "), where(r), f"{r['solutions']:.0f}", f"{r['preparing_s']:.1f}",
              f"{r['solving_s']:.1f}", f"{r['wall_s']:.1f}", f"{r['largest_error']:.0e}") for r in found()]
    return table(["scene", "particles", "free", "on", "solutions", "preparing (s)", "solving (s)", "wall (s)",
                  "largest error of a parameter"], lines, range(4, 9))
