# SPDX-License-Identifier: GPL-3.0-or-later
"""Mastic, voids, aggregates and size classes have one colour each in all pictures, and the colours can be
distinguished."""

from __future__ import annotations

import importlib.util
import re
from itertools import combinations
from types import ModuleType

import numpy as np
import pytest

from conftest import ROOT
from macadam.report import look, phases

# Names of the classes of mixes by ASTM and EN sieves, from coarse to fine.
MIXES = [
    ["12.5-19 mm", "9.5-12.5 mm", "4.75-9.5 mm", "2-4.75 mm"],
    ["4.75-9.5 mm", "2-4.75 mm"],
    ["5.6-8 mm", "2-5.6 mm"],
    ["12.5-20 mm", "10-12.5 mm", "6.3-10 mm", "4-6.3 mm", "2-4 mm"],
    ["16-22.4 mm", "11.2-16 mm", "8-11.2 mm", "5.6-8 mm", "4-5.6 mm", "2.8-4 mm", "2-2.8 mm"],
    ["16-31.5 mm", "8-16 mm", "4-8 mm", "2-4 mm", "1-2 mm", "0.5-1 mm"],
    ["25-37.5 mm", "19-25 mm", "12.5-19 mm", "9.5-12.5 mm", "4.75-9.5 mm", "2.36-4.75 mm", "1.18-2.36 mm"],
]

# Linear red, green and blue as seen with normal vision, and without the first, second or third kind of cones
# (Machado, Oliveira and Fernandes, 2009, severity 1).
VISION = {
    "normal": np.eye(3),
    "protan": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deutan": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritan": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}
_TO_CONES = np.array(
    [[0.41222147, 0.53633254, 0.05144599], [0.21190350, 0.68069955, 0.10739696], [0.08830246, 0.28171884, 0.62997870]]
)
_TO_OKLAB = np.array(
    [[0.21045426, 0.79361779, -0.00407205], [1.97799850, -2.42859221, 0.45059371], [0.02590404, 0.78277177, -0.80867577]]
)


def _oklab(colour: str, vision: np.ndarray) -> np.ndarray:
    """Returns the coordinates of a colour in Oklab, in which distances are perceived differences (white to black: 1)."""
    c = np.array(phases.rgb(colour))
    linear = np.clip(vision @ np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4), 0, 1)
    return _TO_OKLAB @ np.cbrt(_TO_CONES @ linear)


def _difference(a: str, b: str) -> float:
    """Returns the smallest perceived difference of two colours over all kinds of colour vision."""
    return min(float(np.linalg.norm(_oklab(a, v) - _oklab(b, v))) for v in VISION.values())


