# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs tests of a specimen, stepped in time or solved without steps. Each writes the same folder as the command."""
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any

from . import _core
from ._result import Result
from ._result import result_folder as result_folder
from ._scene import Scene

SceneLike = _core.Scene | _core.Specimen | Mapping[str, Any] | str | PathLike[str]
# a specimen made before, or changed keys of the scene's section `specimen`
SpecimenLike = _core.Specimen | Mapping[str, Any]
Number = float | int | str  # a value of a scene: in SI units, or text with its unit

#: Keys of [solver] that belong to the scene's own test and are removed when another test replaces it.
_OF_THE_TEST = ("method", "density_scaling", "time_step", "safety", "inertia")
#: Arguments of run() that the functions of single tests accept too and pass on.
_OF_RUN = ("resume", "on_step", "every", "on_plan", "on_warning")


def _scene_and_specimen(scene: SceneLike, specimen: SpecimenLike | None,
                        overrides: dict[str, Any] | None = None) -> tuple[Scene, _core.Specimen | None]:
    """Returns the scene, and the specimen if the caller has made one before. If `specimen` is a dictionary of keys,
    puts the dictionary into `overrides` as the section `specimen`."""
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
        raise _core.InputError(f"{other[0]}: found a value together with a Specimen, expected no value, because the "
                               "particles of a Specimen cannot be changed")
    if isinstance(scene, _core.Specimen):
        return Scene(scene.scene), made
    return scene if isinstance(scene, Scene) else Scene(scene), made


def run(scene: SceneLike, *, out: str | PathLike[str] | None = None, specimen: SpecimenLike | None = None,
        resume: bool = False, on_step: Callable[[_core.Step], object] | None = None, every: int = 1000,
        progress: Callable[[str, float], object] | None = None,
        on_plan: Callable[[list[str]], object] | None = None, on_warning: Callable[[str], object] | None = None,
        **overrides: Any) -> Result:
    """Runs a scene's test: `macadam run`.

    scene: a Scene, file or dictionary, or a Specimen, which is then used as it is.
    out: the folder of the results; a temporary one if it is not given.
    specimen: a Specimen of the same scene, made before; or a dictionary with the changed keys of the section
    `specimen`.
    resume: continue from the checkpoint that an interrupted run left in `out`.
    on_step: called after every `every` steps of a stepped test with a Step: its time [s], strain, stress_pa [Pa] …
    progress: called with the name of the current stage and the fraction of it that is done, 0 to 1.
    on_plan: called with the decisions before the first step; on_warning: called with each warning as soon as it occurs.
    overrides: as for Scene, in SI units or text with a unit: `backend="cuda"`, `method="harmonic"`, `threads=4`,
    `loading={"cycles": 3}` …

    Ctrl-C ends a stepped test with a checkpoint in `out` and raises KeyboardInterrupt, whose message says so. An
    exception in a callback ends the test in the same way and is raised again.
    """
    given, made = _scene_and_specimen(scene, specimen, overrides)
    if overrides:
        given = Scene(given, **overrides)
    return Result(given, made, **_require_folder_to_resume({"out": out, "resume": resume, "on_step": on_step, "every": every,
                                           "progress": progress, "on_plan": on_plan, "on_warning": on_warning}))


def _test(scene: SceneLike, specimen: SpecimenLike | None, loading: dict[str, Any], overrides: dict[str, Any],
          method: str = "harmonic", **call: Any) -> Result:
    """Runs a test that replaces the scene's own test. loading: the new section [loading]. call: arguments for run();
    `overrides` may contain arguments for run() too."""
    given, made = _scene_and_specimen(scene, specimen, overrides)
    tables = given.as_dict()
    tables["loading"] = {name: value for name, value in loading.items() if value is not None}
    solver = {k: v for k, v in tables.get("solver", {}).items() if k not in _OF_THE_TEST}
    if method != "harmonic":
        # the scene's tolerance is removed: it would be refused, because the program cannot predict the error of a
        # stepped test of this kind
        solver.pop("tolerance", None)
    tables["solver"] = {**solver, "method": method}
    options = {**given.options, "method": None}
    call |= {name: overrides[name] for name in _OF_RUN if name in overrides}
    other = Scene(tables, file=given.file,
                  **{**options, **{name: value for name, value in overrides.items() if name not in _OF_RUN}})
    return Result(other, made, **_require_folder_to_resume(call))


