# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/frequency-solver.md on the frequency domain with the iterative and the direct solver, from
bench/linear_solvers."""
from pages.data import downto, head, listed, memory, minus, plain, power, rows, table, thousands, upto
from pages.marks import mark

HZ = (2, 5, 10, 20)


def runs():
    return rows("linear-solvers.csv")


def pairs():
    """Returns (iterative, direct) of all scenes that ran with both solvers."""
    by = {(r["scene"], r["linear"]): r for r in runs()}
    return [(r, by[r["scene"], "direct"]) for r in runs()
            if r["linear"] == "iterative" and (r["scene"], "direct") in by]


@mark
def linear_machine():
    return head("linear-solvers.csv")[0].split("; solve_s")[0].split("…, ")[1]


@mark
def linear_solvers():
    names = {"iterative": "iteration", "direct": "factors"}
    return table(["scene", "particles", "contacts", "by", "solution (s)", "memory (GB)", "iterations", "residual"],
                 [(r["scene"], thousands(r["particles"]), thousands(r["contacts"]), names[r["linear"]],
                   plain(r["solve_s"], 3), f"{r['memory_gb']:g}", f"{r['iterations']:.0f}",
                   minus(power(r["residual"]))) for r in runs()])


@mark
def linear_faster():
    """Returns the range of the direct solver's time over the iterative solver's, for scenes of more than 30,000
    particles."""
    of = [d["solve_s"] / i["solve_s"] for i, d in pairs() if i["particles"] > 30000]
    return f"{downto(min(of)):.1f} to {upto(max(of)):.1f}"


@mark
def linear_difference():
    """Returns the largest differences of |E*| and of the phase angle, but at least what the digits of the file can
    show."""
    e = max(abs(i[f"e_star_pa_{hz}"] / d[f"e_star_pa_{hz}"] - 1) for i, d in pairs() for hz in HZ)
    phi = max(abs(i[f"phase_deg_{hz}"] - d[f"phase_deg_{hz}"]) for i, d in pairs() for hz in HZ)
    return f"{power(upto(max(e, 1e-12)))} of \\|E\\*\\| and {power(upto(max(phi, 1e-8)))}°"


@mark
def linear_largest():
    """Returns time and memory of the largest scene, which ran with the iterative solver only."""
    r = max(runs(), key=lambda r: r["particles"])
    return (f"{r['scene']}, {thousands(r['particles'])} particles: {plain(r['solve_s'], 2)} s and "
            f"{memory([r['memory_gb']])}")


@mark
def linear_scenes():
    return listed([i["scene"] for i, _ in pairs()])
