# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays as arguments: every kind that NumPy reads is accepted, and a wrong shape raises an InputError that names the
argument."""
import numpy as np
import pandas as pd
import pytest

import macadam as mc

SIDE = np.arange(2) * 1e-3 + 0.5e-3
CENTRE = np.stack(np.meshgrid(SIDE, SIDE, SIDE, indexing="ij"), axis=-1).reshape(-1, 3)
EIGHT = {"box": [2e-3] * 3, "centre": CENTRE, "radius": np.full(8, 5e-4)}


def of_particles(scene, **changed):
    return mc.specimen(scene, particles={**EIGHT, **changed})


@pytest.mark.parametrize("changed", [
    {"centre": CENTRE.tolist(), "radius": [5e-4] * 8},
    {"centre": np.asfortranarray(CENTRE), "radius": pd.Series(np.full(8, 5e-4))},
    {"centre": np.repeat(CENTRE, 2, axis=0)[::2], "radius": np.full(8, 5e-4, ">f8")},  # strided, big-endian
    {"phase": np.ones(8, bool), "body": np.full(8, -1.0)},
    {"phase": np.ones(8, np.uint64), "body": np.full(8, -1, np.int8)},
], ids=["lists", "Fortran order and pandas", "strided and big-endian", "bool and float", "integers of any size"])
def test_arrays_of_any_kind_are_read(scene, changed):
    made = of_particles(scene, **changed)
    assert np.array_equal(made.centre, CENTRE) and np.array_equal(made.radius, EIGHT["radius"])
    assert (made.phase == 1).all() and (made.body == -1).all()


WRONG = [
    ({"centre": CENTRE[:, :2]}, r"particles: centre: found numbers of shape \(8, 2\), expected numbers of shape \(n, 3\)"),
    ({"centre": CENTRE.ravel()}, r"particles: centre: found numbers of shape \(24,\), expected numbers of shape \(n, 3\)"),
    ({"centre": [[0, 0, 0], [1, 1]]}, r"particles: centre: found rows of different lengths, expected numbers of shape \(n, 3\)"),
    ({"radius": np.ones((8, 1))}, r"particles: radius: found numbers of shape \(8, 1\), expected numbers of shape \(n,\)"),
    ({"radius": 5e-4}, r"particles: radius: found numbers of shape \(\), expected numbers of shape \(n,\)"),
    ({"radius": ["5e-4"] * 8}, r"particles: radius: found text, expected numbers of shape \(n,\)"),
    ({"radius": np.full(8, 5e-4 + 0j)}, r"particles: radius: found complex numbers, expected"),
    ({"radius": [{}] * 8}, r"particles: radius: found objects that are not numbers, expected"),
    ({"radius": np.full(7, 5e-4)}, r"particles: found 8 centres, 7 radii, 7 phases and 7 bodies, expected the same number of each"),
    ({"phase": ["mastic"] * 8}, r"particles: phase: found text, expected numbers of shape \(n,\)"),
    ({"phase": np.full(8, 0.5)}, r"particles: phase: found 0.5 in row 0, expected whole numbers of 32 bits"),
    ({"body": np.full(8, 2**40)}, r"particles: body: found 1099511627776 in row 0, expected whole numbers of 32 bits"),
    ({"body": [-1, np.nan, -1, -1, -1, -1, -1, -1]}, r"particles: body: found nan in row 1, expected whole numbers"),
    ({"colour": [1] * 8}, r"particles: found 'colour', expected centre, radius and, if needed, phase, body, box"),
]


@pytest.mark.parametrize("changed, message", WRONG)
def test_a_wrong_array_of_particles_is_named(scene, changed, message):
    with pytest.raises(mc.InputError, match=message):
        of_particles(scene, **changed)


def test_what_is_missing_is_named(scene):
    with pytest.raises(mc.InputError, match="particles: found no radius, expected centre, radius"):
        mc.specimen(scene, particles={"centre": CENTRE})
    with pytest.raises(mc.InputError, match="box"):
        mc.specimen(scene, particles={**EIGHT, "box": [2e-3] * 2})


def refusals(specimen):
    """Returns calls of all other functions that take an array, each with an array of wrong shape, and the beginning of
    the expected message."""
    stepper = mc.Stepper(specimen, mc.Boundary(), backend="cpu")
    n, state = len(specimen), stepper.state()
    name = next(iter(state))
    series = mc.spectrum(specimen, shortest=0.01, longest=1.0)
    triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    flat = r"found numbers of shape \(2, 1\), expected numbers of shape \(n,\)"
    column = [[1.0], [2.0]]
    return [
        (lambda: mc.drives.Table([1, 2], column, dt=1e-6), f"times: {flat}"),
        (lambda: mc.drives.Table([1, 2, 3], [1, 2], dt=1e-6), r"values: found numbers of shape \(3,\), expected .*\(2,\)"),
        (lambda: mc.Boundary().fix(column), f"particles: {flat}"),
        (lambda: mc.Boundary().fix([0.5]), "particles: found 0.5 in row 0, expected whole numbers"),
        (lambda: mc.Boundary().body_force(np.ones(n)), r"force: found numbers of shape .*expected .*\(n, 3\)"),
        (lambda: stepper.set_velocities(np.zeros((n, 2)), np.zeros((n, 3))), rf"velocity: found .*\({n}, 2\), expected .*\({n}, 3\)"),
        (lambda: stepper.set_velocities(np.zeros((n, 3)), np.zeros((1, 3))), rf"spin: found .*\(1, 3\), expected .*\({n}, 3\)"),
        (lambda: stepper.set_state({name: [[1.0]]}), rf"arrays: {name}: found float64 of shape \(1, 1\), expected shape \(n,\)"),
        (lambda: stepper.set_state({name: "text"}), f"arrays: {name}: found text, expected an array as state"),
        (lambda: mc.HarmonicSolver(specimen).solve(column), f"frequencies: {flat}"),
        (lambda: mc.HarmonicSolver(specimen).solve(10.0), r"frequencies: found numbers of shape \(\)"),
        (lambda: series.relaxation.modulus(column), f"times: {flat}"),
        (lambda: series.creep.after_ramp(["a"], 1.0), "times: found text"),
        (lambda: mc.evaluate_cyclic([0, 1], [0, 1], [0], 1.0), r"stress: found numbers of shape \(1,\), expected .*\(2,\)"),
        (lambda: mc.shapes.Surface([[0, 0]], [[0, 1, 2]]), r"points: found numbers of shape \(1, 2\), expected .*\(n, 3\)"),
        (lambda: mc.shapes.Surface(triangle, [0, 1, 2]), r"facets: found numbers of shape \(3,\), expected .*\(n, 3\)"),
        (lambda: mc.shapes.Surface(triangle, [[0, 1, 2.5]]), "facets: found 2.5 in row 0, expected whole numbers"),
        (lambda: specimen.write("a.vtp", arrays={"x": ["a"] * n}), rf"arrays: x: found text, expected numbers of shape \({n},\)"),
        (lambda: specimen.write("a.vtp", arrays={"x": [1.0]}), rf"arrays: x: found shape \(1,\), expected \({n},\)"),
    ]


def test_every_function_names_the_argument_of_wrong_shape(specimen):
    for call, message in refusals(specimen):
        with pytest.raises(mc.InputError, match=f"^{message}"):
            call()


def test_lists_and_columns_serve_as_well(specimen):
    table = pd.DataFrame({"t": [0.0, 1e-6], "u": [0.0, 1e-9]})
    # The tolerance covers rounding in the interpolation.
    assert mc.drives.Table(table.u, table.t, dt=1e-6).value(1) == pytest.approx(1e-9, rel=1e-12)
    assert mc.HarmonicSolver(specimen).solve(np.array([10], np.float32))[0].frequency_hz == 10
    assert mc.harmonic(specimen, np.int64(10)).table.frequency_hz[0] == 10
    assert list(mc.harmonic(specimen, frequencies=pd.Series([10.0, 20.0])).table.frequency_hz) == [10, 20]
