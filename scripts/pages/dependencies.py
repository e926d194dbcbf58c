# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/dependencies.md: the rows of scripts/supply.csv."""
import csv

from pages.data import RESULTS, table
from pages.marks import mark

DOCUMENT = "docs/dependencies.md"
SUPPLY = RESULTS.parents[1] / "scripts" / "supply.csv"


@mark
def supply(*lists):
    with open(SUPPLY, encoding="utf-8") as f:
        rows = [r for r in csv.DictReader(line for line in f if not line.startswith("#")) if r["list"] in lists]
    return table(["what", "package", "tried from", "licence", "for", "considered instead"],
                 [(r["name"], f"`{r['package']}`", r["version"], r["licence"], r["why"], r["considered"] or "–") for r in rows])
