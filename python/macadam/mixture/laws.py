# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of one scale: a chain of Kelvin units with the binder's shift, and the range of reduced frequencies in which
it holds. `macadam fit` computes the chain, from points of a curve or from a 2S2P1D model."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from macadam import _toml
from macadam.mixture.binder import Model
from macadam.mixture.errors import MixtureError
from macadam.study import programs
from macadam.study.locks import locked

_ERRORS = (0.01, 0.02, 0.05)  # allowed errors of a chain that replaces a 2S2P1D model, tried one after the other


@dataclass
class Curve:
    """A complex modulus over the reduced frequency: frequencies [Hz], |E*| [Pa], phase [degrees]."""

    frequency: np.ndarray
    e_star: np.ndarray
    phase: np.ndarray

    @staticmethod
    def of(frequency, modulus) -> Curve:
        """Returns the curve of complex moduli [Pa]."""
        modulus = np.asarray(modulus)
        return Curve(np.asarray(frequency, float), abs(modulus), np.degrees(np.angle(modulus)))

    @property
    def complex(self) -> np.ndarray:
        """Complex moduli [Pa]."""
        return self.e_star * np.exp(1j * np.radians(self.phase))

    def text(self) -> str:
        """Returns the curve as CSV for `macadam fit`."""
        rows = zip(self.frequency, self.e_star, self.phase)
        return "frequency_hz,e_star_pa,phase_deg\n" + "".join(
            f"{f!r},{e!r},{p!r}\n" for f, e, p in (map(float, r) for r in rows)
        )


@dataclass
class Law:
    """A chain of Kelvin units and a Maxwell unit. E, C: springs [Pa] and dashpots [Pa s] of the Kelvin units. E_m, C_m:
    spring and dashpot of the Maxwell unit. shift: keys of the temperature shift in a scene. valid_hz: reduced
    frequencies [Hz] between which the law holds. misfit: largest relative difference of the complex modulus from the
    points to which the chain was fitted."""

    name: str
    E_m: float
    C_m: float
    E: list[float]
    C: list[float]
    shift: dict[str, Any]
    valid_hz: tuple[float, float]
    misfit: float

    def modulus(self, frequency) -> np.ndarray:
        """Returns the complex modulus [Pa] at reduced frequencies [Hz]."""
        s = 2j * np.pi * np.asarray(frequency, float)[..., None]
        units = np.sum(1 / (np.array(self.E) + s * np.array(self.C)), axis=-1)
        flow = 0 if np.isinf(self.C_m) else 1 / (s[..., 0] * self.C_m)
        return 1 / (1 / self.E_m + flow + units)

    def keys(self) -> dict[str, Any]:
        """Returns the keys of the law in a scene."""
        chain = {"law": "generalised_kelvin", "E_m": self.E_m, "C_m": self.C_m, "E": self.E, "C": self.C}
        return {**chain, **self.shift, "valid_frequencies": list(self.valid_hz)}

    def toml(self, poisson: float) -> str:
        """Returns a section `[materials.mastic]` for a scene with this law and its range. poisson: Poisson's ratio."""
        return (
            f"# macadam mixture: law of {self.name}\n# largest difference from the values to which it was fitted: "
            f"{100 * self.misfit:.2g} %\n"
        ) + _toml.dumps({"materials": {"mastic": {**self.keys(), "poisson_ratio": poisson}}}).lstrip()


def shift_keys(model: Model) -> dict[str, Any]:
    """Returns the keys of the binder's shift in a scene."""
    return {"shift": "wlf", "C1": model.c1, "C2": model.c2, "reference_temperature": model.reference}


def read_law(file: Path, name: str, shift: dict[str, Any], valid_hz: tuple[float, float], curve: Curve) -> Law:
    """Reads the chain in a `law.toml` of `macadam fit`, and compares it with the curve to which it was fitted."""
    entry = tomllib.loads(file.read_text(encoding="utf-8"))["contacts"][0]
    law = Law(
        name,
        float(entry["E_m"]),
        float(entry.get("C_m", np.inf)),
        list(map(float, entry.get("E", []))),
        list(map(float, entry.get("C", []))),
        shift,
        valid_hz,
        0.0,
    )
    law.misfit = float(np.max(abs(law.modulus(curve.frequency) / curve.complex - 1)))
    return law


class Fitter:
    """Fits laws by `macadam fit`. Results are kept in a folder under a digest of the data, the options and the version
    of the program, and are not computed again."""

    def __init__(self, program: str, version: str, folder: Path) -> None:
        self.program, self.version, self.folder = program, version, folder

    def fit(self, name: str, curve: Curve, shift: dict[str, Any]) -> Law:
        """Fits a chain of at most 16 Kelvin units to a curve. The chain holds between the ends of the curve. Raises
        MixtureError if no such chain was found."""
        valid = float(curve.frequency.min()), float(curve.frequency.max())
        file, said = self._run("data.csv", curve.text(), ["--curve"])
        if file is None:
            raise MixtureError(f"law of {name}: {said}", 1)
        return read_law(file, name, shift, valid, curve)

    def convert(self, name: str, model: Model, poisson: float, curve: Curve, shift: dict[str, Any]) -> Law:
        """Returns the chain that stands for the binder's model between the ends of a curve of it."""
        valid = float(curve.frequency.min()), float(curve.frequency.max())
        text = _toml.dumps(
            {
                "model": "2s2p1d",
                "E_0": 2 * (1 + poisson) * model.glass,
                "k": model.k,
                "h": model.h,
                "delta": model.delta,
                "tau": model.tau,
                "beta": model.beta,
            }
        )
        said = ""
        for error in _ERRORS:
            options = ["--from", repr(valid[0]), "--to", repr(valid[1]), "--error", str(error)]
            file, said = self._run("model.toml", text, options)
            if file is not None:
                return read_law(file, name, shift, valid, curve)
        raise MixtureError(f"law of {name}: {said}", 1)

    def _run(self, name: str, text: str, options: list[str]) -> tuple[Path | None, str]:
        """Runs `macadam fit` unless its result is in the folder. Returns its law.toml, or None and the message of the
        program."""
        key = hashlib.sha256(json.dumps([name, text, options, self.version]).encode()).hexdigest()[:20]
        done, work = self.folder / "results" / key, self.folder / "running" / key
        with locked(self.folder / "running" / f"{key}.lock", wait=True):
            if not done.is_dir():
                shutil.rmtree(work, ignore_errors=True)
                work.mkdir(parents=True)
                (work / name).write_text(text, encoding="utf-8")
                source = (
                    ["--parameters", str(work / name)] if name == "model.toml" else [str(work / name), "--no-pictures"]
                )
                line = [self.program, "fit", *source, *options, "--out", str(work)]
                code, said = programs.run(
                    str(self.folder.parent), line, env={**os.environ, "OMP_NUM_THREADS": "1"}, stdout=subprocess.DEVNULL
                )
                if code not in (0, 2):
                    raise MixtureError(f"macadam fit: {said.strip() or f'exit code {code}'}", 1)
                (work / "message.txt").write_text(said, encoding="utf-8")
                done.parent.mkdir(parents=True, exist_ok=True)
                work.rename(done)
        law = done / "law.toml"
        return (law if law.is_file() else None), programs.error_line((done / "message.txt").read_text(encoding="utf-8"))
