#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares |E*| and phase angle of specimens of examples/ct/scene.toml with their twins, made from the truth and
from the segmentation, and with other specimens of the same mixture. Writes one row per specimen and frequency.

usage: twin.py PROGRAM SEEDS FILE.csv      SEEDS is a range such as 1-3"""
import csv
import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENE = HERE.parents[1] / "examples" / "ct" / "scene.toml"
VOXEL = "100 um"
CASES = {"whole": [], "sawn": ["--sawn", "2 mm"]}
REPACKED = 1000  # added to the seed of a specimen to get another specimen of the same mixture
COLUMNS = ["case", "seed", "kind", "frequency_hz", "e_star_pa", "phase_deg", "particles", "grains", "aggregate", "void",
           "seconds"]


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder, self.rows = program, folder, []

    def macadam(self, *arguments):
        subprocess.run([self.program, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)

    def solve(self, case, seed, kind, scene, started, numbers):
        out = self.folder / "out"
        self.macadam("run", scene, "--out", out)
        s = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        for r in s["results"]:
            self.rows.append([case, seed, kind, r["frequency_hz"], f"{r['e_star_pa']:.8g}", f"{r['phase_deg']:.6f}",
                              s["particles"], *numbers, f"{time.monotonic() - started:.1f}"])
            print(*self.rows[-1], flush=True)

    def source(self, case, seed, kind):
        """Scans the specimen of a seed, and computes |E*| of the scanned part."""
        started, scan = time.monotonic(), self.folder / f"phantom-{kind}"
        self.macadam("ct", "phantom", SCENE, "--voxel", VOXEL, "--specimen-seed", seed, "--seed", seed, "--out", scan,
                     *CASES[case])
        p = json.loads((scan / "phantom.json").read_text(encoding="utf-8"))
        text = SCENE.read_text(encoding="utf-8")
        scene = scan / "truth" / "scene.toml"
        scene.write_text(f'[specimen]\nfile = "specimen.csv"\nbox = {p["box_m"]}\n' +
                         text[text.index("[materials.aggregate]"):], encoding="utf-8")
        self.solve(case, seed, kind, scene, started,
                   [p["grains"], f"{p['volume_fractions']['aggregate']:.6g}", f"{p['volume_fractions']['void']:.6g}"])
        return scan

    def twin(self, case, seed, kind, folder):
        started, out = time.monotonic(), self.folder / "twin"
        self.macadam("ct", "twin", folder, "--scene", SCENE, "--seed", seed, "--out", out)
        t = json.loads((out / "twin.json").read_text(encoding="utf-8"))
        self.solve(case, seed, kind, out / "scene.toml", started,
                   [t["grains"], f"{t['aggregate']:.6g}", f"{t['void']:.6g}"])

    def seed(self, case, seed):
        scan = self.source(case, seed, "source")
        self.twin(case, seed, "truth", scan / "truth")
        self.macadam("ct", "segment", scan / "scan.mha", "--voxel", VOXEL, "--out", self.folder / "segmented")
        self.twin(case, seed, "segmented", self.folder / "segmented")
        self.source(case, seed + REPACKED, "repacked")


def main():
    program, out = sys.argv[1], Path(sys.argv[3])
    first, last = map(int, re.fullmatch(r"(\d+)-(\d+)", sys.argv[2]).groups())
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(program, Path(folder))
        for case in CASES:
            for seed in range(first, last + 1):
                bench.seed(case, seed)
    with open(out, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(bench.rows)


if __name__ == "__main__":
    main()
