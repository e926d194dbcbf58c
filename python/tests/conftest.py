# SPDX-License-Identifier: GPL-3.0-or-later
"""Fixtures for all tests: a small scene and its specimen, made once."""
import os
from pathlib import Path

import pytest

import macadam as mc

ROOT = Path(__file__).resolve().parents[2]
DEMO = ROOT / "examples" / "demo" / "scene.toml"
PROGRAM = os.environ.get("MACADAM_PROGRAM", "")
SMALL = {"specimen.box": ["12 mm", "12 mm", "15 mm"], "loading.frequencies": [10.0, 20.0], "solver.backend": "cpu"}


@pytest.fixture(scope="session")
def scene():
    """The demo scene in a smaller box, with about 550 particles."""
    return mc.Scene(DEMO, **SMALL)


@pytest.fixture(scope="session")
def specimen(scene):
    return mc.specimen(scene)


@pytest.fixture(scope="session")
def small_file(scene, tmp_path_factory):
    """Returns the file of the small scene."""
    file = tmp_path_factory.mktemp("scene") / "small.toml"
    file.write_text(scene.text)
    return file


@pytest.fixture(scope="session")
def program():
    if not PROGRAM:
        pytest.skip("MACADAM_PROGRAM names no program to compare with")
    return PROGRAM
