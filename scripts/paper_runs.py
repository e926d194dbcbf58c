# SPDX-License-Identifier: GPL-3.0-or-later
"""What the files of one run say, and the statistics of several."""
import csv
import json
import math
from pathlib import Path

from paper_tables import BOX, PAIRS

ROOT = Path(__file__).resolve().parent.parent


def program(given):
    """The program to run: the one given, else the one built."""
    candidates = [given] if given else [ROOT / "build" / folder / "macadam" for folder in ("test", "demo")]
    for file in candidates:
        if file.is_file():
            return file.resolve()
    raise SystemExit(f"no program {' or '.join(map(str, candidates))}: scripts/test or scripts/demo builds it, "
                     "--program names another")


def rows(file):
    with open(file, encoding="utf-8") as f:
        return list(csv.DictReader(f))


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else math.nan


def spread(values):
    """Half the range over the seeds: the one measure of spread in all tables."""
    values = list(values)
    return (max(values) - min(values)) / 2


class Run:
    """One specimen of one seed."""

    def __init__(self, folder, status="done"):
        file = folder / "summary.json"
        if not file.is_file():
            raise SystemExit(f"{folder}: no summary.json; "
                             "scripts/paper-specimens makes it, without --text or --pictures")
        self.summary = json.loads(file.read_text())
        if self.summary["status"] != status:
            raise SystemExit(f"{folder}: status is '{self.summary['status']}', not '{status}'")
        self.aggregates = rows(folder / "aggregates.csv")
        self.of_class = [[a for a in self.aggregates if int(a["size_class"]) == k] for k in range(4)]
        mastic = self.summary["composition"][4]
        # without voids inside aggregates the spheres of a shape have the shape's volume in all
        self.volume = [sum(float(a["volume"]) for a in c) / BOX for c in self.of_class] + [mastic["fraction"]]
        self.particles = [len(c) for c in self.of_class] + [mastic["count"]]
        self.spheres = [sum(int(a["spheres"]) for a in c) for c in self.of_class] + [mastic["count"]]
        self.single = [sum(a["shape"] == "sphere" for a in c) for c in self.of_class]
        self.single_volume = [sum(float(a["volume"]) for a in c if a["shape"] == "sphere") / BOX for c in self.of_class]
        self.size = [1e3 * mean(float(a["size"]) for a in c) for c in self.of_class]
        self.to_box = sum(self.volume)
        self.share = [100 * v / self.to_box for v in self.volume]
        contacts = [self.summary["contacts"][pair] for pair in PAIRS]
        self.contacts = [*contacts, sum(contacts)]
        self.inner = self.summary["contacts"]["inner"]
        self.coordination = self.contacts[3] / sum(self.particles)
        self.seconds = self.summary["timing_s"]["specimen"]
        self.e_star = [r["e_star_pa"] / 1e9 for r in self.summary.get("results", [])]
        self.phase = [r["phase_deg"] for r in self.summary.get("results", [])]
        self.axes = [[abs(float(a["axis_" + x])) for x in "xyz"] for a in self.aggregates if a["shape"] != "sphere"]


def kolmogorov_smirnov(values):
    """Largest distance of a sample in [0, 1] from the uniform distribution, and its p-value (asymptotic)."""
    values, n = sorted(values), len(values)
    d = max(max((k + 1) / n - v, v - k / n) for k, v in enumerate(values))
    t = d * (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n))
    return d, min(1.0, 2 * sum((-1) ** (k - 1) * math.exp(-2 * (k * t) ** 2) for k in range(1, 101)))
