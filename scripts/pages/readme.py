# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of README.md."""
import re

from pages import accuracy_asked, accuracy_elsewhere, common, data, paper_met
from pages.data import between, plain, rows, text, upto, where
from pages.marks import mark

DOCUMENT = "README.md"
PARTS = (paper_met,)


def without_times(lines):
    """Returns the table of a run without its last column, the times, which depend on the load of the machine."""
    out, cut = [], None
    for line in lines:
        if line.rstrip().endswith("time (s)"):
            cut = len(line.rstrip()) - len("time (s)")
            line = line[:cut]
        elif cut is not None and re.match(r" +\d", line):
            line = line[:cut]
        else:
            cut = None if line and not re.match(r" +\d", line) else cut
        out.append(line.rstrip())
    return out


def shown(name, patterns):
    """Returns the lines of a committed output that match each pattern in turn; the pattern `…` gives a line `…`."""
    lines, out = without_times(text(name)), []
    for pattern in patterns:
        found = [pattern] if pattern in ("…", "") else [line for line in lines if re.match(pattern, line)]
        if not found:
            raise LookupError(f"bench/results/{name} has no line '{pattern}'")
        out += [f"    {line}".rstrip() for line in found]
    return out


@mark
def demo():
    return shown("demo-output.txt", [r"\d+ particles", "geometry", "steady start", "2 Hz", "…", "precision", "",
                                     r" +f \(Hz\)", r" +\d", "err:"])


@mark
def full():
    return shown("paper-output.txt", [r" +f \(Hz\)", r" +\d"])


@mark
def particles(name):
    line = next(line for line in text(f"{name}-output.txt") if "particles" in line)
    return f"{int(line.split()[0]):,}"


def specimens(clusters):
    return [r for r in rows("paper-specimens-time.csv") if ("_ms_" in r["scene"]) == clusters]


def runs(*scenes):
    return where(rows("paper-specimens.csv"), scene=scenes)


MULTI = ("ac14_ms_poly_coarse", "ac14_ms_poly_fine", "ac14_ms_ico_coarse", "ac14_ms_ico_fine")


def spheres(r):
    return sum(r[f"spheres_{k}"] for k in range(4)) + r["particles_4"]


@mark
def multi_particles():
    of = [spheres(r) for r in runs(*MULTI)]
    return f"{round(min(of), -2):,.0f}–{round(max(of), -2):,.0f}"


@mark
def multi_specimen():
    of = [r["seconds"] for r in specimens(True)]
    return f"{plain(min(of), 2)} to {plain(max(of), 3)} s"


@mark
def solved(*scenes):
    of = [r["wall_s"] for r in runs(*(f"ac14_{s}" for s in scenes)) if r["wall_s"]]
    return between([t / 60 for t in of], "{:.1f}") + " minutes"


@mark
def memory(*scenes):
    return data.memory(r["memory_gb"] for r in runs(*(f"ac14_{s}" for s in scenes)) if r["memory_gb"])


@mark
def threads():
    return f"{runs(*MULTI)[0]['threads']:.0f}"


@mark
def design_specimen():
    of = [r["specimen_s"] for r in runs("ac14_ms_design")]
    return f"{plain(min(of), 2)} to {plain(max(of), 2)} s"


@mark
def design_particles():
    return f"{round(sum(spheres(r) for r in runs('ac14_ms_design')) / len(runs('ac14_ms_design')), -3):,.0f}"


@mark
def paper_minutes():
    """Returns the total time of the runs of bench/paper/paper-specimens."""
    every = rows("paper-specimens.csv")
    return f"{plain(upto(sum(r['wall_s'] or 0 for r in every) / 60))} minutes"


@mark
def prediction():
    """Returns the largest difference between a run with `tolerance` and its prediction, in % of the tolerance."""
    return accuracy_asked.prediction_off(accuracy_asked.asked())


@mark
def tolerance_runs():
    return f"{len(accuracy_asked.asked())}"


@mark
def facet():
    return common.asserted("tessellation_voro_test", "SameNeighboursAndAreasAsVoro", "largest", "1e-9")


@mark
def facet_measured():
    return accuracy_elsewhere.voro_difference()


@mark
def faster():
    return accuracy_elsewhere.voro_times()
