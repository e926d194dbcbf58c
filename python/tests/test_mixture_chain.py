# SPDX-License-Identifier: GPL-3.0-or-later
"""Mixtures with runs: all scales of a small design, its files, and that no result is computed twice."""

from __future__ import annotations

import json
import re
import tomllib

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT
from macadam.mixture import MixtureError, binder, laws
from macadam.mixture.driver import compute_and_write
from macadam.study.program import version_of

EXAMPLE = ROOT / "examples" / "mixture" / "design.toml"


def small():
    """Returns the example with smaller boxes and fewer points: some 1,000 particles per specimen."""
    tables = tomllib.loads(EXAMPLE.read_text())
    for key in ("file", "bbr"):
        tables["binder"][key] = str(EXAMPLE.parent / tables["binder"][key])
    tables["test"] = {"temperatures": [5, 30], "frequencies": [0.1, 10]}
    tables["scale"][1] |= {"box": ["3.5 mm", "3.5 mm", "4 mm"], "points_per_decade": 2}
    tables["scale"][2] |= {"box": ["14 mm", "14 mm", "16 mm"], "seeds": [3, 4]}
    return tables


def nothing(_):
    pass


@pytest.fixture(scope="module", params=["centres", "series"])
def made(request, program, tmp_path_factory):
    """Returns the rule, the folder and the result. With rule "centres" the moduli mean little, but the chain of
    commands is the same."""
    folder, said = tmp_path_factory.mktemp("mixture"), []
    return request.param, folder, compute_and_write(small(), folder, 2, nothing, said.append, request.param), said


def test_the_table(made):
    rule, folder, found, _ = made
    table = pd.read_csv(folder / "mixture.csv")
    assert list(table.columns[:8]) == [
        "temperature_c",
        "frequency_hz",
        "e_star_pa",
        "e_star_std_pa",
        "phase_deg",
        "phase_std_deg",
        "e_star_hirsch_pa",
        "e_star_witczak_pa",
    ]
    assert [*zip(table.temperature_c, table.frequency_hz)] == [(5, 0.1), (5, 10), (30, 0.1), (30, 10)]
    assert np.isfinite(table.to_numpy()).all() and (table.e_star_std_pa > 0).all()
    # |E*| of a linear material rises with the reduced frequency
    assert table.sort_values("reduced_frequency_hz").e_star_pa.is_monotonic_increasing
    assert (table.e_star_pa < table.hashin_shtrikman_upper_pa).all()
    np.testing.assert_allclose(table.e_star_pa, found.table.e_star_pa, rtol=1e-8)  # nine digits are written


def test_curves_and_laws(made):
    _, folder, found, _ = made
    curves = pd.read_csv(folder / "master_curve.csv")
    assert list(dict.fromkeys(curves.scale)) == ["binder", "mastic", "mortar", "mixture"]
    summary = json.loads((folder / "summary.json").read_text())
    needed = summary["binder"]["needed_reduced_hz"]
    files = sorted(f.name for f in (folder / "laws").iterdir())
    assert files == ["binder.toml", "mastic.toml", "mortar_seed_1.toml", "mortar_seed_2.toml"]
    for entry in summary["laws"]:
        assert entry["valid_hz"][0] < needed[0] and entry["valid_hz"][1] > needed[1]
        assert entry["units"] <= 16  # a contact law has at most 16 units
        assert entry["misfit"] < 0.05  # the largest error that a chain is allowed
        text = (folder / entry["file"]).read_text()
        mastic = tomllib.loads(text)["materials"]["mastic"]
        assert "valid_frequencies" in text and mastic["shift"] == "wlf" and mastic["C1"] == summary["binder"]["C1"]
    # each scale is stiffer than the scale below
    at = {
        name: np.interp(0.0, np.log10(c.reduced_frequency_hz), np.log10(c.e_star_pa))
        for name, c in curves.groupby("scale")
    }
    assert at["binder"] < at["mastic"] < at["mortar"]


def test_decisions_are_printed_and_kept(made):
    _, folder, found, said = made
    assert sorted(said) == sorted([*found.decisions, *(f"warning: {w}" for w in found.warnings)])
    summary = json.loads((folder / "summary.json").read_text())
    assert (summary["decisions"], summary["warnings"]) == (found.decisions, found.warnings)
    words = " ".join(said)
    assert "merged with the class 5.6-8 mm" in words and "are voids with radii" in words and "rule nielsen" in words
    assert "the shortest edge of the box is 1.75 times the largest grain" in words


def test_the_report(made):
    text = (made[1] / "report.html").read_text()
    assert (
        "Witczak 1-37A are predictions" in text
        and "they are not measurements" in text
        and "Constants of the binder" in text
    )
    assert not re.search(r'(src|href)="http', text)


def test_results_are_not_computed_again(made):
    rule, folder, found, _ = made
    assert found.summary["runs"] == {"computed": 4, "reused": 0}
    again = compute_and_write(small(), folder, 1, nothing, nothing, rule)
    assert again.summary["runs"] == {"computed": 0, "reused": 4}
    pd.testing.assert_frame_equal(again.table, found.table)
    changed = small()
    changed["scale"][2]["seeds"] = [3, 5]
    more = compute_and_write(changed, folder, 2, nothing, nothing, rule)
    assert more.summary["runs"] == {"computed": 1, "reused": 3}  # the new seed alone


def test_the_scatter_has_that_of_the_scale_below(made):
    """Each seed of the mixture has the law of another seed of the mortar."""
    _, folder, found, _ = made
    scales = {s["name"]: s for s in found.summary["scales"]}
    moduli = []
    for run in scales["mixture"]["folders"]:
        moduli.append(tomllib.loads((folder / run / "scene.toml").read_text()))
    mastics = [s.get("materials", {}).get("mastic") or s["contacts"][0] for s in moduli]
    expected = [
        tomllib.loads((folder / "laws" / f"mortar_seed_{k}.toml").read_text())["materials"]["mastic"]["E_m"]
        for k in (1, 2)
    ]
    assert [m["E_m"] for m in mastics] == expected and expected[0] != expected[1]


def test_a_failed_run_names_scale_and_seed(program, tmp_path):
    wrong = small()
    wrong["scale"][2]["void_radius"] = ["7 mm", "8 mm"]  # one void is larger than all air
    with pytest.raises(MixtureError, match="^scale mixture, seed [34]: macadam: ") as error:
        compute_and_write(wrong, tmp_path, 2, nothing, nothing, "centres")
    assert error.value.code in (1, 2)


def test_fits_are_kept(program, tmp_path):
    model = binder.Model(0.95e9, 0.23, 0.58, 3.4, 2.2e-5, 180.0, 19.0, 165.0, 20.0)
    frequency = np.geomspace(1e-2, 1e2, 17)
    curve = laws.Curve.of(frequency, 5 * 2.9 * model.shear(frequency))
    version = version_of(program)
    law = laws.Fitter(program, version, tmp_path / "fits").fit("mastic", curve, laws.shift_keys(model))
    # the curve is a 2S2P1D model, so only the allowed error of its chain is left
    assert law.misfit < 0.012 and law.valid_hz == (1e-2, 1e2)
    again = laws.Fitter("/no/program", version, tmp_path / "fits").fit("mastic", curve, laws.shift_keys(model))
    assert again == law
    with pytest.raises(OSError):
        laws.Fitter("/no/program", "another version", tmp_path / "fits").fit("mastic", curve, laws.shift_keys(model))
