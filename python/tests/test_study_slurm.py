# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies on a Slurm cluster that consists of this machine alone; wrong options of Slurm; jobs that Slurm refuses."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest
from slurm_cluster import cluster, why_not

from macadam.study import StudyError, executors
from macadam.study.parsl_pool import slurm_lines
from report_folders import ENVIRONMENT, PROGRAM
from study_faults import lines, scene, stand_in

pytest.importorskip("parsl")

STUDY = """
scene = "scene.toml"
[grid]
"contacts.M-A.delta" = [11.0, 12.0, 13.0, 14.0, 15.0, 16.0]
[run]
workers = 2
[run.slurm]
partition = "debug"
exclusive = false
cores_per_node = 2
walltime = "00:05:00"
"""


@pytest.mark.long
@pytest.mark.skipif(bool(why_not()), reason=why_not() or "-")
@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
def test_the_same_file_runs_on_slurm(tmp_path: Path) -> None:
    program, log = stand_in(tmp_path, real="5.0")
    scene(tmp_path)
    (tmp_path / "study.toml").write_text(STUDY)
    out = tmp_path / "out"
    with cluster(tmp_path / "slurm") as environment:
        done = subprocess.run(
            [sys.executable, "-m", "macadam.study", "study.toml", "--out", str(out), "--on", "slurm"],
            cwd=tmp_path,
            env={**ENVIRONMENT, **environment, "PYTHONPATH": ENVIRONMENT["PYTHONPATH"], "MACADAM_PROGRAM": program},
            capture_output=True,
            text=True,
            timeout=3600,
        )
    assert done.returncode == 1, done.stderr  # the stand-in fails for 13
    assert "expected better luck" in done.stderr and "5 results, 1 failed" in done.stdout
    assert sorted(lines(log, "begin")) == [11.0, 12.0, 13.0, 14.0, 15.0, 16.0]
    records = [json.loads(f.read_text()) for f in (out / "results").glob("*/study.json")]
    # all results were computed by a job of the cluster
    assert len(records) == 5 and all(int(r["machine"]["slurm_job_id"]) > 0 for r in records)


@pytest.mark.long
@pytest.mark.skipif(bool(why_not()), reason=why_not() or "-")
def test_a_stopped_study_leaves_no_job(tmp_path: Path) -> None:
    from study_running import Running

    study = STUDY.replace("[11.0, 12.0, 13.0, 14.0, 15.0, 16.0]", "[1.0, 2.0, 3.0]")
    with cluster(tmp_path / "slurm") as environment:
        environment = {**ENVIRONMENT, **environment, "PYTHONPATH": ENVIRONMENT["PYTHONPATH"]}
        running = Running(tmp_path, "slurm", study, environment)
        try:
            running.wait_for_work()
            running.process.terminate()
            running.process.communicate(timeout=3600)
            assert running.process.returncode == 130
            _wait_for_jobs(environment)
            assert len(list((tmp_path / "out/results").iterdir())) == 1
            assert "the study was stopped" in (tmp_path / "out/report.html").read_text("utf-8")
        finally:
            running.kill()


def _wait_for_jobs(environment: dict[str, str], rounds: int = 600) -> None:
    """Returns when the cluster has no jobs; an assertion fails if it still has some after `rounds` half seconds."""
    for _ in range(rounds):
        listed = subprocess.run(["squeue", "-h"], env=environment, capture_output=True, text=True, timeout=3600)
        assert listed.returncode == 0, listed.stderr
        if not listed.stdout:
            return
        time.sleep(0.5)
    raise AssertionError(f"the cluster still has jobs:\n{listed.stdout}")


def test_the_wait_for_jobs_ends(tmp_path: Path) -> None:
    squeue = tmp_path / "squeue"
    squeue.write_text("#!/bin/sh\necho 7 debug macadam\n")
    squeue.chmod(0o755)
    with pytest.raises(AssertionError, match="still has jobs:\n7 debug"):
        _wait_for_jobs({"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"}, rounds=2)
    squeue.write_text("#!/bin/sh\n")
    _wait_for_jobs({"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"}, rounds=2)


