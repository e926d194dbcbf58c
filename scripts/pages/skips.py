# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/skips.md, from skips.csv of bench/skips."""
from pages.data import head, minus, power, rows, table, upto_percent
from pages.marks import mark

DOCUMENT = "docs/skips.md"


def effect(row):
    difference = row["difference"]
    if row["compared"] == "model":
        return f"another model: \\|E\\*\\| {minus(power(difference, sign=True))}"
    what = "\\|E\\*\\|" if row["compared"] == "modulus" else "velocities"
    return f"same bits of {what}" if difference == 0 else f"{what} differ by {minus(power(difference, 1))}"


@mark
def machine():
    return head("skips.csv")[0]


@mark
def saved():
    return table(["skipped", "stepped", "µs per step", "against", "µs per step", "ratio", "effect"],
                 [(r["skipped"], r["with"], f"{r['with_us']:,.0f}", r["without"], f"{r['without_us']:,.0f}",
                   f"{r['ratio']:.2f}", effect(r)) for r in rows("skips.csv")], right=(2, 4, 5))


@mark
def twice():
    """Returns the largest difference between two measurements of the same step in different rows."""
    times = {}
    for r in rows("skips.csv"):
        for way in ("with", "without"):
            times.setdefault(r[way], []).append(r[f"{way}_us"])
    apart = [max(t) / min(t) - 1 for t in times.values() if len(t) > 1]
    return upto_percent(apart)
