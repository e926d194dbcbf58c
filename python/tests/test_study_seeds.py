# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene with several seeds: the study that it becomes, and mean, standard deviation and count of each result."""

from __future__ import annotations

import json
import statistics
import subprocess
from pathlib import Path

import pytest

import macadam.study.__main__ as command
from macadam.report import ReportError, report
from macadam.study import StudyError, seeds
from report_folders import ENVIRONMENT, PROGRAM
from study_faults import lines, stand_in

SCENE = """
[specimen]
box = [0.008, 0.008, 0.011]
seed = 3
[specimen.mastic]
radius = [0.00075, 0.001]
porosity = 0.05
[materials.mastic]
density = 2110
[[contacts]]
pair = "M-M"
law = "elastic"
E = 1e9
[[contacts]]
pair = "M-W"
law = "elastic"
E = 1e9
[loading]
kind = "sweep"
frequencies = [1, 10]
"""


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(SCENE)
    return tmp_path / "scene.toml"


def test_the_seeds_follow_the_seed_of_the_scene(scene: Path) -> None:
    assert seeds.study_of(scene, 3, None, [], None) == {
        "scene": str(scene),
        "command": "run",
        "arguments": [],
        "grid": {"specimen.seed": [3, 4, 5]},
        "run": {"on": "threads", "threads": 1},
    }
    for options in (["--threads=2", "--linear=direct"], ["--linear", "direct", "--threads", "2"]):
        found = seeds.study_of(scene, 2, 7, options, 4)
        assert found["grid"] == {"specimen.seed": [7, 8]} and found["arguments"] == options
        assert found["run"] == {"on": "threads", "threads": 2, "workers": 4}
    scene.write_text(SCENE.replace("seed = 3\n", ""))
    assert seeds.study_of(scene, 2, None, [], None)["grid"] == {"specimen.seed": [1, 2]}


@pytest.mark.parametrize(
    "text, number, first, says",
    [
        ('[specimen]\nfile = "a.csv"\n', 2, None, "found the specimen of the file 'a.csv', which has no seed, expected"),
        (SCENE, 1, None, "--seeds: found 1, expected a whole number from 2 to 10000"),
        (SCENE, 2, -1, "--first-seed: found -1, expected a whole number from 0 to "),
        (SCENE, 2, 2**63 - 2, "--first-seed: found 9223372036854775806, expected"),
    ],
)
def test_scenes_without_a_seed_and_wrong_numbers_are_refused(
    text: str, number: int, first: int | None, says: str, scene: Path
) -> None:
    scene.write_text(text)
    with pytest.raises(StudyError) as refused:
        seeds.study_of(scene, number, first, [], None)
    assert says in str(refused.value)


def test_mean_deviation_and_count_of_each_result() -> None:
    one = {"results": [{"frequency_hz": 1.0, "e_star_pa": 2.0, "phase_deg": 10.0, "iterations": 5, "modulus": "uniaxial"}]}
    two = {"results": [{"frequency_hz": 1.0, "e_star_pa": 4.0, "phase_deg": None}]}
    three = {"results": [{"frequency_hz": 1.0, "e_star_pa": 9.0}, {"frequency_hz": 2.0, "e_star_pa": 1.0}]}
    assert seeds.over_seeds([one, two, three]) == [
        {
            "frequency_hz": 1.0,
            # mean 5, deviations -3, -1 and 4: (9 + 1 + 16) / 2 = 13
            "e_star_pa": {"mean": 5.0, "standard_deviation": 13**0.5, "count": 3},
            "phase_deg": {"mean": 10.0, "standard_deviation": None, "count": 1},
        },
        {"frequency_hz": 2.0, "e_star_pa": {"mean": 1.0, "standard_deviation": None, "count": 1}},
    ]


