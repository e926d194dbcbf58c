# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/frequency-solver.md on the frequency domain on a CUDA device, from `macadam bench --only harmonic`."""
from pages.data import head, minus, one, plain, power, rows, table, thousands
from pages.marks import mark

FILE = "harmonic-h200.csv"


@mark
def harmonic_device_machine():
    return head(FILE)[0].split("; median")[0].split("residual 1e-8, ")[1]


@mark
def harmonic_device():
    return table(["network", "particles", "contacts", "frequencies", "iteration on", "setup (s)", "solutions (s)",
                  "both, first run (s)", "iterations", "residual", "process (GB)"],
                 [(r["network"], thousands(r["particles"]), thousands(r["contacts"]), f"{r['frequencies']:.0f}",
                   r["backend"], plain(r["setup_s"], 2), plain(r["solve_s"], 2), plain(r["first_s"], 2),
                   f"{r['iterations']:.0f}", minus(power(r["residual"])), f"{r['process_gb']:g}") for r in rows(FILE)])


KERNELS = "harmonic-kernels-h200.csv"


@mark
def harmonic_kernels_machine():
    return "NVIDIA" + head(KERNELS)[0].split("NVIDIA")[1].split(";")[0]


@mark
def harmonic_kernels():
    found = rows(KERNELS)
    commits = list(dict.fromkeys(r["commit"] for r in found))
    lines = []
    for scene, label in (("ac14_ss_am1", "ac14_ss_am1"), ("lattice:1e5", "lattice of 10⁵"), ("lattice:1e6", "lattice of 10⁶")):
        for loads in (1, 4):
            each = [one(found, commit=commit, row=f"harmonic/{scene}/cuda/loads:{loads}") for commit in commits]
            times = [r["ms"] for r in each]
            lines.append((label, loads, *(plain(t, 2) for t in times), f"{times[0] / times[-1]:.1f}", *(f"{r['spread_percent']:.0f}" for r in each)))
    return table(["network", "frequencies", "at first (ms)", "then (ms)", "now (ms)", "factor", "spread at first (%)", "then (%)", "now (%)"], lines)


ITERATION = "harmonic-iteration-h200.csv"


@mark
def harmonic_iteration():
    found = rows(ITERATION)
    before, now = dict.fromkeys(r["commit"] for r in found)
    columns = [(commit, loads) for loads in (1, 4) for commit in (before, now)]
    parts = (("turn", "direction"), ("apply", "stiffness times direction"), ("advance", "solution and residual"), ("coarse", "coarse correction"),
             ("iteration", "whole iteration"))
    lines = []
    for devices, label in ((1, "one GPU"), (2, "two GPUs")):
        for part, name in parts:
            lines.append((f"{label}, {name}", *(plain(one(found, commit=c, devices=devices, loads=n)[part], 3) for c, n in columns)))
    return table(["µs", "one frequency, before", "now", "four frequencies, before", "now"], lines)
