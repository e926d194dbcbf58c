# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/devices.md: one specimen on several GPUs, several specimens on one or more."""
from pages.data import head, one, rows, span, table
from pages.marks import mark

DOCUMENT = "docs/devices.md"
TEAM = "team-h100-2026-11-24.csv"


@mark
def team_machine():
    return head(TEAM)[0]


def pair(row):
    return one(rows(TEAM), row=row)["us"], one(rows(TEAM), row=f"{row}/devices:2")["us"]


def written(us):
    return f"{us:.1f}" if us < 1e3 else f"{us:,.0f}" if us < 1e5 else f"{us / 1e6:.2f} s"


@mark
def team():
    cases = [(f"step/{scene}/cuda/condensed/{p}/fixed", f"{label}, {p}")
             for scene, label in (("ac14_ss_am1", "full specimen, 221,000 contacts"), ("ac14_ms_ico_fine", "MS-Ico-fine, 441,000 contacts"),
                                  ("lattice:1e6", "lattice of 10⁶, 5.9·10⁶ contacts"))
             for p in ("single", "mixed", "double")]
    lines = []
    for row, label in cases:
        alone, both = pair(row)
        path = one(rows(TEAM), row=f"{row}/devices:2")["path"].split(", ")[2]
        lines.append((label, written(alone), written(both), f"{alone / both:.2f}", path))
    return table(["a step (µs)", "one GPU", "two GPUs", "factor", "on two"], lines)


@mark
def team_harmonic(loads):
    alone, both = pair(f"harmonic/lattice:1e6/cuda/loads:{loads}")
    return f"{alone / 1e6:.2f} s on one GPU and {both / 1e6:.2f} s on two"


@mark
def team_huge():
    """Twice the particles on two GPUs against one."""
    alone = one(rows(TEAM), row="step/lattice:8e6/cuda/condensed/single/fixed")["us"]
    both = one(rows(TEAM), row="step/lattice:1.6e7/cuda/condensed/single/fixed/devices:2")["us"]
    return f"{both / 1e3:.2f} ms, and of half of it on one {alone / 1e3:.2f} ms: {100 * alone / both:.0f} %"


MANY = "many-h100-2026-11-25.csv"


@mark
def many_machine():
    return head(MANY)[0]


def many_rows():
    """Times by number of GPUs: of the program before, as it is now, and what was tried beside."""
    out = {}
    for r in rows(MANY):
        out.setdefault(r["how"], {})[r["devices"]] = r["seconds"]
    return out


@mark
def many(which):
    """`turns`: the program before; `two`: as it is now."""
    found = next(times for how, times in many_rows().items() if which in how.split())
    return f"{found[1]:.0f} s on one GPU and {found[2]:.0f} s on two"


@mark
def many_factors():
    """Of two GPUs to one, of all but the program before."""
    return span([t[1] / t[2] for t in list(many_rows().values())[1:] if 1 in t], "{:.2f}", " to ")


@mark
def many_worst():
    others = list(many_rows().values())[1:]
    one_gpu, two = (max(t[n] for t in others if n in t) for n in (1, 2))
    return f"{one_gpu:.0f} s and {two:.0f} s"
