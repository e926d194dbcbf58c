# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes dictionaries as TOML: only the types that a scene can hold, no dates."""
from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from typing import Any


# Returns the name of a key in TOML, in quotes if necessary.
def _key(name: object) -> str:
    text = str(name)
    bare = text and all(c.isalnum() and c.isascii() or c in "-_" for c in text)
    return text if bare else json.dumps(text)


# Returns a float in TOML: with a point or an exponent.
def _number(value: float) -> str:
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    text = repr(float(value))
    return text if any(c in text for c in ".en") else text + ".0"


def _plain(value: Any) -> Any:
    """Returns numbers and arrays of NumPy as Python numbers and lists, and paths as texts."""
    if isinstance(value, PathLike):
        return fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    return value


def value(of: Any) -> str:
    """Returns one value as TOML, on one line. Raises TypeError for a type that a scene cannot hold."""
    of = _plain(of)
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, int):
        return str(of)
    if isinstance(of, float):
        return _number(of)
    if isinstance(of, str):
        return json.dumps(of, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(of, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {value(v)}" for k, v in of.items() if v is not None) + "}"
    if isinstance(of, Sequence):
        return "[" + ", ".join(map(value, of)) + "]"
    raise TypeError(f"a scene cannot hold a {type(of).__name__}: {of!r}")


# Returns whether a value is a list of dictionaries, which TOML writes as an array of tables.
def _tables(of: Any) -> bool:
    return isinstance(of, (list, tuple)) and len(of) > 0 and all(isinstance(x, Mapping) for x in of)


def dumps(table: Mapping[str, Any], path: str = "") -> str:
    """Returns the TOML text of a table and of the tables in it. Keys whose value is None are left out."""
    keys, tables = "", ""
    for name, entry in table.items():
        full = f"{path}.{_key(name)}" if path else _key(name)
        if isinstance(entry, Mapping):
            tables += f"\n[{full}]\n" + dumps(entry, full)
        elif _tables(entry):
            for one in entry:
                tables += f"\n[[{full}]]\n" + dumps(one, full)
        elif entry is not None:
            keys += f"{_key(name)} = {value(entry)}\n"
    return keys + tables
