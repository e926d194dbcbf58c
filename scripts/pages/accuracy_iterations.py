# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/frequency-solver.md on the number of iterations of the frequency domain over size, from
bench/iterations/run."""
from pages.data import head, plain, rows, table, thousands
from pages.marks import mark

FILE = "iterations.csv"
MANY = 640  # number of boxes that is tried for all sizes


def usual(boxes):
    return 0 < boxes < MANY


def sizes():
    return sorted({r["particles"] for r in rows(FILE)})


def of(particles, boxes):
    """Returns the row with this number of boxes (a number, or a function that accepts it), or None if it was not
    tried."""
    fits = boxes if callable(boxes) else lambda number: number == boxes
    return next((r for r in rows(FILE) if r["particles"] == particles and fits(r["boxes"])), None)


def count(row):
    if row is None:
        return ""
    return f"{row['iterations']:.0f}" if row["converged"] == "yes" else f"not in {row['iterations']:.0f}"


def seconds(row):
    return plain(row["preconditioner_s"] + row["solve_s"], 2) if row else ""


@mark
def iterations():
    lines = []
    for n in sizes():
        ways = [of(n, 0), of(n, usual), of(n, MANY)]
        lines.append((thousands(n), thousands(ways[0]["contacts"]), f"{ways[1]['boxes']:.0f}",
                      *(count(r) for r in ways), *(seconds(r) for r in ways)))
    return table(["particles", "contacts", "boxes", "iterations without", "with them", f"with {MANY}",
                  "seconds without", "with them", f"with {MANY}"], lines)


@mark
def iterations_machine():
    return "; ".join(head(FILE))


@mark
def iterations_growth(which):
    """Returns by which factor the height or the iterations grow from the smallest specimen to the largest."""
    if which == "height":
        return f"{(sizes()[-1] / sizes()[0]) ** (1 / 3):.1f}"
    boxes = {"alone": 0, "boxes": usual}[which]
    ends = [of(n, boxes) for n in (sizes()[0], sizes()[-1])]
    if any(r["converged"] != "yes" for r in ends):
        raise LookupError(f"bench/results/{FILE}: no convergence in {ends[-1]['iterations']:.0f} iterations")
    return f"{ends[1]['iterations'] / ends[0]['iterations']:.1f}"


@mark
def iterations_sizes():
    return f"{thousands(sizes()[0])} to {thousands(sizes()[-1])} particles, a factor of {sizes()[-1] / sizes()[0]:.0f}"


@mark
def iterations_saved():
    """Returns the range of the factor by which boxes reduce the iterations."""
    of_both = [of(n, 0)["iterations"] / of(n, usual)["iterations"] for n in sizes()]
    return f"{min(of_both):.1f} to {max(of_both):.1f}"
