# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions that queries in marks may call in addition to SQLite's own. They write numbers as text, return parts of
lines, and read facts from files."""
import math
import re
from pathlib import Path

from pages import numbers

ROOT = Path(__file__).resolve().parents[2]


class Refused(LookupError):
    """Raised if a query has no result, or a result that it must not have."""


def path(name):
    """Returns the path of a committed file. Raises Refused if it does not exist."""
    file = ROOT / name if "/" in name else ROOT / "bench" / "results" / name
    if not file.is_file():
        raise Refused(f"{file.relative_to(ROOT)} is not there: bench/README.md says which command makes it")
    return file


def comment(name, number=0):
    """Returns a comment line of a file, without its #."""
    found = [line[1:].strip() for line in path(name).read_text(encoding="utf-8").splitlines() if line.startswith("#")]
    if number >= len(found):
        raise Refused(f"{name} has {len(found)} comment lines, not {number + 1:.0f}")
    return found[int(number)]


def text(form, *values):
    """Returns the values in a format of Python, with minus signs. NULL if a value is NULL."""
    if any(value is None for value in values):
        return None
    return re.sub(r"(?<![\w)}])-(?=[\d.])", "−", form.format(*values))


def part(line, pattern):
    """Returns the first group of a regular expression in a text, NULL if the text does not match."""
    found = re.search(pattern, line)
    return found[1] if found else None


def asserted(file, test, name, literal):
    """Returns a number that a test of tests/FILE.cpp (or a helper function of the file) asserts: one EXPECT or ASSERT
    statement must contain both the literal and the name."""
    found = next(iter(sorted((ROOT / "tests").rglob(f"{file}.cpp"))), None)
    if found is None:
        raise Refused(f"tests/ has no {file}.cpp")
    body = re.search(rf"^( *)(?:TEST\w*\(\w+, |static void ){re.escape(test)}\b(.*?)^\1}}",
                     found.read_text(encoding="utf-8"), re.M | re.S)
    if not body:
        raise Refused(f"{file}.cpp has no test {test}")
    for statement in re.findall(r"\b(?:EXPECT|ASSERT)_[^;]*;", body[2]):
        if (re.search(rf"\b{re.escape(name)}\b", statement)
                and re.search(rf"(?<![\w.]){re.escape(literal)}(?![\w.])", statement)):
            return numbers.minus(literal.rstrip("f"))
    raise Refused(f"{test} in {file}.cpp asserts no {literal} of {name}")


def fail(message):
    """Refuses the query, because the results contradict the sentence in which the mark is."""
    raise Refused(message)


def of_number(function):
    """Returns a version of the function that returns NULL if its first value is NULL."""
    return lambda x, *more: None if x is None else function(x, *(int(n) for n in more))


FUNCTIONS = {
    "text": text,
    "part": part,
    "matches": lambda line, pattern: re.search(pattern, line or "") is not None,
    "replaced": lambda line, pattern, by: re.sub(pattern, by, line),
    "power": of_number(lambda x, digits=2: numbers.minus(numbers.power(x, digits))),  # 6.8e-8
    "signed": of_number(lambda x, digits=2: numbers.minus(numbers.power(x, digits, sign=True))),  # +6.8e-8
    "plain": of_number(numbers.plain),  # significant digits, no power of ten
    "upto": of_number(numbers.upto),  # rounded up to significant digits
    "downto": of_number(numbers.downto),
    "bound": of_number(numbers.bound),  # upper bound as text
    "sqrt": of_number(math.sqrt),
    "radians": of_number(math.radians),
    "degrees": of_number(math.degrees),
    "floor": of_number(math.floor),
    "pow": lambda x, y: x ** y,
    "finite": lambda x: x is not None and math.isfinite(x),
    "comment": comment,
    "asserted": asserted,
    "fail": fail,
}


class Aggregate:
    """Collects the values of a group that are not NULL."""

    def __init__(self):
        self.found = []

    def step(self, *values):
        if values[0] is not None:
            self.found.append(values)


class One(Aggregate):
    """one(x): the value of the only row. The query is refused unless it has exactly one row."""

    def finalize(self):
        if len(self.found) != 1:
            raise Refused(f"{len(self.found)} rows where one is expected")
        return self.found[0][0]


class Span(Aggregate):
    """span(x, text): the texts of the smallest and the largest x, "2 to 4"; one text if both are the same.
    span(x, text, ' … ') joins them otherwise."""

    def finalize(self):
        if not self.found:
            return None
        low, high = min(self.found), max(self.found)
        return low[1] if low[1] == high[1] else (low[2:] or (" to ",))[0].join((low[1], high[1]))


class Listed(Aggregate):
    """listed(x): "a, b and c", each text once, in the order of the rows. listed(x, key) orders them by a key."""
    join = staticmethod(numbers.listed)

    def finalize(self):
        ordered = sorted(self.found, key=lambda found: found[1:])
        return self.join(list(dict.fromkeys(numbers.shown(x) for x, *_ in ordered))) if ordered else None


class Joined(Listed):
    """joined(x), joined(x, key): "a, b, c", in the same order as listed()."""
    join = staticmethod(", ".join)


class Errors(Aggregate):
    """errors(e, phi): upper bounds of |e| and |phi| over all rows, "1.7e-6 and 0.0052°"."""

    def finalize(self):
        if not self.found:
            return None
        e, phi = (numbers.bound(max(abs(x) for x in column)) for column in zip(*self.found))
        return f"{e} and {phi}°"


class Median(Aggregate):
    """median(x): the middle value, or the mean of the two middle values if the number of values is even."""

    def finalize(self):
        ordered = sorted(x for x, *_ in self.found)
        return (ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2 if ordered else None


AGGREGATES = {"one": One, "span": Span, "listed": Listed, "joined": Joined, "errors": Errors, "median": Median}
