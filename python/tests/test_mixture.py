# SPDX-License-Identifier: GPL-3.0-or-later
"""Mixtures without runs: stiffening rules against closed forms and bounds, predictions against values computed by hand,
volumes of the scales, the binder's fit, laws, scenes and messages."""

from __future__ import annotations

import copy
import math
import tomllib

import numpy as np
import pytest
from conftest import ROOT
from macadam.mixture import MixtureError, binder, design, laws, predictions, scenes, stiffening, volumes
from macadam.mixture import __main__ as command
from macadam.study import scenes as study_scenes

EXAMPLE = ROOT / "examples" / "mixture" / "design.toml"
RIGID = (1e14, 1e14)  # bulk and shear modulus of inclusions in a matrix of shear modulus 1: rigid to 1e-14
SOFT = (1e9, 1.0)  # an incompressible matrix


@pytest.fixture
def tables():
    """Returns the tables of the example with absolute paths."""
    found = tomllib.loads(EXAMPLE.read_text())
    for key in ("file", "bbr"):
        found["binder"][key] = str(EXAMPLE.parent / found["binder"][key])
    return found


# ---- stiffening rules and bounds


@pytest.mark.parametrize("c", [0.1, 0.3, 0.457, 0.6])
def test_rigid_spheres_in_an_incompressible_matrix(c):
    # closed forms of the rules; bulk and shear modulus of the matrix differ by 1e9, so the formulas hold to some 1e-9
    assert stiffening.hashin_shtrikman(SOFT, RIGID, c)[1] == pytest.approx(1 + 2.5 * c / (1 - c), rel=1e-7)
    assert stiffening.differential(SOFT, RIGID, c)[1] == pytest.approx((1 - c) ** -2.5, rel=1e-7)
    psi = 1 + c * 0.37 / 0.63**2
    assert stiffening.nielsen(SOFT, RIGID, c, 0.5)[1] == pytest.approx((1 + 1.5 * c) / (1 - psi * c), rel=1e-7)


@pytest.mark.parametrize("rule", stiffening.RULES)
def test_rules_end_at_the_matrix_and_at_equal_phases(rule):
    # rounding only: the rules are exact in these limits
    assert stiffening.stiffened(rule, 2e6, 0.4, 60e9, 0.25, 0.0) == pytest.approx(2e6, rel=1e-12)
    assert stiffening.stiffened(rule, 60e9, 0.25, 60e9, 0.25, 0.5) == pytest.approx(60e9, rel=1e-12)


def test_rules_are_between_the_bounds():
    for seed in range(200):
        random = np.random.default_rng(seed)
        c, contrast, nu, nu_i = (
            random.uniform(0.1, 0.6),
            10 ** random.uniform(0.3, 4),
            random.uniform(0, 0.49),
            random.uniform(0, 0.4),
        )
        matrix, inclusion = stiffening.bulk_and_shear(1.0, nu), stiffening.bulk_and_shear(contrast, nu_i)
        low, high = stiffening.bounds([(1 - c, *matrix), (c, *inclusion)])
        if matrix[0] > inclusion[0] or matrix[1] > inclusion[1]:
            continue  # the two phases are not ordered, so the expressions are not bounds
        # the lower bound is the expression with the softer matrix
        assert stiffening.young_of(*stiffening.hashin_shtrikman(matrix, inclusion, c)) == pytest.approx(low, rel=1e-10)
        assert stiffening.young_of(*stiffening.hashin_shtrikman(inclusion, matrix, 1 - c)) == pytest.approx(
            high, rel=1e-10
        )
        assert low < stiffening.young_of(*stiffening.differential(matrix, inclusion, c)) < high
        reuss, voigt = 1 / (1 - c + c / contrast), 1 - c + c * contrast
        assert reuss * (1 - 1e-12) <= low <= high
        if nu == nu_i:
            assert high <= voigt


