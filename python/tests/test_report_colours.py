# SPDX-License-Identifier: GPL-3.0-or-later
"""Mastic and size classes have the same colours in reports and in the pictures of scripts/."""

from __future__ import annotations

import importlib.util

from matplotlib.colors import to_hex

from conftest import ROOT
from macadam.report import look


def test_reports_and_scripts_have_the_same_colours() -> None:
    spec = importlib.util.spec_from_file_location("specimen_colours", ROOT / "scripts" / "specimen_colours.py")
    assert spec is not None and spec.loader is not None
    scripts = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(scripts)
    assert to_hex(scripts.MASTIC) == look.MASTIC
    assert [to_hex(c) for c in scripts.CLASSES] == look.CLASSES
