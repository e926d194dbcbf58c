# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of experiments from Python: the same numbers as the command's, callbacks, errors."""
import json
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import macadam as mc
from conftest import ROOT


def of_the_command(program, file, out, *options):
    subprocess.run([program, "run", file, "--out", out, *options], check=True, capture_output=True)
    return json.loads((out / "summary.json").read_text())


def same(found, expected):
    """Asserts that two summaries are equal, except for measured times and paths of files."""
    timed = ("timing_s", "scene", "solve_s")
    if isinstance(expected, dict):
        assert list(found) == list(expected)
        for key in expected:
            if key not in timed:
                same(found[key], expected[key])
    elif isinstance(expected, list):
        assert len(found) == len(expected)
        for a, b in zip(found, expected, strict=True):
            same(a, b)
    else:
        assert found == expected


def test_harmonic_has_the_numbers_of_the_command(small_file, tmp_path, program):
    expected = of_the_command(program, small_file, tmp_path / "command", "--method", "harmonic")
    result = mc.harmonic(small_file)
    same(result.summary, expected)
    assert list(result.table.e_star_pa) == [r["e_star_pa"] for r in expected["results"]]
    assert (result.folder / "specimen.csv").read_bytes() == (tmp_path / "command" / "specimen.csv").read_bytes()
    others = mc.harmonic(small_file, frequencies=[20.0, 10.0])
    assert list(others.table.frequency_hz) == [20, 10]
    assert others.table.e_star_pa[0] == pytest.approx(result.table.e_star_pa[1], rel=1e-9)  # the solver's tolerance


def test_a_stepped_run_has_the_numbers_of_the_command(small_file, tmp_path, program):
    expected = of_the_command(program, small_file, tmp_path / "command")
    told, seen, stages = [], [], []
    result = mc.run(small_file, on_plan=told.extend, on_step=lambda s: seen.append((s.frequency_hz, s.step)), every=3000,
                    progress=lambda stage, share: stages.append(stage))
    same(result.summary, expected)
    assert told == result.decisions and any("Hz" in s for s in stages)
    assert (result.folder / "response.csv").read_bytes() == (tmp_path / "command" / "response.csv").read_bytes()
    steps = {r["frequency_hz"]: r["steps"] for r in expected["results"]}
    assert seen == [(f, k) for f, n in steps.items() for k in range(3000, n + 1, 3000)]
    assert len(result.response) == sum(r["cycles"] * 500 + 1 for r in expected["results"])
    assert "|E*|" in str(result) and result.backend == "cpu" and result.skips[0].keys() == {"what", "why", "effect"}


def test_what_a_callback_sees(specimen):
    kept, samples = [], []

    def look(step):
        kept.append(step)
        samples.append((step.time, step.strain, step.stress_pa))
        state = step.particles()
        force = step.contacts().force
        assert state.displacement.shape == (len(specimen), 3) and force.shape == (len(specimen.contacts), 3)
        top = specimen.contacts.b == -6
        # The force on the wall is opposite to the sum of the forces on its particles. Each force is a sum of some
        # hundred terms in single precision.
        assert step.observation.top_force == pytest.approx(-force[top, 2].sum(), rel=1e-6)
    result = mc.run(specimen, on_step=lambda s: (look(s) if s.step % 10_000 == 0 else None), every=2000,
                    **{"loading.frequencies": [20.0]})
    assert samples
    response = result.response
    for time, strain, stress in samples:
        i = int(np.argmin(abs(response.time_s - time)))
        if abs(response.time_s[i] - time) < 1e-12:
            assert (strain, stress) == (response.strain[i], response.stress_pa[i])
    with pytest.raises(mc.RunError, match="after the callback had returned"):
        kept[0].particles()


def test_what_a_callback_raises_ends_the_run(specimen, tmp_path):
    def fail(step):
        raise LookupError(f"enough at {step.step}")
    with pytest.raises(LookupError, match="enough at 500"):
        mc.run(specimen, on_step=fail, every=500, out=tmp_path / "stepped")
    assert (tmp_path / "stepped" / "checkpoint.h5").exists()
    with pytest.raises(ZeroDivisionError):
        mc.run(specimen.scene, progress=lambda *_: 1 / 0, out=tmp_path / "preparing")
    assert not (tmp_path / "preparing").exists()
    with pytest.raises(mc.InputError, match="every: found 0"):
        mc.run(specimen, on_step=print, every=0)


