#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests completion in shells, and the manual page: shell_command_test.py PROGRAM"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
failed = 0


def expect(right: bool, what: str) -> None:
    global failed
    if not right:
        failed += 1
        print("FAILED:", what)


def said(*arguments: str) -> str:
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def completed(script: str, folder: str, line: str) -> set[str]:
    """Returns what bash offers at the end of a line, from the function that `complete -F` names."""
    ask = (
        f"source '{script}'\n"
        "function_of=$(complete -p macadam | sed -E 's/.*-F ([^ ]+).*/\\1/')\n"
        "COMP_WORDS=($1)\n[[ $1 == *' ' ]] && COMP_WORDS+=('')\n"
        "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMP_LINE=$1 COMP_POINT=${#1}\n"
        "compopt() { :; }\n"  # compopt works only in a completion that bash itself began
        "$function_of macadam\n"
        "printf '%s\\n' \"${COMPREPLY[@]}\"\n"
    )
    done = subprocess.run(["bash", "-c", ask, "bash", line], check=True, capture_output=True, text=True, cwd=folder)
    expect(done.stderr == "", f"{line}: {done.stderr}")
    return set(done.stdout.split("\n")) - {""}


with tempfile.TemporaryDirectory() as folder:
    script = os.path.join(folder, "bash.sh")
    pathlib.Path(script).write_text(said("completion", "bash"), encoding="utf-8")
    expect(subprocess.run(["bash", "-n", script], check=False).returncode == 0, "bash -n")
    (pathlib.Path(folder) / "my scene.toml").touch()
    (pathlib.Path(folder) / "results").mkdir()
    for line, offered in {
        "macadam ru": {"run"},
        "macadam shapes f": {"fill"},
        "macadam shapes fill --sin": {"--single"},
        "macadam run --backend c": {"cuda", "cpu"},
        "macadam run x.toml --backend re": {"reference"},
        "macadam run my": {"my scene.toml"},
        "macadam run x.toml --out re": {"results"},
        "macadam specimen x.toml --seed ": set(),
        "macadam completion ": {"bash", "zsh", "fish"},
        "macadam run --met": {"--method"},
    }.items():
        found = completed(script, folder, line)
        expect(found == offered, f"{line!r}: found {found}, expected {offered}")
    commands = completed(script, folder, "macadam ")
    expect({"run", "new", "check", "study", "ct"} <= commands, f"commands: {commands}")

    page = os.path.join(folder, "macadam.1")
    text = said("man")
    pathlib.Path(page).write_text(text, encoding="utf-8")
    for words in ["macadam shapes fill", "\\-\\-backend", "EXIT STATUS"]:
        expect(words in text, f"manual page: no {words!r}")
    if shutil.which("man"):
        shown = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", page], check=False, capture_output=True,
                               text=True, env={**os.environ, "MANWIDTH": "100", "MANPAGER": "cat"})
        expect(shown.returncode == 0 and shown.stderr == "", f"man: {shown.stderr}")
        expect("macadam run examples/demo/scene.toml --out results" in shown.stdout, "man: no example of run")
    if shutil.which("mandoc"):
        lint = subprocess.run(["mandoc", "-Tlint", "-W", "error", page], check=False, capture_output=True, text=True)
        expect(lint.returncode == 0, f"mandoc: {lint.stdout}")
    for shell in ("zsh", "fish"):
        other = os.path.join(folder, shell)
        pathlib.Path(other).write_text(said("completion", shell), encoding="utf-8")
        if shutil.which(shell):
            done = subprocess.run([shell, "-n", other], check=False, capture_output=True, text=True)
            expect(done.returncode == 0, f"{shell} -n: {done.stderr}")

sys.exit(1 if failed else 0)
