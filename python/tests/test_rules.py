# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules of contacts: a specimen of mastic has the Poisson's ratio of the mastic with rule "volumetric"."""
import pytest

import macadam as mc

MASTIC = """[specimen]
box = ["8 mm", "8 mm", "11 mm"]
seed = 3
[specimen.mastic]
radius = ["0.75 mm", "1 mm"]
porosity = 0.05
[materials.mastic]
density = 2110
law = "elastic"
E = "4 GPa"
poisson_ratio = 0.45
[network]
rule = "volumetric"
[loading]
kind = "cyclic"
frequencies = [2.0]
[solver]
method = "harmonic"
"""


@pytest.fixture(scope="module")
def mastic(tmp_path_factory):
    file = tmp_path_factory.mktemp("rules") / "mastic.toml"
    file.write_text(MASTIC)
    return file


def test_a_specimen_of_mastic_has_its_constants(mastic):
    for rule, ratio in (("volumetric", 0.45), ("series", 0.0)):
        found = mc.harmonic(mastic, **{"network.rule": rule}).summary["results"][0]
        # the solver's usual tolerance gives nine digits of E and five of the Poisson's ratio
        assert found["e_star_pa"] == pytest.approx(4e9, rel=1e-9)
        assert found["poisson_ratio"] == pytest.approx(ratio, abs=1e-5)


def test_time_steps_refuse_the_rule(mastic):
    with pytest.raises(mc.InputError, match=r'"volumetric" with method "explicit"'):
        mc.run(mastic, **{"solver.method": "explicit"})