def test_an_interrupted_run_goes_on_to_the_same_bits(small_file, tmp_path):
    whole = mc.run(small_file)

    def stop(step):
        if step.step >= 7000:
            raise StopIteration
    with pytest.raises((StopIteration, RuntimeError)):
        mc.run(small_file, out=tmp_path, on_step=stop, every=1000)
    resumed = mc.run(small_file, out=tmp_path, resume=True)
    assert (tmp_path / "response.csv").read_bytes() == (whole.folder / "response.csv").read_bytes()
    assert resumed.table.e_star_pa.equals(whole.table.e_star_pa)
    with pytest.raises(mc.InputError, match="out"):
        mc.run(small_file, resume=True)


def test_a_specimen_is_made_once_and_serves_many(specimen):
    first = mc.harmonic(specimen, frequencies=10)
    stiffer = mc.harmonic(specimen.scene, frequencies=10, specimen=specimen, **{"contacts.M-M.delta": 2, "contacts.M-A.delta": 2})
    assert first.specimen is specimen and first.summary["timing_s"]["specimen"] == specimen.seconds[0]
    assert 1.5 < stiffer.table.e_star_pa[0] / first.table.e_star_pa[0] < 2
    assert mc.harmonic(specimen, frequencies=[10]).table.e_star_pa[0] == first.table.e_star_pa[0]


def test_a_section_specimen_is_an_override_of_every_test(small_file):
    narrow = {"box": ["12 mm", "13 mm", "15 mm"]}
    times = [0.01, 0.1]
    for call in (lambda **more: mc.run(small_file, method="harmonic", **more),
                 lambda **more: mc.harmonic(small_file, **more),
                 lambda **more: mc.harmonic(small_file, frequencies=[10], **more),
                 lambda **more: mc.sweep(small_file, frequencies=[10], **more),
                 lambda **more: mc.relaxation(small_file, times=times, **more),
                 lambda **more: mc.creep(small_file, stress=1e5, times=times, **more),
                 lambda **more: mc.monotonic(small_file, rate=1e-5, times=times, **more)):
        result = call(specimen=narrow)
        assert result.scene.box == result.specimen.box == (0.012, 0.013, 0.015)
        assert result.summary["box_m"] == [0.012, 0.013, 0.015]


@pytest.mark.parametrize("other", [{"seed": 3}, {"specimen.box": [0.01] * 3}, {"specimen": {"seed": 3}}])
def test_a_made_specimen_is_not_changed_by_overrides(specimen, other):
    with pytest.raises(mc.InputError, match=r"^(seed|specimen).*: found a value together with a Specimen, expected no value"):
        mc.harmonic(specimen, frequencies=[10], **other)
    with pytest.raises(mc.InputError, match="specimen: found 'a.csv', expected a Specimen, or a dictionary of keys"):
        mc.run(specimen.scene, specimen="a.csv")


def test_sensitivities_and_inertia(specimen):
    result = mc.harmonic(specimen, frequencies=[10], sensitivities=True)
    by = result.sensitivities.set_index("parameter").d_e_star_pa
    deltas = [by[name] for name in by.index if name.endswith(".delta")]
    # |E*| is a homogeneous function of degree 1 of all stiffnesses, so its derivatives with respect to the logarithms
    # of the stiffnesses add up to |E*|.
    assert sum(deltas) == pytest.approx(result.table.e_star_pa[0], rel=1e-9)
    heavy = mc.harmonic(specimen, frequencies=[10], inertia=True, **{"solver.density_scaling": 1e6})
    assert heavy.table.density_scaling[0] == 1e6 and heavy.table.e_star_pa[0] != result.table.e_star_pa[0]


