# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks on stability in docs/verification.md, from the table of bench/stability."""
import math
import re

from pages.data import RESULTS, downto, head, mean, power, rows, upto, where
from pages.marks import mark

DOCUMENT = "docs/verification.md"


def file():
    """Returns the name of the committed table, which contains the machine's name. Raises LookupError if there is not
    exactly one."""
    files = sorted(f.name for f in RESULTS.glob("stability-*.csv"))
    if len(files) != 1:
        raise LookupError(f"bench/results/ has {len(files)} tables stability-*.csv, expected one")
    return files[0]


@mark
def file_name():
    return file()


@mark
def machine():
    """Returns processor, date, commit and duration of the run."""
    return re.sub(r"^stability_bench, full run; ", "", head(file())[0]).partition("; cuda:")[0]


def computed():
    """Returns the smallest and the largest ratio of the computed step to the true limit, over all networks."""
    found = [r["measured"] for r in rows(file()) if r["quantity"].endswith("computed / true limit")
             and not r["quantity"].startswith("mean")]
    return min(found), max(found)


@mark
def step_range():
    low, high = computed()
    usual = [r["measured"] for r in where(rows(file()), case="step_bound", quantity="computed / true limit")]
    return (f"{downto(low, 3):.3f} to {upto(high, 3):.3f} of the true limit in all networks, and {mean(usual):.3f} in "
            f"the mean of the {len(usual)} usual specimens")


@mark
def ringing():
    """Returns the part of the force that alternates after a sudden start."""
    found = [r for r in rows(file()) if r["quantity"] == "alternating part of the force after 1000 steps / η·v"]
    return f"{found[0]['measured']:.3f}"


@mark
def drift():
    found = [r for r in rows(file()) if r["quantity"] == "largest |energy / that of the start − 1|"
             and r["variant"].startswith("two particles, free, elastic, fixed")]
    return ", ".join(f"{power(upto(r['measured']))} ({r['setting'].partition(', ')[2]}, "
                     f"{r['variant'].rpartition(', ')[2]})" for r in found)


@mark
def strain(which):
    """Returns the strain up to which fixed geometry gives the `stress`, or the `modulus`."""
    start = {"stress": "strain at which stresses of `fixed`", "modulus": "strain at which E* of `fixed`"}[which]
    least = min(r["measured"] for r in rows(file()) if r["quantity"].startswith(start))
    return f"a strain of {power(downto(least))}" if math.isfinite(least) else "the largest strain tried, 1e-2"


def failures():
    return [r for r in rows(file()) if r["verdict"] != "pass"]


@mark
def passed():
    found = rows(file())
    return f"{len(found) - len(failures())} of {len(found)} comparisons pass."


@mark
def failed():
    """Returns the sentence on the comparison that fails."""
    found = failures()
    if {(r["case"], r["setting"]) for r in found} != {("long_free", "cpu, single")}:
        raise LookupError("the comparisons that fail are not those of long free runs in single precision")
    return ("1 of them fails: the energy of such a run." if len(found) == 1 else
            f"{len(found)} of them fail: the energies of such runs.")
