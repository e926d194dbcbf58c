# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/dependencies.md, from scripts/supply.csv."""
import csv
import re

from pages.data import RESULTS, rows, table, thousands
from pages.marks import mark

DOCUMENT = "docs/dependencies.md"
SUPPLY = RESULTS.parents[1] / "scripts" / "supply.csv"


@mark
def supply(*lists):
    with open(SUPPLY, encoding="utf-8") as f:
        rows = [r for r in csv.DictReader(line for line in f if not line.startswith("#")) if r["list"] in lists]
    return table(["what", "package", "tried from", "licence", "for", "considered instead"],
                 [(r["name"], f"`{r['package']}`", r["version"], r["licence"], r["why"], r["considered"] or "–") for r in rows])


def compiler_of(text):
    """Returns a compiler's name and version, from the first line that its --version prints."""
    return f"{'clang' if 'clang' in text else 'gcc'} {re.search(r'[0-9]+[.][0-9]+[.][0-9]+', re.sub(r'[(].*?[)]', '', text))[0]}"


@mark
def distributions():
    """Returns the table of other distributions, from scripts/chroot-build --table."""
    return table(["distribution", "compiler", "CGAL", "HDF5", "ITK", "{fmt}", "passed", "failed", "skipped", "commit"],
                 [(r["distribution"], compiler_of(r["compiler"]), *(r[c] for c in ("cgal", "hdf5", "itk", "fmt")),
                   *(thousands(r[c]) for c in ("passed", "failed", "skipped")), r["commit"]) for r in rows("distributions.csv")], range(6, 9))
