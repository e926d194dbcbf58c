# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/paper-specimens.md, the whole page: of the runs that scripts/paper-specimens left in bench/results/."""
from paper_document import document
from paper_fillings import prose
from paper_reasons import REASONS
from paper_runs import RESULTS, committed, rows
from paper_tables import DESIGN, PAPER

DOCUMENT = "docs/paper-specimens.md"


def page():
    runs = {name: committed(p.scene) for name, p in PAPER.items()}
    return document(runs, committed(DESIGN[0]), REASONS, prose(runs, rows(RESULTS / "paper-variants.csv"),
                                                              rows(RESULTS / "paper-specimens-time.csv")))
