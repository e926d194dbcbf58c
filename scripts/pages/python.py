# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/python.md, from python-cpu.csv of bench/python/run."""
from pages.data import head, one, rows, table, thousands
from pages.marks import mark

DOCUMENT = "docs/python.md"
LEVELS = {"x86-64": "any x86-64 processor", "x86-64-v3": "processors with AVX2", "x86-64-v4": "processors with AVX-512"}


def value(case, by):
    return one(rows("python-cpu.csv"), case=case, by=by)["value"]


@mark
def costs():
    cases = {"first call": "\\|E\\*\\| of the demo, from nothing", "stepped": "a stepped run, from nothing",
             "stepping": "of this, the steps, with a callback in Python"}
    return table(["what (s)", "`macadam`", "Python"],
                 [[words, *(f"{value(case, by):.2f}" for by in ("program", "package"))] for case, words in cases.items()], [1, 2])


@mark
def generations():
    own = value("steps/s", "program")
    lines = [["a build for this machine", thousands(own), "100 %"]]
    lines += [[f"the wheel, for {words}", thousands(value("steps/s", level)), f"{100 * value('steps/s', level) / own:.0f} %"]
              for level, words in LEVELS.items()]
    return table(["code", "steps a second", "of that of a build for this machine"], lines, [1, 2])


@mark
def size():
    return f"{value('size (MB)', 'wheel'):.0f} MB"


@mark
def install():
    return f"{value('install to |E*|', 'wheel'):.0f} s"


@mark
def measured():
    return head("python-cpu.csv")[0].split("; ")[1]
