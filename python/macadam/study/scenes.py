# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the scenes of a study's points: sets values at dotted keys, resolves paths of files, and computes the key of a
result."""

from __future__ import annotations

import copy
import hashlib
import json
import tomllib
from pathlib import Path
from typing import Any

from macadam import _toml
from macadam.study.errors import StudyError

# Keys of a scene whose values name a file or folder; for each key, the values that have another meaning.
_FILES = {
    ("specimen", "file"): (),
    ("specimen", "aggregate_file"): (),
    ("materials", "mastic", "from"): (),
    ("specimen", "shapes", "library"): ("aggregates", "icosahedron", "aggregates and icosahedron"),
}

Table = dict[str, Any]


def read_toml(file: Path) -> Table:
    """Reads a TOML file. Raises StudyError that names the file."""
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:  # ValueError: invalid UTF-8, invalid TOML, numbers of thousands of digits
        raise StudyError(f"{file}: {getattr(error, 'strerror', None) or error}") from None
    except RecursionError:
        raise StudyError(f"{file}: found lists or tables nested too deeply for Python, expected fewer levels") from None


def with_value(scene: Table, key: str, value: Any) -> Table:
    """Returns a copy of the scene with a value at a dotted key. A table replaces the whole section.
    `contacts.M-A.delta` means the entry of that pair, `specimen.aggregate.0.volume_fraction` the first class. Missing
    sections are made."""
    changed = copy.deepcopy(scene)
    parts, at = key.split("."), changed
    if not all(parts):
        raise StudyError(f"key {key!r}: found an empty name between dots")
    for k, part in enumerate(parts[:-1]):
        at = _step(at, part, ".".join(parts[: k + 1]))
    if isinstance(at, list):
        at[_index(at, parts[-1], key)] = value
    else:
        at[parts[-1]] = value
    return changed


# Returns the section or entry that one part of a dotted key names; makes a missing section.
def _step(at: Any, part: str, key: str) -> Any:
    if isinstance(at, list):
        return at[_index(at, part, key)]
    following = at.setdefault(part, {})
    if not isinstance(following, (dict, list)):
        raise StudyError(f"key {key}: found the value {following!r} in the scene, expected a section")
    return following


# Returns the index of an entry in an array of tables, by its pair or its number.
def _index(entries: list[Any], part: str, key: str) -> int:
    pairs = [e.get("pair") if isinstance(e, dict) else None for e in entries]
    if part in pairs:
        return pairs.index(part)
    if part.isdigit() and int(part) < len(entries):
        return int(part)
    named = [str(p) for p in pairs if p]
    have = f"the pairs {', '.join(named)}" if named else f"{len(entries)} entries, numbered from 0"
    raise StudyError(f"key {key}: found no {part!r} in the scene; the scene has {have}")


def merged(scene: Table, more: Table) -> Table:
    """Returns a copy of the scene with the sections of another file, such as a law of `macadam fit`. An entry of
    contacts replaces the whole entry of the same pair, at the same position in the list; in other sections single keys
    are replaced."""
    out = copy.deepcopy(scene)
    for key, value in more.items():
        if key == "contacts" and isinstance(value, list):
            out["contacts"] = _contacts(out.get("contacts", []), copy.deepcopy(value))
        elif isinstance(value, dict) and isinstance(out.get(key), dict):
            out[key] = merged(out[key], value)
        else:
            out[key] = copy.deepcopy(value)
    return out


# Returns the contacts with the new entries in place of the old entries of the same pairs; entries of other pairs are appended.
def _contacts(there: Any, new: list[Any]) -> list[Any]:
    for contacts in (new, there):
        if not isinstance(contacts, list) or not all(isinstance(c, dict) for c in contacts):
            raise StudyError(f"contacts: found {contacts!r}, expected tables [[contacts]]")
    pairs = [c.get("pair") for c in new]
    for pair in pairs:
        if pairs.count(pair) > 1:
            raise StudyError(f"contacts: found the pair {pair!r} more than once in a file, expected each pair once")
    kept = [new[pairs.index(c.get("pair"))] if c.get("pair") in pairs else c for c in there]
    had = [c.get("pair") for c in there]
    return kept + [c for c in new if c.get("pair") not in had]


def located(scene: Table, folder: Path) -> tuple[Table, dict[str, str]]:
    """Returns a copy of the scene with absolute paths in place of paths relative to `folder`, and a digest of every
    file that the scene names, by dotted key."""
    scene, digests = copy.deepcopy(scene), {}
    for keys, names in _FILES.items():
        at: Any = scene
        for part in keys[:-1]:
            at = at.get(part, {}) if isinstance(at, dict) else {}
        value = at.get(keys[-1]) if isinstance(at, dict) else None
        if isinstance(value, str) and value not in names:
            path = (folder / value).resolve()
            if not path.exists():
                raise StudyError(f"{'.'.join(keys)}: found {value!r}, but there is no {path}")
            at[keys[-1]] = str(path)
            digests[".".join(keys)] = _digest(path)
    return scene, digests


# Returns the SHA-256 digest of a file, or of the names and contents of all files in a folder.
def _digest(path: Path) -> str:
    sha = hashlib.sha256()
    for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
        if file.is_file():
            sha.update(str(file.relative_to(path)).encode())
            sha.update(file.read_bytes())
    return sha.hexdigest()


def normal(value: Any) -> Any:
    """Returns the value with whole numbers as integers, so that 1 and 1.0 are equal in lists and in JSON text too."""
    if isinstance(value, dict):
        return {key: normal(v) for key, v in value.items()}
    if isinstance(value, list):
        return [normal(v) for v in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def key_of(scene: Table, digests: dict[str, str], command: list[str], version: str) -> str:
    """Returns the key of a result, which is its folder's name. It is the same for the same scene, content of the
    scene's files, command and version of macadam."""
    plain = copy.deepcopy(scene)
    for dotted, digest in digests.items():
        plain = with_value(plain, dotted, f"sha256:{digest}")
    text = json.dumps([plain, command, version], sort_keys=True, ensure_ascii=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:20]


def text_of(scene: Table) -> str:
    """Returns the scene as TOML text."""
    try:
        return _toml.dumps(scene)
    except TypeError as error:
        raise StudyError(str(error)) from None
