# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs examples/study and writes its results and its cost. Usage: measure.py WORKERS DIR"""
import csv
import json
import sys
import time
from pathlib import Path

import macadam as mc
from macadam.study.job import machine

RESULTS = Path(__file__).resolve().parents[1] / "results"
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "study" / "study.toml"
# column of the committed file: column of the study's table, and a factor
COLUMNS = {"air_voids_percent": ("specimen.recipe.air_voids_percent", 1), "binder_percent": ("specimen.recipe.binder_percent", 1),
           "seed": ("specimen.seed", 1), "e_star_mpa": ("e_star_pa", 1e-6), "phase_deg": ("phase_deg", 1),
           "particles": ("particles", 1)}


def main():
    workers, out = int(sys.argv[1]), Path(sys.argv[2])
    if out.exists():
        sys.exit(f"bench/study/run: {out}: found it, expected a folder that is not there")
    began = time.monotonic()
    found = mc.study(EXAMPLE, out, workers=workers)
    wall = time.monotonic() - began
    if found.failures or found.missing:
        sys.exit(f"bench/study/run: {len(found.failures)} failed, {found.missing} missing")
    records = {key: json.loads((out / "results" / key / "study.json").read_text()) for key in found.table["key"]}
    cpu = sum(r["processor_s"] for r in records.values())
    with open(RESULTS / "study.csv", "w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow([*COLUMNS, "processor_s"])
        for _, row in found.table.iterrows():
            rows.writerow([*(f"{row[c] * factor:.8g}" for c, factor in COLUMNS.values()),
                           f"{records[row['key']]['processor_s']:.2f}"])
    with open(RESULTS / "study-time.csv", "w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["processor", "workers", "results", "wall_s", "processor_s"])
        rows.writerow([machine()["processor"], workers, len(found.table), f"{wall:.1f}", f"{cpu:.1f}"])


main()
