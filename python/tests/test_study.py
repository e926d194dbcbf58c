# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: their points, tables, failures, locks and report, and that no result is computed twice."""

from __future__ import annotations

import concurrent.futures
import importlib.util
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import macadam.report
import macadam.study.__main__ as command
from macadam.study import StudyError, study
from macadam.study.design import read_design
from macadam.study.locks import locked
from report_folders import ENVIRONMENT, PROGRAM, ROOT
from study_faults import lines, scene, stand_in

KEY = "contacts.M-A.delta"
THREADS = {"on": "threads", "workers": 2}


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Installs the stand-in for the program and returns the path of its log."""
    file, log = stand_in(tmp_path)
    monkeypatch.setenv("MACADAM_PROGRAM", file)
    scene(tmp_path)
    monkeypatch.chdir(tmp_path)
    return log


def asked(**more) -> dict:
    return {"scene": "scene.toml", "run": THREADS, **more}


def values(design) -> list[dict]:
    return [job.values for job in design.jobs]


def test_grid_hypercube_list_and_choices_are_crossed(program: Path) -> None:
    design = read_design(
        asked(
            grid={"materials": {"temperature": [5, 20]}, KEY: [1.0, 2.0, 3.0]},
            latin_hypercube=[
                {
                    "points": 4,
                    "contacts.M-M.delta": [0.5, 1.5],
                    "contacts.A-A.E": {"low": 1e9, "high": 1e11, "scale": "log"},
                }
            ],
            list=[{"contacts.M-M.delta": 7.0, "contacts.A-A.E": 1e10}],
            choice={"binder": {"soft": {"contacts.M-M.E_m": 1e9}, "hard": {"contacts.M-M.E_m": 1e10}}},
        ),
        "1",
    )
    assert len(design.jobs) == (4 + 1) * 2 * 3 * 2
    assert len({job.key for job in design.jobs}) == len(design.jobs)
    sampled = sorted({v["contacts.M-M.delta"] for v in values(design)} - {7.0})
    assert [int((x - 0.5) * 4) for x in sampled] == [0, 1, 2, 3]  # one point in each quarter of the range
    logs = sorted({np.log10(v["contacts.A-A.E"]) for v in values(design) if v["contacts.M-M.delta"] != 7.0})
    assert [int((x - 9) / 2 * 4) for x in logs] == [0, 1, 2, 3]
    one = next(j for j in design.jobs if j.values[KEY] == 2.0 and j.values["binder"] == "soft")
    made = tomllib.loads(one.scene)
    of = {c["pair"]: c for c in made["contacts"]}
    assert of["M-A"]["delta"] == 2.0 and of["M-M"]["E_m"] == 1e9 and made["materials"]["temperature"] in (5, 20)


def test_values_with_units_gradations_and_sections(program: Path) -> None:
    curves = [[["4 mm", "100 %"], ["2 mm", "50 %"]], [["4 mm", "100 %"], ["2 mm", "60 %"]]]
    design = read_design(
        asked(
            grid={"specimen.recipe.gradation": curves},
            latin_hypercube={"points": 3, "specimen.recipe.binder": ["4 %", "7 %"]},
            experiment={
                "slow": {"loading": {"kind": "creep", "stress": 1e5, "times": [1.0]}},
                "fast": {"loading.frequencies": [50]},
            },
        ),
        "1",
    )
    assert len(design.jobs) == 2 * 3 * 2
    scenes = [tomllib.loads(job.scene) for job in design.jobs]
    assert {str(s["specimen"]["recipe"]["gradation"]) for s in scenes} == set(map(str, curves))
    assert all(re.fullmatch(r"[\d.]+ %", s["specimen"]["recipe"]["binder"]) for s in scenes)
    slow = next(s for s, j in zip(scenes, design.jobs, strict=True) if j.experiment == "slow")
    fast = next(s for s, j in zip(scenes, design.jobs, strict=True) if j.experiment == "fast")
    assert slow["loading"] == {"kind": "creep", "stress": 1e5, "times": [1.0]}  # the whole section is replaced
    assert fast["loading"]["kind"] == "cyclic" and fast["loading"]["frequencies"] == [50]


def test_a_choice_may_be_a_file_such_as_fit_writes(program: Path) -> None:
    Path("law.toml").write_text('[[contacts]]\npair = "M-M"\nlaw = "elastic"\nE = 5e9\n')
    design = read_design(asked(choice={"binder": {"new": {"file": "law.toml"}, "old": {}}}), "1")
    laws = [next(c for c in tomllib.loads(j.scene)["contacts"] if c["pair"] == "M-M")["law"] for j in design.jobs]
    assert laws == ["elastic", "generalised_kelvin"]


def test_the_key_is_of_scene_files_and_version(program: Path, tmp_path: Path) -> None:
    def key(version: str = "1", **grid) -> str:
        return read_design(asked(grid={KEY: [2.0]} | grid), version).jobs[0].key

    assert key() == key() and key("2") != key() and key(**{"loading.frequencies": [[3]]}) != key()
    particles = (ROOT / "tests/data/t8.csv").read_bytes()
    for folder in "ab":  # a file with the same content in another folder gives the same key
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "t8.csv").write_bytes(particles)
    here, there = (key(**{"specimen.file": [f"{folder}/t8.csv"]}) for folder in "ab")
    assert here == there == key()
    (tmp_path / "a/t8.csv").write_bytes(particles + b"\n")
    assert key(**{"specimen.file": ["a/t8.csv"]}) != here


@pytest.mark.parametrize(
    "wrong, says",
    [
        ({"grids": {}}, "unknown key grids; did you mean grid"),
        ({"grid": {KEY: 1.0}}, f"grid.{KEY}: found 1.0, expected a list"),
        ({"grid": {"contacts.M-X.delta": [1]}}, "found no 'M-X' in the scene; the scene has the pairs M-M, M-A"),
        ({"grid": {"loading.kind.x": [1]}}, "found the value 'cyclic' in the scene, expected a section"),
        ({"latin_hypercube": {"points": 0, KEY: [1, 2]}}, "points: found 0"),
        ({"latin_hypercube": {"points": True, KEY: [1, 2]}}, "latin_hypercube: points: found True, expected a number"),
        ({"latin_hypercube": {"points": 2, "seed": "x", KEY: [1, 2]}}, "seed: found 'x', expected a whole number, at"),
        ({"latin_hypercube": {"points": 2, "seed": -1, KEY: [1, 2]}}, "latin_hypercube: seed: found -1, expected"),
        ({"latin_hypercube": {"points": 2, "seed": True, KEY: [1, 2]}}, "latin_hypercube: seed: found True, expected"),
        ({"latin_hypercube": {"points": 2, "seed": 1.5, KEY: [1, 2]}}, "latin_hypercube: seed: found 1.5, expected"),
        ({"latin_hypercube": {"points": 2, KEY: [2, 1]}}, "expected low below high"),
        ({"latin_hypercube": {"points": 2, KEY: ["1 %", 2]}}, "two numbers of one unit"),
        ({"grid": {KEY: [1]}, "list": [{KEY: 2}]}, f"{KEY}: set by grid and by list, expected only one of the two"),
        ({"scene": "none.toml"}, "none.toml: No such file"),
        ({"command": "calibrate"}, "command: found 'calibrate', expected run or specimen"),
        ({"run": {"on": "moon"}}, "run.on: found 'moon', expected local, slurm, threads"),
        ({"run": {"worker": 3}}, "unknown key worker"),
        ({"run": {"workers": 0}}, "run.workers: found 0"),
        ({"run": {"gpus": -1}}, "run.gpus: found -1"),
        ({"run": {"slurm": {"partitions": "x"}}}, "run.slurm: found the unknown key partitions"),
        ({"report": {"frequency": "10 Hz"}}, "report.frequency: found '10 Hz', expected a number"),
        ({"grid": {"specimen.file": ["none.csv"]}}, "specimen.file: found 'none.csv', but there is no"),
    ],
)
def test_what_is_asked_wrongly_is_said(wrong: dict, says: str, program: Path, tmp_path: Path) -> None:
    with pytest.raises(StudyError, match=re.escape(says)):
        study(asked() | wrong, tmp_path / "out")
    assert not lines(program, "begin")


def test_results_table_failures_and_report(program: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    numbers = []
    found = study(asked(grid={KEY: [11.0, 12.0, 13.0, 17.0]}), out, progress=lambda *n: numbers.append(n))
    assert sorted(found.table["e_star_pa"]) == [11e9, 12e9] and numbers[0] == (0, 0, 4) and numbers[-1] == (2, 2, 4)
    assert {f["values"][KEY] for f in found.failures} == {13.0, 17.0}
    messages = {f["values"][KEY]: f["message"] for f in found.failures}
    assert "expected better luck" in messages[13.0] and "SIGKILL" in messages[17.0]
    raw = (out / "table.csv").read_bytes()
    columns = f"{KEY},frequency_hz,e_star_pa,phase_deg,particles,warnings,macadam,key"
    assert raw.decode("utf-8").splitlines()[0] == columns
    read = pd.read_csv(out / "table.csv")
    assert read["e_star_pa"].tolist() == found.table["e_star_pa"].tolist()
    parquet = ["table.parquet"] if importlib.util.find_spec("pyarrow") else []
    if parquet:
        assert pd.read_parquet(out / "table.parquet")["e_star_pa"].tolist() == read["e_star_pa"].tolist()
    assert "better luck" in (out / "failures.csv").read_text("utf-8")
    page = (out / "report.html").read_text("utf-8")
    assert "better luck" in page and "2 of 4 failed" in page and "Main effects" in page
    assert sorted(p.name for p in out.iterdir()) == [
        "failures",
        "failures.csv",
        "report.html",
        "results",
        "study.lock",
        "table.csv",
        *parquet,
    ]
    assert all((p / "scene.toml").is_file() and (p / "study.json").is_file() for p in (out / "results").iterdir())
    # a failed result is not computed again, unless retry_failed is set
    study(asked(grid={KEY: [11.0, 12.0, 13.0, 17.0]}), out)
    assert lines(program, "begin").count(13.0) == 1
    study(asked(grid={KEY: [11.0, 12.0, 13.0]}), out, retry_failed=True)
    assert lines(program, "begin").count(13.0) == 2 and lines(program, "begin").count(11.0) == 1


def test_a_study_goes_on_and_adds_points_and_another_version_is_computed_anew(
    program: Path, tmp_path: Path, monkeypatch
) -> None:
    out = tmp_path / "out"
    study(asked(grid={KEY: [1.0, 2.0]}), out)
    found = study(asked(grid={KEY: [1.0, 2.0, 3.0]}), out)
    assert sorted(lines(program, "begin")) == [1.0, 2.0, 3.0] and len(found.table) == 3
    monkeypatch.setenv("MACADAM_PROGRAM", stand_in(tmp_path, version="2")[0])
    study(asked(grid={KEY: [1.0]}), out)
    assert lines(program, "begin").count(1.0) == 2


@pytest.mark.parametrize("pool", [concurrent.futures.ThreadPoolExecutor, concurrent.futures.ProcessPoolExecutor])
def test_any_executor_of_concurrent_futures(pool, program: Path, tmp_path: Path) -> None:
    with pool(2) as executor:
        found = study(asked(grid={KEY: [1.0, 2.0, 3.0]}), tmp_path / "out", executor=executor)
    assert found.table["e_star_pa"].tolist() == [1e9, 2e9, 3e9] and not found.missing


def test_two_studies_do_not_run_in_one_folder(program: Path, tmp_path: Path, capsys) -> None:
    out = tmp_path / "out"
    out.mkdir()
    with locked(out / "study.lock", wait=False):
        with pytest.raises(StudyError, match="another study runs in this folder"):  # another thread
            study(asked(), out)
        line = [sys.executable, "-m", "macadam.study", "study.toml", "--out", str(out)]
        Path("study.toml").write_text(f'scene = "scene.toml"\n[grid]\n"{KEY}" = [1.0]\n[run]\non = "threads"\n')
        done = subprocess.run(line, capture_output=True, text=True, env=ENVIRONMENT)  # another process
        assert done.returncode == 2 and "another study runs in this folder" in done.stderr
    assert not lines(program, "begin")
    assert command.main(["study.toml", "--out", str(out)]) == 0
    assert "1 results, 0 failed" in capsys.readouterr().out


def test_columns_of_a_hypercube_do_not_go_together(program: Path) -> None:
    keys = ["contacts.M-M.delta", "contacts.M-A.delta", "contacts.A-A.E"]
    design = read_design(asked(latin_hypercube={"points": 24, **{k: [1.0, 2.0] for k in keys}}), "1")
    table = np.array([[job.values[k] for k in keys] for job in design.jobs])
    # 0.2 is the standard deviation of the correlation of 24 independent points
    assert abs(np.corrcoef(table.T) - np.eye(3)).max() < 0.2


def test_wrong_arguments_of_the_command(program: Path, tmp_path: Path, capsys) -> None:
    assert command.main(["none.toml", "--out", str(tmp_path / "out")]) == 2
    assert "none.toml: No such file" in capsys.readouterr().err
    (tmp_path / "bad.toml").write_text("scene = [")
    assert command.main(["bad.toml", "--out", str(tmp_path / "out")]) == 2
    assert "bad.toml" in capsys.readouterr().err and not (tmp_path / "out").exists()


@pytest.mark.parametrize("mode", [[], ["--list"], ["--check"]])
@pytest.mark.parametrize(
    "more, options, says",
    [
        ("", ["--workers", "-1"], "workers: found -1, expected a whole number above 0"),
        ("", ["--workers", "0"], "workers: found 0, expected a whole number above 0"),
        ("[run]\nworkers = -2\n", [], "run.workers: found -2, expected a whole number above 0"),
        ("[run]\nworker = 2\n", [], "run: found the unknown key worker, expected"),
        ("[report]\nfrequency = '10 Hz'\n", [], "report.frequency: found '10 Hz', expected a number"),
        ("[latin_hypercube]\npoints = 2\nseed = 'x'\n", [], "latin_hypercube: seed: found 'x', expected"),
    ],
)
def test_wrong_sections_and_options_are_refused_in_every_mode(
    more: str, options: list[str], says: str, mode: list[str], program: Path, tmp_path: Path, capsys
) -> None:
    Path("study.toml").write_text(f'scene = "scene.toml"\n[grid]\n"{KEY}" = [1.0]\n{more}')
    assert command.main(["study.toml", "--out", str(tmp_path / "out"), *options, *mode]) == 2
    said = capsys.readouterr()
    assert said.err.startswith(f"macadam study: {says}") and not said.out and not (tmp_path / "out").exists()


def test_the_caller_of_python_cannot_ask_for_no_workers(program: Path, tmp_path: Path) -> None:
    with pytest.raises(StudyError, match="workers: found 0, expected a whole number above 0"):
        study(asked(), tmp_path / "out", workers=0)


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_the_program_itself(program: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setenv("MACADAM_PROGRAM", PROGRAM)
    design = asked(
        grid={KEY: [0.5, 2.0]},
        experiment={
            "fast": {"loading": {"kind": "cyclic", "frequencies": [5.0, 10.0]}},
            "slow": {"loading": {"kind": "relaxation", "times": [0.1, 1.0], "points_per_decade": 1}},
        },
    )
    found = study(design, tmp_path / "out")
    assert len(found.table) == 8 and not found.failures
    fast = found.table[found.table["frequency_hz"] == 10]
    assert fast["e_star_pa"].is_monotonic_increasing and fast["particles"].eq(175).all()
    assert (found.table[found.table["time_s"] == 1.0]["modulus_pa"] > 0).all()
    page = (tmp_path / "out/report.html").read_text("utf-8")
    assert "|E*| at 10 Hz (fast)" in page and "relaxation modulus at 1 s (slow)" in page.lower()


def test_workers_import_little_and_the_modules_can_be_called(program: Path, tmp_path: Path) -> None:
    line = "import macadam.study.job, macadam.report, sys; print({'pandas', 'matplotlib', 'scipy'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, env=ENVIRONMENT)
    assert done.stdout.strip() == "set()", done.stderr
    assert len(macadam.study(asked(grid={KEY: [1.0]}), tmp_path / "out").table) == 1
    page = macadam.report(next((tmp_path / "out/results").iterdir()), tmp_path / "r.html")
    assert "7 particles" in page.read_text("utf-8")
