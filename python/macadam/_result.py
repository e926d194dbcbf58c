# SPDX-License-Identifier: GPL-3.0-or-later
"""Results: the folder of a run, whose files are read when they are first used."""
from __future__ import annotations

import html
import importlib
import json
import shutil
import tempfile
import weakref
from functools import cached_property
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _core
from ._scene import Scene

if TYPE_CHECKING:
    import pandas


def result_folder(out: str | PathLike[str] | None, owner: Any) -> Path:
    """Returns the folder `out`, or, if it is None, a new temporary folder that is removed together with `owner`."""
    if out is not None:
        return Path(out)
    folder = Path(tempfile.mkdtemp(prefix="macadam-"))
    weakref.finalize(owner, shutil.rmtree, folder, ignore_errors=True)
    return folder


class _Outcome(NamedTuple):
    """Texts of a finished run. Its numbers are in the files of the folder."""
    text: str
    decisions: list[str]
    skips: list[dict[str, str]]
    warnings: list[str]
    solver: str
    backend: str


class Result:
    """The results of a test, and the folder with its files (docs/output-files.md).

    `folder` is the folder that was given, or a temporary one that is removed together with this object; save() copies
    it. A pickled result contains the files if the folder is temporary, otherwise only the folder's name.

        >>> import macadam as mc
        >>> result = mc.relaxation("examples/demo/scene.toml", times=[0.01, 1], points_per_decade=1,
        ...                        specimen={"box": ["12 mm", "12 mm", "15 mm"]})
        >>> result.table.time_s.tolist()
        [0.01, 0.1, 1.0]
        >>> result.save("results/relaxation").name
        'relaxation'
    """

    def __init__(self, scene: Scene, specimen: _core.Specimen | None, out: str | PathLike[str] | None,
                 **call: Any) -> None:
        self.scene = scene
        self._specimen = specimen
        self._temporary = out is None
        self.folder = result_folder(out, self)
        done = _core.run(scene, fspath(self.folder), specimen, **call)
        self._run = _Outcome(*(getattr(done, name) for name in _Outcome._fields))

    def __getstate__(self) -> dict[str, Any]:
        state = {"scene": self.scene, "_specimen": self._specimen, "_run": self._run, "_temporary": self._temporary}
        if not self._temporary:
            return state | {"folder": self.folder.absolute()}
        files = [p for p in self.folder.rglob("*") if p.is_file()]
        return state | {"files": {str(p.relative_to(self.folder)): p.read_bytes() for p in files}}

    def __setstate__(self, state: dict[str, Any]) -> None:
        files = state.pop("files", {})
        self.__dict__.update(state)
        if self._temporary:
            self.folder = result_folder(None, self)
        for name, content in files.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_bytes(content)

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json: input, specimen and results."""
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8", errors="replace"))

    @cached_property
    def table(self) -> pandas.DataFrame:
        """For a cyclic test or a sweep one row per frequency: frequency_hz, e_star_pa (torsion: g_star_pa) [Pa],
        phase_deg and so on. For the other tests one row per time: time_s and the measured quantities."""
        import pandas
        rows = self.summary["results"]
        if rows and "points" in rows[0]:
            rows = rows[0]["points"]
        return pandas.DataFrame([{k: v for k, v in r.items() if not isinstance(v, (dict, list))} for r in rows])

    @cached_property
    def sensitivities(self) -> pandas.DataFrame:
        """Change of |E*| [Pa] and φ [degrees] per unit of each parameter's natural logarithm; empty if the scene does
        not ask for sensitivities."""
        import pandas
        return pandas.DataFrame([{"frequency_hz": r["frequency_hz"], **s} for r in self.summary["results"]
                                 for s in r.get("sensitivities", [])])

    @cached_property
    def response(self) -> pandas.DataFrame:
        """The samples of a stepped cyclic test: frequency_hz, time_s, strain, stress_pa. Other tests have only
        `table`."""
        return self.csv("response.csv")

    @cached_property
    def prony(self) -> pandas.DataFrame:
        """The relaxation modulus as Maxwell units, for relaxation, creep and monotonic tests without steps."""
        return self.csv("prony.csv")

    @cached_property
    def cracks(self) -> pandas.DataFrame:
        """The contact points that broke in a stepped test: contact, a, b, pair, x, y, z [m], normal, area_m2, mode, with
        cracks opening_m, slip_m and damage, and time_s."""
        return self.csv("cracks.csv")

    @cached_property
    def damage(self) -> pandas.DataFrame:
        """The contacts that have begun to crack, at the end of a stepped test with cracks: contact, a, b, pair, x, y, z
        [m], normal, area_m2, opening_m, slip_m, damage (means over the facet), energy_j, friction_j, cracked_points,
        points."""
        return self.csv("damage.csv")

    def csv(self, name: str) -> pandas.DataFrame:
        """Reads a CSV file of the folder by its name."""
        import pandas
        file = self.folder / name
        if not file.is_file():
            there = ", ".join(sorted(p.name for p in self.folder.glob("*.csv")))
            raise _core.InputError(f"{file}: found no such file, expected one of {there}")
        return pandas.read_csv(file, comment="#")

    @property
    def specimen(self) -> _core.Specimen:
        """The particles, cells and contacts that were tested."""
        if self._specimen is None:
            self._specimen = _core.prepare(self.scene)
        return self._specimen

    @property
    def decisions(self) -> list[str]:
        """The choices that the scene left open to the program, each with the value chosen and the reason."""
        return self._run.decisions

    @property
    def skips(self) -> list[dict[str, str]]:
        """Computations that were left out because the scene does not need them: what, why, effect."""
        return self._run.skips

    @property
    def warnings(self) -> list[str]:
        """Warnings that a reader of the results must know."""
        return self._run.warnings

    @property
    def solver(self) -> str:
        """A description of the solver that ran."""
        return self._run.solver

    @property
    def backend(self) -> str:
        """The backend that ran: cpu, cuda or reference."""
        return self._run.backend

    def report(self, file: str | PathLike[str], *, figures: str | PathLike[str] | None = None, view: bool = False) -> Path:
        """Writes a report of the folder, one HTML file: `macadam report`. figures: a folder into which each figure is
        written too, as SVG, PDF, PNG and CSV. view: also write a view in three dimensions beside the report."""
        importlib.import_module("macadam.report").report(self.folder, file, figures=figures, scene=self.scene.text, view=view)
        return Path(file)

    def plot(self, what: str | None = None) -> Any:
        """Returns a matplotlib figure of the results, which a notebook shows; `figure.savefig(file)` writes it.

        what: for a test over frequencies "modulus" (|E*| and φ over the frequency, the default), "cole_cole",
        "black" or, with several temperatures, "master_curve";
        for a test over time "history" (the default). Needs matplotlib: pip install 'macadam[report]'.
        """
        return importlib.import_module("macadam._plot").plot_result(self, what)

    def save(self, folder: str | PathLike[str]) -> Path:
        """Copies the folder of the results to `folder` and returns the copy's path."""
        return Path(shutil.copytree(self.folder, folder, dirs_exist_ok=True))

    def __str__(self) -> str:
        return self._run.text

    def __repr__(self) -> str:
        return f"<macadam.Result {self.scene.kind}: {self._numbers()}; {self.backend}, {self.folder}>"

    def _repr_html_(self) -> str:
        table = self.table.to_html(max_rows=12, index=False, float_format=lambda x: f"{x:.5g}")
        return f"<p>{html.escape(repr(self))}</p>{table}"

    def _numbers(self) -> str:
        """Returns the most important numbers: modulus and phase at the first and the last frequency, or strength, or the
        first and the last value over time."""
        rows = self.summary.get("results") or [{}]
        modulus = next((key for key in ("e_star_pa", "g_star_pa") if key in rows[0]), None)
        if modulus:
            ends = rows if len(rows) == 1 else (rows[0], rows[-1])
            at = [f"|{modulus[0].upper()}*| {r[modulus]:.4g} Pa, phase {r['phase_deg']:.3g} degrees at {r['frequency_hz']:g} Hz"
                  + (f", {r['temperature_c']:g} °C" if r.get("temperature_c") is not None else "") for r in ends]
            return " to ".join(at)
        if rows[0].get("strength_pa") is not None:
            return f"strength {rows[0]['strength_pa']:.4g} Pa at a strain of {rows[0]['strain_at_peak']:.4g}"
        if rows[0].get("fracture_stress_pa") is not None:
            return f"fracture at {rows[0]['fracture_temperature_c']:.4g} °C, {rows[0]['fracture_stress_pa']:.4g} Pa"
        for key, name in (("indirect_tensile_strength_pa", "indirect tensile strength"), ("bending_strength_pa", "strength")):
            if rows[0].get(key) is not None:
                return f"{name} {rows[0][key]:.4g} Pa, largest load {rows[0]['peak_load_n']:.4g} N"
        if rows[0].get("fracture_energy_j_m2") is not None:
            return f"fracture energy {rows[0]['fracture_energy_j_m2']:.4g} J/m2, largest load {rows[0]['peak_load_n']:.4g} N"
        points = rows[0].get("points") or []
        for key in ("modulus_pa", "secant_pa", "compliance_1_pa", "stress_pa"):
            ends = [p for p in points if p.get(key) is not None]
            if ends:
                return " to ".join(f"{key} {p[key]:.4g} at {p['time_s']:g} s" for p in (ends[0], ends[-1]))
        return "no results"
