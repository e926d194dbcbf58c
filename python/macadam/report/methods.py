# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report for a paper: a paragraph on the methods, the constants of the contact laws, the scene's text, and
what to cite."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from macadam.report import look
from macadam.report.folders import Folder, modulus_symbol
from macadam.report.page import Page

MOST = 3  # largest number of different scenes that are printed
_CITE = (
    "Cite Macadam with its version, and for the model the article “Effect of aggregate shape representation and "
    "deformability on the bituminous mixture stiffness properties using 3D DEM modelling”."
)
_LOADING = {  # the words for each `modulus` of summary.json that is not uniaxial
    "indirect_tension": "cyclic indirect tension, with the closed form of Hondros,",
    "bending": "cyclic bending, with the theory of Timoshenko beams,",
    "torsion": "cyclic torsion of a cylinder between glued platens,",
}


def add(page: Page, folders: list[Folder]) -> None:
    """Adds the section for all runs. Runs of one scene with several seeds have one paragraph."""
    runs = [f for f in folders if f.kind == "run" and f.summary.get("particles")]
    if not runs:
        return
    page.section("Methods, for a paper")
    for group in _groups(runs):
        words = " ".join(paragraph(group))
        page.text(words if len(runs) == len(group) else f"{', '.join(f.label for f in group)}: {words}")
    page.text(_CITE)
    scenes = {}
    for f in runs:
        text, source = scene_of(f)
        if text is None:
            page.leave_out(f.label, "laws and scene", source)
        else:
            scenes.setdefault(text, source)
    for text, source in list(scenes.items())[:MOST]:
        _add_scene(page, text, source)
    for source in list(scenes.values())[MOST:]:
        page.leave_out(source, "laws and scene", f"only the first {MOST} scenes are shown")


def _groups(runs: list[Folder]) -> list[list[Folder]]:
    """Returns the runs in groups that differ only in their seeds."""
    found: dict[tuple[Any, ...], list[Folder]] = {}
    for f in runs:
        s = f.summary
        key = (s.get("scene"), str(s.get("box_m")), (s.get("solver") or {}).get("description"), str(_test(f)))
        found.setdefault(key, []).append(f)
    return list(found.values())


def paragraph(group: list[Folder]) -> list[str]:
    """Returns the sentences on runs that differ only in their seeds."""
    s = group[0].summary
    number = _span([f.summary["particles"] for f in group])
    contacts = _span([sum(v or 0 for v in (f.summary.get("contacts") or {}).values()) for f in group])
    seeds = [f.summary.get("specimen", {}).get("seed") for f in group]
    edges = " × ".join(map(look.length, s.get("box_m") or []))
    shape = (s.get("domain") or {}).get("shape", "box").replace("_", " ")
    words = [
        f"The computations were made with Macadam {s.get('macadam', '(version not recorded)')}.",
        f"{'The specimen' if len(group) == 1 else f'Each of the {len(group)} specimens'}"
        f"{f' is a {shape}' if shape in ('box', 'beam') else f' is a {shape} within a box'} of {edges} mm with {number} particles"
        + (f" (seed {', '.join(map(str, seeds))})" if None not in seeds else "")
        + f", whose Laguerre cells meet in {contacts} contacts.",
    ]
    fractions = s.get("volume_fractions") or {}
    parts = [f"{look.percent(fractions[k + '_cells'])} {name}" for k, name in
             (("aggregate", "aggregate"), ("mastic", "mastic"), ("void", "air voids")) if fractions.get(k + "_cells")]
    if parts:
        words.append(f"By volume of the cells it is {', '.join(parts)}{' (first specimen)' if len(group) > 1 else ''}.")
    words += [w for w in (_test(group[0]), _method(s)) if w]
    return words


def _span(values: list[int]) -> str:
    low, high = min(values), max(values)
    return look.number(low) if low == high else f"{look.number(low)} to {look.number(high)}"


def _test(f: Folder) -> str:
    """Returns a sentence on the test; empty if no test was run."""
    if f.by_frequency:
        of = sorted({r["frequency_hz"] for r in f.by_frequency})
        warm = sorted({r["temperature_c"] for r in f.by_frequency if r.get("temperature_c") is not None})
        span = look.hertz(of[0]) if len(of) == 1 else f"{len(of)} frequencies from {look.hertz(of[0])} to {look.hertz(of[-1])}"
        at = f", at {', '.join(f'{t:g}' for t in warm)} °C" if warm else ""
        loading = _LOADING.get(f.by_frequency[0].get("modulus"), "uniaxial cyclic loading")
        return f"{modulus_symbol([f])} and the phase angle were computed in {loading} at {span}{at}."
    if f.in_time and f.in_time.get("points"):
        points = f.in_time["points"]
        return (f"The test is of the kind {f.in_time['kind'].replace('_', ' ')}, with {len(points)} points from {look.seconds(points[0]['time_s'])} "
                f"to {look.seconds(points[-1]['time_s'])}.")
    return ""


def _method(s: dict[str, Any]) -> str:
    solver = s.get("solver") or {}
    method, precision = solver.get("method"), f"in {solver.get('precision', 'double')} precision"
    if method == "harmonic":
        inertia = "with" if solver.get("inertia") else "without"
        return f"The steady state was solved in the frequency domain {inertia} inertia, {precision}."
    if method == "quasi_static":
        return f"The test was followed by increments of equilibrium, without inertia, {precision}."
    if method == "explicit":
        step = "" if not solver.get("dt_s") else f" with a time step of {look.seconds(solver['dt_s'])}"
        scaling = next((r["density_scaling"] for r in s.get("results") or [] if r.get("density_scaling")), None)
        more = f" and all densities multiplied by {look.number(float(scaling), 3)}" if scaling and scaling != 1 else ""
        return f"The motion was integrated in time by a leapfrog scheme{step}{more}, {precision}."
    return ""


def scene_of(f: Folder) -> tuple[str | None, str]:
    """Returns the text of a folder's scene and where it comes from; or None and the reason why it is not known."""
    if f.scene_text is not None:
        return f.scene_text, f"The scene of {f.label}"
    name = f.summary.get("scene")
    if not name:
        return None, "summary.json names no scene"
    changed = f.path / "scene_as_run.toml" if f.summary.get("set") else None
    try:
        text = (changed or Path(name)).read_text(encoding="utf-8")
        tomllib.loads(text)
    except (OSError, ValueError):
        if changed:
            return None, f"{changed} is not there, or is not a scene"
        return None, f"{name} is not there, or is not a scene; run the report in the folder in which the run was started"
    if changed:
        return text, f"{changed.name}: the scene file {name} with the values from --set. Other options of the command are not shown"
    return text, f"The scene file {name}, as it was when this report was written, without options of the command"


def _add_scene(page: Page, text: str, source: str) -> None:
    tables = tomllib.loads(text)
    rows = [[c.get("pair", "–"), c.get("law", "–"), _constants(c, ("pair", "law"))] for c in tables.get("contacts") or []
            if isinstance(c, dict)]
    for name, material in (tables.get("materials") or {}).items():
        if isinstance(material, dict) and "law" in material:
            rows.append([name, material["law"], _constants(material, ("law",))])
    if rows:
        page.table(["pair or material", "law", "constants"], rows, f"{source}: laws, with the constants of the scene (SI units "
                   "unless a unit is given).", words=3)
    page.text(f"{source}:")
    page.preformatted(text)


def _constants(entry: dict[str, Any], without: tuple[str, ...]) -> str:
    return ", ".join(f"{key} = {_value(value)}" for key, value in entry.items() if key not in without)


def _value(value: Any) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, dict):
        return f"({_constants(value, ())})"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
