# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws bench/results/study-map.png, the map of the study's report, from bench/results/study.csv."""
from pathlib import Path

import pandas as pd

from macadam.report import look
from macadam.study.effects import Quantity
from macadam.study.summary import design_map

RESULTS = Path(__file__).resolve().parents[1] / "results"
FACTORS = {"air_voids_percent": "air_voids (%)", "binder_percent": "binder (%)"}

jobs = pd.read_csv(RESULTS / "study.csv").rename(columns=FACTORS | {"e_star_mpa": "value"})
with look.style():
    figure, _ = design_map(Quantity("|E*|", "MPa", "10 Hz", "", jobs, list(FACTORS.values()), ["seed"]))
    figure.savefig(RESULTS / "study-map.png", dpi=130, metadata={"Software": None})
