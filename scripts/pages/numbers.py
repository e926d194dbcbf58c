# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes numbers as text, in the same way on all pages."""
import math
import re


def listed(words):
    """Returns "a, b and c"."""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last


def minus(written):
    """Replaces hyphens before numbers by minus signs. Hyphens in names stay."""
    return re.sub(r"(?<![\w)])-(?=[\d.])", "−", written)


def power(x, digits=2, sign=False):
    """Returns a number with this many significant digits as a power of ten, such as 6.8e-8."""
    if x == 0:
        return "0"
    mantissa, exponent = f"{x:{'+' if sign else ''}.{digits - 1}e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa and digits > 2 else mantissa.removesuffix(".0")
    return f"{mantissa}e{int(exponent)}"


def plain(x, digits=2):
    """Returns a number with this many significant digits, without a power of ten."""
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(x)))) if x else 0
    return f"{round(x, decimals):.{decimals}f}"


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


def bound(x):
    """Returns an upper bound of |x| as text, as a power of ten if it is below 0.001."""
    above = upto(x)
    return power(above) if above < 0.001 else f"{above:g}"


def shown(value):
    """Returns the text of a cell: a number as short as possible, nothing if the cell is empty."""
    if value is None:
        return ""
    return f"{value:.15g}" if isinstance(value, float) else str(value)


def line(cells):
    """Returns one row of a Markdown table."""
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def table(heads, lines, right=()):
    """Returns the lines of a Markdown table. right: numbers of the columns that are aligned to the right."""
    rule = ["---:" if k in right else "---" for k in range(len(heads))]
    return [line(heads), "|" + "|".join(rule) + "|", *(line(cells) for cells in lines)]
