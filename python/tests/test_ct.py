# SPDX-License-Identifier: GPL-3.0-or-later
"""CT scans: phantom, segmentation and twin made from Python equal the files that the commands write."""
import subprocess

import numpy as np
import pytest
from conftest import DEMO

import macadam as mc

pytestmark = pytest.mark.skipif(not mc.info()["ct"], reason="built without ITK")
SPEC = {"specimen.box": ["10 mm", "10 mm", "10 mm"], "specimen.aggregate.0.volume_fraction": 0.1,
        "specimen.aggregate.1.volume_fraction": 0.15}


@pytest.fixture(scope="module")
def scanned(tmp_path_factory):
    """The scene of a small phantom, the phantom's folder, and the phantom."""
    folder = tmp_path_factory.mktemp("phantom")
    scene = mc.Scene(DEMO, **SPEC)
    return scene, folder, mc.ct.phantom(scene, "200 um", folder, seed=3)


def test_a_phantom_is_that_of_the_command(scanned, tmp_path, program):
    scene, folder, phantom = scanned
    (tmp_path / "scene.toml").write_text(scene.text)
    subprocess.run([program, "ct", "phantom", tmp_path / "scene.toml", "--voxel", "200 um", "--seed", "3", "--out",
                    tmp_path / "out"], check=True, capture_output=True)
    assert (tmp_path / "out" / "scan.mha").read_bytes() == (folder / "scan.mha").read_bytes()
    assert phantom.grains > 0 and phantom.aggregate + phantom.mastic + phantom.voids == pytest.approx(1, abs=1e-6)


def test_grains_and_twin(scanned, tmp_path):
    scene, folder, phantom = scanned
    stages = []
    found = mc.ct.segment(folder / "scan.mha", tmp_path / "grains", smallest=2e-3, progress=lambda s, _: stages.append(s))
    assert found.labels.shape == found.phases.shape == found.grey.shape and not found.labels.flags.writeable
    assert found.labels.max() == max(g["id"] for g in found.grains) and "writing" not in stages and stages
    assert found.aggregate == pytest.approx(phantom.aggregate, abs=0.1)
    assert (tmp_path / "grains" / "grains.csv").exists() and 0 <= found.in_no_grain < 0.1
    twin = mc.ct.twin(folder / "truth", scene, tmp_path / "twin", box=["1 mm"] * 3 + ["9 mm"] * 3)
    assert twin.box == pytest.approx((8e-3,) * 3) and twin.particles > 100
    assert np.isfinite(mc.harmonic(tmp_path / "twin" / "scene.toml", frequencies=[10]).table.e_star_pa[0])


@pytest.mark.parametrize(("change", "message"), [
    ({"voxel": [1e-4, 1e-4]}, "2 lengths"), ({"denoise": "x"}, "denoise"), ({"memory": "3"}, "--memory"),
    ({"region": "ball"}, "--region"), ({"air_voids": 0.9}, "air_voids: found 0.9"),
    ({"air_voids": "60 %"}, "air_voids: found 0.6"), ({"aggregate": "40"}, "aggregate: found \"40\", expected a number, or"), ({"gradation": "none.csv"}, "none.csv"),
])
def test_what_is_wrong_is_named(change, message, scanned, tmp_path):
    with pytest.raises(mc.InputError, match=message):
        mc.ct.segment(scanned[1] / "scan.mha", tmp_path / "out", **change)
