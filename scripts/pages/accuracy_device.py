# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/accuracy.md: the frequency domain on a CUDA device, as `macadam bench --only harmonic` times it."""
from pages.data import head, minus, plain, power, rows, table, thousands
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