def test_bounds_with_a_void():
    solid = stiffening.bulk_and_shear(1.0, 0.25)
    low, high = stiffening.bounds([(0.9, *solid), (0.1, 0.0, 0.0)])
    assert low == 0
    # upper bound of Hashin and Shtrikman for voids, written out: K = k/(1 + f·x) with nu 0.25
    k, g = solid
    bulk = k * 0.9 / (1 + 0.1 * 3 * k / (4 * g))
    shear = g * 0.9 / (1 + 0.1 * (6 * k + 12 * g) / (9 * k + 8 * g))
    assert high == pytest.approx(stiffening.young_of(bulk, shear), rel=1e-12)


def test_a_complex_modulus_without_loss_is_the_real_one():
    for rule in stiffening.RULES:
        found = stiffening.stiffened(rule, np.array([1e6 + 0j, 1e8 + 0j]), 0.4, 60e9, 0.25, 0.45)
        real = [stiffening.stiffened(rule, e, 0.4, 60e9, 0.25, 0.45) for e in (1e6, 1e8)]
        np.testing.assert_allclose(found, real, rtol=1e-12)


# ---- predictions


def test_hirsch_by_hand():
    # 3|G*| = 1e5 psi, VMA 15 %, VFA 70 %: x = 466,667, P = 466,687^0.58 / (650 + 466,667^0.58) = 1941.2/2591.1 =
    # 0.74916; parallel 3,580,500 psi, series 426,396 psi; |E*| = 2,789,300 psi; phase −21·0.12543² + 55·0.12543 =
    # 6.568°. The hand computation has four digits.
    e, phase = predictions.hirsch(1e5 / 3 * predictions.PSI, 0.15, 0.70)
    assert e == pytest.approx(2.7893e6 * 6894.757, rel=1e-3)
    assert phase == pytest.approx(6.568, abs=0.01)


def test_witczak_by_hand():
    # 10 Hz, 1e6 poise = 1e5 Pa s; retained 0 / 10 / 40 %, filler 5 %, air 5 %, binder 10 %: 2.913558 +
    # 3.825857/1.399850 = 5.646606, so |E*| = 443,210 psi. The hand computation has five digits.
    e = predictions.witczak(10.0, 1e5, predictions.Retained(0, 10, 40, 5), 0.05, 0.10)
    assert e == pytest.approx(4.4321e5 * 6894.757, rel=1e-4)
    assert predictions.viscosity(1e6, 90.0) == pytest.approx(1e5, rel=1e-12)  # eta = |G*|/10 at 90 degrees


def test_retained_is_interpolated():
    mix = predictions.retained([(0.0125, 1.0), (0.00475, 0.6), (0.001, 0.3), (150e-6, 0.1)])
    assert (mix.on_19, mix.on_4_75) == (0, pytest.approx(40))
    share = math.log(0.0095 / 0.00475) / math.log(0.0125 / 0.00475)
    assert mix.on_9_5 == pytest.approx(100 * (1 - 0.6 - 0.4 * share))
    assert mix.filler == pytest.approx(5)  # half of the finest sieve


# ---- volumes of the scales


def ac14(**more):
    """The mix design that docs/mix-design.md computes step by step."""
    curve = [
        (19, 1),
        (12.5, 0.837),
        (9.5, 0.712),
        (4.75, 0.478),
        (2, 0.325),
        (0.425, 0.169),
        (0.18, 0.094),
        (0.075, 0.053),
    ]
    given = {
        "binder": 0.052,
        "binder_of": "mix",
        "aggregate_density": [2630.0],
        "binder_density": 1030.0,
        "air_voids": 0.05,
    }
    return volumes.Recipe([(1e-3 * s, p) for s, p in curve], **{**given, **more})


def test_volumes_of_the_documented_mix():
    found = volumes.volumes(ac14())
    # docs/mix-design.md gives these digits
    assert round(found.maximum_density, 1) == 2433.4
    assert round(found.bulk_density, 1) == 2311.8
    assert round(100 * found.vma, 2) == 16.67
    assert round(100 * found.vfa, 1) == 70.0
    assert round(100 * found.classes[0] / found.bulk, 2) == 13.58


