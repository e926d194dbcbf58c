# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/profiling.md on the operations of a step and their rate, from bench/steps/operations."""
import re

from pages.data import head, minus, one, rows, table
from pages.marks import mark

DOCUMENT = "docs/profiling.md"
COUNTED, TIMED = "operations-h100-2026-11-25.csv", "bench-h100-2026-11-25-operations.csv"
SCENES = {"ac14_ss_am1": "full specimen", "lattice:1e5": "lattice of 10⁵"}


@mark
def operations_machine():
    return head(COUNTED)[0].removeprefix("operations a contact and step by ncu, ")


def most():
    """Returns the operations per second that the device can do in single and in double precision. Each multiprocessor
    has 128 lanes for single and 64 for double precision, and a fused multiply-add counts as two operations."""
    multiprocessors, mhz = map(int, re.search(r"(\d+) multiprocessors at (\d+) MHz", head(COUNTED)[0]).groups())
    return 256e6 * multiprocessors * mhz, 128e6 * multiprocessors * mhz


@mark
def operations_most():
    single, double = most()
    return f"{single / 1e12:.0f} and {double / 1e12:.0f}"


@mark
def operations():
    lines = []
    for r in rows(COUNTED):
        _, scene, _, form, precision, geometry = r["row"].split("/")
        us = one(rows(TIMED), row=r["row"])["us"]
        rate = [n * r["contacts"] / us * 1e6 for n in (r["single_per_contact"], r["double_per_contact"])]
        share = sum(done / possible for done, possible in zip(rate, most()))
        lines.append((f"{SCENES[scene]}, {precision}, {form}, {geometry}", f"{r['single_per_contact']:.0f}", f"{r['double_per_contact']:.0f}",
                      f"{us:.1f}", f"{sum(rate) / 1e12:.1f}", f"{100 * share:.0f} %"))
    return table(["step", "single per contact", "double per contact", "µs", "10¹² operations per second", "of the maximum"], lines, range(1, 6))


@mark
def waiting_machine():
    return head("waiting.csv")[0]


@mark
def waiting():
    lines = []
    for r in rows("waiting.csv"):
        if r["waiting"] != "spin":
            continue
        sleep = one(rows("waiting.csv"), beside=r["beside"], command=r["command"], waiting="sleep")
        lines.append((r["command"], r["beside"], *(f"{x[key]:.2f}" for key in ("seconds", "processor_s") for x in (r, sleep))))
    return table(["command", "beside it", "spin (s)", "sleep (s)", "spin, processor (s)", "sleep, processor (s)"], lines, range(2, 6))


@mark
def steps_by_sleeping():
    """Time of a step with threads that sleep over that with threads that spin, %."""
    return minus(f"{min(d := [100 * (r['sleep_us'] / r['spin_us'] - 1) for r in rows('waiting-steps.csv')]):+.0f} to {max(d):+.0f} %")
