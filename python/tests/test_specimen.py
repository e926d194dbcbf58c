# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens: their arrays are views that stay valid without the specimen, and files of specimens."""
import csv
import gc
import pickle
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT

import macadam as mc
from macadam import _toml


def test_views_are_what_the_command_writes(scene, small_file, specimen, tmp_path, program):
    subprocess.run([program, "specimen", small_file, "--out", tmp_path], check=True, capture_output=True)
    with (tmp_path / "specimen.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(specimen) == len(rows)
    assert np.array_equal(specimen.centre, [[float(r[k]) for k in "xyz"] for r in rows])
    assert np.array_equal(specimen.radius, [float(r["radius"]) for r in rows])
    assert np.array_equal(specimen.phase, [["aggregate", "mastic"].index(r["phase"]) for r in rows])
    assert np.array_equal(specimen.body, [int(r["body"]) for r in rows])
    specimen.write(tmp_path / "own.csv")
    assert (tmp_path / "own.csv").read_bytes() == (tmp_path / "specimen.csv").read_bytes()


def every_array(of):
    return {name: value for name in dir(of) if not name.startswith("_")
            for value in [getattr(of, name)] if isinstance(value, np.ndarray)}


@pytest.mark.parametrize("part", [lambda s: s, lambda s: s.contacts, lambda s: s.cells, lambda s: s.section("x=6 mm")],
                         ids=["specimen", "contacts", "cells", "section"])
def test_views_share_memory_and_cannot_be_written(part, specimen):
    arrays = every_array(part(specimen))
    assert len(arrays) >= 2
    again = every_array(part(specimen))
    for name, array in arrays.items():
        assert not array.flags.writeable, name
        assert not array.flags.owndata, name
        assert array.size == 0 or name in ("particle", "area") or np.shares_memory(array, again[name]), name
        if array.size:
            with pytest.raises(ValueError, match="read-only"):
                array.flat[0] = array.flat[0]


def test_views_do_not_dangle(scene):
    made = mc.specimen(scene)
    views = [*every_array(made).values(), *every_array(made.contacts).values(), *every_array(made.cells).values(),
             made.cells.polygon(3), made.section("z=5 mm").polygon(0)]
    copies = [v.copy() for v in views]
    del made
    gc.collect()
    # if the memory of the view had been freed, these arrays would overwrite it
    others = [np.full(100_000, float(i)) for i in range(50)]
    for view, copy in zip(views, copies, strict=True):
        assert np.array_equal(view, copy)
    del others


def test_a_specimen_goes_when_nobody_looks(scene):
    made = mc.specimen(scene)
    contacts = made.contacts
    area = contacts.area
    before = sys.getrefcount(made)
    del contacts, area
    gc.collect()
    assert sys.getrefcount(made) < before


def test_contacts_and_cells_hang_together(specimen):
    contacts, cells = specimen.contacts, specimen.cells
    assert sum(contacts.count.values()) == len(contacts)
    names = np.array(mc.pair_names)
    assert {str(n): int(c) for n, c in zip(*np.unique(names[contacts.pair], return_counts=True))} == contacts.count
    assert np.allclose(np.linalg.norm(contacts.normal, axis=1), 1)
    assert np.allclose(np.cross(contacts.s, contacts.t), contacts.normal)
    assert np.allclose(contacts.moments[:, 0], contacts.area)
    both = contacts.b >= 0
    apart = specimen.centre[contacts.b[both]] - specimen.centre[contacts.a[both]]
    assert np.allclose(np.linalg.norm(apart, axis=1), contacts.distance[both])
    assert cells.volume.sum() == pytest.approx(np.prod(specimen.box), rel=1e-12)  # rounding of some thousand terms
    assert len(cells) == len(cells.area) and cells.polygon(0).shape[1] == 3
    section = specimen.section("z=7 mm")
    assert section.area.sum() == pytest.approx(specimen.box[0] * specimen.box[1], rel=1e-12)
    for wrong in (-1, len(section)):
        with pytest.raises(IndexError):
            section.polygon(wrong)


def test_particles_of_ones_own(scene):
    side = np.arange(4) * 1e-3 + 0.5e-3
    centre = np.stack(np.meshgrid(side, side, side, indexing="ij"), axis=-1).reshape(-1, 3)
    made = mc.specimen(scene, particles={"box": [4e-3] * 3, "centre": centre, "radius": np.full(64, 0.5e-3)})
    assert len(made) == 64 and made.contacts.count == {"M-M": 144, "M-W": 32}
    assert np.allclose(made.cells.volume, 1e-9)
    assert len(mc.harmonic(made, frequencies=[10]).table) == 1
    with pytest.raises(mc.InputError, match="64 centres, 63 radii"):
        mc.specimen(scene, particles={"centre": centre, "radius": np.full(63, 0.5e-3)})
    with pytest.raises(mc.InputError, match="particle 0: phase: found 7"):
        mc.specimen(scene, particles={"centre": centre, "radius": np.full(64, 5e-4), "phase": np.full(64, 7)})
    with pytest.raises(mc.InputError, match="particle 5"):
        twice = centre.copy()
        twice[5] = twice[4]
        mc.specimen(scene, particles={"box": [4e-3] * 3, "centre": twice, "radius": np.full(64, 0.5e-3)})


def test_particles_of_ones_own_need_no_other_source(scene, tmp_path):
    """The scene needs only laws and a test. A mixture in it is ignored, because it does not describe the particles."""
    side = np.arange(3) * 1e-3 + 0.5e-3
    centre = np.stack(np.meshgrid(side, side, side, indexing="ij"), axis=-1).reshape(-1, 3)
    particles = {"box": [3e-3] * 3, "centre": centre, "radius": np.full(27, 5e-4)}
    tables = scene.as_dict()
    minimal = {key: tables[key] for key in ("contacts", "loading", "materials")}
    file = tmp_path / "minimal.toml"
    file.write_text(_toml.dumps(minimal))
    found = [mc.harmonic(mc.specimen(source, particles=particles), frequencies=[10]) for source in (minimal, file, scene)]
    assert len({result.table.e_star_pa[0] for result in found}) == 1
    for result in found:
        assert result.scene.as_dict()["specimen"] == {"file": "particles given in Python", "box": [3e-3] * 3}
        assert result.specimen.scene.box == (3e-3, 3e-3, 3e-3) and not result.specimen.aggregates
    of_section = {**minimal, "specimen": {"box": ["3 mm"] * 3}}
    assert len(mc.specimen(of_section, particles={k: v for k, v in particles.items() if k != "box"})) == 27
    recipe = mc.Scene(ROOT / "examples" / "ac14_recipe" / "scene.toml", seed=5)
    of_recipe = mc.specimen(recipe, particles=particles)
    assert of_recipe.scene.recipe is None
    assert of_recipe.inertia()[0].sum() == pytest.approx(recipe.recipe["mastic_density"] * 27 * 4 / 3 * np.pi * 5e-4**3)
    with pytest.raises(mc.InputError, match="box"):
        mc.specimen(minimal, particles={k: v for k, v in particles.items() if k != "box"})


def test_cylinders(scene):
    """A cylinder keeps its shape in copies and with particles of one's own; with a box of one's own it is a box."""
    tables = scene.as_dict()
    mix = {k: v for k, v in tables["specimen"].items() if k != "box"}
    core = mc.Scene({**tables, "specimen": {**mix, "domain": "cylinder", "diameter": "14 mm", "height": "15 mm"}})
    made = mc.specimen(core)
    assert core.domain == made.domain == "cylinder" and made.box == pytest.approx((14e-3, 14e-3, 15e-3))
    assert made.section_area == pytest.approx(np.pi / 4 * 14e-3**2, rel=1e-12)
    assert made.cells.volume.sum() == pytest.approx(made.volume, rel=1e-12)  # rounding of some thousand terms
    assert np.hypot(*(made.centre[:, :2] - 7e-3).T).max() <= 7e-3
    assert pickle.loads(pickle.dumps(made)).domain == "cylinder"
    own = {name: getattr(made, name) for name in ("centre", "radius", "phase", "body")}
    again = mc.specimen(core, particles=own)
    assert again.domain == "cylinder" and np.array_equal(again.cells.volume, made.cells.volume)
    assert mc.specimen(core, particles={**own, "box": [14e-3, 14e-3, 15e-3]}).domain == "box"


@pytest.mark.parametrize(
    ("keys", "box", "volume"),
    [
        ({"domain": "disc", "diameter": "20 mm", "thickness": "12 mm"}, (20e-3, 12e-3, 20e-3), np.pi * 1e-4 * 12e-3),
        ({"domain": "half_disc", "diameter": "28 mm", "thickness": "12 mm"}, (28e-3, 12e-3, 14e-3),
         np.pi / 2 * 1.96e-4 * 12e-3),
        ({"domain": "beam", "length": "20 mm", "width": "12 mm", "height": "13 mm"}, (20e-3, 12e-3, 13e-3), 20e-3 * 156e-6),
        ({"domain": "trapezoid", "base_width": "18 mm", "top_width": "12 mm", "thickness": "12 mm", "height": "20 mm"},
         (18e-3, 12e-3, 20e-3), 15e-3 * 20e-3 * 12e-3),
    ],
)
def test_domains_of_laboratories(scene, keys, box, volume):
    """Specimens of every domain have its volume, and keep the domain when they are copied."""
    tables = scene.as_dict()
    mix = {k: v for k, v in tables["specimen"].items() if k != "box"}
    made = mc.specimen(mc.Scene({**tables, "specimen": {**mix, **keys}}))
    assert made.domain == keys["domain"] and made.box == pytest.approx(box)
    assert made.volume == pytest.approx(volume, rel=1e-12)
    assert made.cells.volume.sum() == pytest.approx(made.volume, rel=1e-12)  # rounding of some thousand terms
    again = pickle.loads(pickle.dumps(made))
    assert again.domain == made.domain and again.volume == made.volume


def test_notches(scene):
    """A notch leaves the contacts of its ligament, also in a copy of the specimen."""
    tables = scene.as_dict()
    x, y, z = mc.specimen(scene).box
    notch = {"axis": "x", "at": x / 2, "z": [0, z / 3]}
    made = mc.specimen(mc.Scene({**tables, "specimen": {**tables["specimen"], "notch": [notch]}}))
    (cut,) = made.contacts.notches
    assert (cut["axis"], cut["at"]) == ("x", x / 2) and cut["removed"] > 0 and cut["shortened"] > 0
    assert cut["ligament"] + cut["cut_area"] == pytest.approx(y * z, rel=1e-9)  # sums of some hundred facets
    assert cut["cut_area"] == pytest.approx(y * z / 3, rel=1e-9)
    assert pickle.loads(pickle.dumps(made)).contacts.notches == [cut]
    assert mc.specimen(scene).contacts.notches == []


def test_texts_have_numbers(specimen, tmp_path):
    n, contacts, cells = len(specimen), specimen.contacts, specimen.cells
    assert repr(specimen) == f"<macadam.Specimen: {n} particles, {len(contacts)} contacts, box 12 × 12 × 15 mm>"
    assert repr(contacts).startswith(f"<macadam.Contacts: {len(contacts)}: {contacts.count['M-M']} M-M, ")
    assert repr(cells) == f"<macadam.Cells: {len(cells.volume)} cells, {len(cells)} facets>"
    section = specimen.section("z=7 mm")
    assert repr(section) == f"<macadam.Section z = 0.007 m: {len(section)} polygons>"
    series = mc.FieldSeries(specimen, tmp_path / "motion.vtkhdf")
    series.add(0.0, {"x": np.zeros(n)})
    assert repr(series) == f"<macadam.FieldSeries motion.vtkhdf: 1 frames of {n} particles>"
    stepper = mc.Stepper(specimen, mc.Boundary(), backend="cpu")
    stepper.advance(3)
    assert repr(stepper).startswith(f"<macadam.Stepper: {n} particles, dt {stepper.dt:.4g} s, cpu")
    assert repr(stepper.observe()) == f"<macadam.Observation: step 3, {3 * stepper.dt:.6g} s, top wall 0 m, 0 N>"
    steady = mc.HarmonicSolver(specimen).solve([10])[0]
    assert repr(steady) == f"<macadam.SteadyState: 10 Hz, |E*| {steady.e_star_pa:.6g} Pa, phase {steady.phase_deg:.4g} degrees>"


def test_files_for_viewers(specimen, tmp_path):
    for what in ("particles", "contacts", "cells"):
        for ending in ("vtkhdf", "vtp"):
            specimen.write(tmp_path / f"{what}.{ending}", what)
            assert (tmp_path / f"{what}.{ending}").stat().st_size > 1000
    for file, what, message in (("a.txt", "particles", "ending"), ("a.csv", "cells", "ending"), ("a.vtp", "x", "what")):
        with pytest.raises(mc.InputError, match=message):
            specimen.write(tmp_path / file, what)
    with pytest.raises(mc.RunError, match="no_folder"):
        specimen.write(tmp_path / "no_folder" / "a.csv")


def test_arrays_of_ones_own_for_viewers(specimen, tmp_path):
    n = len(specimen)
    height = specimen.centre[:, 2]
    for ending in ("vtkhdf", "vtp"):
        specimen.write(tmp_path / f"plain.{ending}")
        specimen.write(tmp_path / f"more.{ending}", arrays={"height": height, "number": np.arange(n), "pair": np.ones((n, 2))})
        plain, more = ((tmp_path / f"{name}.{ending}").read_bytes() for name in ("plain", "more"))
        assert b"height" in more and b"number" in more and b"height" not in plain and len(more) > len(plain)
        series = mc.FieldSeries(specimen, tmp_path / f"series.{ending}", "contacts")
        for k in range(3):
            series.add(0.1 * k, {"k": np.full(len(specimen.contacts), k, dtype=float)})
        assert len(series) == 3
    for arrays in ({"x": np.ones(n - 1)}, {"x": 1.0}, {"x": np.ones((n, 2, 2))}):
        with pytest.raises(mc.InputError, match=rf"arrays: x: found shape .*expected \({n},\) or"):
            specimen.write(tmp_path / "a.vtp", arrays=arrays)
    with pytest.raises(mc.InputError, match="ending"):
        specimen.write(tmp_path / "a.csv", arrays={"height": height})


def test_a_recipe_tells_its_volumes(scene):
    assert scene.recipe is None
    recipe = mc.Scene(ROOT / "examples" / "ac14_recipe" / "scene.toml").recipe
    assert 0 < recipe["vfb"] < 1 and recipe["bulk_density"] < recipe["maximum_density"]
    assert recipe["aggregate_mass"] + recipe["mastic_mass"] == pytest.approx(1)


def test_a_folder_as_the_command_leaves_it(scene, tmp_path):
    told = []
    made = mc.specimen(scene, out=tmp_path, sections=["x=6 mm"], progress=lambda stage, share: told.append((stage, share)))
    assert {"specimen.csv", "aggregates.csv", "summary.json", "section_x_0.006.csv"} <= {p.name for p in tmp_path.iterdir()}
    assert all(0 <= share <= 1 for _, share in told) and len({stage for stage, _ in told}) >= 3
    assert made.aggregates and made.composition["mastic"]["count"] == int((made.phase == 1).sum())
    with pytest.raises(mc.InputError, match="plane"):
        mc.specimen(scene, sections=["x=6"], out=tmp_path)


def test_a_packing_that_does_not_fill_its_box_is_warned_of(scene, specimen):
    assert specimen.warnings == []
    high = mc.Scene(scene, **{"specimen.box": ["12 mm", "12 mm", "30 mm"]})
    particles = {name: getattr(specimen, name) for name in ("centre", "radius", "phase", "body")}
    made = mc.specimen(high, particles=particles)
    assert len(made.warnings) == 1
    assert "does not fill its box" in made.warnings[0] and "and the +z wall" in made.warnings[0]
    assert made.warnings[0] in mc.harmonic(made, frequencies=[10]).warnings
