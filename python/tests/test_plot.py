# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results and specimens, their numbers in repr and HTML, and snapshots."""
from __future__ import annotations

import pickle
import sys

import numpy as np
import pytest

import macadam as mc
from macadam._plot import OF_FREQUENCY

PNG = b"\x89PNG"


@pytest.fixture(scope="module")
def result(specimen: mc.Specimen) -> mc.Result:
    return mc.harmonic(specimen, frequencies=[1, 10])


@pytest.mark.parametrize("what", [None, *OF_FREQUENCY[:3]])
def test_a_result_is_drawn_with_its_numbers(result: mc.Result, what: str | None) -> None:
    figure = result.plot(what)
    assert figure._repr_png_().startswith(PNG)
    if what in (None, "modulus"):
        drawn = figure.axes[0].lines[0]
        assert np.array_equal(drawn.get_xdata(), result.table.frequency_hz)
        assert np.allclose(drawn.get_ydata(), 1e-9 * result.table.e_star_pa, rtol=1e-12)  # GPa


def test_a_master_curve_has_its_reference_temperature(scene: mc.Scene, result: mc.Result) -> None:
    shift = {"shift": "wlf", "C1": 15, "C2": 122, "reference_temperature": 20}
    laws = [c | (shift if c["law"] == "generalised_kelvin" else {}) for c in scene.as_dict()["contacts"]]
    swept = mc.sweep(mc.Scene(scene, contacts=laws), frequencies=[1, 10], temperatures=[10, 20, 30])
    assert swept.plot("master_curve").axes[0].get_xlabel() == "reduced frequency (Hz) at 20 °C"
    with pytest.raises(mc.InputError, match="what: found 'master_curve' for results without a reduced frequency"):
        result.plot("master_curve")


def test_a_test_in_time_is_drawn(specimen: mc.Specimen) -> None:
    relaxed = mc.relaxation(specimen, times=[0.01, 1], points_per_decade=2)
    assert relaxed.plot()._repr_png_().startswith(PNG)
    assert repr(relaxed).startswith(f"<macadam.Result relaxation: modulus_pa {relaxed.table.modulus_pa[0]:.4g} at 0.01 s to ")
    with pytest.raises(mc.InputError, match="what: found 'modulus', expected one of history"):
        relaxed.plot("modulus")


@pytest.mark.parametrize("what", [None, "block", "section", "aggregates"])
def test_a_specimen_is_drawn(specimen: mc.Specimen, what: str | None) -> None:
    assert specimen.plot(what)._repr_png_().startswith(PNG)


def test_wrong_pictures_are_refused(result: mc.Result, specimen: mc.Specimen) -> None:
    with pytest.raises(mc.InputError, match="what: found 'x', expected one of modulus, cole_cole, black, master_curve"):
        result.plot("x")
    with pytest.raises(mc.InputError, match="what: found 'x', expected one of block, section, aggregates, 3d"):
        specimen.plot("x")


def test_the_view_in_space_names_the_package_that_it_needs(specimen: mc.Specimen, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyvista", None)  # importing it raises ImportError
    with pytest.raises(mc.InputError, match="found '3d' without the Python package PyVista"):
        specimen.plot("3d")


def test_texts_of_objects_have_numbers(result: mc.Result, specimen: mc.Specimen) -> None:
    first = result.table.iloc[0]
    assert repr(result).startswith(f"<macadam.Result cyclic: |E*| {first.e_star_pa:.4g} Pa, phase {first.phase_deg:.3g} degrees at 1 Hz to ")
    assert "<table" in result._repr_html_() and f"{first.e_star_pa:.5g}" in result._repr_html_()
    fit = mc.fit({"frequency_hz": [0.1, 1, 10, 100], "e_star_pa": [1e9, 2e9, 4e9, 7e9], "phase_deg": [40, 35, 30, 20]}, units=1)
    assert repr(fit).startswith("<macadam.Fit kelvin: ")
    dt = mc.critical_step(specimen, density_scaling=1e6) / 2
    boundary = mc.Boundary().move("+z", "z", mc.drives.Ramp(1e-6, 50, dt=dt))
    assert repr(boundary) == "<macadam.Boundary: wall +z moved along z>" and "at rest" in repr(mc.Boundary())
    stepper = mc.Stepper(specimen, boundary, backend="cpu", density_scaling=1e6)
    stepper.advance(10)
    n, contacts = len(specimen), len(specimen.contacts)
    assert repr(stepper.particles()).startswith(f"<macadam.ParticleState: {n} particles, displacement up to ")
    assert repr(stepper.contacts()).startswith(f"<macadam.ContactState: {contacts} contacts, force up to ")
    spectrum = mc.spectrum(specimen, shortest=0.01, longest=1)
    assert all(" object at " not in repr(one) for one in (spectrum, spectrum.relaxation, spectrum.creep))


def test_a_snapshot_restores_the_state(specimen: mc.Specimen, tmp_path) -> None:
    dt = mc.critical_step(specimen, density_scaling=1e6) / 2

    def stepper() -> mc.Stepper:
        boundary = mc.Boundary().move("+z", "z", mc.drives.Ramp(1e-6, 50, dt=dt))
        return mc.Stepper(specimen, boundary, backend="cpu", density_scaling=1e6)

    first = stepper()
    first.advance(20)
    kept = first.snapshot()
    assert (kept.step, kept.time, len(kept)) == (20, pytest.approx(20 * dt), len(specimen))
    assert f"step 20, {kept.time:.6g} s, {len(specimen)} particles" in repr(kept)
    first.advance(30)
    kept.save(tmp_path / "kept.npz")
    for copy in (kept, mc.Snapshot.load(tmp_path / "kept.npz"), pickle.loads(pickle.dumps(kept))):
        again = stepper()
        again.restore(copy)
        again.advance(30)
        assert np.array_equal(again.particles().displacement, first.particles().displacement)
    other = mc.Stepper(specimen, mc.Boundary(), backend="cpu", dt=dt / 2, density_scaling=1e6)
    with pytest.raises(mc.InputError, match="snapshot: found a time step of"):
        other.restore(kept)
    (tmp_path / "wrong.npz").write_bytes(b"text")
    with pytest.raises(mc.InputError, match="wrong.npz: found .*expected a snapshot"):
        mc.Snapshot.load(tmp_path / "wrong.npz")
