#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes |E*| of specimens of bench/voids/scene.toml with increasing void fractions: `measure.py PROGRAM SEEDS
FILE.csv`. Writes one row per specimen and frequency."""
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
FRACTIONS = [0, 0.02, 0.04, 0.06, 0.08, 0.10]
RADII = [("0.5", "0.75"), ("0.75", "1.0"), ("1.0", "1.5")]  # [mm]; larger voids do not fit between the aggregates
COLUMNS = ["radius_min_mm", "radius_max_mm", "fraction", "seed", "voids", "particles", "void_cells", "mastic",
           "frequency_hz", "e_star_pa", "phase_deg"]


def voids(fraction, radii):
    return f'[specimen.voids]\nradius = ["{radii[0]} mm", "{radii[1]} mm"]\nfraction = {fraction}\n\n'


def run(program, folder, fraction, radii, seed):
    text = (HERE / "scene.toml").read_text(encoding="utf-8")
    before, mark, after = text.partition("[materials.aggregate]")
    (folder / "scene.toml").write_text(before + (voids(fraction, radii) if fraction else "") + mark + after,
                                       encoding="utf-8")
    subprocess.run([program, "run", folder / "scene.toml", "--out", folder / "out", "--seed", str(seed)], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads((folder / "out" / "summary.json").read_text(encoding="utf-8"))


def main():
    program, seeds, out = sys.argv[1], int(sys.argv[2]), Path(sys.argv[3])
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for radii in RADII:
            for fraction in FRACTIONS:
                for seed in range(1, seeds + 1):
                    s = run(program, Path(folder), fraction, radii, seed)
                    for r in s["results"]:
                        rows.append([*radii, fraction, seed, s["voids"], s["particles"],
                                     f"{s['volume_fractions']['void_cells']:.6g}",
                                     f"{s['volume_fractions']['mastic']:.6g}", r["frequency_hz"],
                                     f"{r['e_star_pa']:.8g}", f"{r['phase_deg']:.6f}"])
                    print(*rows[-1], flush=True)
    with open(out, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)


if __name__ == "__main__":
    main()
