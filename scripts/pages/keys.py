# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of the pages docs/scene/*.md: the table of a section's keys, copied from docs/keys.md, which the program prints
(`macadam info --keys markdown`)."""
import sys
import types

from pages.common import ROOT, source
from pages.marks import mark


@mark
def keys(section):
    """Returns the rows of the table of a section such as [solver]."""
    _, found, text = source("docs/keys.md").partition(f"\n## `{section}`\n")
    if not found:
        raise LookupError(f"docs/keys.md has no section {section}")
    return [line for line in text.partition("\n## ")[0].splitlines() if line.startswith("|")]


def pages():
    """Returns a module for each page of docs/scene/."""
    found = []
    for file in sorted((ROOT / "docs" / "scene").glob("*.md")):
        page = types.ModuleType(f"pages.scene_{file.stem}")
        page.DOCUMENT, page.PARTS = f"docs/scene/{file.name}", (sys.modules[__name__],)
        found.append(page)
    return found
