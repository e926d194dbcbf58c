# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks for the sentence in the README, the index and the tutorial on how well the paper's figures are reproduced."""
from pages.data import between, mean, minus, rows
from pages.marks import mark
from paper_document import deviations
from paper_runs import committed
from paper_tables import CLUSTERS, DELTA_MA, DEVIATION, PAPER

FINE = [name for name in CLUSTERS if name.endswith("fine")]
COARSE = [name for name in CLUSTERS if name.endswith("coarse")]


def beside(names, index, key):
    """Returns mean deviations from the single spheres in %, ours and the paper's."""
    runs = {name: committed(p.scene) for name, p in PAPER.items()}
    ours = [mean(d[-1] for d in deviations(runs, name, "SS", key)) for name in names]
    return minus(f"{between(ours, '{:+.0f}')} % (paper {between([DEVIATION[name][index] for name in names], '{:+.0f}')} %)")


def fewer_contacts():
    """Returns by how much our numbers of A-A contacts are below the paper's, %."""
    runs = {name: committed(p.scene) for name, p in PAPER.items()}
    return between([100 * (1 - mean(run.contacts[0] for run in runs[name]) / PAPER[name].contacts[0]) for name in CLUSTERS],
                   "{:.0f}")


def calibrated():
    name = "MS-Poly-coarse"
    ours = mean(r["delta_ma"] for r in rows("paper-deltas.csv") if r["mix"] == "AM1" and r["specimen"] == name)
    return f"{ours:.2f} ({DELTA_MA['AM1'][name]:.2f})"


@mark
def paper_met():
    return ("The paper's tables of shapes and compositions are met; its stiffness figures are met in sign and order, not in size: "
            f"coarse clusters change \\|E\\*\\| of single spheres by {beside(COARSE, 0, 'e_star')} and fine ones by "
            f"{beside(FINE, 0, 'e_star')}, φ of fine ones by {beside(FINE, 1, 'phase')}; clusters have {fewer_contacts()} % fewer "
            f"contacts between aggregates, and the calibrated factor δ_MA of the coarse real shapes is {calibrated()}.")
