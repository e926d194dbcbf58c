# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the page docs/stability.md from the table of bench/stability."""
import math
import re

from pages.data import RESULTS, downto, head, mean, minus, power, rows, table, upto, where

DOCUMENT = "docs/stability.md"
COLUMNS = ["case", "backend, precision", "measured quantity", "expected", "because", "measured", "verdict"]


def file():
    """Returns the name of the committed table, which contains the machine's name. Exits if there is not exactly one."""
    files = sorted(f.name for f in RESULTS.glob("stability-*.csv"))
    if len(files) != 1:
        raise SystemExit(f"bench/results/ has {len(files)} tables stability-*.csv: of one machine the page is made")
    return files[0]


def number(x):
    if x is None or x == 0:
        return "0"
    return f"{x:.4g}" if 0.01 <= abs(x) < 1e4 else f"{x:.2g}"


def expected(row):
    low, high = row["expected_low"], row["expected_high"]
    if low == -high:
        return f"± {number(high)}"
    return f"≤ {number(high)}" if low == 0 else f"{number(low)} … {number(high)}"


def cell(text):
    """Returns the text of a cell with escaped pipes, which would otherwise end the cell."""
    return text.replace("|", "\\|")


def computed():
    """Returns the smallest and the largest ratio of the computed step to the true limit, over all networks."""
    found = [r["measured"] for r in rows(file()) if r["quantity"].endswith("computed / true limit")
             and not r["quantity"].startswith("mean")]
    return min(found), max(found)


def computed_range():
    low, high = computed()
    usual = [r["measured"] for r in where(rows(file()), case="step_bound", quantity="computed / true limit")]
    return (f"{downto(low, 3):.3f} to {upto(high, 3):.3f} of the true limit in all networks of "
            f"[stability.md](stability.md), {mean(usual):.3f} in the mean of its {len(usual)} usual specimens")


def bounded(table_of):
    found = computed_range().replace("all networks of [stability.md](stability.md)", "all networks below")
    return f"The computed step is {found.replace('its ', 'the ')}."


def ringing(table_of):
    found = [r for r in table_of if r["quantity"] == "alternating part of the force after 1000 steps / η·v"]
    return ("Relaxation times far below the step are stable and exact with a smooth start; a sudden one rings (a "
            f"Maxwell unit of a millionth of the step: {found[0]['measured']:.3f} of the force still alternates after "
            "1000 steps)." if found else "")


def drift(table_of):
    found = [r for r in table_of if r["quantity"] == "largest |energy / that of the start − 1|"
             and r["variant"].startswith("two particles, free, elastic, fixed")]
    return ("The energy of two particles moved by no more than " +
            ", ".join(f"{power(upto(r['measured']))} ({r['setting']}, {r['variant'].rpartition(', ')[2]})"
                      for r in found) + "." if found else "")


def strain(table_of):
    def crossing(start):
        found = [r["measured"] for r in table_of if r["quantity"].startswith(start)]
        if not math.isfinite(min(found)):
            return "the largest strain tried, 1e-2"
        return f"a strain of {power(downto(min(found)))}"
    return ("`fixed` geometry gives the stress to 1e-3 of its amplitude up to "
            f"{crossing('strain at which stresses of `fixed`')}, and E* to 1e-5 up to "
            f"{crossing('strain at which E* of `fixed`')}.")


def failures(table_of):
    failed = [r for r in table_of if r["verdict"] != "pass"]
    if not failed:
        return f"All {len(table_of)} lines pass."
    text = (f"{len(table_of) - len(failed)} of {len(table_of)} lines pass; those that fail ({len(failed)}) are marked "
            "FAIL.")
    if {r["case"] for r in failed} == {"long_free"} and {r["setting"] for r in failed} == {"cpu, single"}:
        text += (" It is the energy of a long free run in single precision: a force that follows from the place is "
                 "rounded the same way on every visit, so that errors add up. `mixed` and `double` do not drift so.")
    return text


def shown(found):
    """Returns all lines except details that pass."""
    return [r for r in found if r["detail"] != 1 or r["verdict"] != "pass"]


def page():
    about = head(file())
    where_and_when = re.sub(r"^stability_bench, ", "", about[0])
    cases = [re.fullmatch(r"case (\w+): (.*)", line).groups() for line in about[1:] if line.startswith("case ")]
    found = rows(file())
    out = ["# Stability under stress", "",
           f"Written by `scripts/documents` from [{file()}](../bench/results/{file()}), which `bench/stability/run`",
           "makes; not to be edited. Each line states what must come out and why, what was measured, and the verdict",
           f"that follows from the two. Of {len(found)} lines, {len(shown(found))} are shown; the others, which pass, repeat one",
           "of these with another seed, number of threads or precision, and are in the file alone.", "",
           where_and_when[0].upper() + where_and_when[1:] + ".", ""]
    for sentence in (failures, bounded, ringing, drift, strain):
        out += [f"- {text}" for text in [sentence(found)] if text]
    for name, title in cases:
        of = [r for r in shown(found) if r["case"] == name]
        out += ["", f"## {title} (`{name}`)", "",
                *table(COLUMNS, [(cell(r["variant"]), r["setting"] or "", cell(r["quantity"] or ""), expected(r),
                                  cell(r["because"] or ""), minus(number(r["measured"])), r["verdict"]) for r in of])]
    return "\n".join(out) + "\n"
