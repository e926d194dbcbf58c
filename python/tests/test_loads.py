# SPDX-License-Identifier: GPL-3.0-or-later
"""Stepped tests of relaxation, creep and constant strain rate, and bonds that break in them."""
import subprocess

import numpy as np
import pytest

import macadam as mc

TIMES = [1e-3, 2e-3, 4e-3]
FAST = {"solver.density_scaling": 100}  # waves are damped within some tenths of a millisecond
CALLS = {
    "relaxation": lambda s, **more: mc.relaxation(s, times=TIMES, strain=1e-4, **more),
    "creep": lambda s, **more: mc.creep(s, times=TIMES, stress="0.1 MPa", **more),
    "monotonic": lambda s, **more: mc.monotonic(s, times=TIMES, rate=0.01, **more),
}


@pytest.mark.parametrize("kind", CALLS)
def test_stepped_tests_have_the_numbers_of_the_command(kind, specimen, tmp_path, program):
    seen = []
    found = CALLS[kind](specimen, method="explicit", on_step=lambda s: seen.append((s.step, s.frequency_hz, s.stress().shape)),
                        every=200, **FAST)
    (tmp_path / "scene.toml").write_text(found.scene.text)
    subprocess.run([program, "run", tmp_path / "scene.toml", "--out", tmp_path / "command"], check=True, capture_output=True)
    assert (found.folder / f"{kind}.csv").read_bytes() == (tmp_path / "command" / f"{kind}.csv").read_bytes()
    assert [step for step, _, _ in seen] == list(range(200, found.summary["results"][0]["steps"] + 1, 200))
    assert {(f, shape) for _, f, shape in seen} == {(0.0, (len(specimen), 6))}
    assert found.scene.method == "explicit" and found.scene.kind == kind
    assert np.allclose(found.table.time_s, TIMES, atol=1e-6)  # times are rounded to whole steps of about 4e-7 s


def test_a_stepped_creep_nears_the_spectrum(specimen):
    stepped = CALLS["creep"](specimen, method="explicit", platen_mass=1e-4, **FAST).table
    spectrum = mc.spectrum(specimen, shortest=1e-4, longest=1e-2)
    expected = 1e5 * spectrum.creep.compliance(stepped.time_s.to_numpy())
    # The tolerance of 5 % covers the difference between the stepped test and the spectrum at 4 ms. The difference comes
    # from damping and from the ramp of some tenths of a millisecond. The spectrum contains neither damping nor a ramp.
    assert stepped.strain.iloc[-1] == pytest.approx(expected[-1], rel=0.05)


def test_an_interrupted_relaxation_goes_on_to_the_same_bits(specimen, tmp_path):
    scene = CALLS["relaxation"](specimen, method="explicit", **FAST)
    file = tmp_path / "scene.toml"
    file.write_text(scene.scene.text)

    def stop(step):
        raise LookupError("enough")
    with pytest.raises(LookupError):
        mc.run(file, out=tmp_path / "out", on_step=stop, every=300)
    mc.run(file, out=tmp_path / "out", resume=True)
    assert (tmp_path / "out" / "relaxation.csv").read_bytes() == (scene.folder / "relaxation.csv").read_bytes()
    with pytest.raises(mc.InputError, match="resume: found no value of out"):
        CALLS["relaxation"](specimen, method="explicit", resume=True)


def test_wrong_keys_of_stepped_tests_are_named(specimen):
    with pytest.raises(mc.InputError, match="platen_mass"):
        mc.creep(specimen, times=TIMES, stress=1e5, platen_mass=-1, method="explicit")
    with pytest.raises(mc.InputError, match="method"):
        mc.creep(specimen, times=TIMES, stress=1e5, method="by hand")


def test_brittle_bonds_break_for_good(scene):
    def pulled(strength):
        brittle = [dict(pair=c["pair"], law="brittle_bond", E=1e10, tensile_strength=strength) if c["pair"] == "M-M" else c
                   for c in scene.as_dict()["contacts"]]
        return mc.monotonic(mc.Scene(scene, contacts=brittle), rate=0.5, strain=5e-4, points=5, method="explicit", **FAST)
    weak, strong = pulled("1 kPa"), pulled(1e12)
    assert weak.table.strain.iloc[-1] == pytest.approx(5e-4, rel=1e-2)
    # contacts between mastic particles carry much of the load until they break
    assert weak.table.stress_pa.iloc[-1] < 0.8 * strong.table.stress_pa.iloc[-1]
    assert weak.table.broken_points.iloc[-1] > 0
    assert strong.table.broken_points.iloc[-1] == 0
    with pytest.raises(mc.InputError, match="brittle_bond"):
        mc.harmonic(strong.scene, frequencies=[10])


def test_cracks_have_energies_and_tables(scene):
    crack = dict(tensile_strength="20 kPa", fracture_energy=2.0, shear_strength="30 kPa")
    cracking = [dict(c, crack=crack) if c["pair"] == "M-M" else c for c in scene.as_dict()["contacts"]]
    pulled = mc.monotonic(mc.Scene(scene, contacts=cracking), rate=0.5, strain=5e-4, points=5, method="explicit", **FAST)
    last = pulled.table.iloc[-1]
    assert last.cracked_points > 0 and 0 < last.crack_energy_j < last.work_j
    assert pulled.summary["cracks"]["M-M"]["cracked_points"] == last.cracked_points
    assert len(pulled.cracks) == last.broken_points
    assert pulled.damage.cracked_points.sum() == last.cracked_points
    assert pulled.damage.energy_j.sum() == pytest.approx(last.crack_energy_j)