def as_recipe(part):
    keys = {k: v for k, v in part.recipe.items() if k not in ("cut", "gradation")}
    keys["aggregate_density"] = (
        keys["aggregate_density"] if isinstance(keys["aggregate_density"], list) else [keys["aggregate_density"]]
    )
    return volumes.Recipe([tuple(e) for e in part.recipe["gradation"]], **keys)


@pytest.mark.parametrize(
    "more", [{}, {"absorbed_binder": 0.006}, {"aggregate_density": [2600.0 + 20 * k for k in range(7)]}]
)
def test_the_recipe_of_a_scale_has_its_volumes(more):
    recipe = ac14(**more)
    whole = volumes.volumes(recipe)
    for lower, upper, air in ((0.002, 0.019, True), (0.000425, 0.002, False)):
        part = volumes.part_of(recipe, lower, upper, 1.0, air)  # a box of 1 m³, so that no class is merged
        assert not part.merged
        found = volumes.volumes(as_recipe(part))
        first, last = volumes.index_of(recipe, upper), volumes.index_of(recipe, lower)
        asked = sum(whole.classes[first:last]) / (whole.finer(first) + whole.effective_binder)
        assert part.c == pytest.approx(asked, rel=1e-12)
        # the same fraction by the recipe that the scene gets
        kept = volumes.index_of(as_recipe(part), lower)
        assert sum(found.classes[:kept]) / (sum(found.classes) + found.effective_binder) == pytest.approx(
            asked, rel=1e-12
        )
        assert found.air_voids == (0.05 if air else 0)
        assert found.absorbed == pytest.approx(whole.absorbed, abs=1e-15)
    fine = volumes.filler_fraction(recipe, 0.000425)
    assert fine == pytest.approx(whole.finer(5) / (whole.finer(5) + whole.effective_binder), rel=1e-12)


def test_a_class_of_less_than_one_grain_is_merged():
    recipe = ac14()
    recipe.gradation = [
        (1e-3 * s, p) for s, p in [(16, 1), (11.2, 0.999), (8, 0.8), (5.6, 0.7995), (2, 0.4), (0.063, 0.08)]
    ]
    box = 0.03**2 * 0.04
    part = volumes.part_of(recipe, 0.002, 0.016, box, True)
    assert len(part.merged) == 2
    assert "11.2-16 mm" in part.merged[0] and "8-11.2 mm" in part.merged[0]
    assert "5.6-8 mm" in part.merged[1] and "2-5.6 mm" in part.merged[1]
    assert part.recipe["gradation"][0] == [pytest.approx(0.0112), 1.0]  # the coarsest sieve with grains passes all
    passing = {round(1e3 * s, 4): p for s, p in part.recipe["gradation"]}
    assert passing[8] == pytest.approx(0.8) and passing[5.6] == pytest.approx(0.8) and passing[2] == pytest.approx(0.4)
    assert sorted(part.grains) == [(0.002, 0.0056), (0.008, 0.0112)]
    # merging moves material and loses none
    kept = volumes.part_of(recipe, 0.002, 0.016, 1.0, True)
    held = sum(n * volumes.mean_grain(a, b) for (a, b), n in part.grains.items())
    whole = sum(n * volumes.mean_grain(a, b) for (a, b), n in kept.grains.items())
    assert held / box == pytest.approx(whole, rel=1e-12)


@pytest.mark.parametrize("law", ["log_uniform", "uniform", "volume_uniform"])
def test_mean_grain(law):
    a, b, x = 0.002, 0.0056, (np.arange(200_000) + 0.5) / 200_000
    diameters = {"log_uniform": a * (b / a) ** x, "uniform": a + (b - a) * x}.get(law)
    if diameters is None:  # equal volume per diameter: the number of grains goes with the inverse cube
        d = a + (b - a) * x
        mean = 1 / np.mean(1 / (math.pi / 6 * d**3))
    else:
        mean = np.mean(math.pi / 6 * diameters**3)
    assert volumes.mean_grain(a, b, law) == pytest.approx(mean, rel=1e-8)  # the midpoint rule with 200,000 points


