# SPDX-License-Identifier: GPL-3.0-or-later
"""The view in three dimensions beside a report: what the page holds, and that it needs no network."""

from __future__ import annotations

import base64
import importlib.util
import json
import re
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from macadam.report import ReportError, report, specimen, view
from macadam.report.__main__ import main
from macadam.report.folders import read, read_all
from macadam.report.spheres import largest
from report_folders import PROGRAM, make

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")


@pytest.fixture
def k3d(monkeypatch: pytest.MonkeyPatch):
    """The package that draws the view. Pictures of specimens, which take most of the time of a report, are left out."""
    monkeypatch.setattr(specimen, "MOST", 0)
    return pytest.importorskip("k3d", reason="no package k3d: pip install 'macadam[view]'")


def facts_of(page: str) -> dict:
    return json.loads(re.search(r'<script type="application/json" id="facts">(.*?)</script>', page)[1])


def layers_of(k3d, page: str) -> dict:
    """Returns the objects that the page draws, by name."""
    data = re.search(r"var data = '([^']*)'", page)[1]
    plot = k3d.plot()
    plot.load_binary_snapshot(base64.b64decode(data))
    return {o.name: o for o in plot.objects}


@pytest.mark.parametrize("kind", ["harmonic", "voids", "cracked"])
def test_the_view_has_every_sphere_and_loads_nothing(kind: str, k3d, tmp_path: Path) -> None:
    out = report(make(kind), tmp_path / "a report.html", view=True)
    view_file = tmp_path / "a report-3d.html"
    assert sorted(tmp_path.iterdir()) == sorted([out, view_file])
    assert '<a href="a%20report-3d.html">' in out.read_text(encoding="utf-8")
    page = view_file.read_text(encoding="utf-8")
    policy = re.search(r'<head><meta http-equiv="Content-Security-Policy" content="([^"]*)"', page)[1]
    assert policy.startswith("default-src 'none';") and "http" not in policy and "*" not in policy
    assert not re.search(r"""(?i)(src|href|action)\s*=\s*["']?\s*(https?:)?//|url\(\s*["']?(https?:)?//|@import""", page)
    folder = read(make(kind))
    table = folder.specimen
    facts, layers = facts_of(page), layers_of(k3d, page)
    assert facts["particles"] == folder.summary["particles"]
    assert facts["spheres"] == len(table) == sum(len(o.positions) for o in layers.values() if o.type == "Points")
    for phase, rows in table.groupby("phase"):
        drawn = next(o for name, o in layers.items() if name.startswith(f"{phase} ("))
        # millimetres in single precision: 24 bits
        assert np.allclose(drawn.positions, 1e3 * rows[list("xyz")], rtol=1e-6, atol=1e-6)
        assert np.allclose(drawn.point_sizes, 2e3 * rows["radius"], rtol=1e-6)
    assert facts["box_mm"] == pytest.approx([1e3 * e for e in folder.summary["box_m"]])


def test_facets_at_walls_lie_on_the_walls(k3d) -> None:
    folder = read_all([make("harmonic")])[0]
    page, words = view.html(folder)
    table = folder.table("contacts.csv", ["b", "area"])
    ends = table[table["b"] < 0]
    assert facts_of(page)["facets_at_walls"] == len(ends) > 0 and "green discs" in words
    mesh = next(o for name, o in layers_of(k3d, page).items() if name.startswith("facets at walls"))
    corners = np.asarray(mesh.vertices, float).reshape(len(ends), view.CORNERS, 3)
    height = np.where(ends["b"] == -5, 0, 1e3 * folder.summary["box_m"][2])  # -5 is the wall -z, -6 the wall +z
    assert np.allclose(corners[:, :, 2], height[:, None], rtol=0, atol=1e-5)  # coordinates of some 10 mm in single precision
    triangles = corners.reshape(-1, 3)[np.asarray(mesh.indices).reshape(-1, 3)]
    sizes = 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    assert sizes.sum() == pytest.approx(1e6 * ends["area"].sum(), rel=1e-4)  # small differences of coordinates in single precision


