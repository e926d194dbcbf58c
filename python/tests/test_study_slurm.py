# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies on a Slurm cluster: a real one, of this machine alone."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from slurm_cluster import cluster, why_not

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
            timeout=280,
        )
    assert done.returncode == 1, done.stderr  # 13 fails
    assert "expected better luck" in done.stderr and "5 results, 1 failed" in done.stdout
    assert sorted(lines(log, "begin")) == [11.0, 12.0, 13.0, 14.0, 15.0, 16.0]
    records = [json.loads(f.read_text()) for f in (out / "results").glob("*/study.json")]
    assert len(records) == 5 and all(int(r["machine"]["slurm_job_id"]) > 0 for r in records)  # by a job of the cluster
