# SPDX-License-Identifier: GPL-3.0-or-later
"""`mixture`: computes the scales of a design one after the other, from the binder to the mixture, and writes tables,
laws and report."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from macadam.mixture import design as designs
from macadam.mixture.binder import BinderFit, fit_binder, needed_range
from macadam.mixture.errors import MixtureError
from macadam.mixture.laws import Curve, Fitter, shift_keys
from macadam.mixture.runs import Runner
from macadam.mixture.scenes import sweep_of
from macadam.mixture.steps import Sentences, Step, Workshop, by_rule, by_specimens
from macadam.study import programs
from macadam.study.errors import StudyError
from macadam.study.locks import Taken, locked
from macadam.study.program import find_program, version_of

if TYPE_CHECKING:
    import pandas

_MARGIN = 2.0  # factor by which the range of every law extends beyond the reduced range of the test
_PER_DECADE = 4  # points per decade of the curves of binder and stiffening rule
_MISFIT = 0.03  # misfit of a law above which a warning is added


@dataclass
class Mixture:
    """The result of `mixture`. table: mixture.csv. master_curve: the curves of all scales. folder: of the files.
    summary: as in summary.json. decisions, warnings: sentences."""

    folder: Path
    table: pandas.DataFrame
    master_curve: pandas.DataFrame
    summary: dict[str, Any]
    decisions: list[str]
    warnings: list[str]


@dataclass
class Chain:
    """The computed scales, from which tables and report are made. needed: reduced frequencies [Hz] of the test.
    computed, reused: number of specimens."""

    design: designs.Design
    binder: BinderFit
    steps: list[Step]
    needed: tuple[float, float]
    decisions: list[str]
    warnings: list[str]
    version: str
    seconds: float = 0.0
    computed: int = 0
    reused: int = 0


def mixture(
    design: str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str],
    *,
    workers: int | None = None,
    progress: Callable[[str], object] | None = None,
    say: Callable[[str], object] | None = None,
) -> Mixture:
    """Computes |E*| and phase of a mixture from its binder and its mix design: `macadam mixture` (docs/mixture.md).

    design: a TOML file, or a dictionary of the same keys. out: the folder of the results; results that it has are not
    computed again. workers: number of specimens that are solved at the same time; by default the number of cores.
    progress: called with a sentence after each specimen. say: called with each decision and warning as soon as it is
    known. Raises MixtureError for wrong input and for a failed run."""
    return compute_and_write(design, out, workers, progress or _ignore, say or _ignore)


def _ignore(_: str) -> None:
    pass


def compute_and_write(
    design: Any,
    out: Any,
    workers: int | None,
    progress: Callable[[str], object],
    say: Callable[[str], object],
    rule: str = "series",
) -> Mixture:
    """Does the work of `mixture`. rule: `rule` of `[network]` in the scenes; only tests use another one than
    "series"."""
    from macadam.mixture import output

    folder, read = Path(out), designs.read(design)
    try:
        program = find_program()
        version = version_of(program)
    except StudyError as error:
        raise MixtureError(str(error), 1) from None
    cache = (folder / "cache").resolve()
    programs.start(str(cache))
    try:
        with locked(folder / ".lock", wait=False):
            runner = Runner(program, version, cache, workers or read.run.get("workers"))
            return output.write(_compute(read, runner, progress, say, rule), folder)
    except Taken:
        raise MixtureError(
            f"{folder}: found a running command that uses this folder, expected another folder"
        ) from None
    except BaseException:
        programs.stop(str(cache))
        raise


def _compute(
    design: designs.Design, runner: Runner, progress: Callable[[str], object], say: Callable[[str], object], rule: str
) -> Chain:
    """Computes all scales of a design."""
    began = time.monotonic()
    decisions, warnings = Sentences(say), Sentences(say, "warning: ")
    for words in design.decisions:
        decisions.add(words)
    found = fit_binder(design.binder, design.temperatures, design.frequencies)
    needed = needed_range(found.model, design.temperatures, design.frequencies)
    _judge_binder(design, found, needed, decisions, warnings)
    fitter = Fitter(runner.program, runner.version, runner.folder / "fits")
    shop = Workshop(design, runner, fitter, shift_keys(found.model), decisions, warnings, progress, rule)
    wide = needed[0] / _MARGIN, needed[1] * _MARGIN
    steps = [_binder(shop, found, wide)]
    for number, scale in enumerate(design.scales):
        last = number == len(design.scales) - 1
        if scale.rule:
            steps.append(by_rule(shop, scale, steps[-1]))
        else:
            asked = _test_frequencies(found, design) if last else sweep_of(*wide, scale.points_per_decade)
            steps.append(by_specimens(shop, scale, steps[-1], asked, last))
        for law in steps[-1].laws:
            if law.misfit > _MISFIT:
                warnings.add(
                    f"The law of {law.name} differs by up to {100 * law.misfit:.2g} % from the values to which it was "
                    "fitted."
                )
    seconds = time.monotonic() - began
    return Chain(
        design, found, steps, needed, [*decisions], [*warnings], runner.version, seconds, runner.computed, runner.reused
    )


def _binder(shop: Workshop, found: BinderFit, wide: tuple[float, float]) -> Step:
    """Returns the binder as the first step: its curve and its chain between two reduced frequencies [Hz]."""
    poisson = shop.design.binder.poisson_ratio
    frequencies = sweep_of(*wide, _PER_DECADE)
    curve = Curve.of(frequencies, 2 * (1 + poisson) * found.model.shear(frequencies))
    law = shop.fitter.convert("the binder", found.model, poisson, curve, shop.shift)
    return Step("binder", "binder", [curve], [law], poisson)


def _judge_binder(
    design: designs.Design, found: BinderFit, needed: tuple[float, float], decisions: Sentences, warnings: Sentences
) -> None:
    """Adds sentences on the fit of the binder and on the range of its measurements."""
    modulus, phase, stiffness = found.errors
    creep = "" if stiffness is None else f", {100 * stiffness:.2g} % of creep stiffness"
    decisions.add(
        f"Binder: 2S2P1D with WLF, fitted to the {found.used} of {found.total} shear moduli that are near the test; "
        f"rms errors {100 * modulus:.2g} % of |G*|, {phase:.2g} degrees{creep}; glass modulus "
        f"{found.model.glass / 1e9:.3g} GPa in shear."
    )
    decisions.add(
        f"Test: reduced frequencies from {needed[0]:.2g} to {needed[1]:.2g} Hz at "
        f"{design.binder.reference_temperature:g} °C."
    )
    if modulus > 0.1 or phase > 5:
        warnings.add(
            f"The binder's law misses its measurements by {100 * modulus:.2g} % of |G*| and {phase:.2g} degrees "
            "(rms); they may not belong to one linear material."
        )
    low, high = np.log10(found.range[0] / needed[0]), np.log10(needed[1] / found.range[1])
    for missing, side, end in ((low, "below", found.range[0]), (high, "above", found.range[1])):
        if missing > 0.05:
            towards = " towards the glass modulus" if side == "above" else ""
            warnings.add(
                f"The test needs the binder {missing:.1f} decades {side} its measurements, which end at a reduced "
                f"frequency of {end:.2g} Hz; there its law is extrapolated{towards}."
            )


def _test_frequencies(found: BinderFit, design: designs.Design) -> list[float]:
    """Returns the different reduced frequencies [Hz] of the test, in rising order."""
    return sorted({rounded(found.model.reduced(t, f)) for t in design.temperatures for f in design.frequencies})


def rounded(frequency: float) -> float:
    """Rounds to nine digits, as in scenes."""
    return float(f"{float(frequency):.9g}")
