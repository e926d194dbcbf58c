# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the report: reads the folders, adds every section and writes one file."""

from __future__ import annotations

import datetime
import platform
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from macadam._files import write_text
from macadam.report import contacts, cracks, decisions, fields, fits, histories, look, loops, methods, mixture, modulus, scans, specimen
from macadam.report import view as views
from macadam.report.export import Export
from macadam.report.folders import Folder, ReportError, modulus_symbol, read_all
from macadam.report.page import Page

_KINDS = {
    "run": "run",
    "calibration": "calibration",
    "fit": "contact law",
    "scan": "segmented scan",
    "phantom": "synthetic scan",
    "twin": "specimen of a scan",
    "shapes": "library of shapes",
}


def report(
    dirs: str | Path | Iterable[str | Path],
    out: str | Path,
    title: str | None = None,
    *,
    figures: str | Path | None = None,
    scene: str | None = None,
    view: bool = False,
) -> Path:
    """Writes one self-contained HTML file about the contents of the result folders.

    dirs: one folder, or several, which are shown side by side. out: the file; its folder is made if needed. title:
    title of the page. figures: a folder into which each figure is written too, as SVG, PDF, PNG of 1,800 pixels and, if it
    has curves, CSV. scene: the text of the scene of a single folder; without it, the scene's file is read if it is found.
    view: also write a view in three dimensions of each specimen beside `out`, in `<out>-3d.html`; it needs the package
    k3d. Returns the file. Raises ReportError if a folder is not a results folder, if a file in it cannot be read, or if
    the package for the view is missing."""
    folders = read_all([dirs] if isinstance(dirs, (str, Path)) else list(dirs))
    if scene is not None and len(folders) == 1:
        folders[0].scene_text = scene
    if view:
        views.require_package()
    export = None if figures is None else Export(Path(figures))
    with look.style():
        page = _page(folders, export, Path(out) if view else None)
    if export:
        export.write_captions()
    return write(page, out, title or _title(folders), _subtitle(folders))


# Returns the page with the sections of all modules. A section without content is not shown. beside: the file of the page,
# if views in three dimensions are written beside it.
def _page(folders: list[Folder], export: Export | None = None, beside: Path | None = None) -> Page:
    page = Page(len(folders) > 1, export)
    _overview(page, folders)
    mixture.add(page, folders)
    specimen.add(page, folders)
    if beside is not None:
        views.add(page, folders, beside)
    modulus.add(page, folders)
    loops.add(page, folders)
    histories.add(page, folders)
    cracks.add(page, folders)
    fields.add(page, folders)
    contacts.add(page, folders)
    fits.add(page, folders)
    scans.add(page, folders)
    decisions.add_decisions(page, folders)
    decisions.add_run(page, folders)
    methods.add(page, folders)
    if page.left_out:
        page.section("Left out of this report")
        page.table(["folder", "what", "why"], page.left_out, words=3)
    return page


def write(page: Page, out: str | Path, title: str, subtitle: str) -> Path:
    """Writes the page to a file, its companions beside it, and returns the file. After an error there is no incomplete
    file. Raises ReportError if `out` is a folder."""
    out = Path(out)
    if out.is_dir():
        raise ReportError(f"{out}: found a folder, expected the name of a file")
    out.parent.mkdir(parents=True, exist_ok=True)
    import matplotlib

    now = datetime.datetime.now().astimezone()
    foot = (
        f"Written {now:%Y-%m-%d %H:%M %Z} on {platform.node()}, {platform.system()} {platform.machine()}, "
        f"Python {platform.python_version()}, matplotlib {matplotlib.__version__}. This file needs no other files."
    )
    for name, text in page.companions.items():
        write_text(out.with_name(name), text)
    write_text(out, page.html(title, subtitle, foot))
    return out


def _title(folders: list[Folder]) -> str:
    return (
        _name(folders[0])
        if len(folders) == 1
        else " · ".join(f.label for f in folders[:4]) + (" …" if len(folders) > 4 else "")
    )


