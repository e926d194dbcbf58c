# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes docs/paper-specimens.md, docs/paper-details.md, and bench/results/paper-summary.csv with the numbers that other
pages name, from the files that bench/paper/paper writes into bench/results/. scripts/documents writes and checks them."""
import csv
import io

import paper_figures
import paper_laws
import paper_open
from paper_data import mean
from paper_document import (Cells, composition, contacts, design, details_head, deviations, orientation, pictures,
                            stiffness, verdict)
from paper_fillings import prose
from paper_reasons import REASONS
from paper_runs import RESULTS, committed, rows
from paper_tables import CLUSTERS, DELTA_MA, DESIGN, DEVIATION, PAPER


def pages(runs):
    """Returns the texts of both pages. Both need the reasons of all bold cells."""
    cells = Cells(REASONS)
    main = [*verdict(runs), *stiffness(runs, cells), *contacts(runs, cells), *paper_figures.calibrated(), *pictures()]
    details = [*details_head(), *composition(runs, cells), *design(committed(DESIGN[0])), *paper_figures.gradation(),
               *paper_figures.numbers_of_spheres(), *orientation(runs),
               *paper_laws.section(), *paper_figures.stepped()]
    cells.check()
    after = prose(runs, rows(RESULTS / "paper-study.csv"))
    details += [*after(cells.used), *paper_open.section()]
    return ("\n".join(lines).rstrip() + "\n" for lines in (main, details))


def quantities(runs, name):
    """Yields quantity, our value and the paper's value of a specimen of clusters."""
    paper = PAPER[name]
    for index, key in enumerate(("e_star", "phase")):  # mean deviation from the single spheres, %
        yield key, mean(d[-1] for d in deviations(runs, name, "SS", key)), DEVIATION[name][index]
    yield "fewer contacts", 100 * (1 - mean(run.contacts[0] for run in runs[name]) / paper.contacts[0]), None  # A-A, %
    for run in runs[name]:
        yield "uncovered volume (%)", 100 * (1 - run.to_box), None
    yield "size of a largest aggregate (mm)", None, paper.size[0]
    yield "spheres of a largest aggregate", None, paper.spheres[0] / paper.particles[0]


def summary(runs):
    out = io.StringIO()
    write = csv.writer(out, lineterminator="\n").writerow
    out.write("# Written by scripts/documents from paper-specimens.csv, paper-deltas.csv and the publication's tables\n")
    write(("specimen", "quantity", "ours", "paper"))
    for name in CLUSTERS:
        for quantity, *values in quantities(runs, name):
            write((name, quantity, *("" if x is None else f"{x:.6g}" for x in values)))
    name = "MS-Poly-coarse"
    ours = mean(float(r["delta_ma"]) for r in rows(RESULTS / "paper-deltas.csv") if r["mix"] == "AM1" and r["specimen"] == name)
    write((name, "delta_ma", f"{ours:.6g}", DELTA_MA["AM1"][name]))
    return out.getvalue()


def made():
    """Returns the text of each file."""
    runs = {name: committed(p.scene) for name, p in PAPER.items()}
    main, details = pages(runs)
    return {"docs/paper-specimens.md": main, "docs/paper-details.md": details,
            "bench/results/paper-summary.csv": summary(runs)}