# ---- the binder


KNOWN = binder.Model(0.95e9, 0.23, 0.58, 3.4, 2.2e-5, 180.0, 19.0, 165.0, 20.0)


def test_creep_of_a_maxwell_element():
    class Maxwell(binder.Model):
        def _laplace(self, s):
            return self.glass / (1 + 1 / (self.beta * s * self.tau))

    model = Maxwell(1e9, 0.2, 0.5, 0.0, 1.0, 50.0, 18.0, 160.0, 20.0)
    time = np.array([0.1, 1.0, 10.0, 1000.0])
    # Talbot's method with 24 points; its error for this function is below 1e-11
    np.testing.assert_allclose(model.creep_stiffness(time, 0.5), 3e9 / (1 + time / 50), rtol=1e-9)


def measured(folder, temperatures=(4, 16, 28, 40, 52), noise=0.0):
    rows = ["temperature_c,frequency_hz,g_star_mpa,phase_deg"]
    random = np.random.default_rng(5)
    for t in temperatures:
        for f in np.geomspace(0.1, 30, 8):
            g = KNOWN.shear(KNOWN.reduced(t, f))
            modulus = abs(g) / 1e6 * np.exp(noise * random.standard_normal())
            rows.append(f"{t},{f:.12g},{modulus:.12g},{np.degrees(np.angle(g)):.12g}")
    file = folder / "dsr.csv"
    file.write_text("\n".join(rows) + "\n")
    return file


def test_the_binder_is_recovered(tmp_path):
    given = design.Binder(measured(tmp_path), None, 0.95e9, 0.0, 0.45, 20.0)
    found = binder.fit_binder(given, [5, 20, 40], [0.1, 10])
    assert found.model.glass == 0.95e9  # held
    assert found.model.c1 == pytest.approx(19, rel=1e-3) and found.model.c2 == pytest.approx(165, rel=1e-3)
    # exact data: the misfit ends at the accuracy of the derivatives by differences
    assert found.errors[0] < 1e-4 and found.errors[1] < 0.01
    low, high = binder.needed_range(found.model, [5, 20, 40], [0.1, 10])
    assert low == pytest.approx(float(KNOWN.reduced(40, 0.1)), rel=1e-2)
    assert high == pytest.approx(float(KNOWN.reduced(5, 10)), rel=1e-2)


def test_only_measurements_near_the_test_are_fitted(tmp_path):
    given = design.Binder(measured(tmp_path, (-5, 4, 16, 28, 40, 52, 64)), None, 0.95e9, 0.0, 0.45, 20.0)
    near = binder.fit_binder(given, [10, 25], [1, 10])
    assert set(near.dsr.temperature) == {4, 16, 28} and near.used < near.total == 56
    low, high = binder.needed_range(near.model, [10, 25], [1, 10])
    assert near.range[0] < low and near.range[1] > high
    # a test that needs the hot end of the data keeps it, although 64 °C is far from the temperatures of the test
    wide = binder.fit_binder(given, [10, 40], [1e-4, 10])
    assert 64 in wide.dsr.temperature


def test_creep_stiffness_extends_the_range(tmp_path):
    dsr = measured(tmp_path, (22, 28, 34, 40, 52), noise=0.02)
    rows = ["temperature_c,time_s,stiffness_mpa"]
    for t in (-18, -12, -6):
        for seconds in (8, 30, 120):
            stiffness = KNOWN.creep_stiffness(np.array([seconds / 10 ** KNOWN.log_shift(t)]), 0.45)[0]
            rows.append(f"{t},{seconds},{stiffness / 1e6:.9g}")
    (tmp_path / "bbr.csv").write_text("\n".join(rows) + "\n")
    misses, ranges = [], []
    for bbr in (None, tmp_path / "bbr.csv"):
        # the prior of the glass is wrong, 2 GPa in place of 0.95 GPa
        found = binder.fit_binder(design.Binder(dsr, bbr, 2e9, 0.5, 0.45, 20.0), [0, 20, 40], [0.1, 10])
        shear = [abs(m.shear(m.reduced(0.0, 0.1))) for m in (found.model, KNOWN)]
        misses.append(abs(math.log(shear[0] / shear[1])))
        ranges.append(found.range[1])
    # half a decade above the DSR data; noise of 2 % in 40 values, the creep stiffness is exact
    assert misses[1] < 0.01 and misses[1] < misses[0] / 2
    assert ranges[1] > 10 * ranges[0]


