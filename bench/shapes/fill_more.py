#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fills shapes without voids for docs/filling.md.

usage: fill_more.py PROGRAM RESULT.csv

Runs `macadam shapes fill` for four shapes of D^I = 12.59 mm with seven ranges of radii (seeds 1 to 3), and for all
shapes of the library at D^I = 9 mm with radii of 1 to 2 mm. Writes the values that it reports, one row per filling."""
import concurrent.futures
import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SHAPES = [EXAMPLES / "icosahedron" / "icosahedron.off",
          *(EXAMPLES / "shapes" / f"aggregate_{k}.off" for k in (82, 59, 81))]
RADII = [(0.5, 0.5), (0.75, 0.75), (1, 1), (1.5, 1.5), (2, 2), (0.75, 1), (1, 2)]


def fill(program, shape, d_intermediate, radii, seed):
    with tempfile.TemporaryDirectory() as out:
        radius = f"{radii[0]} mm" if radii[0] == radii[1] else f"{radii[0]} mm,{radii[1]} mm"
        text = subprocess.run([program, "shapes", "fill", shape, "--circumscribed", f"{d_intermediate / 2} mm",
                               "--porosity", "0", "--radius", radius, "--seed", str(seed), "--out", out], check=True,
                              capture_output=True, text=True).stdout
        with open(Path(out) / "spheres.csv", encoding="utf-8") as f:
            spheres = len(list(csv.DictReader(f)))
    row = {"shape": shape.stem, "d_intermediate_mm": d_intermediate, "radius_min_mm": radii[0],
           "radius_max_mm": radii[1], "seed": seed, "spheres": spheres}
    for key, label in (("volume_mm3", r"volume, sum \(mm3\)"), ("d_long_mm", r"D\^L \(mm\)"),
                       ("d_intermediate_mm", r"D\^I \(mm\)"), ("d_short_mm", r"D\^S \(mm\)")):
        found = re.search(rf"^{label} +(\S+) +(\S+)$", text, re.M)
        row[f"shape_{key}"], row[f"cluster_{key}"] = found[1], found[2]
    row["covered"] = f"{float(re.search('^covered ([0-9.]+) %', text, re.M)[1]) / 100:.4f}"
    return row


def main():
    program, result = sys.argv[1:]
    library = sorted((EXAMPLES / "shapes").glob("*.off"))
    work = [(shape, 12.59, radii, seed) for shape in SHAPES for radii in RADII for seed in (1, 2, 3)]
    work += [(shape, 9, (1, 2), 1) for shape in library]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda w: fill(program, *w), work))
    with open(result, "w", newline="", encoding="utf-8") as f:
        out = csv.DictWriter(f, rows[0], lineterminator="\n")
        out.writeheader()
        out.writerows(rows)


if __name__ == "__main__":
    main()
