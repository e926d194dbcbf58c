# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads values of a design: numbers in SI units, or text with a unit, as in scenes."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NoReturn

from macadam.mixture.errors import refuse

LENGTH = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6}
MODULUS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
DENSITY = {"kg/m3": 1.0, "kg/m^3": 1.0, "kg/m³": 1.0, "g/cm3": 1e3, "g/cm^3": 1e3, "g/cm³": 1e3}
FREQUENCY = {"Hz": 1.0, "kHz": 1e3, "mHz": 1e-3}
TEMPERATURE = {"degC": 1.0, "°C": 1.0, "C": 1.0}
FRACTION = {"%": 1e-2}

_TEXT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*")


class Section:
    """A table of a design. It knows its file and its name, so that messages can name both.

    table: its values by key. file: the design. name: such as `[binder]`. known: every key that it may have; another key
    raises MixtureError that names the nearest known key."""

    def __init__(self, table: Any, file: Any, name: str, known: Iterable[str]) -> None:
        self.file, self.name = file, name
        if not isinstance(table, Mapping):
            refuse(file, name, repr(table), "a table")
        self.table = dict(table)
        known = list(known)
        for key in self.table:
            if key not in known:
                near = difflib.get_close_matches(key, known, 1)
                hint = f"; did you mean {near[0]}?" if near else ""
                refuse(file, self.at(key), "an unknown key", "one of " + ", ".join(known) + hint)

    def __contains__(self, key: str) -> bool:
        return key in self.table

    def at(self, key: str) -> str:
        """Returns the name of a key in messages, such as `[binder] file`."""
        return f"{self.name} {key}".strip()

    def refuse(self, key: str, found: Any, expected: str) -> NoReturn:
        """Raises MixtureError about a key."""
        refuse(self.file, self.at(key), found, expected)

    def require(self, key: str, expected: str) -> Any:
        """Returns the value of a key that must be there."""
        if key not in self.table:
            self.refuse(key, "nothing", expected)
        return self.table[key]

    def number(
        self,
        key: str,
        units: Mapping[str, float],
        default: float | None = None,
        rule: Callable[[float], bool] = lambda _: True,
        expected: str = "a number",
    ) -> float:
        """Returns a number in SI units. Raises MixtureError if it is missing without a default, is no number, has a
        unit that is not in `units`, or breaks the rule that `expected` describes."""
        if key not in self.table:
            if default is None:
                self.refuse(key, "nothing", expected)
            return float(default)
        return self.value(key, self.table[key], units, rule, expected)

    def numbers(
        self,
        key: str,
        units: Mapping[str, float],
        rule: Callable[[float], bool] = lambda _: True,
        expected: str = "numbers",
        size: int | None = None,
    ) -> list[float]:
        """Returns a list of numbers in SI units, of `size` entries if a size is given."""
        values = self.require(key, expected)
        if not isinstance(values, list) or not values or size not in (None, len(values)):
            self.refuse(key, repr(values), f"a list of {expected}" if size is None else f"{size} values: {expected}")
        return [self.value(key, v, units, rule, expected) for v in values]

    def value(
        self, key: str, value: Any, units: Mapping[str, float], rule: Callable[[float], bool], expected: str
    ) -> float:
        """Returns one value of a key in SI units."""
        number = math.nan
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            number = float(value)
        elif isinstance(value, str) and (text := _TEXT.fullmatch(value)):
            if text[2] and text[2] not in units:
                self.refuse(key, repr(value), f"{expected}, with a unit out of {', '.join(units)}")
            number = float(text[1]) * units.get(text[2], 1.0)
        if not math.isfinite(number) or not rule(number):
            self.refuse(key, repr(value), expected)
        return number

    def text(self, key: str, choices: Iterable[str] | None = None, default: str | None = None) -> str:
        """Returns a text, which must be one of `choices` if they are given."""
        expected = "a text" if choices is None else "one of " + ", ".join(f'"{c}"' for c in choices)
        if key not in self.table and default is not None:
            return default
        value = self.require(key, expected)
        if not isinstance(value, str) or (choices is not None and value not in choices):
            self.refuse(key, repr(value), expected)
        return value


def positive(value: float) -> bool:
    """Whether a value is above 0."""
    return value > 0


def millimetres(value: float) -> str:
    """Returns a length [m] as text in mm."""
    return f"{1e3 * value:.6g} mm"
