# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the paper's specimens: makes a run, writes the important numbers of its files into a row of bench/results/,
and reads such rows."""
import csv
import json
import math
import os
import re
import subprocess
import time
from pathlib import Path

from pages.data import RESULTS, mean
from paper_tables import BOX, FREQUENCIES, PAIRS

ROOT = Path(__file__).resolve().parents[2]


def program(given):
    """Returns the program to run: the given one or, by default, that of build/local. Ends the process if it does not
    exist."""
    file = given or ROOT / "build" / "local" / "macadam"
    if file.is_file():
        return file.resolve()
    raise SystemExit(f"no program {file}: scripts/test or scripts/demo builds it, --program names another")


def rows(file):
    with open(file, encoding="utf-8") as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def write(file, table, head=()):
    """Writes a CSV file. head: lines of comments before it."""
    with open(file, "w", newline="", encoding="utf-8") as f:
        f.writelines(f"# {line}\n" for line in head)
        out = csv.DictWriter(f, table[0], lineterminator="\n")
        out.writeheader()
        out.writerows(table)


def call(macadam, command, folder, *arguments, threads=None):
    """Runs the program with `folder` as its output and writes the time and memory that it took into measured.json
    there."""
    environment = dict(os.environ)
    if threads:
        environment.update(OMP_NUM_THREADS=str(threads), OPENBLAS_NUM_THREADS=str(threads))
    start = time.monotonic()
    process = subprocess.Popen([str(a) for a in (macadam, command, *arguments, "--out", folder)], env=environment,
                               stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"{folder.name}: exit code {process.returncode} of {' '.join(map(str, process.args))}")
    measured = {"seconds": round(time.monotonic() - start, 3), "memory_gb": round(usage.ru_maxrss / 1e6, 2),
                "threads": threads or os.cpu_count(), "machine": processor(),
                "date": time.strftime("%Y-%m-%d", time.gmtime())}
    (folder / "measured.json").write_text(json.dumps(measured))


def processor():
    """Returns the name of this machine's processor, as the system reports it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown processor")