def _scripts() -> ModuleType:
    spec = importlib.util.spec_from_file_location("specimen_colours", ROOT / "scripts" / "specimen_colours.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_class_has_one_colour_whatever_the_other_classes_are() -> None:
    assert len(phases.LADDER) == len(phases.SIEVES) - 1
    assert phases.of_class("4.75-9.5 mm") == phases.of_class("4.75–9.5 mm") == phases.of_sieves(4.75, 9.5) == "#e7b83c"
    assert phases.of_class("5.6-8 mm") == phases.of_class("4.75-9.5 mm")  # the geometric means are 6.69 and 6.72 mm
    assert phases.of_size(1e-3) == phases.LADDER[0] and phases.of_size(1e3) == phases.LADDER[-1]
    assert phases.of_class("") == phases.of_class(None) == phases.of_class("limestone") == phases.AGGREGATE


def test_scripts_have_the_colours_of_reports() -> None:
    """The class 4.75-9.5 mm is the first class of one specimen and the third of the other."""
    scripts = _scripts()
    assert scripts.MASTIC == phases.rgb(phases.MASTIC) and scripts.AIR == phases.rgb(phases.VOID)
    first = scripts.colour({7: (0, "4.75-9.5 mm"), 8: (1, "2-4.75 mm")}, 7, 3)
    second = scripts.colour({1: (0, "12.5-19 mm"), 7: (2, "4.75-9.5 mm")}, 7, 3)
    assert first == second == phases.shaded(phases.of_sieves(4.75, 9.5), 7, 3)
    assert scripts.colour({}, 7, 3) == phases.shaded(phases.AGGREGATE, 7, 3)


@pytest.mark.parametrize("names", MIXES, ids=lambda names: " ".join(names))
def test_classes_of_a_mix_can_be_distinguished(names: list[str]) -> None:
    colours = [phases.of_class(name) for name in names]
    assert all(_difference(a, b) > 0.1 for a, b in zip(colours, colours[1:]))
    assert all(_difference(a, b) > 0.06 for a, b in combinations(colours, 2))


def test_neighbours_mastic_and_voids_can_be_distinguished() -> None:
    assert all(_difference(a, b) > 0.1 for a, b in zip(phases.LADDER, phases.LADDER[1:]))
    assert all(_difference(a, b) > 0.1 for a, b in zip(phases.LADDER, phases.LADDER[2:]))
    assert all(_difference(c, phases.MASTIC) > 0.12 for c in (*phases.LADDER, phases.AGGREGATE, phases.VOID))
    assert all(_difference(c, phases.VOID) > 0.15 for c in (*phases.LADDER, phases.AGGREGATE))


def test_pictures_of_scans_have_the_same_colours() -> None:
    text = (ROOT / "host" / "tools" / "ct" / "segment" / "overlay.cpp").read_text("utf-8")
    ladder, sieves = (re.search(rf"{name}\[\] = {{(.*?)}};", text, re.S) for name in ("ladder", "sieves"))
    assert ladder is not None and sieves is not None
    assert ["#" + c for c in re.findall(r"0x([0-9a-f]{6})", ladder[1])] == list(phases.LADDER)
    assert [float(s) for s in sieves[1].split(",")] == list(phases.SIEVES)
    assert f"aggregate_colour = 0x{phases.AGGREGATE[1:]};" in text


# Files that draw specimens, sections, aggregates or classes, and so take colours of phases from phases.py.
DRAWING = [
    "bench/draw_shapes.py",
    "bench/paper/paper_pictures.py",
    "bench/shapes/draw_fill.py",
    "python/macadam/report/mixture.py",
    "python/macadam/report/specimen.py",
    "scripts/draw-gradation",
    "scripts/draw-model",
    "scripts/draw-section",
    "scripts/draw-specimen",
]


@pytest.mark.parametrize("name", DRAWING)
def test_drawings_of_specimens_use_the_module(name: str) -> None:
    text = (ROOT / name).read_text("utf-8")
    assert re.search(r"^from (specimen_colours import |macadam\.report import .*\bphases\b)", text, re.M)


def test_no_other_file_has_a_colour_of_a_phase() -> None:
    """Looks for the colours as hexadecimal numbers, and for constants of phases with a colour of their own."""
    colours = {c.lower() for c in (phases.MASTIC, phases.AGGREGATE, *phases.LADDER)}
    own = {ROOT / "python" / "macadam" / "report" / "phases.py", ROOT / "python" / "tests" / "test_report_colours.py"}
    files = [f for part in ("bench", "docs", "examples", "python", "scripts") for f in (ROOT / part).rglob("*")]
    texts = [f for f in files if f.is_file() and f not in own and (f.suffix == ".py" or f.name.startswith("draw-"))]
    assert {ROOT / name for name in DRAWING} <= set(texts)
    for file in texts:
        text = file.read_text("utf-8")
        assert not colours & {c.lower() for c in re.findall(r"#[0-9a-fA-F]{6}\b", text)}, file
        literal = r"(?m)^(?:MASTIC|VOID|AIR|AGGREGATE|CLASSES)\b[^=\n]*= *[\[(]*(?:[\"']#|(?:0?\.\d+, *){2}0?\.\d+\))"
        assert not re.search(literal, text), file
    assert not colours & {c.lower() for c in look.COLOURS}