def test_cracked_facets_have_the_colour_of_their_opening(k3d) -> None:
    folder = read_all([make("cracked")])[0]
    page, words = view.html(folder)
    table = folder.table("damage.csv", ["opening_m", "damage"])
    assert facts_of(page)["cracked_facets"] == len(table)
    layers = {name: o for name, o in layers_of(k3d, page).items() if name.startswith("opening")}
    assert [o.visible for o in layers.values()] == [False, True]  # little damage, then much damage
    for rows, drawn in zip((table[table["damage"] <= 0.5], table[table["damage"] > 0.5]), layers.values(), strict=True):
        openings = np.asarray(drawn.attribute).reshape(-1, view.CORNERS)
        assert (openings == openings[:, :1]).all() and np.allclose(openings[:, 0], 1e6 * rows["opening_m"], rtol=1e-6)
    assert "no contacts.csv" in words and "mastic is hidden at first" in words


def test_large_specimens_are_thinned_and_the_page_tells_it(k3d, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(view, "MOST_SPHERES", 100)
    monkeypatch.setattr(view, "MOST_FACETS", 7)
    folder = read_all([make("harmonic")])[0]
    page, words = view.html(folder)
    assert (facts_of(page)["spheres"], facts_of(page)["facets_at_walls"]) == (100, 7)
    assert facts_of(page)["particles"] == len(folder.specimen)
    assert f"Of {len(folder.specimen)} spheres the 100 largest are shown." in words and "the 7 largest are shown" in words


def test_the_largest_keep_their_order() -> None:
    size = np.array([3.0, 9, 1, 9, 5])
    assert largest(size, np.arange(5), 3).tolist() == [1, 3, 4]
    assert largest(size, np.array([0, 2, 4]), 2).tolist() == [0, 4]
    assert largest(size, np.array([2, 0]), 2).tolist() == [2, 0]


def test_several_folders_have_a_view_each(k3d, tmp_path: Path) -> None:
    page = report([make("harmonic"), make("fit"), make("cracked")], tmp_path / "r.html", view=True).read_text(encoding="utf-8")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["r-3d-1.html", "r-3d-2.html", "r.html"]
    assert 'href="r-3d-1.html"' in page and 'href="r-3d-2.html"' in page
    assert "the view in three dimensions" in page  # left out for the fit


def test_names_cannot_add_markup(k3d) -> None:
    folder = read_all([make("harmonic")])[0]
    folder.label = "</script><script>alert(1)</script>"
    page, _ = view.html(folder)
    assert "<script>alert(1)" not in page and facts_of(page)["folder"] == folder.label


def test_a_contact_without_its_particle_is_refused(k3d, tmp_path: Path) -> None:
    folder = tmp_path / "damaged"
    shutil.copytree(make("harmonic"), folder)
    file = folder / "contacts.csv"
    file.write_text(file.read_text().splitlines()[0] + "\n99999,-5,M-W,1e-6,1e-3,0,0,-1,5\n")
    with pytest.raises(ReportError, match="contacts.csv: found the particle 99999, expected numbers from 0 to"):
        report(folder, tmp_path / "r.html", view=True)
    assert not list(tmp_path.glob("*.html"))


def test_without_k3d_the_option_names_the_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name, *a: None if name == "k3d" else find(name, *a))
    monkeypatch.setitem(sys.modules, "k3d", None)
    monkeypatch.setattr(specimen, "MOST", 0)
    figures = ["--figures", str(tmp_path / "figures")]
    assert main([str(make("harmonic")), "--out", str(tmp_path / "r.html"), "--view", *figures]) == 2
    assert "found no Python package k3d, expected it" in capsys.readouterr().err and not list(tmp_path.iterdir())
    assert main([str(make("harmonic")), "--out", str(tmp_path / "r.html")]) == 0
