# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the page docs/paper-specimens.md from the files that bench/paper/paper writes into bench/results/."""
import paper_figures
import paper_laws
import paper_open
from paper_document import (Cells, composition, contacts, design, head, orientation, pictures, stiffness)
from paper_fillings import prose
from paper_reasons import REASONS
from paper_runs import RESULTS, committed, rows
from paper_tables import DESIGN, PAPER

DOCUMENT = "docs/paper-specimens.md"


def page():
    runs = {name: committed(p.scene) for name, p in PAPER.items()}
    cells = Cells(REASONS)
    body = [*paper_figures.gradation(), *paper_figures.numbers_of_spheres(), *composition(runs, cells),
            *design(committed(DESIGN[0])), *contacts(runs, cells), *orientation(runs), *paper_figures.directions(runs),
            *stiffness(runs, cells), *paper_figures.calibrated(), *paper_laws.section(), *paper_figures.stepped()]
    cells.check()
    after = prose(runs, rows(RESULTS / "paper-study.csv"), rows(RESULTS / "paper-specimens-time.csv"))
    return "\n".join([*head(runs), *body, *after(cells.used), *paper_open.section(), *pictures()]).rstrip() + "\n"