def test(scene: SceneLike, kind: str, loading: Mapping[str, Any], *, method: str = "harmonic",
         specimen: SpecimenLike | None = None, out: str | PathLike[str] | None = None,
         progress: Callable[[str, float], object] | None = None, **overrides: Any) -> Result:
    """Runs a test of any kind of experiments() instead of the scene's own test.

    kind: `kind` in [loading]. loading: the other keys of [loading], in SI units or text with a unit (docs/scene.md).
    method: "harmonic", without time steps, or "explicit", stepped in time. overrides: as for run(). Raises InputError
    for another kind.
    """
    kinds = [experiment["kind"] for experiment in _core.experiments()]
    if kind not in kinds:
        raise _core.InputError(f"kind: found {kind!r}, expected one of {', '.join(kinds)}")
    return _test(scene, specimen, {**loading, "kind": kind}, overrides, method, out=out, progress=progress)


def _as_list(numbers: Sequence[Number] | Number) -> Any:
    """Returns a single number as a list, and a list or an array unchanged."""
    return [numbers] if isinstance(numbers, str) or not hasattr(numbers, "__len__") else numbers


# Returns the arguments unchanged. Raises InputError for `resume` without `out`.
def _require_folder_to_resume(call: dict[str, Any]) -> dict[str, Any]:
    if call.get("resume") and call.get("out") is None:
        raise _core.InputError("resume: found no value of out, expected the folder of the interrupted run")
    return call


