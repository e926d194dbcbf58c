# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/scene.md."""
from pages import readme
from pages.data import percents
from pages.marks import mark

DOCUMENT = "docs/scene.md"
SIEVES = {"4.75-9.5": 2, "2-4.75": 3}


@mark
def single_share(filling, sieve):
    """Returns the share of a class's aggregates that fewer spheres than `least` would fill, in the paper's scenes."""
    k = SIEVES[sieve]
    return percents(r[f"single_{k}"] / r[f"particles_{k}"]
                    for r in readme.runs(f"ac14_ms_poly_{filling}", f"ac14_ms_ico_{filling}"))
