# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/reliability.md: campaigns of faults, from tests/faults/campaign --table."""
from pages.data import head, rows, table
from pages.marks import mark

DOCUMENT = "docs/reliability.md"
FAULTS = "faults.csv"


@mark
def faults_machine():
    return head(FAULTS)[0]


@mark
def faults():
    return table(["campaign", "trials", "failures"],
                 [(r["campaign"], f"{r['trials']:,.0f}", f"{r['failures']:.0f}") for r in rows(FAULTS)])
