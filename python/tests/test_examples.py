# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the examples in docstrings of the package, in the top folder of the repository."""
from __future__ import annotations

import doctest
import importlib

import pytest
from conftest import ROOT

MODULES = ("drives", "_fit", "_result", "_scene", "_simulation", "_specimen", "_stepper", "shapes")


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_docstrings_run(name, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    done = doctest.testmod(importlib.import_module(f"macadam.{name}"))
    assert done.attempted > 0 and done.failed == 0
