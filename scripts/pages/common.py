# SPDX-License-Identifier: GPL-3.0-or-later
"""What several pages say."""
import functools
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@functools.cache
def source(file):
    return (ROOT / file).read_text(encoding="utf-8")


def asserted(file, test, literal):
    """A number that a test asserts: the literal, if that test's body has it in an expectation."""
    body = re.search(rf"^TEST\w*\(\w+, {re.escape(test)}\)(.*?)^}}", source(f"tests/{file}.cpp"), re.M | re.S)
    if not body:
        raise LookupError(f"tests/{file}.cpp has no test {test}")
    if not re.search(rf"(EXPECT|ASSERT)_[^;]*(?<![\w.]){re.escape(literal)}(?![\w.])", body[1]):
        raise LookupError(f"{test} in tests/{file}.cpp asserts no {literal}")
    return literal.rstrip("f")