@pytest.mark.parametrize(
    "line, words",
    [
        ("4,0.1,x,30", "g_star_mpa: found 'x', expected a positive number"),
        ("4,-1,3,30", "frequency_hz: found -1, expected a positive number"),
        ("4,0.1,3,120", "phase_deg: found 120, expected an angle"),
        ("4,0.1", "g_star_mpa: found nothing, expected a positive number"),
    ],
)
def test_wrong_measurements_name_their_line(tmp_path, line, words):
    file = measured(tmp_path)
    file.write_text(file.read_text() + line + "\n")
    with pytest.raises(MixtureError, match=f"dsr.csv:42: {words}"):
        binder.read_dsr(file)


def test_a_missing_column_is_named(tmp_path):
    file = measured(tmp_path)
    file.write_text(file.read_text().replace("g_star_mpa", "modulus"))
    with pytest.raises(MixtureError, match="expected one of g_star_pa, g_star_kpa"):
        binder.read_dsr(file)


# ---- laws and scenes


def law(**more):
    keys = {
        "name": "mortar",
        "E_m": 4e9,
        "C_m": 2e9,
        "E": [1e9, 2e8],
        "C": [3e8, 5e9],
        "shift": laws.shift_keys(KNOWN),
        "valid_hz": (1e-3, 1e3),
        "misfit": 0.004,
    }
    return laws.Law(**{**keys, **more})


def test_modulus_of_a_chain():
    s = 2j * math.pi * 3.0
    expected = 1 / (1 / 4e9 + 1 / (s * 2e9) + 1 / (1e9 + s * 3e8) + 1 / (2e8 + s * 5e9))
    assert law().modulus(3.0) == pytest.approx(expected, rel=1e-14)
    assert law(C_m=math.inf, E=[], C=[]).modulus(3.0) == pytest.approx(4e9, rel=1e-14)


def test_a_law_as_toml_has_its_range():
    text = law().toml(0.4)
    mastic = tomllib.loads(text)["materials"]["mastic"]
    assert mastic == {
        "law": "generalised_kelvin",
        "E_m": 4e9,
        "C_m": 2e9,
        "E": [1e9, 2e8],
        "C": [3e8, 5e9],
        "shift": "wlf",
        "C1": 19.0,
        "C2": 165.0,
        "reference_temperature": 20.0,
        "valid_frequencies": [1e-3, 1e3],
        "poisson_ratio": 0.4,
    }


def test_a_sweep_covers_its_range():
    found = scenes.sweep_of(1e-3, 2e2, 3)
    assert (found[0], found[-1]) == (1e-3, 2e2)
    steps = np.diff(np.log10(found))
    np.testing.assert_allclose(steps, steps[0], rtol=1e-6)  # nine digits
    assert steps[0] <= 1 / 3


