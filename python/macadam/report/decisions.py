# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report on the run: the program's decisions and skips with their reasons, its warnings, wall times,
version and machine."""

from __future__ import annotations

from html import escape
from typing import Any

from macadam.report import look
from macadam.report.folders import Folder
from macadam.report.page import Page, facts, points

_TIMES = {
    "specimen": "making the specimen",
    "tessellation": "cells",
    "network": "contacts",
    "planning": "settings and step",
    "preconditioner": "preconditioner or factors",
    "harmonic": "harmonic solutions",
    "stepper": "setting up the stepper",
    "stepping": "stepping",
    "writing": "writing files",
    "start": "finding the device",
}


# Adds the section on decisions and skips.
def add_decisions(page: Page, folders: list[Folder]) -> None:
    runs = [f for f in folders if f.kind == "run"]
    page.section("Decisions and omissions, with their reasons")
    blocks = []
    for f in runs:
        decisions = (f.summary.get("solver") or {}).get("decisions") or []
        if decisions:
            blocks.append((f.label, f.colour, points(decisions)))
    if blocks:
        page.heading("Decided by the program")
        page.columns(blocks)
    blocks = [(f.label, f.colour, _skips(f)) for f in runs if f.summary.get("skips")]
    if blocks:
        page.heading("Left out, because the scene does not need it")
        page.columns(blocks)
    for f in runs:
        if not (f.summary.get("solver") or {}).get("decisions") and not f.summary.get("skips"):
            page.leave_out(
                f.label,
                "decisions and skips",
                "the program decided nothing, because the run is not stepped or the scene gives all settings",
            )


# Returns the skipped computations of a run as an HTML list.
def _skips(folder: Folder) -> str:
    return (
        "<ul>"
        + "".join(
            f"<li><b>{escape(str(s.get('what')))}</b>: {escape(str(s.get('why')))}. Effect: "
            f"{escape(str(s.get('effect')))}.</li>"
            for s in folder.summary["skips"]
        )
        + "</ul>"
    )


# Adds the section on method, wall times, version and machine.
def add_run(page: Page, folders: list[Folder]) -> None:
    runs = [f for f in folders if f.kind == "run"]
    if not runs:
        return
    page.section("The run: method, times, version and machine")
    page.columns([(f.label, f.colour, facts(_facts_of_run(f))) for f in runs])
    names = [n for n in _TIMES if any((f.summary.get("timing_s") or {}).get(n, 0) >= 5e-3 for f in runs)]
    if names:
        rows: list[list[Any]] = [[_TIMES[n]] + [_time(f, n) for f in runs] for n in names]
        rows.append(
            ["sum"]
            + [look.seconds(sum((f.summary.get("timing_s") or {}).get(n, 0.0) for n in _TIMES)) for f in runs]
        )
        page.table(
            ["wall time"] + [f.label for f in runs],
            rows,
            "Where the time went. Times below 5 ms in every run are not listed.",
        )


# Returns the wall time of a stage as text; a dash if the run did not record it.
def _time(folder: Folder, name: str) -> str:
    value = (folder.summary.get("timing_s") or {}).get(name)
    return "–" if value is None else look.seconds(value)


# Returns names and values of the facts about a run.
def _facts_of_run(folder: Folder) -> list[tuple[str, Any]]:
    s = folder.summary
    solver, machine = s.get("solver") or {}, s.get("machine") or folder.of_study.get("machine")
    rows: list[tuple[str, Any]] = [("status", s["status"]), ("macadam", s.get("macadam", "not recorded"))]
    if s.get("scene"):
        rows.append(("scene", s["scene"]))
    if solver.get("description"):
        rows.append(("solved by", solver["description"]))
    rows.append(("method", solver.get("method")))
    if solver.get("backend"):
        rows.append(("backend", f"{solver['backend']}, {solver.get('precision', '–')} precision"))
    if solver.get("steps"):
        rows.append(("steps", solver["steps"]))
    if solver.get("tolerance"):
        rows.append(("tolerance asked", look.percent(solver["tolerance"])))
    if solver.get("strain_amplitude"):
        rows.append(("strain amplitude", f"{look.number(1e6 * solver['strain_amplitude'], 3)} µm/m"))
    if solver.get("bytes"):
        rows.append(("memory of the stepper", f"{look.number(1e-6 * solver['bytes'], 3)} MB"))
    if isinstance(machine, dict):
        rows += [(str(k), v) for k, v in machine.items()]
    elif machine:
        rows.append(("machine", machine))
    return rows


def add_warnings(page: Page, folders: list[Folder]) -> None:
    """Adds paragraphs that a reader must see before any number: an incomplete run, warnings, a tolerance not kept. Adds
    nothing if there is no such thing."""
    for f in folders:
        of = f"{f.label}: " if len(folders) > 1 else ""
        status = f.summary.get("status")
        if f.kind == "run" and status not in ("done", "prepared"):
            page.text(
                f"{of}this run is not complete. Its status is “{status}”. The report shows the results until then.",
                "failure",
            )
        for words in f.summary.get("warnings") or []:
            page.text(f"{of}warning: {words}", "warning")
        unkept = [look.hertz(r["frequency_hz"]) for r in f.by_frequency if r.get("tolerance_kept") is False]
        if unkept and not f.summary.get("warnings"):
            page.text(f"{of}the tolerance was not met at {', '.join(unkept)}.", "warning")
