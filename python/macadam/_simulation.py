# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of a specimen: stepped, or solved without steps; each leaves the folder that the command leaves."""
from __future__ import annotations

import importlib
import json
import shutil
import tempfile
import weakref
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _core
from ._scene import Scene

if TYPE_CHECKING:
    import pandas

SceneLike = _core.Scene | _core.Specimen | Mapping[str, Any] | str | PathLike[str]
SpecimenLike = _core.Specimen | Mapping[str, Any]  # made before, or what is different in the section `specimen` of the scene
Number = float | int | str  # of a scene: SI units, or text with its unit

#: Of [solver], what belongs to the test that is replaced.
_OF_THE_TEST = ("method", "density_scaling", "time_step", "safety", "inertia")
#: Of run(), what the calls of single tests pass on.
_OF_RUN = ("resume", "on_step", "every", "on_plan", "on_warning")


def result_folder(out: str | PathLike[str] | None, owner: Any) -> Path:
    """The folder that was asked for, or one that goes with the object that owns it."""
    if out is not None:
        return Path(out)
    folder = Path(tempfile.mkdtemp(prefix="macadam-"))
    weakref.finalize(owner, shutil.rmtree, folder, ignore_errors=True)
    return folder


class _Outcome(NamedTuple):
    """What a run said, beside its files."""
    text: str
    decisions: list[str]
    skips: list[dict[str, str]]
    warnings: list[str]
    solver: str
    backend: str


class Result:
    """What a test found, and the folder with its files (docs/scene.md lists them).

    `folder` is the one that was asked for, or a temporary one that goes with this object; save() copies it. A pickled
    result holds the files of a temporary folder, and the name of one that was asked for.
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
        """summary.json: everything asked, made and found."""
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8", errors="replace"))

    @cached_property
    def table(self) -> pandas.DataFrame:
        """Of a cyclic test or a sweep, a row a frequency: frequency_hz, e_star_pa [Pa], phase_deg and so on. Of the
        others a row a time: time_s and what the test measures."""
        import pandas
        rows = self.summary["results"]
        if rows and "points" in rows[0]:
            rows = rows[0]["points"]
        return pandas.DataFrame([{k: v for k, v in r.items() if not isinstance(v, (dict, list))} for r in rows])

    @cached_property
    def sensitivities(self) -> pandas.DataFrame:
        """Change of |E*| [Pa] and φ [degrees] per unit of each parameter's natural logarithm, where they were asked for."""
        import pandas
        return pandas.DataFrame([{"frequency_hz": r["frequency_hz"], **s} for r in self.summary["results"]
                                 for s in r.get("sensitivities", [])])

    @cached_property
    def response(self) -> pandas.DataFrame:
        """Of a stepped cyclic test: frequency_hz, time_s, strain, stress_pa. Of the others, table has all there is."""
        return self.csv("response.csv")

    @cached_property
    def prony(self) -> pandas.DataFrame:
        """Of relaxation, creep and monotonic tests without steps: the relaxation modulus as Maxwell units."""
        return self.csv("prony.csv")

    def csv(self, name: str) -> pandas.DataFrame:
        """A table of the folder by its name."""
        import pandas
        file = self.folder / name
        if not file.is_file():
            there = ", ".join(sorted(p.name for p in self.folder.glob("*.csv")))
            raise _core.InputError(f"{file}: found no such file, expected one of {there}")
        return pandas.read_csv(file, comment="#")

    @property
    def specimen(self) -> _core.Specimen:
        """Particles, cells and contacts that were tested."""
        if self._specimen is None:
            self._specimen = _core.prepare(self.scene)
        return self._specimen

    @property
    def decisions(self) -> list[str]:
        """What the scene left open, and what was chosen why."""
        return self._run.decisions

    @property
    def skips(self) -> list[dict[str, str]]:
        """What was left out because the scene does not need it: what, why, effect."""
        return self._run.skips

    @property
    def warnings(self) -> list[str]:
        """What a reader of the results must know."""
        return self._run.warnings

    @property
    def solver(self) -> str:
        """What ran, in words."""
        return self._run.solver

    @property
    def backend(self) -> str:
        """That ran: cpu, cuda or reference."""
        return self._run.backend

    def report(self, file: str | PathLike[str]) -> Path:
        """Writes a report of the folder, one HTML file: `macadam report`."""
        importlib.import_module("macadam.report").report(self.folder, file)
        return Path(file)

    def save(self, folder: str | PathLike[str]) -> Path:
        """Copies the folder."""
        return Path(shutil.copytree(self.folder, folder, dirs_exist_ok=True))

    def __str__(self) -> str:
        return self._run.text

    def __repr__(self) -> str:
        return f"<macadam.Result {self.scene.kind}, {self.solver}, {self.folder}>"


