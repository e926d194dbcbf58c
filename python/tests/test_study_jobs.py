# SPDX-License-Identifier: GPL-3.0-or-later
"""How a study starts the program (threads, arguments), and how it reports what the program says when it fails."""

from __future__ import annotations

from pathlib import Path

import pytest

import macadam.study.__main__ as command
from macadam.study import study
from macadam.study.job import message_of
from macadam.study.programs import error_line
from study_faults import scene, stand_in

KEY = "contacts.M-A.delta"
# A program that logs two environment variables and the arguments after the folder. It prints an error between other
# lines.
_LOGGER = """#!/bin/sh
[ $1 = --version ] && echo "macadam logger 1" && exit
shift 4
echo "$OMP_NUM_THREADS $OMP_WAIT_POLICY $*" >> LOG
echo "macadam: warning: the box is small" >&2
echo "macadam: the first error" >&2
for k in 1 2 3 4 5 6 7 8 9 10 11 12 13; do echo "hint $k" >&2; done
exit 1
"""


@pytest.fixture
def log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Installs the logging program and returns the path of its log."""
    file = tmp_path / "logger"
    file.write_text(_LOGGER.replace("LOG", str(tmp_path / "log")))
    file.chmod(0o755)
    monkeypatch.setenv("MACADAM_PROGRAM", str(file))
    monkeypatch.delenv("OMP_WAIT_POLICY", raising=False)
    scene(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "log"


def asked(**more) -> dict:
    return {"scene": "scene.toml", "run": {"on": "threads", "workers": 1}, "grid": {KEY: [1.0]}, **more}


@pytest.mark.parametrize("name, options", [("run", ["--threads", "3"]), ("specimen", [])])
def test_threads_of_the_study_win_over_the_environment(
    name: str, options: list[str], log: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The study sets OMP_NUM_THREADS itself. It sets OMP_WAIT_POLICY only if the user has not set it."""
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    monkeypatch.setenv("OMP_WAIT_POLICY", "active")
    run = {"on": "threads", "workers": 1, "threads": 3}
    study(asked(command=name, run=run), tmp_path / "out")
    assert log.read_text().split() == ["3", "active", *options]
    monkeypatch.delenv("OMP_WAIT_POLICY")
    study(asked(command=name, run=run), tmp_path / "out", retry_failed=True)
    assert log.read_text().splitlines()[1].startswith("3 passive")


@pytest.mark.parametrize("words", [["--threads=1"], ["--threads", "1"]])
def test_threads_among_the_arguments_are_passed_once(words: list[str], log: Path, tmp_path: Path) -> None:
    study(asked(arguments=words), tmp_path / "out")
    assert log.read_text() == f"1 passive {' '.join(words)}\n"


def test_the_error_of_the_program_is_shown_and_not_its_last_line(log: Path, tmp_path: Path, capsys) -> None:
    Path("study.toml").write_text(f'scene = "scene.toml"\n[grid]\n"{KEY}" = [1.0]\n[run]\non = "threads"\n')
    assert command.main(["study.toml", "--out", "out"]) == 1
    assert f"failed: {KEY} = 1.0: macadam: the first error\n" in capsys.readouterr().err
    page = Path("out/report.html").read_text("utf-8")
    assert "macadam: the first error" in page and "hint 13" not in page
    assert "hint 13" in Path("out/failures.csv").read_text("utf-8")


def test_the_line_that_says_what_is_wrong() -> None:
    assert error_line("macadam: warning: a\nmacadam: b\nmacadam: c\nd") == "macadam: b"
    assert error_line("a\nb\n") == "b" and error_line("") == ""
    long = "macadam: b\n" + "hint\n" * 30
    assert message_of(2, long).splitlines() == ["macadam: b"] + ["hint"] * 12
    assert "SIGKILL" in error_line(message_of(-9, "a\nb")) and message_of(3, "") == "exit code 3 without a message"


def test_failures_have_the_labels_of_the_present_study(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    """A first study computes the failing scene as a point of a grid. In the second study, two names of a choice
    have this scene, and each name has its row."""
    program, log = stand_in(tmp_path)
    monkeypatch.setenv("MACADAM_PROGRAM", program)
    monkeypatch.chdir(tmp_path)
    scene(tmp_path)
    assert study(asked(grid={KEY: [13.0]}), tmp_path / "out").failures[0]["values"] == {KEY: 13.0}
    Path("study.toml").write_text(
        'scene = "scene.toml"\n[run]\non = "threads"\n[experiment.first]\n'
        + "".join(f'[choice.binder.{name}]\n"{KEY}" = 13.0\n' for name in ("soft", "hard"))
    )
    assert command.main(["study.toml", "--out", "out"]) == 1
    said = capsys.readouterr()
    for name in ("soft", "hard"):
        assert f"failed: first binder = {name}: macadam: " in said.err
    assert f"failed: {KEY}" not in said.err and f"failed:  {KEY}" not in said.err
    assert "0 results, 1 failed" in said.out  # one result, which both points share
    assert log.read_text().count("begin 13.0") == 1
    rows = Path("out/failures.csv").read_text("utf-8").splitlines()
    assert [row.split(",")[1:3] for row in rows[1:]] == [["first", "binder = soft"], ["first", "binder = hard"]]
    page = Path("out/report.html").read_text("utf-8")
    assert "1 of 1 failed" in page and "binder = hard" in page
