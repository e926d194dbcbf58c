# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of bench/README.md on the phases of the whole command, from bench/command/run."""
from pages.data import RESULTS, Missing, head, listed, rows, table, thousands
from pages.marks import mark

KEYS = ("scene", "method", "specimen", "particles", "backend", "threads", "device", "machine", "date", "commit", "runs")


def files():
    found = sorted(file.name for file in RESULTS.glob("command-*.csv"))
    if not found:
        raise Missing("bench/results/command-*.csv are not there: bench/README.md says which command makes them")
    return found


def cases():
    """Returns each case of each machine, with the seconds of its phases in the order of a run."""
    out = {}
    for name in files():
        for r in rows(name):
            out.setdefault((name, *(r[key] for key in KEYS)), {})[r["phase"]] = r["seconds"]
    return [dict(zip(KEYS, where[1:]), phases=phases) for where, phases in out.items()]


def seconds(x):
    return "" if x == 0 else f"{x:.2f}" if x < 100 else f"{x:,.0f}"


@mark
def command_phases():
    phases = [phase for phase in cases()[0]["phases"] if phase != "wall"]
    lines = [(c["scene"], f"{c['method']}{', read' if c['specimen'] == 'read' else ''}", thousands(c["particles"]),
              f"{c['device'] or c['machine']}, {c['threads']:.0f} threads", seconds(c["phases"]["wall"]),
              *(seconds(c["phases"][phase]) for phase in phases)) for c in cases()]
    return table(["scene", "method", "particles", "on", "wall", *phases], lines)


@mark
def command_phases_machines():
    """Returns, for each file, what was measured, where and when, and the text of the file's first line."""
    said = []
    for name in files():
        r = rows(name)[0]
        at = f"{r['device']} and {r['machine']}" if r["device"] else r["machine"]
        runs = sorted({int(c["runs"]) for c in rows(name)})
        said.append(f"{at}, {r['threads']:.0f} threads, {r['date']}, commit {r['commit']}, "
                    f"{listed([str(n) for n in runs])} run{'' if runs == [1] else 's'} of each, "
                    f"{head(name)[0].split('; ')[-1]}")
    return "; ".join(said)
