# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts a study that never ends, for tests that stop it."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import psutil

from report_folders import ENVIRONMENT
from study_faults import lines, scene, stand_in

STUDY = """
scene = "scene.toml"
[grid]
"contacts.M-A.delta" = [1.0, 2.0, 3.0]
[run]
workers = 2
"""


class Running:
    """A study that runs in its own session. One of its points ends, and two points run forever."""

    def __init__(self, folder: Path, place: str, study: str = STUDY, environment: dict[str, str] | None = None) -> None:
        self.folder, self.out, self.go = folder, folder / "out", folder / "go"
        program, self.log = stand_in(folder, go=self.go)
        scene(folder)
        (folder / "study.toml").write_text(study)
        self.line = [sys.executable, "-m", "macadam", "study", "study.toml", "--out", str(self.out), "--on", place]
        self.how = {"cwd": folder, "env": {**(environment or ENVIRONMENT), "MACADAM_PROGRAM": program}, "text": True}
        self.process = subprocess.Popen(self.line, stderr=subprocess.PIPE, start_new_session=True, **self.how)

    def wait_for_work(self) -> None:
        """Returns when the first point is done and the two programs that never end are running."""
        while len(list((self.out / "results").glob("*"))) < 1 or len(lines(self.log, "begin")) < 3:
            assert self.process.poll() is None, self.process.stderr.read()
            time.sleep(0.01)

    def left(self) -> set[psutil.Process]:
        """Returns the processes that this study started, found by the study's folder in their command lines, and their
        children."""
        found = set()
        for process in psutil.process_iter():
            try:
                if process.pid != self.process.pid and str(self.folder) in " ".join(process.cmdline()):
                    found |= {process, *process.children(recursive=True)}
            except psutil.Error:
                continue
        return found | set(psutil.Process(self.process.pid).children(recursive=True) if self.alive() else ())

    def alive(self) -> bool:
        return self.process.poll() is None

    def kill(self) -> None:
        for process in self.left():
            try:
                process.kill()
            except psutil.Error:
                continue
        if self.alive():
            self.process.kill()
        self.process.wait()
