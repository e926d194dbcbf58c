# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the files of bench/results/, and writes numbers as text in the same way on all pages."""
import csv
import functools
import math
import re
from pathlib import Path

RESULTS = Path(__file__).resolve().parents[2] / "bench" / "results"


class Missing(LookupError):
    """A file of results does not exist."""


def opened(name):
    """Opens a committed file of results. Raises Missing if it does not exist."""
    if not (RESULTS / name).is_file():
        raise Missing(f"bench/results/{name} is not there: bench/README.md says which command makes it")
    return open(RESULTS / name, encoding="utf-8")


@functools.cache
def head(name):
    """Returns the comment lines of a file."""
    with opened(name) as f:
        return [line[1:].strip() for line in f if line.startswith("#")]


@functools.cache
def rows(name):
    """Returns the rows of a table in bench/results/, with numbers as numbers; an empty cell is None."""
    with opened(name) as f:
        table = list(csv.DictReader(line for line in f if not line.startswith("#")))
    return [{key: converted(value) for key, value in row.items()} for row in table]


# Returns a cell as a number if it is one, otherwise as text; None if it is empty.
def converted(value):
    if value is None or value == "":
        return None
    try:
        return float(value)
    except ValueError:
        return value


def text(name):
    """Returns the lines of a committed output without its comments."""
    with opened(name) as f:
        return [line.rstrip() for line in f if not line.startswith("#")]


def where(table, **wanted):
    """Returns the rows with these values; a tuple lists several allowed values, a function returns whether a value is
    allowed.
    Raises LookupError if there are none."""
    def fits(value, want):
        return want(value) if callable(want) else value in want if isinstance(want, tuple) else value == want
    found = [r for r in table if all(fits(r[key], want) for key, want in wanted.items())]
    if not found:
        raise LookupError(f"no row with {wanted}")
    return found


def listed(words):
    """Returns "a, b and c"."""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last


# Returns the only row with these values. Raises LookupError if there is not exactly one.
def one(table, **wanted):
    found = where(table, **wanted)
    if len(found) != 1:
        raise LookupError(f"{len(found)} rows with {wanted}")
    return found[0]


def largest(table, *keys):
    """Returns the largest magnitude in some columns."""
    return max(abs(r[key]) for r in table for key in keys)


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else math.nan


def half_range(values):
    """Returns half the difference between largest and smallest value, the measure of spread in all tables."""
    values = list(values)
    return (max(values) - min(values)) / 2


def minus(written):
    """Replaces hyphens before numbers by minus signs; hyphens in names stay."""
    return re.sub(r"(?<![\w)])-(?=[\d.])", "−", written)


def power(x, digits=2, sign=False):
    """Returns a number with this many significant digits as a power of ten (6.8e-8), or without one if that is as
    short."""
    if x == 0:
        return "0"
    written = f"{x:{'+' if sign else ''}.{digits - 1}e}"
    mantissa, exponent = written.split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa and digits > 2 else mantissa
    if mantissa.endswith(".0"):
        mantissa = mantissa[:-2]
    return f"{mantissa}e{int(exponent)}"


def upto(x, digits=2):
    """Returns an upper bound of |x|: rounded up to this many significant digits."""
    if x == 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(abs(x))) - digits + 1)
    return float(f"{math.ceil(abs(x) / step - 1e-9) * step:.12g}")


def downto(x, digits=2):
    """Returns a lower bound of |x|: rounded down to this many significant digits."""
    if x == 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(abs(x))) - digits + 1)
    return float(f"{math.floor(abs(x) / step + 1e-9) * step:.12g}")


def upto_percent(shares, digits=2):
    """Returns an upper bound of some shares in per cent."""
    return f"{upto(100 * max(shares), digits):g} %"


def plain(x, digits=2):
    """Returns a number with this many significant digits, without a power of ten."""
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(x)))) if x else 0
    return f"{round(x, decimals):.{decimals}f}"


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


def percents(shares):
    """Returns the range of some shares in whole per cent."""
    return between(100 * share for share in shares) + " %"


def memory(gigabytes):
    """Returns the largest memory of some runs, rounded up in the same way on every page."""
    return f"{upto(max(gigabytes)):g} GB"


def line(cells):
    """Returns a row of a Markdown table."""
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def table(heads, lines, right=()):
    """Returns the lines of a Markdown table. right: numbers of the columns that are aligned to the right."""
    rule = ["---:" if k in right else "---" for k in range(len(heads))]
    return [line(heads), "|" + "|".join(rule) + "|", *(line(cells) for cells in lines)]