def test_tests_without_steps_hang_together(specimen):
    times = [0.01, 0.1, 1.0]
    relaxed = mc.relaxation(specimen, times=times, strain=1e-4)
    crept = mc.creep(specimen, times=times, stress="0.1 MPa", release=0.5)
    pulled = mc.monotonic(specimen, times=times, rate=1e-5)
    swept = mc.sweep(specimen, frequencies=[1, 10], points_per_decade=1)
    assert list(relaxed.table.time_s) == times and relaxed.scene.kind == "relaxation"
    assert (np.diff(relaxed.table.modulus_pa) < 0).all() and (relaxed.table.modulus_pa * 1e-4).equals(relaxed.table.stress_pa)
    assert crept.table.stress_pa[2] == 0 and (crept.table.strain > 0).all()
    assert (pulled.table.secant_pa > relaxed.table.modulus_pa).all()
    solved = mc.harmonic(specimen, frequencies=list(swept.table.frequency_hz))
    assert np.allclose(swept.table.e_star_pa, solved.table.e_star_pa, rtol=1e-9)  # the solver's tolerance
    assert {"modulus_pa", "time_s"} <= set(relaxed.prony.columns)
    assert isinstance(relaxed.csv("relaxation.csv"), pd.DataFrame)
    with pytest.raises(mc.InputError, match=r"nothing\.csv.*relaxation\.csv"):
        relaxed.csv("nothing.csv")
    with pytest.raises(mc.InputError, match="sweep.*not stepped in time|not stepped in time"):
        mc.run(swept.scene, method="explicit")
    spectrum = mc.spectrum(specimen, shortest=0.01, longest=1.0)
    # the tolerance of the relaxation modulus is 1e-5
    assert np.allclose(relaxed.table.modulus_pa, spectrum.relaxation.modulus(times), rtol=1e-4)
    assert spectrum.error < 1e-6 and spectrum.relaxation.units.shape[1] == 2
    assert spectrum.relaxation.instantaneous * spectrum.creep.instantaneous == pytest.approx(1, rel=1e-9)
    assert abs(spectrum.relaxation.stiffness(2j * np.pi)) == pytest.approx(swept.table.e_star_pa[0], rel=1e-3)


def test_temporary_folders_go_with_their_results(specimen, tmp_path):
    result = mc.harmonic(specimen, frequencies=[10])
    folder = result.folder
    assert (folder / "summary.json").exists()
    assert result.save(tmp_path / "kept") == tmp_path / "kept" and (tmp_path / "kept" / "summary.json").exists()
    del result
    assert not folder.exists()


def test_errors_of_runs_are_told_apart(specimen):
    with pytest.raises(mc.DivergenceError, match="diverged") as caught:
        mc.run(specimen, **{"solver.time_step": "0.1 ms", "solver.tolerance": None, "loading.start": "rest"})
    assert isinstance(caught.value, mc.RunError) and isinstance(caught.value, RuntimeError)
    assert 0 <= caught.value.particle < len(specimen) and caught.value.time > 0
    with pytest.raises(mc.InputError, match="no law for|law"):
        mc.harmonic(specimen, frequencies=[1], contacts=[c for c in specimen_contacts(specimen) if c["pair"] != "M-M"])
    if not mc.info()["devices"]:
        with pytest.raises(mc.RunError, match="cuda"):
            mc.run(specimen, backend="cuda")


def specimen_contacts(specimen):
    return mc.Scene(specimen.scene).as_dict()["contacts"]


def test_a_test_of_any_kind_needs_no_function_of_its_own(specimen):
    kinds = {experiment["kind"]: experiment for experiment in mc.experiments()}
    assert {"cyclic", "sweep", "relaxation", "creep", "monotonic"} <= set(kinds)
    assert "relaxation.csv" in kinds["relaxation"]["files"] and not kinds["sweep"]["can_be_stepped"]
    loading = {"times": [1e-3, 1.0], "strain": 1e-4}
    assert mc.test(specimen, "relaxation", loading).table.equals(mc.relaxation(specimen, **loading).table)
    with pytest.raises(mc.InputError, match="kind: found 'impact', expected one of cyclic, sweep, relaxation"):
        mc.test(specimen, "impact", loading)


def test_a_specimen_keeps_its_rollers(tmp_path: Path) -> None:
    bending = (ROOT / "examples" / "bending" / "scene.toml").read_text(encoding="utf-8")
    bending = bending.replace('"100 mm"', '"60 mm"').replace('"16 mm"', '"12 mm"')
    sweep = bending[: bending.index("[loading]")] + (
        '[loading]\nkind = "sweep"\nfrequencies = [1.0]\n[solver]\nmethod = "harmonic"\n'
    )
    (tmp_path / "bending.toml").write_text(bending, encoding="utf-8")
    (tmp_path / "sweep.toml").write_text(sweep, encoding="utf-8")
    bent, plain = mc.specimen(tmp_path / "bending.toml"), mc.specimen(tmp_path / "sweep.toml")
    with pytest.raises(mc.InputError, match="found beam .*, rollers of 0.00216 m at .*, expected .* no rollers"):
        mc.run(tmp_path / "sweep.toml", out=tmp_path / "out", specimen=bent)
    with pytest.raises(mc.InputError, match="found beam .* no rollers, expected .* rollers of 0.00216 m"):
        mc.run(tmp_path / "bending.toml", out=tmp_path / "out", specimen=plain)
