# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of aggregates: Python and the commands give the same results."""
import subprocess

import numpy as np
import pandas as pd
import pytest

import macadam as mc

CUBE = (np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)]) * 0.01,
        np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 5, 7], [1, 7, 3]], dtype=np.int32))


@pytest.fixture(scope="module")
def cube():
    return mc.shapes.Surface(*CUBE, "cube")


def test_a_cube_is_measured(cube):
    assert mc.shapes.check(cube) and str(mc.shapes.check(cube)) == "closed"
    measured = mc.shapes.measure(cube)
    assert measured.volume == pytest.approx(1e-6) and measured.area == pytest.approx(6e-4)
    assert measured.d_long == pytest.approx(0.01 * 3**0.5) and measured.centroid == pytest.approx((0.005,) * 3)
    assert np.array_equal(cube.points, CUBE[0]) and np.array_equal(cube.facets, CUBE[1])


def test_what_is_wrong_is_said_and_repaired(cube, tmp_path, program):
    open_cube = mc.shapes.Surface(CUBE[0], CUBE[1][:-1], "open")
    verdict = mc.shapes.check(open_cube)
    assert not verdict and len(verdict.open) == 3 and verdict.pieces == 1
    with pytest.raises(mc.InputError, match="open"):
        mc.shapes.measure(open_cube)
    repaired, what = mc.shapes.repair(open_cube)
    assert mc.shapes.check(repaired).good and "hole" in what
    mc.shapes.write(tmp_path / "open.off", open_cube)
    said = subprocess.run([program, "shapes", "check", tmp_path / "open.off"], capture_output=True, text=True)
    assert said.returncode == 2 and str(verdict) in said.stdout
    with pytest.raises(mc.InputError, match="facet 0: found point 9"):
        mc.shapes.Surface(CUBE[0], np.array([[0, 1, 9]], dtype=np.int32))


def test_polygons_and_seams_are_read_and_said(tmp_path):
    quads = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {' '.join(str(p + 1) for p in q)}" for q in quads]
    (tmp_path / "cube.obj").write_text("\n".join(lines) + "\n")
    read = mc.shapes.read(tmp_path / "cube.obj")
    assert read.reading == "cut 6 polygons into triangles"
    measured = mc.shapes.measure(read)
    assert measured.volume == pytest.approx(8, rel=1e-12) and measured.area == pytest.approx(24, rel=1e-12)
    seams = [f"v {x + 1e-16 * k} {y} {z}" for k in range(6) for x, y, z in corners]  # each face has its own corners
    seams += [f"f {' '.join(str(8 * k + p + 1) for p in q)}" for k, q in enumerate(quads)]
    (tmp_path / "seams.obj").write_text("\n".join(seams) + "\n")
    assert mc.shapes.measure(tmp_path / "seams.obj").volume == pytest.approx(8, rel=1e-12)


def test_a_wrap_that_changes_the_volume_is_asked_about():
    points, facets = CUBE
    two = mc.shapes.Surface(np.vstack([points, points + 0.5 * points.max()]), np.vstack([facets, facets + 8]), "two")
    with pytest.raises(mc.RunError, match="two: the repair changes volume or area .*wrapped"):
        mc.shapes.repair(two)
    repaired, what = mc.shapes.repair(two, wrap=True)
    assert mc.shapes.check(repaired).good and "wrapped" in what and "(before " in what
    assert mc.shapes.table([two], repair=True, wrap=True).volume[0] == mc.shapes.measure(repaired).volume


