# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the results of a mixture: tables, laws, summary and report."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pandas

from macadam._files import write_text
from macadam.mixture import page, predictions, stiffening
from macadam.mixture.driver import Chain, Mixture, rounded
from macadam.mixture.steps import Step
from macadam.mixture.volumes import Volumes, volumes

_FLOAT = "%.9g"


def write(chain: Chain, folder: Path) -> Mixture:
    """Writes mixture.csv, master_curve.csv, laws/, summary.json and report.html, and returns the result."""
    table, curves, summary = mixture_table(chain), curve_table(chain), _plain(_summary(chain))
    summary["results"] = _plain(table.to_dict("records"))
    laws = folder / "laws"
    laws.mkdir(parents=True, exist_ok=True)
    for old in laws.glob("*.toml"):
        old.unlink()
    for step in chain.steps:
        for name, text in law_texts(step).items():
            write_text(laws / name, text)
    write_text(folder / "mixture.csv", table.to_csv(index=False, float_format=_FLOAT))
    write_text(folder / "master_curve.csv", curves.to_csv(index=False, float_format=_FLOAT))
    page.report(chain, table, folder / "report.html")
    write_text(folder / "summary.json", json.dumps(summary, indent=1, ensure_ascii=False) + "\n")
    return Mixture(folder, table, curves, summary, chain.decisions, chain.warnings)


def law_texts(step: Step) -> dict[str, str]:
    """Returns the laws of one scale as TOML by the name of their file: one, or one per seed."""
    if step.kind != "specimen":
        return {f"{step.name}.toml": law.toml(step.poisson) for law in step.laws}
    return {
        f"{step.name}_seed_{seed}.toml": law.toml(step.poisson) for seed, law in zip(step.facts["seeds"], step.laws)
    }


def mixture_table(chain: Chain) -> pandas.DataFrame:
    """Returns |E*| and phase of the mixture at every temperature and frequency of the test, with predictions and
    bounds."""
    design, model, last = chain.design, chain.binder.model, chain.steps[-1]
    mix, gradation = volumes(design.recipe), predictions.retained(design.recipe.gradation)
    index = {f: k for k, f in enumerate(map(rounded, last.frequency))}
    rows = []
    for temperature in design.temperatures:
        ten = model.shear(model.reduced(temperature, 10 / (2 * math.pi)))
        eta = predictions.viscosity(abs(ten), np.degrees(np.angle(ten)))
        for frequency in design.frequencies:
            reduced = rounded(model.reduced(temperature, frequency))
            k, shear = index[reduced], abs(model.shear(reduced))
            hirsch, hirsch_phase = predictions.hirsch(shear, mix.vma, mix.vfa)
            witczak = predictions.witczak(frequency, eta, gradation, mix.air_voids, mix.effective_binder / mix.bulk)
            low, high = bounds(chain, mix, shear)
            row = {
                "temperature_c": temperature,
                "frequency_hz": frequency,
                "e_star_pa": last.e_star[k],
                "e_star_std_pa": last.e_star[k] * last.e_scatter[k],
                "phase_deg": last.phase[k],
                "phase_std_deg": last.phase_scatter[k],
                "e_star_hirsch_pa": hirsch,
                "e_star_witczak_pa": witczak,
                "hashin_shtrikman_lower_pa": low,
                "hashin_shtrikman_upper_pa": high,
                "phase_hirsch_deg": hirsch_phase,
                "log10_a_T": model.log_shift(temperature),
                "reduced_frequency_hz": reduced,
            }
            rows.append({name: float(value) for name, value in row.items()})
    return pandas.DataFrame(rows)


def bounds(chain: Chain, mix: Volumes, shear: float) -> tuple[float, float]:
    """Returns Hashin's and Shtrikman's bounds of Young's modulus [Pa] for aggregate, binder and air. shear: magnitude
    of the binder's complex shear modulus [Pa]. The upper bound includes the air. The lower bound is for aggregate and
    binder alone, because with air it is 0."""
    design, poisson = chain.design, chain.design.binder.poisson_ratio
    phases = [
        (mix.aggregate, *stiffening.bulk_and_shear(design.rock_modulus, design.rock_poisson)),
        (mix.effective_binder / mix.bulk, *stiffening.bulk_and_shear(2 * (1 + poisson) * shear, poisson)),
    ]
    air = [(mix.air_voids, 0.0, 0.0)] if mix.air_voids > 0 else []
    return stiffening.bounds(phases)[0], stiffening.bounds(phases + air)[1]


def curve_table(chain: Chain) -> pandas.DataFrame:
    """Returns the curves of all scales over the reduced frequency: means over the seeds and standard deviations."""
    tables = [
        pandas.DataFrame(
            {
                "scale": step.name,
                "reduced_frequency_hz": step.frequency,
                "e_star_pa": step.e_star,
                "e_star_std_pa": step.e_star * step.e_scatter,
                "phase_deg": step.phase,
                "phase_std_deg": step.phase_scatter,
            }
        )
        for step in chain.steps
    ]
    return pandas.concat(tables, ignore_index=True)


def _summary(chain: Chain) -> dict[str, Any]:
    """Returns the content of summary.json without the results."""
    design, found, mix = chain.design, chain.binder, volumes(chain.design.recipe)
    model = found.model
    return {
        "status": "done",
        "kind": "mixture",
        "design": str(design.file),
        "title": design.title,
        "macadam": chain.version,
        "binder": {
            "model": "2s2p1d",
            "glass_modulus_pa": model.glass,
            "k": model.k,
            "h": model.h,
            "delta": model.delta,
            "tau_s": model.tau,
            "beta": model.beta,
            "C1": model.c1,
            "C2": model.c2,
            "reference_temperature_c": model.reference,
            "poisson_ratio": design.binder.poisson_ratio,
            "measurements": found.total,
            "measurements_used": found.used,
            "rms_modulus": found.errors[0],
            "rms_phase_deg": found.errors[1],
            "rms_stiffness": found.errors[2],
            "measured_reduced_hz": found.range,
            "needed_reduced_hz": chain.needed,
        },
        "recipe": {
            "maximum_density": mix.maximum_density,
            "bulk_density": mix.bulk_density,
            "air_voids": mix.air_voids,
            "vma": mix.vma,
            "vfa": mix.vfa,
            "effective_binder_volume": mix.effective_binder / mix.bulk,
        },
        "scales": [{"name": s.name, "kind": s.kind, "poisson_ratio": s.poisson, **s.facts} for s in chain.steps],
        "laws": [
            {
                "name": law.name,
                "scale": step.name,
                "units": len(law.E),
                "valid_hz": law.valid_hz,
                "misfit": law.misfit,
                "file": f"laws/{file}",
            }
            for step in chain.steps
            for law, file in zip(step.laws, law_texts(step))
        ],
        "decisions": chain.decisions,
        "warnings": chain.warnings,
        "runs": {"computed": chain.computed, "reused": chain.reused},
        "timing_s": {"total": chain.seconds},
    }


def _plain(value: Any) -> Any:
    """Returns a value for JSON: without numbers of NumPy, and with null for a number that is not finite."""
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, (float, np.floating)):
        return float(value) if math.isfinite(value) else None
    return int(value) if isinstance(value, np.integer) else value