def harmonic(scene: SceneLike, frequencies: Sequence[Number] | Number | None = None, *,
             specimen: SpecimenLike | None = None, temperatures: Sequence[Number] | None = None,
             inertia: bool | None = None, sensitivities: bool | None = None,
             out: str | PathLike[str] | None = None, progress: Callable[[str, float], object] | None = None,
             **overrides: Any) -> Result:
    """Computes |E*| and φ as the steady state in the frequency domain: `macadam run --method harmonic`.

    frequencies: [Hz]; those of the scene if they are not given.
    temperatures: [°C]; every frequency is computed at each of them. The laws need keys of a temperature shift then.
    inertia: include the particles' inertia.
    sensitivities: compute derivatives with respect to every parameter of the laws, in `sensitivities` of the result.
    The other arguments are those of run().

        >>> import macadam as mc
        >>> result = mc.harmonic("examples/demo/scene.toml", [1, 10], specimen={"box": ["12 mm", "12 mm", "15 mm"]})
        >>> result.table.frequency_hz.tolist(), bool(result.table.e_star_pa.is_monotonic_increasing)
        ([1.0, 10.0], True)
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
    loading = {"kind": "cyclic", "frequencies": before.get("frequencies") if frequencies is None else _as_list(frequencies),
               "temperatures": before.get("temperatures") if temperatures is None else temperatures}
    if before.get("kind") == "cyclic":
        loading["strain_amplitude"] = before.get("strain_amplitude")
    return _test(given, made, loading, changed, out=out, progress=progress)


def sweep(scene: SceneLike, *, frequencies: Sequence[Number], points_per_decade: int | None = None,
          points: int | None = None, temperatures: Sequence[Number] | None = None,
          specimen: SpecimenLike | None = None, out: str | PathLike[str] | None = None,
          progress: Callable[[str, float], object] | None = None, **overrides: Any) -> Result:
    """Computes the complex modulus over frequencies [Hz] and temperatures [°C]: `kind = "sweep"` (docs/relaxation.md).

    frequencies: a list, or, if points_per_decade or points is given, the two ends of a range.

        >>> import macadam as mc
        >>> result = mc.sweep("examples/demo/scene.toml", frequencies=[0.1, 10], points_per_decade=1,
        ...                   specimen={"box": ["12 mm", "12 mm", "15 mm"]})
        >>> result.table.frequency_hz.round(6).tolist(), bool(result.table.e_star_pa.is_monotonic_increasing)
        ([0.1, 1.0, 10.0], True)
    """
    loading = {"kind": "sweep", "frequencies": frequencies, "points_per_decade": points_per_decade, "points": points,
               "temperatures": temperatures}
    return _test(scene, specimen, loading, overrides, out=out, progress=progress)


def relaxation(scene: SceneLike, *, times: Sequence[Number], points_per_decade: int | None = None,
               points: int | None = None, strain: Number | None = None, ramp: Number | None = None,
               poisson_ratio: float | None = None, method: str = "harmonic", specimen: SpecimenLike | None = None,
               out: str | PathLike[str] | None = None, progress: Callable[[str, float], object] | None = None,
               **overrides: Any) -> Result:
    """Computes the stress under a constant strain: `kind = "relaxation"` (docs/relaxation.md).

    times: [s] from the beginning of the ramp; if points_per_decade or points is given, the two ends of a range.
    strain: the strain that is held. ramp: the time over which the strain grows [s]; 0: it is applied at once.
    poisson_ratio: for the tables of finite-element programs.
    method: "harmonic", without time steps, or "explicit", stepped in time; on_step, every, resume and so on are then
    allowed too. overrides: as for run(): `**{"solver.density_scaling": 100}` …

        >>> import macadam as mc
        >>> result = mc.relaxation("examples/demo/scene.toml", times=[0.01, 1, 100], specimen={"box": ["12 mm", "12 mm", "15 mm"]})
        >>> result.table.time_s.tolist(), bool(result.table.modulus_pa.is_monotonic_decreasing)
        ([0.01, 1.0, 100.0], True)
    """
    loading = {"kind": "relaxation", "times": times, "points_per_decade": points_per_decade, "points": points,
               "strain": strain, "ramp": ramp, "poisson_ratio": poisson_ratio}
    return _test(scene, specimen, loading, overrides, method, out=out, progress=progress)


def creep(scene: SceneLike, *, stress: Number, times: Sequence[Number], points_per_decade: int | None = None,
          points: int | None = None, ramp: Number | None = None, release: Number | None = None,
          platen_mass: Number | None = None, poisson_ratio: float | None = None, method: str = "harmonic",
          specimen: SpecimenLike | None = None, out: str | PathLike[str] | None = None,
          progress: Callable[[str, float], object] | None = None, **overrides: Any) -> Result:
    """Computes the strain under a constant stress [Pa], which is removed at `release` [s]: `kind = "creep"`
    (docs/relaxation.md).

    platen_mass: mass of the loaded top wall [kg], for method "explicit".
    times, points_per_decade, points, ramp, poisson_ratio, method, overrides: as for relaxation().

        >>> import macadam as mc
        >>> result = mc.creep("examples/demo/scene.toml", stress="0.1 MPa", times=[0.01, 1], specimen={"box": ["12 mm", "12 mm", "15 mm"]})
        >>> result.table.time_s.tolist(), bool(result.table.strain.is_monotonic_increasing)
        ([0.01, 1.0], True)
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
    """Computes the stress under a constant strain rate [1/s], tension positive: `kind = "monotonic"`
    (docs/relaxation.md).

    strain: the strain at which the test ends, in place of times. points: number of evenly spaced times.
    times, points_per_decade, poisson_ratio, method, overrides: as for relaxation().

        >>> import macadam as mc
        >>> result = mc.monotonic("examples/demo/scene.toml", rate=1e-5, times=[1, 10], specimen={"box": ["12 mm", "12 mm", "15 mm"]})
        >>> result.table.strain.tolist(), bool(result.table.stress_pa.is_monotonic_increasing)
        ([1e-05, 0.0001], True)
    """
    loading = {"kind": "monotonic", "rate": rate, "times": times, "points_per_decade": points_per_decade,
               "points": points, "strain": strain, "poisson_ratio": poisson_ratio}
    return _test(scene, specimen, loading, overrides, method, out=out, progress=progress)