def _name(folder: Folder) -> str:
    """Returns the name of the scene's file or, if the file is called scene.toml, the name of the folder that contains
    the file. If the result folder names no scene, returns the label of the result folder."""
    scene = Path(str(folder.summary.get("scene") or ""))
    name = scene.parent.name if scene.stem == "scene" else scene.stem
    return name or folder.label


def _subtitle(folders: list[Folder]) -> str:
    versions = sorted({str(f.summary["macadam"]) for f in folders if f.summary.get("macadam")})
    by = f", macadam {', '.join(versions)}" if versions else ""
    return (
        f"Report of {len(folders)} result folders side by side{by}."
        if len(folders) > 1
        else f"Report of a {_KINDS[folders[0].kind]}{by}."
    )


# Adds warnings, and sentences about a single folder or a table of several.
def _overview(page: Page, folders: list[Folder]) -> None:
    page.section("In short")
    decisions.add_warnings(page, folders)
    if len(folders) == 1:
        for words in _summary_sentences(folders[0]):
            page.text(words, "lead")
        return
    page.table(
        ["folder", "what", "status", "found"],
        [[f.label, _test_or_kind(f), f.summary.get("status", "done"), _main_results(f)] for f in folders],
        words=4,
    )


# Returns the kind of the folder, or the test of a run, for the table of several folders.
def _test_or_kind(f: Folder) -> str:
    if f.kind != "run":
        return _KINDS[f.kind]
    if f.summary["status"] == "prepared":
        return "specimen alone"
    return f.in_time["kind"] if f.in_time else f"{modulus_symbol([f])} by method {(f.summary.get('solver') or {}).get('method', '–')}"


# Returns the most important results of a folder on one line; a dash if the folder has no results.
def _main_results(f: Folder) -> str:
    if f.by_frequency:
        rows = sorted(f.by_frequency, key=lambda r: (r.get("temperature_c") or 0, r["frequency_hz"]))
        return "; ".join(_point(r) for r in ([rows[0]] if len(rows) == 1 else [rows[0], rows[-1]]))
    if f.in_time:
        points = f.in_time.get("points") or []
        if text := _strength(f):
            return text
        if f.in_time.get("broke") is False:
            stress, at = f.in_time["largest_stress_pa"], f.in_time["temperature_at_largest_stress_c"]
            return f"not broken; largest thermal stress {look.modulus(stress)} at {look.number(at, 3)} °C"
        key = f.modulus_column
        if points and key:
            return "; ".join(f"{look.modulus(p[key])} at {look.seconds(p['time_s'])}" for p in (points[0], points[-1]))
        return (
            f"strain of {look.number(1e6 * max((p['strain'] for p in points), key=abs), 3)} µm/m at most"
            if points
            else "–"
        )
    if fits.main_result(f):
        return fits.main_result(f)
    if f.kind == "run" and f.summary.get("particles"):
        return f"{look.number(f.summary['particles'])} particles"
    return "–"


# Returns |E*| and phase angle at one frequency as text.
def _point(r: dict[str, Any]) -> str:
    t = r.get("temperature_c")
    return (
        f"{look.modulus(r['e_star_pa'])}, {look.number(float(r['phase_deg']), 3)}° at {look.hertz(r['frequency_hz'])}"
        + ("" if t is None else f", {t:g} °C")
    )


# Names and units of the results of discs, half discs and beams that were loaded until they failed.
_STANDARD_RESULTS = (
    ("indirect_tensile_strength_pa", "indirect tensile strength", 1e-6, "MPa"),
    ("bending_strength_pa", "bending strength", 1e-6, "MPa"),
    ("fracture_toughness_pa_sqrt_m", "fracture toughness", 1e-6, "MPa √m"),
    ("fracture_energy_j_m2", "fracture energy", 1, "J/m²"),
    ("ct_index", "CT index", 1, ""),
    ("flexibility_index", "flexibility index", 1, ""),
)


