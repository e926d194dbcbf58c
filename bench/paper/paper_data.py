# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the files of bench/results/ for the tables of the reference publication, and writes their numbers as text."""
import csv
import functools
import math
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "bench" / "results"
sys.path.insert(0, str(ROOT / "scripts"))
from pages.numbers import line, listed, minus, table, upto  # noqa: E402, F401  (also for the other modules of this folder)


@functools.cache
def rows(name):
    """Returns the rows of a table in bench/results/, with numbers as numbers; an empty cell is None."""
    with open(RESULTS / name, encoding="utf-8") as f:
        table = list(csv.DictReader(line for line in f if not line.startswith("#")))
    return [{key: converted(value) for key, value in row.items()} for row in table]


def converted(value):
    """Returns a cell as a number if it is one, otherwise as text; None if it is empty."""
    if value is None or value == "":
        return None
    try:
        return float(value)
    except ValueError:
        return value


def where(table, **wanted):
    """Returns the rows with these values. Raises LookupError if no row has them."""
    found = [r for r in table if all(r[key] == want for key, want in wanted.items())]
    if not found:
        raise LookupError(f"no row with {wanted}")
    return found


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else math.nan


def half_range(values):
    """Returns half the difference between largest and smallest value, the measure of spread in all tables."""
    values = list(values)
    return (max(values) - min(values)) / 2


def upto_percent(fractions, digits=2):
    """Returns an upper bound of some fractions in per cent."""
    return f"{upto(100 * max(fractions), digits):g} %"


def thousands(x):
    return f"{x:,.0f}"


def span(values, form, join=" … "):
    """Returns smallest and largest value as text, or one number if both have the same text. form: a function or a
    format."""
    write = form.format if isinstance(form, str) else form
    values = list(values)
    low, high = write(min(values)), write(max(values))
    return low if low == high else f"{low}{join}{high}"


def between(values, form="{:.0f}"):
    return span(values, form, " to ")
