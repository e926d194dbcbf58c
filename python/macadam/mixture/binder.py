# SPDX-License-Identifier: GPL-3.0-or-later
"""The binder's law: a 2S2P1D model with the WLF shift, fitted to DSR and BBR data with a glass modulus that is held or
has a prior.

    G*(iω) = G_g / (1 + δ·(iωτ)^(−k) + (iωτ)^(−h) + (iωβτ)^(−1)),  log10 a_T = −C1·(T − T_r)/(C2 + T − T_r)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from macadam.mixture.design import Binder
from macadam.mixture.errors import refuse
from macadam.mixture.measurements import Bbr, Dsr, read_bbr, read_dsr

MODULUS_ERROR, PHASE_ERROR, STIFFNESS_ERROR = 0.03, 1.0, 0.05  # standard deviations: relative, degrees, relative
_MARGIN = 1.0  # decades beyond the range of the test in which measurements are still used
_KELVINS = 10.0  # largest distance from the temperatures of the test; over more the shift is less like WLF
_LEAST = 12  # smallest number of measurements of a fit


@dataclass
class Model:
    """Constants of the binder: glass modulus [Pa] in shear, exponents, δ, τ [s] at the reference temperature [°C], β,
    and the constants of WLF."""

    glass: float
    k: float
    h: float
    delta: float
    tau: float
    beta: float
    c1: float
    c2: float
    reference: float

    def log_shift(self, temperature):
        """Returns log10 a_T at a temperature [°C]; NaN at or below the temperature at which WLF has no value."""
        above = np.asarray(temperature, float) - self.reference
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.c2 + above > 0, -self.c1 * above / (self.c2 + above), np.nan)

    def reduced(self, temperature, frequency):
        """Returns the frequency [Hz] at the reference temperature at which the modulus is the same."""
        return np.asarray(frequency, float) * 10 ** self.log_shift(temperature)

    def shear(self, reduced):
        """Returns the complex shear modulus [Pa] at reduced frequencies [Hz]."""
        return self._laplace(2j * np.pi * np.asarray(reduced, float))

    def creep_stiffness(self, time, poisson: float):
        """Returns the stiffness in extension [Pa], stress over strain, after a load of this duration [s] at the
        reference temperature. The creep compliance is the inverse Laplace transform of 1/(s·E(s)), by Talbot's method
        with 24 points."""
        n = 24
        k = np.arange(1, n)
        theta = k * np.pi / n
        cot = 1 / np.tan(theta)
        r = 2 * n / 5
        s = np.concatenate([[r], r * theta * (cot + 1j)])
        sigma = theta + (theta * cot - 1) * cot
        weight = np.concatenate([[0.5 * np.exp(r)], np.exp(s[1:]) * (1 + 1j * sigma)])
        time = np.asarray(time, float)
        at = s / time[..., None]
        compliance = (r / (n * time)) * np.sum((weight / (at * 2 * (1 + poisson) * self._laplace(at))).real, axis=-1)
        return 1 / compliance

    def _laplace(self, s):
        x = s * self.tau
        return self.glass / (1 + self.delta * x**-self.k + x**-self.h + 1 / (self.beta * x))


@dataclass
class BinderFit:
    """The fitted model and how well it meets the data. used: number of measurements in the fit; total: of all
    measurements. errors: root mean squares of ln|G*|, phase [degrees] and ln S (None without BBR). range: reduced
    frequencies [Hz] of the measurements in the fit."""

    model: Model
    dsr: Dsr
    bbr: Bbr | None
    used: int
    total: int
    errors: tuple[float, float, float | None]
    range: tuple[float, float]


def least_squares(
    residuals: Callable[[np.ndarray], np.ndarray], start: np.ndarray, steps: int = 200
) -> tuple[np.ndarray, float]:
    """Returns the parameters that minimise the sum of squares, and this sum, by the method of Levenberg and Marquardt
    with derivatives by differences."""
    x, damping = np.array(start, float), 1e-2
    r = residuals(x)
    cost = float(r @ r)
    for _ in range(steps):
        jacobian = np.array([(residuals(x + 1e-6 * e) - residuals(x - 1e-6 * e)) / 2e-6 for e in np.eye(len(x))]).T
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ r
        for _ in range(12):
            step = np.linalg.lstsq(
                normal + damping * np.diag(np.maximum(np.diag(normal), 1e-12)), -gradient, rcond=None
            )[0]
            tried = x + np.clip(step, -2, 2)
            with np.errstate(all="ignore"):
                other = residuals(tried)
            smaller = float(other @ other) if np.isfinite(other).all() else np.inf
            if smaller < cost:
                break
            damping *= 4
        else:
            break
        gain, x, r, cost, damping = cost - smaller, tried, other, smaller, max(damping / 5, 1e-12)
        if gain < 1e-10 * cost:
            break
    return x, cost


def _model(x: np.ndarray, binder: Binder) -> Model:
    """Returns the model of the free parameters: logits of h and k/h, logarithms of δ, τ, β, C1, C2 and, if it is not
    held, of the glass modulus."""
    h = 1 / (1 + np.exp(-x[0]))
    k = h / (1 + np.exp(-x[1]))
    delta, tau, beta, c1, c2 = np.exp(x[2:7])
    glass = float(np.exp(x[7])) if binder.glass_modulus_std > 0 else binder.glass_modulus
    return Model(
        glass,
        float(k),
        float(h),
        float(delta),
        float(tau),
        float(beta),
        float(c1),
        float(c2),
        binder.reference_temperature,
    )


def _fit(dsr: Dsr, bbr: Bbr | None, binder: Binder, start: Model | None) -> Model:
    prior = binder.glass_modulus_std

    def residuals(x: np.ndarray) -> np.ndarray:
        model = _model(x, binder)
        found = model.shear(model.reduced(dsr.temperature, dsr.frequency))
        parts = [
            np.log(abs(found) / dsr.modulus) / MODULUS_ERROR,
            (np.degrees(np.angle(found)) - dsr.phase) / PHASE_ERROR,
        ]
        if bbr is not None:
            time = bbr.time / 10 ** model.log_shift(bbr.temperature)
            parts.append(np.log(model.creep_stiffness(time, binder.poisson_ratio) / bbr.stiffness) / STIFFNESS_ERROR)
        if prior > 0:
            parts.append(np.array([np.log(model.glass / binder.glass_modulus) / np.log1p(prior)]))
        return np.concatenate(parts)

    starts = []
    if start is not None:
        starts.append(
            [
                np.log(start.h / (1 - start.h)),
                np.log(start.k / (start.h - start.k)),
                *np.log([start.delta, start.tau, start.beta, start.c1, start.c2]),
            ]
        )
    else:
        coldest = float(min(dsr.temperature.min(), bbr.temperature.min() if bbr else np.inf))
        c2 = max(150.0, binder.reference_temperature - coldest + 60)
        starts = [[0.4, -0.5, 1.0, t, 5.0, np.log(18.0), np.log(c2)] for t in np.log(10.0) * np.arange(-9.0, -2.0, 1.5)]
    tail = [np.log(start.glass if start else binder.glass_modulus)] if prior > 0 else []
    found = []
    for s in starts:
        first = np.array([*s, *tail])
        if np.isfinite(residuals(first)).all():
            found.append(least_squares(residuals, first))
    if not found:
        extent = f"moduli from {dsr.modulus.min():.3g} to {dsr.modulus.max():.3g} Pa"
        refuse(binder.file, "measurements", f"{extent}, with which no fit can start", "moduli of a binder")
    return _model(min(found, key=lambda f: f[1])[0], binder)


def fit_binder(binder: Binder, temperatures: list[float], frequencies: list[float]) -> BinderFit:
    """Fits the binder's law to its measurements. After a first fit of all of them, those near the test are fitted again:
    at most a decade beyond its reduced range and 10 K beyond its temperatures, if they are enough."""
    dsr = read_dsr(binder.file)
    bbr = read_bbr(binder.bbr) if binder.bbr else None
    model = _fit(dsr, bbr, binder, None)
    total, reduced = len(dsr.modulus), model.reduced(dsr.temperature, dsr.frequency)
    low, high = needed_range(model, temperatures, frequencies)
    kept = _kept(dsr, reduced, low, high, temperatures)
    if kept.sum() < total:
        dsr = dsr.part(kept)
        model = _fit(dsr, bbr, binder, replace(model))
    if not np.isfinite(model.log_shift(np.array(temperatures))).all():
        refuse(
            binder.file,
            "shift",
            f"no value of WLF at {min(temperatures):g} °C, because C2 is {model.c2:.3g} K",
            f"test temperatures above {binder.reference_temperature - model.c2:.3g} °C",
        )
    reduced = model.reduced(dsr.temperature, dsr.frequency)
    shear = model.shear(reduced)
    stiffness = None
    extent = [reduced]
    if bbr is not None:
        time = bbr.time / 10 ** model.log_shift(bbr.temperature)
        stiffness = _rms(np.log(model.creep_stiffness(time, binder.poisson_ratio) / bbr.stiffness))
        extent.append(1 / (2 * np.pi * time))
    every = np.concatenate(extent)
    errors = (_rms(np.log(abs(shear) / dsr.modulus)), _rms(np.degrees(np.angle(shear)) - dsr.phase), stiffness)
    return BinderFit(model, dsr, bbr, len(dsr.modulus), total, errors, (float(every.min()), float(every.max())))


def _kept(dsr: Dsr, reduced: np.ndarray, low: float, high: float, temperatures: Sequence[float]) -> np.ndarray:
    """Returns the mask of the measurements that are near a test. low, high: its reduced range [Hz]. A condition that
    leaves too few measurements, or that shortens the part of the reduced range that is measured, is not applied."""
    kept = np.ones(len(reduced), bool)
    near = (dsr.temperature >= min(temperatures) - _KELVINS) & (dsr.temperature <= max(temperatures) + _KELVINS)
    for condition in ((reduced >= low / 10**_MARGIN) & (reduced <= high * 10**_MARGIN), near):
        both = kept & condition
        if both.sum() < _LEAST or len(np.unique(np.round(dsr.temperature[both]))) < 3:
            continue
        if reduced[both].min() <= max(low, reduced.min()) and reduced[both].max() >= min(high, reduced.max()):
            kept = both
    return kept


def needed_range(model: Model, temperatures: list[float], frequencies: list[float]) -> tuple[float, float]:
    """Returns the lowest and the highest reduced frequency [Hz] of a test."""
    reduced = [model.reduced(t, f) for t in temperatures for f in frequencies]
    reduced = [float(r) for r in reduced if np.isfinite(r)]
    return (min(reduced), max(reduced)) if reduced else (1e-15, 1e15)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))