def _strength(f: Folder) -> str:
    """Returns the strength of a specimen that broke, with the results of the standard of its test, or with the strain at
    the peak and the work of fracture; empty if no strength was reached."""
    standard = [
        f"{name} {look.number(factor * f.in_time[key], 3)} {unit}".strip()
        for key, name, factor, unit in _STANDARD_RESULTS
        if f.in_time.get(key) is not None
    ]
    if standard:
        load, moved = 1e-3 * f.in_time["peak_load_n"], 1e3 * f.in_time["displacement_at_peak_m"]
        return ", ".join(standard) + f"; largest load {look.number(load, 3)} kN at {look.number(moved, 3)} mm"
    if f.in_time.get("broke"):
        stress, at = f.in_time["fracture_stress_pa"], f.in_time["fracture_temperature_c"]
        return f"fracture at {look.number(at, 3)} °C under a thermal stress of {look.modulus(stress)}"
    if f.in_time.get("strength_pa") is None:
        return ""
    stress, strain = f.in_time["strength_pa"], f.in_time["strain_at_peak"]
    words = f"strength of {look.modulus(stress)} at a strain of {look.number(1e6 * strain, 3)} µm/m"
    work, box = f.in_time.get("work_of_fracture_j"), f.summary.get("box_m")
    if work is None:
        return words
    words += f", work of fracture {look.number(1e3 * work, 3)} mJ"
    return words + (f" ({look.number(work / (box[0] * box[1]), 3)} J/m² of the section)" if box else "")


def _broken(result: dict[str, Any]) -> str:
    """Returns a sentence that says how many contact points broke, by pair; empty if no law can break. `result` contains
    the `cracks` of a test or of one frequency."""
    pairs = {pair: c for pair, c in (result.get("cracks") or {}).items() if c["points"]}
    if "cracks" not in result:
        return ""
    if not pairs:
        return "No contact point is broken."
    each = "; ".join(
        f"{pair} {look.number(c['points'])} of {look.number(c['breakable_points'])} ({look.number(c['tension'])} in tension, "
        f"{look.number(c['shear'])} in shear), the first at {look.seconds(c['first_s'])}"
        for pair, c in pairs.items()
    )
    return f"Broken contact points: {each}."


# Returns the sentences that summarise one folder.
def _summary_sentences(f: Folder) -> list[str]:
    s, words = f.summary, []
    if f.in_time and (text := _strength(f)):  # not capitalize(), which would change the units to "kpa"
        words.append(text[:1].upper() + text[1:] + ".")
    if f.kind == "run":
        edges = s.get("box_m") or []
        size = " × ".join(map(look.length, edges)) + " mm"
        if (s.get("domain") or {}).get("shape") == "cylinder":
            size = f"{look.length(edges[0])} mm in diameter and {look.length(edges[2])} mm in height"
        contacts_of = sum(v or 0 for v in (s.get("contacts") or {}).values())
        words.append(
            f"A specimen of {size} with {look.number(s.get('particles'))} particles and "
            f"{look.number(contacts_of)} contacts."
        )
    if f.by_frequency:
        rows = sorted(f.by_frequency, key=lambda r: (r.get("temperature_c") or 0, r["frequency_hz"]))
        ends = [rows[0]] if len(rows) == 1 else [rows[0], rows[-1]]
        words.append(f"Its {modulus_symbol([f])} and phase angle are {' and '.join(_point(r) for r in ends)}.")
    elif f.in_time:
        words.append(f"Test: {f.in_time['kind']}. Results: {_main_results(f)}.")
        rupture = (f.in_time.get("rupture") or {}).get("words")
        if rupture and rupture not in (s.get("warnings") or []):  # a warning is shown already
            words.append(rupture)
        words += [w for w in [_broken(f.summary)] if w]
    elif f.kind == "run" and not f.results:
        words.append("The folder holds the specimen and its contacts; no test was run in it.")
    elif f.kind == "run":
        words.append("The specimen broke at every frequency, so no modulus was measured.")
    elif fits.main_result(f):
        words.append(f"Result: {fits.main_result(f)}.")
    else:
        words.append(f"The folder holds a {_KINDS[f.kind]}.")
    by_frequency = [r for r in f.results if "frequency_hz" in r and "cracks" in r]
    words += [f"At {look.hertz(r['frequency_hz'])}: {_broken(r)}" for r in by_frequency]
    return words
