# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands and code of docs/studies.md and the study of examples/study can be run."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from macadam.study import executors, study
from macadam.study.design import read_design
from report_folders import ENVIRONMENT, PROGRAM, ROOT, command
from study_faults import stand_in


def blocks(page: str) -> list[str]:
    """Returns the indented blocks of a page."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return [re.sub(r"(?m)^    ", "", b) for b in re.findall(r"(?m)(?:^    .*\n|^\n(?=    ))+", text)]


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_commands_of_the_page(tmp_path: Path) -> None:
    """Runs every command, study file and line of Python of docs/studies.md with the stand-in for the program."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples", ignore=shutil.ignore_patterns("shapes", "ct"))
    environment = {**ENVIRONMENT, "MACADAM_PROGRAM": stand_in(tmp_path)[0]}
    shutil.copy(tmp_path / "examples/study/scene.toml", tmp_path)
    for binder in ("soft", "hard"):
        (tmp_path / binder).mkdir()
        law = f'[[contacts]]\npair = "M-A"\nlaw = "elastic"\nE = {len(binder)}.{binder == "hard":d}e9\n'
        (tmp_path / binder / "law.toml").write_text(law)
    commands, studies, programs = 0, 0, 0
    for block in blocks("studies.md"):
        if block.lstrip().startswith("macadam "):
            commands += 1
            # the stand-in cannot check scenes
            used = {**ENVIRONMENT, "MACADAM_PROGRAM": str(PROGRAM)} if "--check" in block else environment
            subprocess.run(command(block.strip()), cwd=tmp_path, check=True, env=used, timeout=3600)
        elif "mc.study(" in block:
            programs += 1
            subprocess.run([sys.executable, "-c", block], cwd=tmp_path, check=True, env=environment, timeout=3600)
        elif block.lstrip().startswith("scene ="):
            studies += 1
            (tmp_path / "study.toml").write_text(block)
            assert len(read_design(tmp_path / "study.toml", "1").jobs) == (18, 240, 6)[studies - 1]
        else:
            executors.check(tomllib.loads(block)["run"])
    assert (commands, studies, programs) == (5, 3, 1)
    key = next((tmp_path / "results/study/results").iterdir()).name
    assert f"macadam report results/study/results/{'KEY'} --out one.html" in (
        ROOT / "docs/studies.md"
    ).read_text("utf-8")
    line = command(f"macadam report results/study/results/{key} --out one.html")
    subprocess.run(line, cwd=tmp_path, check=True, env=environment, timeout=3600)


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_the_example(tmp_path: Path, monkeypatch) -> None:
    """The example's file has 48 points. The test computes two opposite corners of this grid: little binder with few air
    voids, and much binder with many air voids."""
    monkeypatch.setenv("MACADAM_PROGRAM", PROGRAM)
    example = ROOT / "examples/study/study.toml"
    assert len(read_design(example, "1").jobs) == 48
    asked_for = tomllib.loads(example.read_text("utf-8"))
    asked_for["scene"] = str(ROOT / "examples/study/scene.toml")
    asked_for["grid"] = {"specimen.seed": [1]}
    asked_for["list"] = [
        {"specimen.recipe.air_voids": a, "specimen.recipe.binder": b} for a, b in (("2 %", "5 %"), ("8 %", "8 %"))
    ]
    found = study(asked_for, tmp_path / "out", on="threads")
    stiff, soft = found.table["e_star_pa"]
    assert not found.failures and stiff > 1.3 * soft > 0