REFUSED = """#!/bin/sh
echo "sbatch: error: User's group not permitted to use this partition" >&2
echo "sbatch: error: invalid partition specified: 'nowhere'" >&2
echo "sbatch: error: Batch job submission failed: Invalid partition name specified" >&2
exit 1
"""


@pytest.mark.parametrize(
    "slurm, says",
    [
        ({"walltime": 90}, 'walltime: found 90, expected text such as "01:30:00" (hours, minutes, seconds)'),
        ({"walltime": "90"}, "walltime: found '90', expected hours, minutes and seconds"),
        ({"walltime": "1-00:00:00"}, "walltime: found '1-00:00:00', expected hours"),
        ({"walltime": "00:00:30"}, "walltime: found '00:00:30', expected hours, minutes and seconds"),
        ({"partition": 3}, "partition: found 3, expected text"),
        ({"max_blocks": "4"}, "max_blocks: found '4', expected a whole number above 0"),
        ({"nodes_per_block": True}, "nodes_per_block: found True, expected a whole number"),
        ({"exclusive": "no"}, "exclusive: found 'no', expected true or false"),
    ],
)
def test_wrong_options_of_slurm_are_refused(slurm: dict, says: str) -> None:
    with pytest.raises(StudyError, match=re.escape(f"run.slurm.{says}")):
        executors.check({"on": "slurm", "slurm": slurm})


def _study(tmp_path: Path, path: str) -> subprocess.CompletedProcess:
    scene(tmp_path)
    (tmp_path / "study.toml").write_text(STUDY)
    line = [sys.executable, "-m", "macadam.study", "study.toml", "--out", "out", "--on", "slurm"]
    environment = {**ENVIRONMENT, "MACADAM_PROGRAM": stand_in(tmp_path)[0], "PATH": path}
    return subprocess.run(line, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=3600)


def test_a_machine_without_slurm_is_told(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    done = _study(tmp_path, str(tmp_path / "empty"))
    assert done.returncode == 2 and 'found "slurm", but no program sbatch in the search path' in done.stderr
    assert "Traceback" not in done.stderr and not (tmp_path / "out").exists()


def test_the_words_of_slurm_are_told(tmp_path: Path) -> None:
    """Slurm refuses the partition: the study reports Slurm's message and does not try again."""
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "sbatch").write_text(REFUSED)
    (programs / "sbatch").chmod(0o755)
    done = _study(tmp_path, f"{programs}{os.pathsep}{os.environ['PATH']}")
    assert done.returncode == 1, done.stderr
    assert (
        "6 results were not computed: no worker could start: error: User's group not permitted to use this partition; "
        "error: invalid partition specified: 'nowhere'; error: Batch job submission failed: Invalid partition name specified\n"
    ) in done.stderr
    assert "Traceback" not in done.stderr
    page = (tmp_path / "out/report.html").read_text("utf-8")
    assert "invalid partition specified: " in page


@pytest.mark.parametrize(
    "message",
    [
        "stderr=sbatch: error: User's group not permitted\nsbatch: error: no partition 'a'\n",
        "stderr=sbatch: error: User's group not permitted\nsbatch: error: no partition 'a'",
        """(stderr="sbatch: error: User's group not permitted\\nsbatch: error: no partition 'a'\\n")""",
        """stderr="sbatch: error: User's group not permitted\\nsbatch: error: no partition 'a'\"""",
    ],
)
def test_the_words_of_slurm_end_with_their_lines(message: str) -> None:
    """Some versions of Parsl put Slurm's lines unchanged into their message, others as a quoted Python string."""
    found = slurm_lines(message)
    assert found == ["error: User's group not permitted", "error: no partition 'a'"]
