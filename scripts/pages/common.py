# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions that the marks of several pages use."""
import functools
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@functools.cache
def source(file):
    return (ROOT / file).read_text(encoding="utf-8")


def asserted(file, test, name, literal):
    """Returns a number that a test, or a helper function in its file, asserts: the literal, if one EXPECT or ASSERT
    statement contains both it and the name. Otherwise raises LookupError."""
    body = re.search(rf"^( *)(?:TEST\w*\(\w+, |static void ){re.escape(test)}\b(.*?)^\1}}", source(f"tests/{file}.cpp"),
                     re.M | re.S)
    if not body:
        raise LookupError(f"tests/{file}.cpp has no test {test}")
    for statement in re.findall(r"\b(?:EXPECT|ASSERT)_[^;]*;", body[2]):
        if (re.search(rf"\b{re.escape(name)}\b", statement)
                and re.search(rf"(?<![\w.]){re.escape(literal)}(?![\w.])", statement)):
            return literal.rstrip("f")
    raise LookupError(f"{test} in tests/{file}.cpp asserts no {literal} of {name}")