# Returns the output of a command; empty if it fails.
def said(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return ""


def commit_of_tree():
    return said("git", "-C", ROOT, "rev-parse", "--short", "HEAD").strip() or "unknown"


def device(macadam):
    """Returns the name of the GPU that the program finds; empty if there is none."""
    found = re.search(r"^cuda +yes.*\n +([^,\n]+),", said(macadam, "info"), re.M)
    return found[1] if found else ""


# Returns the status of the run in a folder; None if there is no summary.
def status(folder):
    file = folder / "summary.json"
    return json.loads(file.read_text())["status"] if file.is_file() else None


def record(folder, scene, seed):
    """Returns the row of a results folder, and the directions of its clusters."""
    summary, measured = json.loads((folder / "summary.json").read_text()), {}
    if (folder / "measured.json").is_file():  # missing if call() was stopped during the run
        measured = json.loads((folder / "measured.json").read_text())
    aggregates, mastic = rows(folder / "aggregates.csv"), summary["composition"][4]
    row = {"scene": scene, "seed": seed, "machine": measured.get("machine"), "date": measured.get("date"),
           "threads": measured.get("threads"), "specimen_s": f"{summary['timing_s']['specimen']:.3g}",
           "wall_s": f"{measured['seconds']:.1f}" if measured else None, "memory_gb": measured.get("memory_gb")}
    for k in range(4):
        of = [a for a in aggregates if int(a["size_class"]) == k]
        volume, spheres = [float(a["volume"]) * 1e9 for a in of], [int(a["spheres"]) for a in of]
        size = [float(a["size"]) * 1e3 for a in of]
        single = [v for v, a in zip(volume, of) if a["shape"] == "sphere"]
        row.update({
            f"particles_{k}": len(of), f"spheres_{k}": sum(spheres), f"single_{k}": len(single),
            f"volume_mm3_{k}": f"{sum(volume):.7g}", f"single_volume_mm3_{k}": f"{sum(single):.7g}",
            f"square_mm6_{k}": f"{sum(v * v for v in volume):.7g}", f"size_mm_{k}": f"{mean(size):.5g}",
            f"size_by_spheres_mm_{k}": f"{sum(s * n for s, n in zip(size, spheres)) / sum(spheres):.5g}",
            f"asked_{k}": f"{summary['composition'][k]['fraction_asked']:.7g}",
            f"reached_{k}": f"{summary['composition'][k]['fraction']:.7g}"})
    row.update({"particles_4": mastic["count"], "asked_4": f"{mastic['fraction_asked']:.7g}",
                "reached_4": f"{mastic['fraction']:.7g}",
                **{pair: summary["contacts"].get(pair, 0) for pair in (*PAIRS, "inner")},
                "second_moment_difference": f"{summary['second_moment_difference']:.4g}"})
    at = {r["frequency_hz"]: r for r in summary.get("results", [])}
    for hz in FREQUENCIES:
        row[f"e_star_pa_{hz}"] = f"{at[hz]['e_star_pa']:.9g}" if at else ""
        row[f"phase_deg_{hz}"] = f"{at[hz]['phase_deg']:.9g}" if at else ""
    axes = [{"scene": scene, "seed": seed, **{x: f"{abs(float(a['axis_' + x])):.4f}" for x in "xyz"}}
            for a in aggregates if a["shape"] != "sphere"]
    return row, axes


class Run:
    """The data of one specimen with one seed, from its row and the directions of its clusters."""

    def __init__(self, row, axes=()):
        def of_class(key, kind=float):
            return [kind(row[f"{key}_{k}"]) for k in range(4)]

        self.seed, self.row = int(row["seed"]), row
        mastic = int(row["particles_4"])
        # without voids inside aggregates, the volume of a shape is the sum of its spheres' volumes
        self.volume = [v * 1e-9 / BOX for v in of_class("volume_mm3")] + [float(row["reached_4"])]
        self.particles = of_class("particles", int) + [mastic]
        self.spheres = of_class("spheres", int) + [mastic]
        self.single = of_class("single", int)
        self.single_volume = [v * 1e-9 / BOX for v in of_class("single_volume_mm3")]
        self.square = of_class("square_mm6")
        self.size, self.size_by_spheres = of_class("size_mm"), of_class("size_by_spheres_mm")
        self.asked = of_class("asked") + [float(row["asked_4"])]
        self.reached = of_class("reached") + [float(row["reached_4"])]
        self.to_box = sum(self.volume)
        self.share = [100 * v / self.to_box for v in self.volume]
        contacts = [int(row[pair]) for pair in PAIRS]
        self.contacts = [*contacts, sum(contacts)]
        self.inner = int(row["inner"])
        self.coordination = self.contacts[3] / sum(self.particles)
        self.seconds, self.threads = float(row["specimen_s"]), row["threads"]
        self.wall, self.memory = (float(row[key]) if row[key] else None for key in ("wall_s", "memory_gb"))
        solved = row[f"e_star_pa_{FREQUENCIES[0]}"] != ""
        self.e_star = [float(row[f"e_star_pa_{hz}"]) / 1e9 for hz in FREQUENCIES] if solved else []
        self.phase = [float(row[f"phase_deg_{hz}"]) for hz in FREQUENCIES] if solved else []
        self.axes = axes


def committed(scene):
    """Returns the runs of a scene from bench/results/, in the order of their seeds."""
    axes = [a for a in rows(RESULTS / "paper-specimens-axes.csv") if a["scene"] == scene]
    return [Run(row, [[float(a[x]) for x in "xyz"] for a in axes if a["seed"] == row["seed"]])
            for row in rows(RESULTS / "paper-specimens.csv") if row["scene"] == scene]


def kolmogorov_smirnov(values):
    """Returns the largest distance of a sample in [0, 1] from the uniform distribution, and its asymptotic p-value."""
    values, n = sorted(values), len(values)
    d = max(max((k + 1) / n - v, v - k / n) for k, v in enumerate(values))
    t = d * (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n))
    return d, min(1.0, 2 * sum((-1) ** (k - 1) * math.exp(-2 * (k * t) ** 2) for k in range(1, 101)))
