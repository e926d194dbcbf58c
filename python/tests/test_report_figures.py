# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures and first sentences of a report: the requested frame, one colour per size class, the scene's name, the
result."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

import macadam as mc
from macadam.report import ReportError, contacts, document, fields, phases, report, specimen
from macadam.report.folders import read, read_all
from report_folders import PROGRAM, make

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
FRAMES = (0.0, 1e-3, 3e-3)  # displacement of all particles in each frame [m]


@pytest.fixture
def series(specimen: mc.Specimen, tmp_path: Path) -> Path:
    """A file of particles with three frames; within a frame all particles have the same displacement."""
    file = tmp_path / "particles.vtkhdf"
    frames = mc.FieldSeries(specimen, file)
    for k, height in enumerate(FRAMES):
        frames.add(0.1 * k, {"displacement": np.full((len(specimen), 3), [0, 0, height])})
    return file


@pytest.mark.parametrize("frame, shown", [(0, 0), (1, 1), (2, 2), (-1, 2), (-3, 0)])
def test_a_picture_shows_the_frame_that_was_asked_for(series: Path, frame: int, shown: int) -> None:
    pytest.importorskip("pyvista")
    data = fields._read(series, frame)
    assert np.allclose(np.linalg.norm(data.point_data["displacement"], axis=1), FRAMES[shown], rtol=1e-6)  # single precision


@pytest.mark.parametrize("frame", [3, -4])
def test_a_frame_that_is_not_there_is_refused(series: Path, frame: int) -> None:
    pytest.importorskip("pyvista")
    with pytest.raises(ReportError, match=rf"particles.vtkhdf: frame: found {frame}, expected a number from 0 to 2, or"):
        fields._read(series, frame)


def _with_classes(folder: Path, names: list[str]) -> Path:
    """Writes a result folder with one aggregate of each of these size classes."""
    folder.mkdir()
    (folder / "summary.json").write_text('{"status": "prepared", "box_m": [0.01, 0.01, 0.01]}')
    spheres = "".join(f"{k},{0.002 + 0.002 * k},0.005,0.005,0.001,aggregate,{k}\n" for k in range(len(names)))
    (folder / "specimen.csv").write_text("id,x,y,z,radius,phase,body\n" + spheres)
    grains = "".join(f"{k},{k},{name},0.002,4e-9\n" for k, name in enumerate(names))
    (folder / "aggregates.csv").write_text("body,size_class,class,size,volume\n" + grains)
    return folder


def test_a_size_class_has_one_colour_in_all_specimens_of_a_report(tmp_path: Path) -> None:
    """The class 4.75-9.5 mm is the first class of one mix and the second of the other."""
    folders = read_all(
        [
            _with_classes(tmp_path / "a", ["4.75-9.5 mm", "2-4.75 mm"]),
            _with_classes(tmp_path / "b", ["9.5-12.5 mm", "4.75-9.5 mm", "2-4.75 mm"]),
        ]
    )
    coarse, fine = phases.of_sieves(4.75, 9.5), phases.of_sieves(2, 4.75)
    first, second = (specimen.colours_of(f)(np.arange(n)) for f, n in zip(folders, (2, 3)))
    assert np.allclose(first, [phases.shaded(coarse, 0), phases.shaded(fine, 1)])  # the shade depends on the body
    assert np.allclose(second[1:], [phases.shaded(coarse, 1), phases.shaded(fine, 2)])


def test_mastic_is_taken_away_only_where_there_is_some(tmp_path: Path) -> None:
    bare = report(_with_classes(tmp_path / "bare", ["2-4.75 mm"]), tmp_path / "bare.html").read_text("utf-8")
    assert "The aggregates in the box." in bare and "not drawn" not in bare
    mixed = report(make("harmonic"), tmp_path / "mixed.html").read_text("utf-8")
    assert "the mastic between them is not drawn" in mixed


def test_a_report_has_the_name_of_its_scene(tmp_path: Path) -> None:
    shutil.copytree(make("harmonic"), tmp_path / "res")
    folder = read(tmp_path / "res")
    assert document._title([folder]) == "harmonic"  # the scene is harmonic.toml
    folder.summary["scene"] = "examples/demo/scene.toml"
    assert document._title([folder]) == "demo"
    del folder.summary["scene"]
    folder.label = "res"
    assert document._title([folder]) == "res"


@pytest.mark.parametrize("kind, words", [("calibration", r"M-A\.delta = [\d.]+; \|E\*\| is met within [\d.]+ % \(rms\), φ within"),
                                         ("fit", r"a chain with 6 Kelvin units; \|E\*\| is met within [\d.]+ % \(rms\), φ within")])
def test_a_summary_says_what_was_found(kind: str, words: str, tmp_path: Path) -> None:
    page = report(make(kind), tmp_path / "r.html").read_text("utf-8")
    assert re.search(words, re.sub(r"<[^>]*>", "", page[: page.index("</section>")])), "not in the first section"
    assert "The folder holds" not in page


def test_sensitivities_are_compared_at_one_temperature() -> None:
    rows = [{"frequency_hz": f, "temperature_c": t} for t in (5.0, 35.0) for f in (25.0, 0.1)]
    chosen = contacts._at_first_temperature(rows)
    assert [(r["frequency_hz"], r["temperature_c"]) for r in chosen] == [(0.1, 5.0), (25.0, 5.0)]
    assert contacts._at_first_temperature([]) == []
