# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every block of Python on the documentation pages, in order, in the top folder of the repository."""
import re

import pytest
from conftest import ROOT

PAGES = sorted(p for p in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")] if "```python" in p.read_text())


def blocks(page):
    text = page.read_text()
    for match in re.finditer(r"^```python\n(.*?)^```$", text, re.M | re.S):
        yield text[:match.start()].count("\n") + 2, match[1]


def test_there_are_pages():
    assert {"python.md", "README.md"} <= {p.name for p in PAGES}


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_every_block_runs(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    names = {}
    for line, code in blocks(page):
        exec(compile("\n" * (line - 1) + code, str(page), "exec"), names)