def test_the_scene_of_a_scale(tables):
    read = design.read(tables)
    scale = read.scales[2]
    part = volumes.part_of(read.recipe, scale.lower, scale.upper, scale.box_volume, True)
    scene = tomllib.loads(study_scenes.text_of(scenes.scene_of(read, scale, part, law(), 0.42, 7, [0.1, 10.0])))
    assert scene["network"] == {"rule": "series"} and "contacts" not in scene
    assert scene["materials"]["mastic"]["poisson_ratio"] == 0.42
    assert scene["materials"]["mastic"]["E"] == [1e9, 2e8]
    assert scene["materials"]["aggregate"] == {"law": "elastic", "E": 60e9, "poisson_ratio": 0.25}
    assert scene["specimen"]["voids"] == {"radius": scale.radius}  # the air voids of the recipe are voids
    assert scene["specimen"]["recipe"]["air_voids"] == 0.04 and scene["specimen"]["recipe"]["cut"] == 0.002
    assert scene["specimen"]["seed"] == 7 and scene["loading"]["frequencies"] == [0.1, 10.0]
    mortar = read.scales[1]
    below = volumes.part_of(read.recipe, mortar.lower, mortar.upper, mortar.box_volume, False)
    assert "voids" not in scenes.scene_of(read, mortar, below, law(), 0.42, 1, [1.0])["specimen"]


def test_keys_of_results(tables):
    read = design.read(tables)
    scale = read.scales[1]
    part = volumes.part_of(read.recipe, scale.lower, scale.upper, scale.box_volume, False)

    def key(version="1", **changed):
        given = {"law": law(), "poisson": 0.4, "seed": 1, "frequencies": [1.0]} | changed
        scene = scenes.scene_of(read, scale, part, given["law"], given["poisson"], given["seed"], given["frequencies"])
        return study_scenes.key_of(study_scenes.normal(scene), {}, ["run"], version)

    keys = [key(), key("2"), key(seed=2), key(poisson=0.41), key(frequencies=[1.0, 2.0]), key(law=law(E_m=4.1e9))]
    assert len(set(keys)) == len(keys)
    assert key() == keys[0]
    assert key(law=law(name="another", misfit=0.1)) == keys[0]  # a name changes no result


# ---- the design


def test_the_example_is_read(tables):
    read = design.read(EXAMPLE)
    assert [s.name for s in read.scales] == ["mastic", "mortar", "mixture"]
    assert read.binder.glass_modulus == 1e9 and read.binder.glass_modulus_std == pytest.approx(0.2)
    assert read.scales[1].seeds == [1, 2] and read.scales[1].box == [0.006, 0.006, 0.008]
    assert read.decisions == []
    assert design.read(tables).recipe == read.recipe


def test_open_values_are_decided_and_reported(tables):
    del tables["binder"]["glass_modulus"], tables["binder"]["poisson_ratio"], tables["aggregate"]
    for scale in tables["scale"][1:]:
        del scale["box"], scale["radius"]
    read = design.read(tables)
    said = " ".join(read.decisions)
    for words in (
        "glass modulus |G*| = 1 GPa",
        "Poisson's ratio 0.45",
        "E = 60 GPa",
        "box of 8 x 8 x 12 mm",
        "box of 32 x 32 x 48 mm",
    ):
        assert words in said
    assert read.scales[1].radius[0] == pytest.approx(0.87 * np.mean(read.scales[1].radius))


def change(*keys, to=None, drop=False, then=None):
    def made(tables):
        if then:
            change(*then[:-1], to=then[-1])(tables)
        at = tables
        for key in keys[:-1]:
            at = at[key]
        if drop:
            del at[keys[-1]]
        else:
            at[keys[-1]] = to

    return made


