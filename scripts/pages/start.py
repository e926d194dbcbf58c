# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/start.md, from the output of its command."""
import re

from pages.data import text
from pages.marks import mark
from pages.readme import shown

DOCUMENT = "docs/start.md"


@mark
def specimen():
    return shown("start-output.txt", ["class", r"[\d.]+-[\d.]+ mm", "mastic {4}", r"\d+ particles"])


@mark
def moduli():
    return shown("start-output.txt", [r" +f \(Hz\)", r" +[\d.]+ +[\d.]+ +[\d.]+ +\d.*e-"])


def number(pattern):
    return next(float(m[1]) for m in (re.search(pattern, line) for line in text("start-output.txt")) if m)


@mark
def took():
    """Returns the time of the whole command, from the comment in the committed output."""
    return f"{number(r'^the whole command: ([0-9.]+) s'):.1f} seconds"


@mark
def aggregates():
    return f"{number(r'^aggregates: ([0-9]+)'):.0f}"


@mark
def single():
    """Returns the number of aggregates that are a single sphere."""
    return f"{number(r'^of these single spheres: ([0-9]+)'):.0f}"