def _scene_and_specimen(scene: SceneLike, specimen: SpecimenLike | None,
                        overrides: dict[str, Any] | None = None) -> tuple[Scene, _core.Specimen | None]:
    """The scene, and the specimen that was made before; a section `specimen` becomes one of the overrides."""
    overrides = {} if overrides is None else overrides
    made = scene if isinstance(scene, _core.Specimen) else None
    if isinstance(specimen, _core.Specimen):
        made = specimen
    elif isinstance(specimen, Mapping):
        overrides["specimen"] = specimen
    elif specimen is not None:
        raise _core.InputError(f"specimen: found {specimen!r}, expected a Specimen, or a dictionary of keys of the scene's "
                               "section specimen")
    other = [k for k, v in overrides.items() if k.split(".")[0] == "specimen" or k == "seed" and v is not None]
    if made is not None and other:
        raise _core.InputError(f"{other[0]}: found another value beside a Specimen, which is not made anew; expected a scene "
                               "in place of the Specimen")
    if isinstance(scene, _core.Specimen):
        return Scene(scene.scene), made
    return scene if isinstance(scene, Scene) else Scene(scene), made


def run(scene: SceneLike, *, out: str | PathLike[str] | None = None, specimen: SpecimenLike | None = None,
        resume: bool = False, on_step: Callable[[_core.Step], object] | None = None, every: int = 1000,
        progress: Callable[[str, float], object] | None = None,
        on_plan: Callable[[list[str]], object] | None = None, on_warning: Callable[[str], object] | None = None,
        **overrides: Any) -> Result:
    """Runs a scene's test: `macadam run`.

    scene: a Scene, file or dictionary, or a Specimen, which is then not made anew.
    out: the folder of the results; a temporary one where it is not given.
    specimen: a Specimen of the same scene, made before; or a dictionary, what is different in the scene's section `specimen`.
    resume: go on from the checkpoint that an interrupted run left in `out`.
    on_step: called after every `every` steps of a stepped test with a Step: its time [s], strain, stress_pa [Pa] …
    progress: called with what is being done and the share of it that is done, 0 to 1.
    on_plan: called with the decisions before the first step; on_warning: with each warning at once.
    overrides: as Scene has them, in SI units or text with a unit: `backend="cuda"`, `method="harmonic"`, `threads=4`, `loading={"cycles": 3}` …

    Ctrl-C ends a stepped test with a checkpoint in `out`, and raises KeyboardInterrupt that says so. What a callback
    raises ends the test likewise.
    """
    given, made = _scene_and_specimen(scene, specimen, overrides)
    if overrides:
        given = Scene(given, **overrides)
    return Result(given, made, **_checked({"out": out, "resume": resume, "on_step": on_step, "every": every,
                                           "progress": progress, "on_plan": on_plan, "on_warning": on_warning}))


def _test(scene: SceneLike, specimen: SpecimenLike | None, loading: dict[str, Any], overrides: dict[str, Any],
          method: str = "harmonic", **call: Any) -> Result:
    """Another test of a scene. Calls have what run() has; `overrides` may too."""
    given, made = _scene_and_specimen(scene, specimen, overrides)
    tables = given.as_dict()
    tables["loading"] = {name: value for name, value in loading.items() if value is not None}
    solver = {k: v for k, v in tables.get("solver", {}).items() if k not in _OF_THE_TEST}
    if method != "harmonic":
        solver.pop("tolerance", None)  # of the scene's own test: refused here, where nothing predicts the error
    tables["solver"] = {**solver, "method": method}
    options = {**given.options, "method": None}
    call |= {name: overrides[name] for name in _OF_RUN if name in overrides}
    other = Scene(tables, file=given.file,
                  **{**options, **{name: value for name, value in overrides.items() if name not in _OF_RUN}})
    return Result(other, made, **_checked(call))


def _several(numbers: Sequence[Number] | Number) -> Any:
    """A list of one number; an array or a list as it is."""
    return [numbers] if isinstance(numbers, str) or not hasattr(numbers, "__len__") else numbers


def _checked(call: dict[str, Any]) -> dict[str, Any]:
    if call.get("resume") and call.get("out") is None:
        raise _core.InputError("resume: found no out, expected the folder of the interrupted run")
    return call


