# SPDX-License-Identifier: GPL-3.0-or-later
"""The places of a study that set keys of the scene (grid, hypercubes, lists, choices, experiments), and the order in
which they are applied.

The files of choices are applied first, then the single keys that choices, the grid, hypercubes, lists and the
experiment set. Two places may not set the same key, so the order of single keys does not matter. A file replaces the
whole entry of a pair of contacts; another place may set a key of that entry which the file does not set."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from macadam.study.errors import StudyError
from macadam.study.scenes import Table, merged, read_toml, with_value

Parts = tuple[str, ...]


@dataclass(frozen=True)
class Setting:
    """A key of the scene that one place of the study sets. `replaces`: the key is the entry of a pair of contacts, and
    a file replaces this whole entry."""

    place: str  # such as "grid" or "choice.binder.a"
    key: str
    path: Parts
    replaces: bool = False

    def clash(self, other: Setting) -> str:
        """Returns why the study may not set both this key and the key of `other`; empty if it may."""
        if self.replaces != other.replaces:
            return ""
        if self.path == other.path:
            verb = "replaced" if self.replaces else "set"
            if self.key != other.key:
                return (
                    f"{self.key} and {other.key} are the same entry of the scene: the first is {verb} by {self.place}, "
                    f"the second by {other.place}; expected only one of the two"
                )
            return f"{self.key}: {verb} by {self.place} and by {other.place}, expected only one of the two"
        low, high = (self, other) if len(self.path) > len(other.path) else (other, self)
        if low.path[: len(high.path)] != high.path:
            return ""
        return (
            f"{low.key}: set by {low.place}, and {high.key}, which contains it, by {high.place}; expected only one of the two"
        )


@dataclass
class Changes:
    """The changes that one alternative makes in the scene: sections of a file, then single keys."""

    place: str
    keys: Table = field(default_factory=dict)
    file: str = ""
    sections: Table = field(default_factory=dict)  # sections of the file

    def settings(self, base: Table) -> list[Setting]:
        """Returns all keys that these changes set. base: the scene of the study, from which numbered contacts get their
        pairs."""
        out = [Setting(self.place, key, path_of(key, base)) for key in self.keys]
        where = f"{self.place} (file {self.file})"
        for path, replaces in _paths_of_file(self.sections):
            out.append(Setting(where, ".".join(path), path, replaces))
        return out


def changes_of(place: str, table: Table, folder: Path) -> Changes:
    """Reads the changes of a named choice: the key `file`, a path relative to `folder`, and keys of the scene."""
    keys = dict(table)
    file = keys.pop("file", "")
    if not isinstance(file, str):
        raise StudyError(f"{place}: file: found {file!r}, expected the name of a file")
    return Changes(place, keys, file, read_toml(folder / file) if file else {})


def refuse_clashes(groups: list[list[Changes]], base: Table) -> None:
    """Raises a StudyError if two places set one key, or a key and a section that contains it.

    groups: the alternatives of each factor; a point has one alternative of each group."""
    of_groups = []
    for group in groups:
        found: dict[Setting, None] = {}
        for alternative in group:
            own = alternative.settings(base)
            _refuse(itertools.combinations(own, 2))
            found |= dict.fromkeys(own)
        of_groups.append(found)
    for first, second in itertools.combinations(of_groups, 2):
        _refuse(itertools.product(first, second))


# Raises StudyError for the first pair of settings that clash.
def _refuse(pairs: Any) -> None:
    for one, other in pairs:
        if why := one.clash(other):
            raise StudyError(why)


def applied(base: Table, changes: list[Changes]) -> Table:
    """Returns the scene with all changes: the sections of files are applied first, then single keys."""
    scene = base
    for one in changes:
        if one.sections:
            scene = merged(scene, one.sections)
    for one in changes:
        for key, value in one.keys.items():
            scene = with_value(scene, key, value)
    return scene


def path_of(key: str, scene: Table) -> Parts:
    """Returns the parts of a dotted key. A numbered entry of a list is named by its pair if it has one, so that every
    entry has only one name."""
    path: list[str] = []
    at: Any = scene
    for part in key.split("."):
        if isinstance(at, list):
            index = int(part) if part.isdigit() and len(part) < 8 else -1
            pairs = [e.get("pair") if isinstance(e, dict) else None for e in at]
            if part in pairs:
                index = pairs.index(part)
            elif 0 <= index < len(at):
                part = str(pairs[index] if isinstance(pairs[index], str) else index)
            at = at[index] if 0 <= index < len(at) else None
        else:
            at = at.get(part) if isinstance(at, dict) else None
        path.append(part)
    return tuple(path)


def _paths_of_file(table: Table, before: Parts = ()) -> Iterator[tuple[Parts, bool]]:
    """Yields the path of every key that a file sets (with False), and of every entry of a pair that it replaces (with
    True)."""
    for key, value in table.items():
        if key == "contacts" and isinstance(value, list) and all(isinstance(e, dict) for e in value):
            for entry in value:
                pair = str(entry.get("pair"))
                yield (*before, key, pair), True
                yield from (((*before, key, pair, name), False) for name in entry if name != "pair")
        elif isinstance(value, dict):
            yield from _paths_of_file(value, (*before, key))
        else:
            yield (*before, key), False
