# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene on docs/scene.md and the examples on docs/scene/*.md are scenes that the program accepts."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import macadam as mc
from conftest import ROOT

PAGES = sorted((ROOT / "docs" / "scene").glob("*.md"))


def block(page: Path, heading: str) -> dict[str, Any]:
    """Returns the first TOML block after a heading or text of a page."""
    text = page.read_text(encoding="utf-8").partition(heading)[2]
    found = re.search(r"^```toml\n(.*?)^```$", text, re.M | re.S)
    assert found is not None, f"{page.name} has no TOML block after '{heading}'"
    return tomllib.loads(found[1])


def whole() -> dict[str, Any]:
    return block(ROOT / "docs" / "scene.md", "A small complete scene:")


def contacts(scene: dict[str, Any], more: list[dict[str, Any]]) -> None:
    """Adds contact laws to a scene. They replace the scene's laws of the same pairs."""
    pairs = {c["pair"] for c in more}
    scene["contacts"] = [c for c in scene["contacts"] if c["pair"] not in pairs] + more


def test_the_scene_on_the_page_is_complete() -> None:
    assert mc.Scene(whole())


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_an_example_fits_into_the_scene(page: Path) -> None:
    scene, example = whole(), block(page, "## Example")
    if page.stem in ("materials", "loading"):  # a temperature needs a law with a shift
        contacts(scene, block(page.with_name("contacts.md"), "## Example")["contacts"])
    if page.stem == "recipe":  # the recipe replaces the aggregates, the content of mastic and the densities
        del scene["specimen"]["aggregate"], scene["specimen"]["mastic"]["porosity"], scene["materials"]
    if page.stem == "shapes":
        contacts(scene, [{"pair": "inner", "law": "elastic", "E": "110 GPa"}])
    contacts(scene, example.pop("contacts", []))
    for section, values in example.items():
        scene[section] = scene.get(section, {}) | values if page.stem in ("recipe", "shapes") else values
    assert mc.Scene(scene)
