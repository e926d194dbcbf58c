# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits of laws and calibration: from files and from columns they write the same files as the commands."""
import subprocess

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT

import macadam as mc

MASTIC = ROOT / "examples" / "laws" / "mastic.csv"


def test_a_fit_is_that_of_the_command(tmp_path, program):
    subprocess.run([program, "fit", MASTIC, "--shift", "wlf", "--units", "6", "--out", tmp_path, "--no-pictures"], check=True,
                   capture_output=True)
    found = mc.fit(MASTIC, shift="wlf", units=6, out=tmp_path / "own")
    assert found.files.keys() == {"law.toml", "fit.json", "fit.csv", "curve.csv"}
    for name, text in found.files.items():
        if name != "fit.json":  # fit.json names the source of the data, which is different here
            assert text == (tmp_path / name).read_text() == (tmp_path / "own" / name).read_text()
    assert found.law["law"] == "generalised_kelvin" and len(found.law["E"]) == 6
    assert len(found.table) == len(pd.read_csv(MASTIC, comment="#")) and "e_star_pa" in found.curve.columns


def test_columns_are_a_file(tmp_path):
    table = pd.read_csv(MASTIC, comment="#")
    expected = mc.fit(MASTIC, shift="wlf", units=4).law
    assert mc.fit(table, shift="wlf", units=4).law == expected
    assert mc.fit({k: list(v) for k, v in table.items()}, shift="wlf", units=4).law == expected
    with pytest.raises(mc.InputError, match=r"^data:1: .*phase_dg"):
        mc.fit(table.rename(columns={"phase_deg": "phase_dg"}))


def test_a_model_of_somebody_else(tmp_path):
    file = tmp_path / "model.toml"
    file.write_text('model = "2s2p1d"\nE_00 = 5e6\nE_0 = 2.4e10\nk = 0.2\nh = 0.58\ndelta = 2.6\ntau = 0.012\nbeta = 4000\n')
    found = mc.fit(parameters=file, from_hz=0.01, to_hz=100)
    assert "largest error" in str(found) and found.files.keys() == {"law.toml"}
    for call, message in ((lambda: mc.fit(parameters=file), "range"), (lambda: mc.fit(), "found nothing"),
                          (lambda: mc.fit(MASTIC, parameters=file), "both"),
                          (lambda: mc.fit(MASTIC, model="maxwell"), r'model: found "maxwell", expected one of kelvin\|2s2p1d'),
                          (lambda: mc.fit(MASTIC, units=99), "units: found 99")):
        with pytest.raises(mc.InputError, match=message):
            call()


@pytest.fixture(scope="module")
def lab(specimen):
    """Returns the moduli that the scene has with another delta; the tests use them as measurements."""
    stiff = mc.harmonic(specimen, frequencies=[5, 20], **{"contacts.M-A.delta": 1.3})
    return stiff.table[["frequency_hz", "e_star_pa", "phase_deg"]]


def test_a_calibration_finds_what_was_there(scene, small_file, lab, tmp_path, program):
    found = mc.calibrate(scene, lab, free=["M-A.delta"])
    # The error of delta is the tolerance of the solver divided by the sensitivity of |E*| to delta.
    assert found.parameters.value[0] == pytest.approx(1.3, rel=1e-6)
    assert found.scene.as_dict()["contacts"][1]["delta"] == found.parameters.value[0]
    assert list(found.table.columns)[0] == "frequency_hz" and "M-A.delta" in str(found)
    lab.to_csv(tmp_path / "lab.csv", index=False)
    subprocess.run([program, "calibrate", small_file, "--target", tmp_path / "lab.csv", "--free", "M-A.delta", "--out",
                    tmp_path / "command", "--no-pictures"], check=True, capture_output=True)
    own = mc.calibrate(small_file, tmp_path / "lab.csv", free="M-A.delta", out=tmp_path / "own")
    for name in ("predicted.csv", "scene.toml"):
        assert (tmp_path / "own" / name).read_bytes() == (tmp_path / "command" / name).read_bytes()
    assert own.warnings == []
    bounded = mc.calibrate(scene, lab, free=["M-A.delta"], bounds={"M-A.delta": (0.5, 1.1)}).parameters
    assert bounded.value[0] == 1.1 and bounded.at_bound[0]


def test_results_are_targets_and_data(specimen, scene, tmp_path):
    """result.table can be used unchanged as measurements, although it has columns that laboratory tables lack."""
    found = mc.harmonic(specimen, frequencies=[2, 5, 20, 50], **{"contacts.M-A.delta": 1.3})
    assert not {"frequency_hz", "e_star_pa", "phase_deg"} >= set(found.table.columns)
    law = mc.fit(found.table, units=1)
    few = mc.fit(found.table[["frequency_hz", "e_star_pa", "phase_deg"]], units=1)
    assert law.files["law.toml"] == few.files["law.toml"]
    again = mc.calibrate(scene, found.table, free=["M-A.delta"])
    # The error of delta is the tolerance of the solver divided by the sensitivity of |E*| to delta.
    assert again.parameters.value[0] == pytest.approx(1.3, rel=1e-6)


def test_other_units_and_columns(scene, lab):
    table = pd.DataFrame({"frequency_hz": lab.frequency_hz, "e_star_mpa": lab.e_star_pa / 1e6, "sample": "A, first"})
    with pytest.raises(mc.InputError, match="with phase_deg"):
        mc.fit(table)
    found = mc.calibrate(scene, table, free=["M-A.delta"], misfit="modulus")
    assert found.parameters.value[0] == pytest.approx(1.3, rel=1e-6)
    assert found.table.phase_deg.isna().all() and found.json["errors"]["phase_rms_deg"] is None


def test_a_model_that_no_chain_reaches_is_there_all_the_same(tmp_path):
    found = mc.fit(MASTIC, shift="wlf", model="2s2p1d", error=1e-6, out=tmp_path / "law")
    assert found.json["analogue"]["k"] > 0 and "units reach" in found.warnings[-1]
    assert sorted(f.name for f in (tmp_path / "law").iterdir()) == ["curve.csv", "fit.csv", "fit.json"]
    with pytest.raises(mc.InputError, match="units reach"):
        found.law


@pytest.mark.parametrize(("change", "message"), [
    ({"free": ["M-X.delta"]}, "M-X.delta"), ({"bounds": {"x": (1, 2)}}, 'bounds: found "x"'),
    ({"misfit": "x"}, r"misfit: .*modulus-and-phase\|modulus"), ({"seeds": 0}, "seeds: found 0"),
])
def test_calibrations_that_cannot_be(change, message, scene, lab):
    with pytest.raises(mc.Error, match=message):
        mc.calibrate(scene, lab, **{"free": ["M-A.delta"], **change})


def test_an_interrupted_calibration_leaves_nothing(scene, lab, tmp_path):
    with pytest.raises(ZeroDivisionError):
        mc.calibrate(scene, lab, free=["M-A.delta"], out=tmp_path / "out", progress=lambda *_: 1 / 0)
    assert not (tmp_path / "out").exists()
    assert np.isfinite(mc.calibrate(scene, lab, free=["M-A.delta"], priors={"M-A.delta": (1.0, 0.1)}).parameters.value[0])
