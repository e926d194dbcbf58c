# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes, specimens and results can be copied and sent to other processes."""
import copy
import multiprocessing
import pickle

import numpy as np
import pytest
from conftest import DEMO

import macadam as mc


def through_pickle(of):
    return pickle.loads(pickle.dumps(of))


COPIES = pytest.mark.parametrize("copied", [through_pickle, copy.deepcopy], ids=["pickle", "deepcopy"])


@COPIES
def test_a_scene_keeps_text_options_and_file(copied, scene, specimen):
    for of in (mc.Scene(DEMO), mc.Scene(DEMO, seed=7, backend="cpu", threads=2), mc.Scene(scene, seed=3), specimen.scene):
        made = copied(of)
        assert type(made) is type(of)
        assert (made.text, made.options, made.file) == (of.text, of.options, of.file)
        assert (made.seed, made.method, made.backend, made.frequencies) == (of.seed, of.method, of.backend, of.frequencies)
    again = mc.Scene(copied(mc.Scene(DEMO, seed=7)), loading={"frequencies": [1.0]})
    assert (again.seed, again.frequencies) == (7, [1])


def arrays(of):
    return {name: getattr(of, name) for name in dir(of) if isinstance(getattr(of, name), np.ndarray)}


@COPIES
@pytest.mark.parametrize("voids", [{}, {"specimen.voids": {"radius": ["0.6 mm", "0.8 mm"], "fraction": "2 %"}}], ids=["plain", "voids"])
def test_a_specimen_keeps_every_number(copied, scene, voids):
    of = mc.specimen(mc.Scene(scene, **voids))
    made = copied(of)
    assert len(of.void_radius) > 0 or not voids
    for part in ("scene", "contacts", "cells", ""):
        before, after = (arrays(getattr(s, part) if part else s) for s in (of, made))
        assert before.keys() == after.keys()
        for name, array in before.items():
            assert np.array_equal(array, after[name]), (part, name)
    for name in ("box", "aggregates", "composition", "relaxation_iterations", "seconds", "loose_particles", "gradation"):
        assert getattr(made, name) == getattr(of, name), name
    assert mc.harmonic(made, frequencies=[10]).table.e_star_pa[0] == mc.harmonic(of, frequencies=[10]).table.e_star_pa[0]


@COPIES
def test_a_specimen_of_given_particles_is_copied(copied, scene):
    side = np.arange(3) * 1e-3 + 0.5e-3
    centre = np.stack(np.meshgrid(side, side, side, indexing="ij"), axis=-1).reshape(-1, 3)
    of = mc.specimen(scene, particles={"box": [3e-3] * 3, "centre": centre, "radius": np.full(27, 5e-4)})
    made = copied(of)
    assert made.scene.text == of.scene.text and np.array_equal(made.contacts.area, of.contacts.area)


@COPIES
def test_a_result_takes_its_files_with_it(copied, specimen):
    of = mc.harmonic(specimen, frequencies=[10, 20])
    made = copied(of)
    assert made.folder != of.folder and str(made) == str(of) and made.table.equals(of.table)
    names = sorted(p.name for p in of.folder.iterdir())
    del of
    assert sorted(p.name for p in made.folder.iterdir()) == names and "summary.json" in names
    assert made.summary["results"][1]["frequency_hz"] == 20 and len(made.specimen) == len(specimen)
    folder = made.folder
    del made
    assert not folder.exists()


def test_a_result_of_a_named_folder_names_it(specimen, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    of = mc.harmonic(specimen, frequencies=[10], out="here")
    data, table = pickle.dumps(of), of.table
    monkeypatch.chdir("/")
    made = pickle.loads(data)
    assert made.folder == tmp_path / "here" and made.table.equals(table)
    del made
    assert (tmp_path / "here" / "summary.json").exists()


def solve(scene):
    return mc.harmonic(scene, frequencies=[10])


def test_processes_take_scenes_and_return_results(scene):
    scenes = [mc.Scene(scene, seed=seed, threads=1) for seed in (1, 2)]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        results = pool.map(solve, scenes)
    for given, result in zip(scenes, results, strict=True):
        assert result.table.e_star_pa[0] == solve(given).table.e_star_pa[0]
        assert (result.folder / "summary.json").exists() and result.scene.seed == given.seed