def harmonic(scene: SceneLike, frequencies: Sequence[Number] | Number | None = None, *,
             specimen: SpecimenLike | None = None, temperatures: Sequence[Number] | None = None, inertia: bool | None = None, sensitivities: bool | None = None,
             out: str | PathLike[str] | None = None, progress: Callable[[str, float], object] | None = None,
             **overrides: Any) -> Result:
    """|E*| and φ as the steady state of the frequency domain: `macadam run --method harmonic`.

    frequencies: [Hz]; the scene's where they are not given.
    temperatures: [°C], every frequency at each; laws need shift keys then.
    inertia: include the particles' inertia.
    sensitivities: derivatives by every parameter of the laws, in `sensitivities` of the result.
    Others as run() has them.
    """
    changed: dict[str, Any] = dict(overrides)
    given, made = _scene_and_specimen(scene, specimen, changed)
    if sensitivities is not None:
        changed["output.sensitivities"] = sensitivities
    if inertia is not None:
        changed["solver.inertia"] = inertia
        changed["solver.method"] = "harmonic"
    if frequencies is None and temperatures is None:
        changed.setdefault("method", "harmonic")
        return Result(Scene(given, **changed), made, out, progress=progress)
    before = given.as_dict()["loading"]
    loading = {"kind": "cyclic", "frequencies": before.get("frequencies") if frequencies is None else _several(frequencies),
               "temperatures": before.get("temperatures") if temperatures is None else temperatures}
    if before.get("kind") == "cyclic":
        loading["strain_amplitude"] = before.get("strain_amplitude")
    return _test(given, made, loading, changed, out=out, progress=progress)


def sweep(scene: SceneLike, *, frequencies: Sequence[Number], points_per_decade: int | None = None,
          points: int | None = None, temperatures: Sequence[Number] | None = None,
          specimen: SpecimenLike | None = None, out: str | PathLike[str] | None = None,
          progress: Callable[[str, float], object] | None = None, **overrides: Any) -> Result:
    """The complex modulus over frequencies [Hz] and temperatures [°C]: `kind = "sweep"` (docs/relaxation.md).

    frequencies: a list, or, with points_per_decade or points, the two ends of a range.
    """
    loading = {"kind": "sweep", "frequencies": frequencies, "points_per_decade": points_per_decade, "points": points,
               "temperatures": temperatures}
    return _test(scene, specimen, loading, overrides, out=out, progress=progress)


def relaxation(scene: SceneLike, *, times: Sequence[Number], points_per_decade: int | None = None,
               points: int | None = None, strain: Number | None = None, ramp: Number | None = None,
               poisson_ratio: float | None = None, method: str = "harmonic", specimen: SpecimenLike | None = None,
               out: str | PathLike[str] | None = None, progress: Callable[[str, float], object] | None = None,
               **overrides: Any) -> Result:
    """Stress under a strain that is held: `kind = "relaxation"` (docs/relaxation.md).

    times: [s] from the beginning of the ramp, or, with points_per_decade or points, the two ends of a range.
    strain: that is held; ramp: over which it grows [s], 0: at once.
    poisson_ratio: for the tables of finite-element programs.
    method: "harmonic", without a time step, or "explicit", stepped; then on_step, every, resume and so on too.
    overrides: as run() has them: `**{"solver.density_scaling": 100}` …
    """
    loading = {"kind": "relaxation", "times": times, "points_per_decade": points_per_decade, "points": points,
               "strain": strain, "ramp": ramp, "poisson_ratio": poisson_ratio}
    return _test(scene, specimen, loading, overrides, method, out=out, progress=progress)


def creep(scene: SceneLike, *, stress: Number, times: Sequence[Number], points_per_decade: int | None = None,
          points: int | None = None, ramp: Number | None = None, release: Number | None = None,
          platen_mass: Number | None = None, poisson_ratio: float | None = None, method: str = "harmonic",
          specimen: SpecimenLike | None = None, out: str | PathLike[str] | None = None,
          progress: Callable[[str, float], object] | None = None, **overrides: Any) -> Result:
    """Strain under a stress [Pa] that is held, and taken off from `release` [s] on: `kind = "creep"` (docs/relaxation.md).

    platen_mass: of the loaded top wall [kg], of method "explicit".
    times, points_per_decade, points, ramp, poisson_ratio, method, overrides: as relaxation() has them.
    """
    loading = {"kind": "creep", "stress": stress, "times": times, "points_per_decade": points_per_decade,
               "points": points, "ramp": ramp, "release": release, "platen_mass": platen_mass,
               "poisson_ratio": poisson_ratio}
    return _test(scene, specimen, loading, overrides, method, out=out, progress=progress)


def monotonic(scene: SceneLike, *, rate: Number, times: Sequence[Number] | None = None,
              points_per_decade: int | None = None, points: int | None = None, strain: Number | None = None,
              poisson_ratio: float | None = None, method: str = "harmonic", specimen: SpecimenLike | None = None,
              out: str | PathLike[str] | None = None, progress: Callable[[str, float], object] | None = None,
              **overrides: Any) -> Result:
    """Stress under a constant rate of strain [1/s], tension positive: `kind = "monotonic"` (docs/relaxation.md).

    strain: at which the test ends, in place of times. points: even distances of time.
    times, points_per_decade, poisson_ratio, method, overrides: as relaxation() has them.
    """
    loading = {"kind": "monotonic", "rate": rate, "times": times, "points_per_decade": points_per_decade,
               "points": points, "strain": strain, "poisson_ratio": poisson_ratio}
    return _test(scene, specimen, loading, overrides, method, out=out, progress=progress)
