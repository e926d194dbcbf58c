# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits contact laws to measured moduli (docs/laws-from-data.md)."""
from __future__ import annotations

import io
import json
import tempfile
import tomllib
from collections.abc import Mapping, Sequence
from functools import cached_property
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core

if TYPE_CHECKING:
    import pandas

#: Measurements: a table in a file, or columns of the same names in a DataFrame or a dictionary. The columns are
#: frequency_hz, e_star_pa (or e_star_mpa, …) or g_star_pa, phase_deg (or e_prime_pa and e_double_prime_pa) and, if
#: known, temperature_c, e_star_std, phase_std. Other columns are ignored, so `Result.table` of a cyclic test or a sweep
#: can be given.
Data = str | PathLike[str] | Mapping[str, Sequence[float]] | Any


def modulus_data(data: Data, poisson: float | None = None, needed: str = "modulus-and-phase") -> _core.ModulusData:
    """Reads measurements from a file, a DataFrame or a dictionary of columns, with the reader of `macadam fit`.

    poisson: Poisson's ratio, to convert a column g_star_pa. needed: the columns that must be there:
    "modulus-and-phase", "modulus" or "phase"."""
    if isinstance(data, _core.ModulusData):
        return data
    if isinstance(data, (str, PathLike)):
        return _core.ModulusData(fspath(data), poisson, needed)
    import pandas
    with tempfile.TemporaryDirectory(prefix="macadam-") as folder:
        file = Path(folder) / "data"
        pandas.DataFrame(data).to_csv(file, index=False, float_format="%.17g")
        try:
            out = _core.ModulusData(fspath(file), poisson, needed)
        except _core.InputError as error:
            raise _core.InputError(str(error).replace(fspath(file), "data")) from None
    out.source = "data"
    return out


class Fit:
    """A fitted law. `files` has the texts of the files that the command writes, by name: law.toml, fit.json, fit.csv,
    curve.csv. law.toml is missing if no chain represents the 2S2P1D or Huet-Sayegh model within the allowed error."""

    def __init__(self, found: dict[str, Any]) -> None:
        self.files: dict[str, str] = found["files"]
        self.warnings: list[str] = found["warnings"]
        self._text: str = found["text"]

    @cached_property
    def law(self) -> dict[str, Any]:
        """The entry of `contacts` for a scene, in SI units. Its `pair` is M-M; change it to use the law for another
        pair.

        Raises InputError if no chain represents the fitted model; the last warning gives the reason."""
        if "law.toml" not in self.files:
            raise _core.InputError(self.warnings[-1])
        return tomllib.loads(self.files["law.toml"])["contacts"][0]

    @cached_property
    def json(self) -> dict[str, Any]:
        """Everything about the fit: parameters with deviations, covariance, candidates, errors."""
        return json.loads(self.files["fit.json"])

    # Reads one of the CSV files by its name.
    def _csv(self, name: str) -> pandas.DataFrame:
        import pandas
        return pandas.read_csv(io.StringIO(self.files[name]), comment="#")

    @cached_property
    def table(self) -> pandas.DataFrame:
        """One row per measurement: measured, fitted, difference."""
        return self._csv("fit.csv")

    @cached_property
    def curve(self) -> pandas.DataFrame:
        """The fitted curve at the reference temperature with its 95 % limits."""
        return self._csv("curve.csv")

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        errors = self.json.get("errors") or {}
        rms = [f"{100 * errors['e_star_rms']:.3g} % of |E*|"] if errors.get("e_star_rms") is not None else []
        rms += [f"{errors['phase_rms_deg']:.3g} degrees"] if errors.get("phase_rms_deg") is not None else []
        return f"<macadam.Fit {self.json['model']}: {len(self.json['parameters'])} parameters, rms {', '.join(rms) or 'unknown'}>"


def fit(data: Data | None = None, *, parameters: str | PathLike[str] | None = None, model: str = "kelvin",
        units: int | None = None, most_units: int = 12, criterion: str = "aicc", flow: bool | None = None,
        shift: str = "none", reference_temperature: float | None = None, poisson: float | None = None,
        from_hz: float | None = None, to_hz: float | None = None, error: float = 0.01,
        out: str | PathLike[str] | None = None) -> Fit:
    """Fits a contact law to measured complex moduli: `macadam fit`.

    data: a table in a file, a DataFrame (`Result.table` of a cyclic test or a sweep, for example) or a dictionary of
    columns. parameters: in place of data, the TOML file of a 2S2P1D or Huet-Sayegh model, which is converted into a
    chain that holds from `from_hz` to `to_hz` [Hz] with a relative error of at most `error`.
    model: "kelvin", "2s2p1d" or "huet-sayegh". units: number of Kelvin units; if it is not given, the criterion
    ("aicc", "bic") chooses it, up to `most_units`. flow: whether the chain has a dashpot in series. shift: "none",
    "wlf", "arrhenius" or "free". reference_temperature: [°C]. poisson: Poisson's ratio, to convert a column g_star_pa.
    out: a folder for the files.

        >>> import macadam as mc
        >>> law = mc.fit("examples/laws/mastic.csv", shift="wlf", units=4)
        >>> law.law["law"], len(law.law["E"])
        ('generalised_kelvin', 4)
    """
    if (data is None) == (parameters is None):
        raise _core.InputError(f"what to fit: found {'nothing' if data is None else 'both data and parameters'}, expected "
                               "measurements, or parameters with a model's TOML file")
    folder = None if out is None else fspath(out)
    if parameters is not None:
        return Fit(_core.convert(fspath(parameters), from_hz, to_hz, error, folder))
    return Fit(_core.fit(modulus_data(data, poisson), model, units, most_units, criterion, flow, shift, reference_temperature,
                         from_hz, to_hz, error, folder))