def test_tables_are_those_of_the_command(cube, tmp_path, program):
    for format in ("off", "stl", "ply", "obj"):
        mc.shapes.write(tmp_path / f"cube.{format}", cube, scale=1e-3)
    subprocess.run([program, "shapes", "measure", tmp_path / "cube.off", "--out", tmp_path, "--scale", "1e-3"], check=True,
                   capture_output=True)
    written = pd.read_csv(tmp_path / "shapes.csv", comment="#")
    table = mc.shapes.table([mc.shapes.read(tmp_path / "cube.off", scale=1e-3)])
    assert len(written) == len(table) == 1
    assert table.volume[0] == pytest.approx(1e-6, rel=1e-12)
    # STL has single precision
    assert mc.shapes.measure(mc.shapes.read(tmp_path / "cube.stl", 1e-3)).volume == pytest.approx(1e-6, rel=1e-5)
    with pytest.raises(mc.InputError, match="none.off"):
        mc.shapes.read(tmp_path / "none.off")


def test_filling(cube):
    spheres = mc.shapes.fill(cube, (0.9e-3, 1.1e-3), seed=2)
    report = mc.shapes.measure_fill(cube, spheres)
    assert len(spheres) > 50 and 0.9e-3 <= spheres.radius.min() and spheres.radius.max() <= 1.1e-3
    # The requested porosity is 0.12. The tolerance is needed because the number of spheres is an integer.
    assert report.sphere_volume == pytest.approx(0.88e-6, rel=0.02)
    assert np.array_equal(mc.shapes.fill(cube, (0.9e-3, 1.1e-3), seed=2).centre, spheres.centre)
    assert len(mc.shapes.fill(cube, 5e-3, single="volume")) == 1
    with pytest.raises(mc.InputError, match=r"single: .*intermediate\|circumscribed\|volume"):
        mc.shapes.fill(cube, 1e-3, single="x")


def test_files_are_those_of_the_commands(cube, tmp_path, program):
    mc.shapes.write(tmp_path / "cube.off", cube)

    def command(*words):
        subprocess.run([program, "shapes", *words], check=True, capture_output=True)
    command("fill", tmp_path / "cube.off", "--radius", "1 mm", "--circumscribed", "4 mm", "--out", tmp_path / "command")
    spheres = mc.shapes.fill(tmp_path / "cube.off", 1e-3, circumscribed=4e-3, out=tmp_path / "own")
    command("measure", tmp_path / "cube.off", "--out", tmp_path / "command")
    mc.shapes.table([tmp_path / "cube.off"], out=tmp_path / "own")
    command("generate", "--out", tmp_path / "command" / "ball", "--icosahedron", "0.5")
    mc.shapes.generate(tmp_path / "own" / "ball", icosahedron=0.5)
    files = {p.relative_to(tmp_path / "command") for p in (tmp_path / "command").rglob("*.*") if p.is_file()}
    assert len(files) == 7 and len(spheres) > 5
    for file in files:
        assert (tmp_path / "own" / file).read_bytes() == (tmp_path / "command" / file).read_bytes(), file
    with pytest.raises(mc.InputError, match="no shapes except those"):
        mc.shapes.generate(tmp_path / "own" / "ball", count=1)
    with pytest.raises(mc.InputError, match="circumscribed: found 0"):
        mc.shapes.fill(cube, 1e-3, circumscribed=0)
    assert [s.name for s in mc.shapes.files_in(tmp_path / "own" / "ball")] == [mc.shapes.icosahedron().name]


def test_a_faulty_surface_is_repaired_for_a_table(cube):
    holed = mc.shapes.Surface(cube.points, cube.facets[:-1], "holed")
    with pytest.raises(mc.Error):
        mc.shapes.table([holed])
    # repair closes the hole with triangles
    assert mc.shapes.table([holed], repair=True).volume[0] == pytest.approx(1e-6, rel=1e-3)


def test_the_library(tmp_path):
    assert len(mc.shapes.library()) == 82
    made = mc.shapes.generate(tmp_path, seed=5, count=3)
    assert [mc.shapes.read(tmp_path / f"{s.name}.off").points.shape for s in made] == [s.points.shape for s in made]
    assert mc.shapes.icosahedron(0.5).facets.shape == (80, 3)
