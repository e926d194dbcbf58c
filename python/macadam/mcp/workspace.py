# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the MCP server. They call the program with `--json` and work only in one folder. They need no package
for MCP."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path
from typing import Any

from macadam import _toml
from macadam.mcp.paths import RequestError, check_files, inside
from macadam.report import ReportError, report
from macadam.study.errors import StudyError
from macadam.study.program import find_program

_KEY = re.compile(r"[A-Za-z0-9_.-]+")  # path of a key in a scene, such as contacts.M-A.delta


class Workspace:
    """A folder, and the functions that an assistant may call in it. Paths are relative to the folder. Every function
    raises RequestError if a path leads out of the folder or an argument is wrong."""

    def __init__(self, root: str | Path, threads: int = 0) -> None:
        """root: the folder, which must exist. threads: largest number of threads of a run; 0: the program's choice.
        Raises RequestError if the folder or the program macadam is missing."""
        self.root = Path(root).resolve()
        if not self.root.is_dir():
            raise RequestError(f"{root}: found no such folder, expected the folder to work in")
        if threads < 0:
            raise RequestError(f"threads: found {threads}, expected a number from 1, or 0 for the program's choice")
        self.threads = threads
        try:
            self.program = find_program()
        except StudyError as error:
            raise RequestError(str(error)) from None

    def info(self) -> dict[str, Any]:
        """Returns the version, the processor, the GPUs and the backend that macadam would choose.

        The result has `code`, the exit code (0 is success), and `events`, with one event `info`."""
        return self._events("info")

    def new_scene(self, file: str, test: str = "cyclic", cracks: bool = False) -> dict[str, Any]:
        """Writes a commented scene of an asphalt mix into a new file and returns its path and text. SI units.

        file: name of the scene, such as "mix.toml"; an existing file is never replaced. test: kind of the loading test:
        cyclic, sweep, relaxation, creep, monotonic, history, indirect_tension, indirect_tensile_strength, bending,
        semicircular_bending, three_point_bending, torsion or cooling. cracks: whether contacts crack; for tests of strength."""
        path = inside(self.root, file)
        done = self._call("new", f"--test={test}", *(["--cracks"] if cracks else []), str(path))
        if done.returncode:
            raise RequestError(_message(done))
        return {"scene": self._name(path), "text": path.read_text(encoding="utf-8")}

    def check(self, scene: str, overrides: dict[str, Any] | None = None) -> dict[str, Any]:
        """Checks a scene and predicts particles, memory, files and times [s] of its run. Nothing is written.

        scene: the scene's file. overrides: values of keys in place of those in the file, such as {"specimen.seed": 3,
        "loading.frequencies": [1, 10]}. The result has `code`, the exit code (0 is success, 2 a wrong scene), and
        `events`: one event `forecast` or `error`."""
        return self._events("check", *self._scene(scene, overrides))

    def run(self, scene: str, out: str, overrides: dict[str, Any] | None = None) -> dict[str, Any]:
        """Runs a scene and returns when it has finished. Call check() first, because a run can take hours.

        scene and overrides: as for check(). out: folder of the results; results in it are replaced. The result has
        `code`, the exit code (0 is success), and `events` without the progress: `start`, `prepared`, `planned`,
        `warning`, `result` with the results in SI units, `error` and `end`."""
        arguments = self._scene(scene, overrides)
        if self.threads:
            arguments.append(f"--threads={self.threads}")
        return self._events("run", *arguments, f"--out={inside(self.root, out)}")

    def results(self, folder: str) -> dict[str, Any]:
        """Returns the results in a folder: `summary`, the contents of summary.json in SI units, and `files`, the sizes
        of all files by name [bytes].

        folder: the folder that run() wrote."""
        path = inside(self.root, folder)
        file = path / "summary.json"
        if not file.is_file():
            raise RequestError(f"{folder}: found no file summary.json, expected a folder of results")
        try:
            summary = json.loads(inside(self.root, f"{folder}/summary.json").read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise RequestError(f"{folder}/summary.json: {error}") from None
        sizes = {str(f.relative_to(path)): f.stat().st_size for f in sorted(path.rglob("*")) if f.is_file() and not f.is_symlink()}
        return {"folder": self._name(path), "summary": summary, "files": sizes}

    def report(self, folder: str, file: str = "report.html", view: bool = False) -> dict[str, Any]:
        """Writes an HTML report with pictures about a folder of results and returns its path.

        folder: the folder that run() wrote. file: name of the page, which ends in .html. view: also write a page with a view in three
        dimensions beside it."""
        path, page = inside(self.root, folder), inside(self.root, file)
        if page.suffix != ".html":
            raise RequestError(f"file: found {file!r}, expected a name that ends in .html")
        try:
            report(path, page, view=view)
        except (ReportError, OSError) as error:
            raise RequestError(str(error)) from None
        return {"report": self._name(page)}

    # Returns the arguments that name a scene and its overrides.
    def _scene(self, scene: str, overrides: dict[str, Any] | None) -> list[str]:
        path = inside(self.root, scene)
        arguments = [str(path)]
        for key, value in (overrides or {}).items():
            if not _KEY.fullmatch(key):
                raise RequestError(f"overrides: found the key {key!r}, expected a path such as loading.frequencies")
            try:
                arguments.append(f"--set={key}={_toml.value(value)}")
            except TypeError as error:
                raise RequestError(f"overrides: {key}: {error}") from None
        check_files(self.root, path, overrides or {})
        return arguments

    # Returns the exit code of a command of the program and its events without the progress.
    def _events(self, *arguments: str) -> dict[str, Any]:
        done = self._call(*arguments, "--json")
        events = []
        for line in done.stdout.splitlines():
            try:
                event = json.loads(line)
            except ValueError:
                raise RequestError(f"macadam {arguments[0]}: found the line {line[:80]!r}, expected JSON") from None
            if event.get("event") != "progress":
                events.append(event)
        if not events:
            raise RequestError(f"macadam {arguments[0]}: {_message(done)}")
        return {"code": done.returncode, "events": events}

    # Runs the program in the folder and waits for its end.
    def _call(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        try:
            return subprocess.run(
                [self.program, *arguments], cwd=self.root, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace"
            )
        except OSError as error:
            raise RequestError(f"{self.program}: {error.strerror}") from None

    # Returns a path relative to the folder.
    def _name(self, path: Path) -> str:
        return str(path.relative_to(self.root))


# Returns the error message of a program that failed, or its exit code.
def _message(done: subprocess.CompletedProcess[str]) -> str:
    return done.stderr.strip() or f"exit code {done.returncode}"
