# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands on the documentation pages. Those of the start page, the how-tos and the tutorial are run as a reader types
them, in order. For every other command, and for those that a page marks `<!-- not run: REASON -->`, the test checks
that the program knows the subcommand and all options."""
import json
import os
import re
import shlex
import subprocess
import sys
from functools import cache

import pytest
from conftest import PROGRAM, ROOT

RUN = [ROOT / "docs" / "start.md", ROOT / "docs" / "tutorial-paper.md", *sorted((ROOT / "docs" / "how-to").glob("*.md"))]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").rglob("README.md")])
FENCE = re.compile(r"(?:<!-- (file|not run): ([^>]+?) -->\n)?^```(\w+)\n(.*?)^```$", re.M | re.S)
pytestmark = pytest.mark.skipif(not PROGRAM, reason="MACADAM_PROGRAM names no program")


def shell_lines(page):
    """Yields (line number, command) of every line of a shell block, fenced or indented, that calls macadam."""
    text = re.sub(r"\\\n\s*", lambda m: " " * len(m[0]), page.read_text(encoding="utf-8"))  # joins continued lines
    fence = None
    for number, line in enumerate(text.splitlines(), 1):
        if m := re.match(r"```(\w*)", line):
            fence = None if fence is not None else m[1]
        elif (fence == "sh" or fence is None and line.startswith("    ")) and \
                (m := re.match(r"\s*(?:build/\w+/)?macadam ((?:run|specimen|shapes|ct|fit|calibrate|info|mcp|mixture|report|study|new|check)\b.*)", line)):
            yield number, m[1]


COMMANDS = [pytest.param(line, id=f"{page.relative_to(ROOT)}:{number}") for page in PAGES for number, line in shell_lines(page)]


@cache
def options(command):
    """Returns the options that the help of a command lists. The help of a command written in Python is printed by its
    argument parser."""
    words = [sys.executable, "-m", f"macadam.{command[0]}"] if command[0] in ("mcp", "mixture", "report", "study") else [PROGRAM, *command]
    told = subprocess.run([*words, "--help"], capture_output=True, text=True, timeout=3600)
    assert told.returncode == 0, f"{' '.join(command)} --help: {told.stderr}"
    return set(re.findall(r"(?<![\w-])--?[a-zA-Z][\w-]*", told.stdout))


def test_there_are_commands():
    assert len(COMMANDS) > 40


@pytest.mark.parametrize("line", COMMANDS)
def test_options_are_known(line):
    line = re.split(r"\s(?:#|&&|\|\||;|>|\|\s)|;|\s{3,}#", line)[0]
    words = [w for w in shlex.split(line.replace("…", "").replace("[", " ").replace("]", " ")) if w]
    commands = [c.split("|") for c in words[:2]] if words[0] in ("shapes", "ct") else [words[:1]]
    every = [(a, b) for a in commands[0] for b in commands[1]] if len(commands) == 2 else [(words[0],)]
    for command in every:
        asked = {w.split("=")[0] for w in words if re.match(r"--?[a-zA-Z]", w)}
        assert asked <= options(command), f"macadam {' '.join(command)} has no {asked - options(command)}"


INLINE = re.compile(r"`(--[a-z][\w-]*) ([^`]+)`")  # an option with a value in a sentence


def not_run(page):
    """Yields the commands in those blocks of a page that are not run. Yields each command again with every option for
    which a sentence of the page gives a value."""
    text = page.read_text(encoding="utf-8")
    commands = [line for kind, _, language, code in FENCE.findall(text) if kind == "not run" and language == "sh"
                for line in code.replace("\\\n", " ").splitlines() if line.startswith("macadam ")]
    for line in commands:
        words = shlex.split(line)[1:]
        known = options(tuple(words[:2] if words[0] in ("shapes", "ct") else words[:1]))
        yield words
        for option, value in INLINE.findall(text):
            if option in known:
                yield [*words, option, *shlex.split(value)[:1]]


def values_not_run():
    return [pytest.param(words, id=f"{page.stem}: {' '.join(words)}") for page in RUN for words in not_run(page)] if PROGRAM else []


@pytest.mark.parametrize("words", values_not_run())
def test_values_of_options_are_accepted(words, tmp_path):
    """In an empty folder a command must fail because its inputs are missing, not because of its options."""
    ran = subprocess.run([PROGRAM, *words], cwd=tmp_path, text=True, capture_output=True, timeout=3600)
    assert ran.returncode == 2 and not re.search(r"(?m)^macadam: (command line: )?--", ran.stderr), ran.stderr


def runnable(page):
    """Yields the steps of a reader in order: files to save, and blocks to run."""
    for kind, what, language, code in FENCE.findall(page.read_text(encoding="utf-8")):
        if kind == "file":
            yield what, code
        elif language == "sh" and not kind:
            yield None, code


@pytest.mark.parametrize("page", RUN, ids=lambda p: p.stem)
def test_page_runs(page, tmp_path):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "macadam").symlink_to(PROGRAM)
    environment = {**os.environ, "PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}", "MACADAM_PYTHON": sys.executable,
                   "OMP_WAIT_POLICY": "passive"}
    blocks = list(runnable(page))
    for file, code in blocks:
        if file:
            (tmp_path / file).write_text(code, encoding="utf-8")
            continue
        ran = subprocess.run(["bash", "-eu", "-o", "pipefail", "-c", code], cwd=tmp_path, env=environment, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=3600)
        assert ran.returncode == 0, f"{page.name}:\n{code}\n{ran.stdout}"
    if page.stem == "start":
        as_told(page.read_text(encoding="utf-8"), tmp_path)


def as_told(text, folder):
    """Asserts that the numbers on the start page are those that the commands gave, and that the report was written."""
    told = re.findall(r"^ {4} +([\d.]+) +([\d.]+) +([\d.]+) +[\d.]+e-\d+ ", text, re.M)
    found = json.loads((folder / "results" / "mix" / "summary.json").read_text(encoding="utf-8"))["results"]
    assert len(told) == len(found) > 4
    for (hz, modulus, phase), row in zip(told, found):
        assert float(hz) == row["frequency_hz"]
        # a program built by another compiler adds terms in another order
        assert float(modulus) == pytest.approx(row["e_star_pa"] / 1e9, rel=1e-4)
        assert float(phase) == pytest.approx(row["phase_deg"], abs=1e-2)
    assert (folder / "mix.html").stat().st_size > 100_000
