# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes from files or dictionaries, with overrides of single keys and options."""
from __future__ import annotations

import copy
import tomllib
from collections.abc import Mapping
from os import PathLike, fspath
from typing import Any

from . import _core, _toml

#: Overrides that are options of the command. All other overrides are keys of the scene.
OPTIONS = ("seed", "backend", "precision", "method", "linear", "threads", "device")

NO_FILE = "scene"  # name that messages use for a scene that does not come from a file


def _entry_of(entries: list[Any], name: str, place: str) -> Any:
    """Returns an entry of an array of tables by its number, from 0, or, if the entries are contacts, by its pair."""
    for entry in entries:
        if isinstance(entry, Mapping) and entry.get("pair") == name:
            return entry
    if name.isdecimal() and int(name) < len(entries):
        return entries[int(name)]
    pairs = [e["pair"] for e in entries if isinstance(e, Mapping) and "pair" in e]
    raise _core.InputError(f"{place}: found {name!r}, expected the position of an entry, from 0 to {len(entries) - 1}"
                           + (f", or one of {', '.join(pairs)}" if pairs else "") if entries else
                           f"{place}: found {name!r}, but the list has no entries")


def set_key(table: dict[str, Any], key: str, value: Any) -> None:
    """Sets a dotted key of a scene's tables: `loading.strain_amplitude`, `contacts.M-A.delta`,
    `specimen.aggregate.0.volume_fraction`. A dictionary is merged into a section; None removes a key."""
    names = key.split(".")
    at: Any = table
    for depth, name in enumerate(names[:-1]):
        if isinstance(at, list):
            at = _entry_of(at, name, ".".join(names[:depth]))
        else:
            at = at.setdefault(name, {})
        if not isinstance(at, (dict, list)):
            raise _core.InputError(f"{key}: found {at!r} at {'.'.join(names[:depth + 1])}, expected a section")
    if isinstance(at, list):
        at = _entry_of(at, names[-1], ".".join(names[:-1]))
        if not isinstance(value, Mapping):
            raise _core.InputError(f"{key}: found {value!r}, expected a dictionary of keys")
        for name, entry in value.items():
            set_key(at, name, entry)
    elif isinstance(value, Mapping) and isinstance(at.get(names[-1]), dict):
        for name, entry in value.items():
            set_key(at[names[-1]], name, entry)
    elif value is None:
        at.pop(names[-1], None)
    else:
        at[names[-1]] = copy.deepcopy(value)


# Returns the tables of a scene's text. file: the scene's name, for messages.
def _tables_of(text: str, file: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        _core.Scene(file, text)  # raises the error with the message of the command
        raise _core.InputError(f"{file}: TOML syntax: found {error}, expected valid TOML") from error


def tables_of(source: str | PathLike[str] | Mapping[str, Any] | _core.Scene,
              file: str | PathLike[str] | None = None) -> tuple[str, dict[str, Any], dict[str, Any]]:
    """Returns a scene's name for messages, a copy of its tables, and its options (a dictionary of names in OPTIONS)."""
    if isinstance(source, _core.Scene):
        return str(source.file), _tables_of(source.text, str(source.file)), source.options
    if isinstance(source, Mapping):
        return fspath(file) if file else NO_FILE, copy.deepcopy(dict(source)), {}
    name = fspath(source)
    return name, _tables_of(_core.Scene.read_text(name), name), {}


class Scene(_core.Scene):
    """A scene: a mix, its laws and a test, read and checked completely.

    source: a file (TOML, docs/scene.md), a dictionary of the same keys, or another Scene.
    overrides: values that replace the scene's own. `seed`, `backend`, `precision`, `method`, `linear`, `threads` and
    `device` are the command's options. Any other name is a key: a section with a dictionary of the values to change
    (`loading={"frequencies": [10]}`), or, in a dictionary, a dotted key (`**{"contacts.M-A.delta": 1.5}`).
    file: for a dictionary, the name of the scene in messages; paths in the dictionary are relative to the folder of
    this file. By default the name is "scene" and the folder is the working folder.

    Raises InputError with the command's message. The message names the line in the file, unless a key is overridden.

        >>> import macadam as mc
        >>> mc.Scene("examples/demo/scene.toml", **{"contacts.M-A.delta": 1.1}, loading={"frequencies": [10]})
        <macadam.Scene examples/demo/scene.toml: cyclic, explicit>
    """

    def __init__(self, source: str | PathLike[str] | Mapping[str, Any] | _core.Scene, *,
                 file: str | PathLike[str] | None = None, **overrides: Any) -> None:
        options = {k: v for k, v in overrides.items() if k in OPTIONS and v is not None}
        keys = {k: v for k, v in overrides.items() if k not in OPTIONS}
        if isinstance(source, _core.Scene) and not keys:
            super().__init__(source)
        elif isinstance(source, (str, PathLike)) and not keys:
            super().__init__(fspath(source))
        else:
            name, tables, before = tables_of(source, file)
            options = {**before, **options}
            for key, value in keys.items():
                set_key(tables, key, value)
            super().__init__(name, _toml.dumps(tables), False)
        self.override(**options)

    def as_dict(self) -> dict[str, Any]:
        """The scene's tables, without options that were overridden."""
        return _tables_of(self.text, str(self.file))

    def __repr__(self) -> str:
        return f"<macadam.Scene {self.file}: {self.kind}, {self.method}>"
