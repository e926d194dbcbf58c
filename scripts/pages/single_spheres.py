# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of the pages of examples/ac14_ss_am1 and _am2 on their specimen, which is the same, from the output of their
commands."""
import re

from pages.data import table, text
from pages.marks import mark

OUTPUT = "paper-output.txt"


def line(pattern):
    return next(m for m in (re.match(pattern, row) for row in text(OUTPUT)) if m)


@mark
def composition():
    lines = [m for m in (re.match(r"(\S+(?: mm)?) +(\d+) +(\d+) +([\d.]+)% +([\d.]+)%$", row) for row in text(OUTPUT)) if m]
    return table(["class", "count", "of the box"],
                 [[m[1].replace("-", "–"), f"{int(m[3]):,}", f"{float(m[5]):.2f} %"] for m in lines], [1, 2])


@mark
def size():
    """Returns the numbers of particles and of contacts, also by pair."""
    m = line(r"(\d+) particles, (\d+) contacts \(([^)]*)\)")
    pairs = re.sub(r"\d+", lambda n: f"{int(n[0]):,}", m[3])
    return f"{int(m[1]):,} particles, {int(m[2]):,} contacts ({pairs})"


@mark
def points():
    return f"{int(line(r'.* (' + chr(92) + r'd+) contact points')[1]) / 1e6:.2f} million"