WRONG = [
    (change("binder", drop=True), "binder: found nothing"),
    (change("binder", "fil", to="x"), r"\[binder\] fil: found an unknown key.*did you mean file\?"),
    (change("binder", "file", to="none.csv"), r"\[binder\] file: found 'none.csv', expected a table"),
    (change("binder", "glass_modulus", to="1 mm"), r"\[binder\] glass_modulus: found '1 mm'.*Pa, kPa"),
    (change("binder", "poisson_ratio", to=0.5), r"\[binder\] poisson_ratio: found 0.5"),
    (change("test", "frequencies", to=[]), r"\[test\] frequencies: found \[\]"),
    (change("test", "temperatures", to=[300]), r"\[test\] temperatures: found 300"),
    (
        change("recipe", "gradation", 0, to=["11.2 mm", "99 %"]),
        r"\[recipe\] gradation: found 99 % passing the coarsest",
    ),
    (change("recipe", "gradation", 1, to=["12 mm", "99 %"]), r"\[recipe\] gradation: found 12 mm after 11.2 mm"),
    (change("recipe", "gradation", 2, to=["5.6 mm", "99.9 %"]), r"\[recipe\] gradation: found 99.9 % passing 5.6 mm"),
    (change("recipe", "binder_of", to="all"), r"\[recipe\] binder_of: found 'all', expected one of \"mix\""),
    (change("recipe", "air_voids", drop=True), r"\[recipe\] air_voids: found neither"),
    (
        change("recipe", "aggregate_density", to=2.7),
        r"\[recipe\] aggregate_density: found 2.7, expected a density from 200",
    ),
    (change("recipe", "absorbed_binder", to="9 %"), r"\[recipe\] binder: found an effective binder"),
    (change("scale", 0, "rule", to="mori"), r"\[\[scale\]\] number 1, rule: found 'mori'"),
    (change("scale", 0, "below", to="0.3 mm"), r"below: found 0.3 mm, expected a sieve of the gradation: 11.2, 8"),
    (change("scale", 0, "seeds", to=3), r"seeds: found this key together with rule"),
    (
        change("scale", 1, "sieves", to=["1 mm", "2 mm"]),
        r"number 2, sieves: found 1 mm, expected 0.25 mm, where scale mastic ends",
    ),
    (
        change("scale", 2, "sieves", to=["2 mm", "8 mm"]),
        r"number 3, sieves: found 8 mm, with 0.2 % of the aggregate above it",
    ),
    (change("scale", 1, "name", to="mastic"), r"number 2, name: found 'mastic'"),
    (change("scale", 2, "seeds", to=[1, 1]), r"number 3, seeds: found \[1, 1\]"),
    (
        change("scale", 2, "box", to=["7 mm", "24 mm", "30 mm"]),
        r"number 3, box: found an edge of 7 mm, expected at least the largest grain",
    ),
    (change("scale", 2, "radius", to=["1 mm", "0.5 mm"]), r"radius: found .* expected the smaller radius first"),
    (change("scale", 1, "void_radius", to=["1 mm", "2 mm"]), r"void_radius: found this key"),
    (change("scale", 0, drop=True), r"number 1, sieves: found 0.25 mm, with 16 % of the aggregate below it"),
    (
        change("recipe", "gradation", 4, to=["1 mm", "46 %"], then=("recipe", "gradation", 5, ["0.25 mm", "46 %"])),
        "sieves: found no aggregate between 0.25 mm and 2 mm",
    ),
    (change("run", to={"backend": "gpu"}), r"\[run\] backend: found 'gpu'"),
    (change("scale", to=[]), r"scale: found \[\]"),
]


@pytest.mark.parametrize("changed, words", WRONG)
def test_messages(tables, changed, words):
    wrong = copy.deepcopy(tables)
    changed(wrong)
    with pytest.raises(MixtureError, match="^design: .*" + words) as error:
        design.read(wrong)
    assert error.value.code == 2


def test_the_command_names_the_file(tmp_path, capsys):
    file = tmp_path / "mix.toml"
    file.write_text("[binder]\nfile = 3\n")
    assert command.main([str(file), "--out", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err.startswith(f"macadam mixture: {file}: [binder] file: found 3, expected a text")
    assert not (tmp_path / "out").exists()
    assert command.main([str(tmp_path / "none.toml"), "--check"]) == 2


def test_check_prints_volumes_and_ranges(capsys):
    assert command.main([str(EXAMPLE), "--check"]) == 0
    said = capsys.readouterr().out
    for words in (
        "VMA 18.30 %",
        "Scale mastic: rule nielsen, 47.8 %",
        "its material is merged with the class 5.6-8 mm",
        "the test needs",
    ):
        assert words in said
