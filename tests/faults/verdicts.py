# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds what is wrong with the files that a command left."""
import json
import re
import shutil
import subprocess
import zlib
from pathlib import Path


CHECKPOINTS = ("checkpoint.h5", "checkpoint-previous.h5")


def callers(trace):
    """Returns the innermost functions (at most three) of the program and its library that led to the failed call."""
    if not trace.exists():
        return ""
    names = []
    for line in trace.read_text(errors="replace").splitlines():
        found = re.match(r"(.*)\((.*)\+(0x[0-9a-f]+)\)", line)
        if not found or "macadam" not in Path(found[1]).name or len(names) == 3:
            continue
        name = found[2]
        if not name and shutil.which("addr2line"):
            name = subprocess.run(["addr2line", "-fe", found[1], found[3]], capture_output=True, text=True).stdout.split("\n")[0]
        if shutil.which("c++filt"):
            name = subprocess.run(["c++filt", name], capture_output=True, text=True).stdout.strip()
        names.append(name.replace("(anonymous namespace)::", "").replace("macadam::", "").split("(")[0])
    return " < ".join(names)


class Result:
    """The files of a result folder, and its summary without times."""

    def __init__(self, folder):
        self.files = {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}
        self.summary = timeless(self.files.get("summary.json"))


def timeless(text):
    """Returns a summary without the entries that differ between runs: times, and the scene's name."""
    if text is None:
        return None
    try:
        out = json.loads(text)
    except ValueError:
        return "no JSON"
    out.pop("timing_s", None)
    out.pop("scene", None)
    for result in out.get("results", []):
        result.pop("solve_s", None)
    return out


def differences(found, expected, of_what):
    out = [] if found.summary == expected.summary else [f"another summary.json than of {of_what}"]
    names = (found.files.keys() | expected.files.keys()) - {"summary.json"}
    return out + [f"another {n} than of {of_what}" for n in sorted(names)
                  if not n.endswith(".vtkhdf") and found.files.get(n) != expected.files.get(n)]


def damaged(folder, killed=False):
    """Returns the files that are damaged, and temporary files that were not removed. Does not compare with any result."""
    out = []
    for path in folder.rglob("*"):
        if not path.is_file():
            continue
        bytes_ = path.read_bytes()
        if path.suffix == ".part":
            if not killed:
                out.append(f"{path.name} is left")
        elif path.suffix == ".json":
            try:
                json.loads(bytes_)
            except ValueError:
                out.append(f"{path.name} is no JSON")
        elif path.name in CHECKPOINTS:
            head = re.match(rb"Macadam checkpoint of (\d+) bytes, CRC-32 of those from 512 on ([0-9a-f]{8})\n", bytes_)
            if not head or int(head[1]) != len(bytes_) or int(head[2], 16) != zlib.crc32(bytes_[512:]):
                out.append(f"{path.name} is damaged")
        elif path.suffix == ".vtkhdf" and not bytes_.startswith(b"\x89HDF\r\n\x1a\n"):
            out.append(f"{path.name} is no HDF5 file")
    return out


def left_behind(folder, older, new, outcome, kind):
    """Returns what is wrong with the files that a command left in a folder that contained an older result."""
    out = [text for text in damaged(folder) if not (kind == "remove" and text.endswith("is left"))]
    found = Result(folder)
    if outcome.code == 0:
        if kind == "remove":
            found.files = {name: bytes_ for name, bytes_ in found.files.items() if name not in CHECKPOINTS}
        if "warning: " in outcome.err and isinstance(found.summary, dict):
            found.summary["warnings"] = new.summary["warnings"]
        return out + differences(found, new, "a plain run")
    if older.summary is not None and found.summary == older.summary:
        return out + differences(found, older, "the older result, whose summary is there")
    for name, bytes_ in found.files.items():
        if name in ("summary.json", *CHECKPOINTS) or name.endswith((".part", ".vtkhdf", ".pvd")):
            continue
        of_new = new.files.get(name, b"")
        if bytes_ == of_new or (name == "response.csv" and of_new.startswith(bytes_)):
            continue
        if found.summary is None and bytes_ == older.files.get(name):
            continue  # the run wrote no summary that its message could contradict
        out.append(f"{name} is neither the new one nor told from it")
    if new.summary is None:
        out += [f"{name} is lost" for name in older.files if name in new.files and name not in found.files]
    return out
