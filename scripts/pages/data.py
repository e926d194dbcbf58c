# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of bench/results/ and how numbers are written."""
import csv
import functools
import math
import re
from pathlib import Path

RESULTS = Path(__file__).resolve().parents[2] / "bench" / "results"


class Missing(LookupError):
    """A result that is not there."""


def opened(name):
    """A committed result."""
    if not (RESULTS / name).is_file():
        raise Missing(f"bench/results/{name} is not there: bench/README.md says which command makes it")
    return open(RESULTS / name, encoding="utf-8")


@functools.cache
def head(name):
    """The comment lines before a table."""
    with opened(name) as f:
        return [line[1:].strip() for line in f if line.startswith("#")]


@functools.cache
def rows(name):
    """A table of bench/results/, numbers as numbers; an empty cell is None."""
    with opened(name) as f:
        table = list(csv.DictReader(line for line in f if not line.startswith("#")))
    return [{key: converted(value) for key, value in row.items()} for row in table]


def converted(value):
    if value is None or value == "":
        return None
    try:
        return float(value)
    except ValueError:
        return value


def text(name):
    """Lines of a committed output, without its comments."""
    with opened(name) as f:
        return [line.rstrip() for line in f if not line.startswith("#")]


def where(table, **wanted):
    """Rows with these values; a tuple names several, a function judges."""
    def fits(value, want):
        return want(value) if callable(want) else value in want if isinstance(want, tuple) else value == want
    found = [r for r in table if all(fits(r[key], want) for key, want in wanted.items())]
    if not found:
        raise LookupError(f"no row with {wanted}")
    return found


def listed(words):
    """a, b and c"""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last


def one(table, **wanted):
    found = where(table, **wanted)
    if len(found) != 1:
        raise LookupError(f"{len(found)} rows with {wanted}")
    return found[0]


def largest(table, *keys):
    """The largest magnitude of some columns."""
    return max(abs(r[key]) for r in table for key in keys)


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else math.nan


def half_range(values):
    """The one measure of spread in all tables."""
    values = list(values)
    return (max(values) - min(values)) / 2


def minus(written):
    """Minus signs before numbers, which hyphens in names are not."""
    return re.sub(r"(?<![\w)])-(?=[\d.])", "−", written)


def power(x, digits=2, sign=False):
    """6.8e-8: so many significant digits, plainly where that is as short."""
    if x == 0:
        return "0"
    written = f"{x:{'+' if sign else ''}.{digits - 1}e}"
    mantissa, exponent = written.split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa and digits > 2 else mantissa
    if mantissa.endswith(".0"):
        mantissa = mantissa[:-2]
    return f"{mantissa}e{int(exponent)}"


def upto(x, digits=2):
    """A bound of x that may be written: rounded up to so many significant digits."""
    if x == 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(abs(x))) - digits + 1)
    return float(f"{math.ceil(abs(x) / step - 1e-9) * step:.12g}")


def downto(x, digits=2):
    """The least magnitude that may be written of x: rounded down to so many significant digits."""
    if x == 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(abs(x))) - digits + 1)
    return float(f"{math.floor(abs(x) / step + 1e-9) * step:.12g}")


def upto_percent(shares, digits=2):
    """The largest of some shares as a bound in percent."""
    return f"{upto(100 * max(shares), digits):g} %"


def plain(x, digits=2):
    """So many significant digits without a power of ten."""
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(x)))) if x else 0
    return f"{round(x, decimals):.{decimals}f}"


def thousands(x):
    return f"{x:,.0f}"


def span(values, form, join=" … "):
    """Least and largest, one number where they are written alike; form is a function or a format."""
    write = form.format if isinstance(form, str) else form
    values = list(values)
    low, high = write(min(values)), write(max(values))
    return low if low == high else f"{low}{join}{high}"


def between(values, form="{:.0f}"):
    return span(values, form, " to ")


def percents(shares):
    """A range of shares in whole percents."""
    return between(100 * share for share in shares) + " %"


def memory(gigabytes):
    """What a run needs at most: one rounding, upwards, on every page."""
    return f"{upto(max(gigabytes)):g} GB"


def line(cells):
    """A row of a Markdown table."""
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def table(heads, lines, right=()):
    """A Markdown table; columns in `right` are aligned so."""
    rule = ["---:" if k in right else "---" for k in range(len(heads))]
    return [line(heads), "|" + "|".join(rule) + "|", *(line(cells) for cells in lines)]
