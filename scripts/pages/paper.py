# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the pages docs/paper-specimens.md and docs/paper-details.md from the files that bench/paper/paper writes into
bench/results/."""
import paper_figures
import paper_laws
import paper_open
from paper_document import (Cells, composition, contacts, design, details_head, orientation, pictures, stiffness, verdict)
from paper_fillings import prose
from paper_reasons import REASONS
from paper_runs import RESULTS, committed, rows
from paper_tables import DESIGN, PAPER

DOCUMENT = "docs/paper-specimens.md"
DETAILS = "docs/paper-details.md"


def text(lines):
    return "\n".join(lines).rstrip() + "\n"


def pages():
    """Returns the texts of both pages, by name. Both need the reasons of all bold cells."""
    runs = {name: committed(p.scene) for name, p in PAPER.items()}
    cells = Cells(REASONS)
    main = [*verdict(runs), *stiffness(runs, cells), *contacts(runs, cells), *paper_figures.calibrated(), *pictures()]
    details = [*details_head(), *composition(runs, cells), *design(committed(DESIGN[0])), *paper_figures.gradation(),
               *paper_figures.numbers_of_spheres(), *orientation(runs), *paper_figures.directions(runs),
               *paper_laws.section(), *paper_figures.stepped()]
    cells.check()
    after = prose(runs, rows(RESULTS / "paper-study.csv"), rows(RESULTS / "paper-specimens-time.csv"))
    return {DOCUMENT: text(main), DETAILS: text([*details, *after(cells.used), *paper_open.section()])}


def page():
    return pages()[DOCUMENT]


class Details:
    """Stands for the second page in the list of complete pages of scripts/documents."""
    DOCUMENT = DETAILS

    @staticmethod
    def page():
        return pages()[DETAILS]
