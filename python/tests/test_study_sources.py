# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies in which two places set one key or points lack a value are refused; points that are equal are reported."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pandas as pd
import pytest

import macadam.study.__main__ as command
from macadam.study import StudyError, predictions, study
from macadam.study.checks import Checked
from macadam.study.design import read_design
from report_folders import PROGRAM
from study_faults import lines, scene, stand_in

DELTA = "contacts.M-A.delta"
# an aggregate and a mastic sphere between two walls: 1/E* = 0.25/E(A-W) + 0.5/(delta E(M-A)) + 0.25/E(M-W)
SPHERES = "id,x,y,z,radius,phase,body\n0,0.005,0.005,0.0025,0.0025,aggregate,0\n1,0.005,0.005,0.0075,0.0025,mastic,-1\n"
SCENE = """
[specimen]
box = [0.01, 0.01, 0.01]
file = "spheres.csv"
[materials.aggregate]
density = 2630
[materials.mastic]
density = 2110
[[contacts]]
pair = "M-A"
law = "elastic"
E = 1e9
alpha = 0.1
delta = 1.0
[[contacts]]
pair = "A-W"
law = "elastic"
E = 1e10
[[contacts]]
pair = "M-W"
law = "elastic"
E = 1e10
[loading]
kind = "sweep"
frequencies = [1]
"""
LAW = '[[contacts]]\npair = "M-A"\nlaw = "elastic"\nE = 2e9\nalpha = 0.1\n'  # without delta, as `macadam fit` writes it


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "spheres.csv").write_text(SPHERES)
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "law.toml").write_text(LAW)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def contacts(job) -> dict[str, dict]:
    return {c["pair"]: c for c in tomllib.loads(job.scene)["contacts"]}


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_fitted_laws_by_delta(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The file replaces the pair M-A, and delta of the grid is set in the new entry."""
    monkeypatch.setenv("MACADAM_PROGRAM", PROGRAM)
    asked = {
        "scene": "scene.toml",
        "grid": {DELTA: [2, 3]},
        "choice": {"binder": {"fitted": {"file": "law.toml"}, "old": {}}},
    }
    found = study(asked, folder / "out", on="threads", workers=1).table
    got = {(row["binder"], row[DELTA]): row["e_star_pa"] for _, row in found.iterrows()}
    modulus = {  # modulus of the specimen by the formula above, for each value of delta times E of M-A
        (name, delta): 1 / (0.25 / 1e10 + 0.5 / (delta * e) + 0.25 / 1e10)
        for name, e in (("fitted", 2e9), ("old", 1e9))
        for delta in (2, 3)
    }
    assert got == pytest.approx(modulus, rel=1e-9)  # moduli are written with 10 digits or more
    assert modulus["fitted", 2] == pytest.approx(5714.2857e6) and modulus["fitted", 3] == pytest.approx(7500e6)


def test_files_come_first_and_keep_the_order_of_the_pairs(folder: Path) -> None:
    more = {"contacts.0.delta": 5.0, "materials.mastic.density": 2000}
    design = read_design(
        {
            "scene": "scene.toml",
            "choice": {"density": {"x": more}, "binder": {"fitted": {"file": "law.toml"}}},
            "experiment": {"fast": {"loading.frequencies": [50]}},
        },
        "1",
    )
    (job,) = design.jobs
    made = tomllib.loads(job.scene)
    assert [c["pair"] for c in made["contacts"]] == ["M-A", "A-W", "M-W"]
    assert made["contacts"][0] == {"pair": "M-A", "law": "elastic", "E": 2e9, "alpha": 0.1, "delta": 5.0}
    assert made["materials"]["mastic"]["density"] == 2000 and made["loading"]["frequencies"] == [50]


@pytest.mark.parametrize(
    "asked, says",
    [
        (
            {"latin_hypercube": {"points": 3, DELTA: [2, 4]}, "choice": {"binder": {"a": {DELTA: 1}}}},
            f"{DELTA}: set by latin_hypercube and by choice.binder.a, expected only one of the two",
        ),
        (
            {"grid": {DELTA: [2, 3]}, "experiment": {"slow": {DELTA: 1}}},
            f"{DELTA}: set by grid and by experiment.slow",
        ),
        (
            {"grid": {"loading.frequencies": [[1], [10]]}, "experiment": {"x": {"loading": {"frequencies": [5]}}}},
            "loading.frequencies: set by grid, and loading, which contains it, by experiment.x",
        ),
        (
            {
                "grid": {DELTA: [2, 3], "contacts.A-W.E": [1e9, 2e9]},
                "choice": {"mix": {"a": {DELTA: 1}, "b": {"contacts.A-W.E": 3e9}}},
            },
            f"{DELTA}: set by grid and by choice.mix.a",
        ),
        (
            {"grid": {"contacts.M-A.E": [1e9]}, "choice": {"binder": {"a": {"file": "law.toml"}}}},
            "contacts.M-A.E: set by grid and by choice.binder.a (file law.toml)",
        ),
        (
            {"grid": {"contacts.0.E": [1e9], "contacts.M-A.E": [2e9]}},
            "contacts.0.E and contacts.M-A.E are the same entry of the scene: the first is set by grid, the second by",
        ),
        (
            {"grid": {"specimen": [{"seed": 1}], "specimen.seed": [1]}},
            "specimen.seed: set by grid",
        ),
        (
            {"choice": {name: {"a": {"file": "law.toml"}} for name in ("one", "two")}},
            "contacts.M-A: replaced by choice.one.a (file law.toml) and by choice.two.a (file law.toml)",
        ),
        (
            {"choice": {"a": {"x": {"file": "law.toml", "contacts.M-A.alpha": 0.2}}}},
            "contacts.M-A.alpha: set by choice.a.x and by choice.a.x (file law.toml)",
        ),
        ({"grid": {"binder": [1]}, "choice": {"binder": {"a": {}}}}, "choice.binder: found a key of the same name"),
        ({"choice": {"key": {"a": {}}}}, "choice.key: found the name of a column of the table"),
        (
            {"list": [{DELTA: 1}, {"contacts.M-A.E": 2e9}]},
            "list 1: found no value for contacts.M-A.E, which list 2 gives",
        ),
        (
            {"latin_hypercube": {"points": 2, DELTA: [1, 2]}, "list": [{"contacts.M-A.E": 1e9}]},
            "latin_hypercube 1: found no value for contacts.M-A.E, which list 1 gives",
        ),
        ({"grid": {DELTA: [1, 1.0]}}, f"grid.{DELTA}: found 1 and 1.0, which are the same value"),
        ({"grid": {"loading.frequencies": [[1, 2.0], [1.0, 2]]}}, "which are the same value"),
        ({"grid": {"specimen.x": ["2 %", "2.0 %"]}}, "found '2 %' and '2.0 %', which are the same value"),
    ],
)
def test_what_is_set_twice_or_not_at_all_is_refused(asked: dict, says: str, folder: Path) -> None:
    with pytest.raises(StudyError, match=re.escape(says)):
        read_design({"scene": "scene.toml"} | asked, "1")


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_every_scene_is_checked_when_asked(folder: Path, monkeypatch, capsys) -> None:
    monkeypatch.setenv("MACADAM_PROGRAM", PROGRAM)
    text = 'scene = "scene.toml"\narguments = ["--no-such-option", "--linear=direct", "--threads", "1"]\n[grid]\n'
    Path("study.toml").write_text(f'{text}"loading.frequencies" = [[10], [-10]]\n"{DELTA}" = [1, 2]\n', encoding="utf-8")
    assert command.main(["study.toml", "--out", "out", "--check"]) == 2
    said = capsys.readouterr()
    assert "4 points, 4 scenes checked, 2 wrong; about " in said.out
    assert said.err.startswith("macadam study: 2 of 4 scenes are wrong\n") and said.err.count("wrong: ") == 2
    assert f"wrong: loading.frequencies = [-10], {DELTA} = 2: " in said.err and "found -10" in said.err
    assert not Path("out").exists()


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_a_check_lists_what_every_point_would_take(folder: Path, monkeypatch, capsys) -> None:
    monkeypatch.setenv("MACADAM_PROGRAM", PROGRAM)
    text = f'scene = "scene.toml"\narguments = ["--linear=direct"]\n[grid]\n"{DELTA}" = [1, 2.5]\n[run]\nworkers = 2\n'
    text += '[experiment.fast]\n"loading.frequencies" = [10]\n[experiment.slow]\n"loading.frequencies" = [1, 2, 3]\n'
    Path("study.toml").write_text(text, encoding="utf-8")
    assert command.main(["study.toml", "--out", "out", "--check"]) == 0
    said = capsys.readouterr()
    head, *rows, total = said.out.splitlines()
    assert said.err == "" and not Path("out").exists() and len(rows) == 4
    words = [re.split(r"  +", row) for row in [head, *rows]]
    assert words[0] == [DELTA, "experiment", "test", "method", "particles", "solutions", "memory", "time"]
    # every row: the factor, the experiment, the test, the method, the two particles of the specimen, and the number of
    # solutions, which is the number of frequencies
    assert [w[:6] for w in words[1:]] == [
        [delta, name, "sweep", "harmonic", "2", number]
        for delta in ("1", "2.5")
        for name, number in (("fast", "1"), ("slow", "3"))
    ]
    assert all(w[6].endswith(" MB") and w[7].endswith(" s") for w in words[1:])
    assert total.startswith("4 points, 4 scenes checked, 0 wrong; about ") and "with 2 at a time" in total


def test_predictions_name_warnings_once_and_leave_out_what_no_point_has(folder: Path) -> None:
    design = read_design({"scene": "scene.toml", "grid": {DELTA: [1, 2, 3]}}, "1")
    forecast = {"kind": "cyclic", "method": "explicit", "particles": 1234, "solutions": 0, "host_bytes": 2e9}
    forecast |= {"device_bytes": 0, "specimen_s": 1.0, "network_s": 2.0, "seconds": 3600.0, "warnings": ["too few"]}
    forecast |= {"steps": [{"steps": 123456}, {"steps": 1000}]}
    checked = [Checked(job, forecast, "") for job in design.jobs[:2]] + [Checked(design.jobs[2], {}, "found 3")]
    found = predictions.lines(design, checked, 2)
    assert re.split(r"  +", found[0]) == [DELTA, "test", "method", "particles", "steps", "memory", "time"]
    # 124,456 steps are shown with two digits, 3600 s in minutes
    assert re.split(r"  +", found[1]) == ["1", "cyclic", "explicit", "1,234", "120,000", "2.0 GB", "60 min"]
    assert re.split(r"  +", found[3]) == ["3", "wrong"]
    assert found[4] == f"warning: too few ({DELTA} = 1 and 1 more)"
    # two scenes of an hour each, both at a time
    assert found[5] == (
        "3 points, 3 scenes checked, 1 wrong; about 2.0 h of computing, 60 min with 2 at a time, which take up to 4.0 GB of "
        "memory"
    )


def test_the_command_refuses_with_exit_2(folder: Path, monkeypatch, capsys) -> None:
    monkeypatch.setenv("MACADAM_PROGRAM", stand_in(folder)[0])
    Path("study.toml").write_text(
        f'scene = "scene.toml"\n[[list]]\n"{DELTA}" = 1\n[[list]]\n"contacts.M-A.E" = 2e9\n', encoding="utf-8"
    )
    assert command.main(["study.toml", "--out", "out"]) == 2
    assert "list 1: found no value for contacts.M-A.E" in capsys.readouterr().err and not Path("out").exists()


def test_equal_points_have_a_row_each_and_are_told(folder: Path, monkeypatch, capsys) -> None:
    """Two points whose scenes are equal are computed once and have two rows. A point that repeats the values of another
    point has no row of its own. Both cases are reported."""
    scene(folder)
    program, log = stand_in(folder)
    monkeypatch.setenv("MACADAM_PROGRAM", program)
    Path("study.toml").write_text(
        f"""scene = "scene.toml"
run = {{ on = "threads" }}
list = [{{ "{DELTA}" = 2 }}, {{ "{DELTA}" = 3 }}, {{ "{DELTA}" = 2.0 }}]
[choice.binder.plain]
[choice.binder.same]
""",
        encoding="utf-8",
    )
    assert command.main(["study.toml", "--out", "out"]) == 0
    said = capsys.readouterr()
    same = f"{DELTA} = 2, binder = same: this point has the same scene as {DELTA} = 2, binder = plain; the scene is computed once"
    assert same in said.err
    assert "binder = plain: this point occurs more than once in the study; it has one row" in said.err
    assert sorted(lines(log, "begin")) == [2.0, 3.0]
    table = pd.read_csv("out/table.csv")
    assert table[[DELTA, "binder", "e_star_pa"]].values.tolist() == [
        [2, "plain", 2e9],
        [2, "same", 2e9],
        [3, "plain", 3e9],
        [3, "same", 3e9],
    ]
    assert "the same scene as" in Path("out/report.html").read_text("utf-8")
    assert command.main(["study.toml", "--out", "out", "--list"]) == 0
    listed = capsys.readouterr()
    assert len(listed.out.splitlines()) == 4 and same in listed.err
