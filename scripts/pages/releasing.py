# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/releasing.md on reproducible builds, from scripts/reproducible --table."""
from pages.data import head, rows, table
from pages.marks import mark

DOCUMENT = "docs/releasing.md"
REPRODUCIBLE = "reproducible.csv"


@mark
def reproducible_where():
    return "; ".join(head(REPRODUCIBLE))


@mark
def reproducible():
    return table(["file", "SHA-256", "same bytes from both folders"],
                 [(f"`{r['file']}`", f"`{r['sha256']}`", r["same"]) for r in rows(REPRODUCIBLE)])
