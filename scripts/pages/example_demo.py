# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of examples/demo/README.md, from the output of its command, and times that several pages give."""
import re

from pages import readme
from pages.data import one, rows, table, text
from pages.marks import mark

DOCUMENT = "examples/demo/README.md"


@mark
def size():
    m = next(m for m in (re.match(r"(\d+) particles, (\d+) contacts \(([^)]*)\)", row) for row in text("demo-output.txt")) if m)
    counts = re.sub(r"\d+", lambda n: f"{int(n[0]):,}", m[3])
    return f"{int(m[1]):,} particles ({aggregates()} aggregates), {int(m[2]):,} contacts ({counts})"


def aggregates():
    return sum(int(m[1]) for m in (re.match(r"[\d.]+-[\d.]+ mm +\d+ +(\d+)", row) for row in text("demo-output.txt")) if m)


def steps():
    return [int(m[1]) for m in (re.search(r"1 cycle of (\d+) steps", row) for row in text("demo-output.txt")) if m]


@mark
def step_range():
    return f"{min(steps()):,} to {max(steps()):,} steps"


@mark
def moduli():
    """Returns the table of frequencies that the program prints."""
    found = [m for m in (re.match(r" +([\d.]+) +([\d.]+) +([\d.]+) +(\S+) +(\S+) +\S+ +\d+", row) for row in text("demo-output.txt")) if m]
    return table(["f (Hz)", "\\|E\\*\\| (GPa)", "φ (degrees)", "against the harmonic solution"],
                 [[m[1], f"{float(m[2]):.3f}", f"{float(m[3]):.3f}", f"{m[4].replace('-', '−', 1)}, {m[5]} rad"] for m in found],
                 range(4))


@mark
def wall(method):
    """Returns the seconds of the whole command on two threads of a processor, from bench/command/run."""
    return f"{one(rows('command-cpu.csv'), scene='demo', method=method, phase='wall')['seconds']:.1f} s"
