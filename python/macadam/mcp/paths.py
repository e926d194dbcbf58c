# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps paths inside the folder of the MCP server, also those that a scene names."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

#: Keys of a scene whose values are files or folders.
FILE_KEYS = ("file", "aggregate_file", "library", "from")


class RequestError(ValueError):
    """An argument is wrong. The message names the argument, the value found and the value expected."""


def inside(root: Path, name: str | Path, start: Path | None = None) -> Path:
    """Returns the absolute path of `name`, which is relative to `start` (default: `root`), with symbolic links
    followed. Raises RequestError if the path is not inside the folder `root`, or is not a name of a file."""
    try:
        path = ((start or root) / name).resolve()
    except (OSError, RuntimeError, ValueError) as error:  # a loop of links, or a zero byte
        raise RequestError(f"{str(name)!r}: {error}") from None
    if not str(name) or not path.is_relative_to(root):
        raise RequestError(f"{str(name)!r}: found a path outside of the folder of this server, expected one inside")
    return path


def check_files(root: Path, scene: Path, overrides: Mapping[str, Any]) -> None:
    """Raises RequestError if a scene, the overrides of its keys, or a scene that it takes its mastic from name a file
    outside of the folder `root`. A missing scene is not an error; the program reports it."""
    values = [(key.rsplit(".", 1)[-1], value) for key, value in overrides.items()]
    _check(root, scene, values, set())


# Checks the scene and the values of keys, which are relative to the folder of the scene. seen: scenes checked before.
def _check(root: Path, scene: Path, values: list[tuple[str, Any]], seen: set[Path]) -> None:
    if scene in seen:
        return
    seen.add(scene)
    for key, value in (*values, ("", _read(scene))):
        for found_key, name in _files(key, value):
            path = inside(root, name, scene.parent)
            if found_key == "from" and path.is_file():
                _check(root, path, [], seen)


# Returns the keys of a scene, empty if there is no such file.
def _read(scene: Path) -> dict[str, Any]:
    if not scene.is_file():
        return {}
    try:
        return tomllib.loads(scene.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise RequestError(f"{scene.name}: {error}") from None


# Yields the key and the value of every key in a value that names a file.
def _files(key: str, value: Any) -> Iterator[tuple[str, str]]:
    if isinstance(value, str) and key in FILE_KEYS:
        yield key, value
    elif isinstance(value, Mapping):
        for name, entry in value.items():
            yield from _files(str(name), entry)
    elif isinstance(value, (list, tuple)):
        for entry in value:
            yield from _files(key, entry)
