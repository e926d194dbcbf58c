# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/index.md on its picture."""
from pages.data import one, rows
from pages.marks import mark

DOCUMENT = "docs/index.md"


def pictured():
    """Returns the row of the specimen in docs/pictures/ac14_ms_poly_fine_view.png."""
    return one(rows("paper-specimens.csv"), scene="ac14_ms_poly_fine", seed=1)


def aggregates():
    return sum(pictured()[f"particles_{k}"] for k in range(4))


def single():
    return sum(pictured()[f"single_{k}"] for k in range(4))


@mark
def aggregates_in_picture():
    return f"{aggregates():,.0f}"


@mark
def clusters_in_picture():
    return f"{aggregates() - single():,.0f}"


@mark
def single_in_picture():
    return f"{single():,.0f}"