def test_results_of_a_whole_test_and_of_its_points() -> None:
    of = [
        {"results": [{"kind": "monotonic", "strength_pa": s, "points": [{"time_s": 1.0, "stress_pa": s / 2}]}]}
        for s in (1e6, 3e6)
    ]
    found = seeds.over_seeds(of)
    deviation = 2**0.5 * 1e6  # of 1 and 3 MPa
    assert found[0] == {"strength_pa": {"mean": 2e6, "standard_deviation": pytest.approx(deviation), "count": 2}}
    assert found[1]["time_s"] == 1.0 and found[1]["stress_pa"]["mean"] == 1e6


def test_a_long_table_ends_with_the_number_of_rows_left_out() -> None:
    moments = {"mean": 1.0, "standard_deviation": 0.1, "count": 2}
    rows = [{"time_s": float(k), "strain": moments} for k in range(30)]
    found = seeds.lines({"results": [{"strength_pa": moments}, *rows]})
    assert len(found) == 1 + 1 + 24 + 1 and found[-1] == "6 more rows are in summary.json"
    assert found[1].split() == ["strength_pa", "1", "0.1", "10", "%", "2"]
    assert found[-2].split() == ["time_s", "29", "strain", "1", "0.1", "10", "%", "2"]


def test_a_failed_seed_does_not_count(scene: Path, monkeypatch, capsys) -> None:
    # the stand-in's modulus is the scene's first line "delta = "; seed 4 gets no delta of its own, so both seeds have 1 GPa
    program, log = stand_in(scene.parent)
    monkeypatch.setenv("MACADAM_PROGRAM", program)
    assert command.main(["scene.toml", "--seeds", "2", "--out", "out"]) == 0
    summary = json.loads(Path("out/summary.json").read_text())
    assert summary["status"] == "done" and summary["results"][0]["e_star_pa"]["count"] == 2
    assert len(lines(log, "begin")) == 2
    # a third seed computes one more result
    assert command.main(["scene.toml", "--seeds", "3", "--out", "out"]) == 0
    assert len(lines(log, "begin")) == 3
    failed = next(Path("out/results").iterdir())
    (Path("out/failures") / f"{failed.name}.json").write_text(
        json.dumps({"key": failed.name, "exit_code": 1, "message": "macadam: no luck"})
    )
    failed.rename("elsewhere")
    assert command.main(["scene.toml", "--seeds", "3", "--out", "out"]) == 1
    summary = json.loads(Path("out/summary.json").read_text())
    assert summary["status"] == "failed: 1 of 3 seeds" and summary["results"][0]["e_star_pa"]["count"] == 2
    assert sorted(s["folder"] is None for s in summary["seeds"]) == [False, False, True]
    assert "no luck" in capsys.readouterr().err
    with pytest.raises(ReportError, match="found a study"):
        report("out", "report.html")


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_the_program_runs_the_seeds_with_its_options(scene: Path) -> None:
    line = [str(PROGRAM), "run", "scene.toml", "--out", "out", "--seeds", "2", "--seed", "5", "--at-once", "2"]
    line += ["--set", "loading.frequencies=[2]", "--threads", "1"]
    done = subprocess.run(line, capture_output=True, text=True, env=ENVIRONMENT)
    assert done.returncode == 0, done.stderr
    summary = json.loads(Path("out/summary.json").read_text())
    assert [s["seed"] for s in summary["seeds"]] == [5, 6]
    runs = [json.loads((Path("out") / s["folder"] / "summary.json").read_text()) for s in summary["seeds"]]
    assert [r["specimen"]["seed"] for r in runs] == [5, 6]
    values = [r["results"][0]["e_star_pa"] for r in runs]
    found = summary["results"][0]
    assert found["frequency_hz"] == 2.0 and found["e_star_pa"]["count"] == 2
    assert found["e_star_pa"]["mean"] == pytest.approx(statistics.fmean(values), rel=1e-14)  # rounding of a sum of two
    assert found["e_star_pa"]["standard_deviation"] == pytest.approx(abs(values[0] - values[1]) / 2**0.5, rel=1e-9)
    assert "frequency_hz 2" in done.stdout and "standard deviation" in done.stdout
