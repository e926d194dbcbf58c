# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the notebooks of examples/notebooks, cell after cell, as a notebook does: the value of a cell's last expression is
shown, which draws its pictures. Jupyter is not needed. Also checks the files' form: no outputs, a valid notebook."""
from __future__ import annotations

import ast
import json
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))


def code_cells(file: Path) -> list[str]:
    cells = json.loads(file.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def show(value: Any) -> list[str]:
    """Returns the names of the forms in which a notebook would show the value, after making each of them. A form may be
    None, as the HTML of a figure of matplotlib is."""
    makers = {name: getattr(value, name, None) for name in ("_repr_png_", "_repr_html_")}
    return [name for name, make in makers.items() if make and make()] or [repr(value)]


def run_cell(code: str, names: dict[str, Any], where: str) -> list[str]:
    """Runs a cell. Returns how the value of its last expression is shown; an empty list if it has none."""
    tree = ast.parse(code, where)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, where, "exec"), names)
    value = eval(compile(ast.Expression(last.value), where, "eval"), names) if last else None
    return [] if value is None else show(value)


def test_there_are_notebooks() -> None:
    assert len(NOTEBOOKS) >= 6


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda f: f.stem)
def test_a_notebook_is_kept_without_outputs(file: Path) -> None:
    book = json.loads(file.read_text(encoding="utf-8"))
    assert (book["nbformat"], book["cells"][0]["cell_type"]) == (4, "markdown")
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in book["cells"])


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda f: f.stem)
def test_a_notebook_runs_and_shows_a_picture(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    names: dict[str, Any] = {"__name__": "__main__"}
    shown = [form for k, code in enumerate(code_cells(file)) for form in run_cell(code, names, f"{file.name}, cell {k}")]
    assert "_repr_png_" in shown
