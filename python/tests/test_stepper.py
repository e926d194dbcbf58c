# SPDX-License-Identifier: GPL-3.0-or-later
"""Steppers stepped by hand: against the run, drives of one's own, states."""
import math

import numpy as np
import pytest

import macadam as mc

HZ = 20.0


@pytest.fixture(scope="module")
def dt(specimen):
    return 0.5 * mc.critical_step(specimen, density_scaling=1e6)


def stepper(specimen, drive, **options):
    boundary = mc.Boundary().move("+z", "z", drive)
    return mc.Stepper(specimen, boundary, **{"backend": "cpu", "density_scaling": 1e6, **options})


def test_steady_start_gives_the_harmonic_modulus(specimen, dt):
    per_period = math.ceil(1 / (HZ * dt))
    height, area = specimen.box[2], specimen.box[0] * specimen.box[1]
    drive = mc.drives.Cyclic(amplitude=1e-4 * height, frequency=HZ, steps_per_period=per_period)
    solved = mc.HarmonicSolver(specimen, typical_hz=HZ).solve([HZ], density_scaling=1e6)[0]
    start = mc.steady_start(specimen, solved, drive)
    stepping = stepper(specimen, drive, start=start)
    assert stepping.dt == drive.dt and stepping.description.startswith("cpu")
    strain, stress = [], []
    for _ in range(per_period):
        stepping.advance(1)
        now = stepping.observe()
        strain.append(now.top_displacement / height)
        stress.append(-now.top_force / area)
    e_star = np.fft.rfft(stress)[1] / np.fft.rfft(strain)[1]
    # 1e-3: the error of the time step, of second order, 1 / (critical step) away from stability
    assert abs(e_star) == pytest.approx(solved.e_star_pa, rel=1e-3)
    assert np.degrees(np.angle(e_star)) == pytest.approx(solved.phase_deg, abs=0.05)
    assert solved.motion.shape == (len(specimen), 6) and solved.motion.dtype == complex
    assert abs(solved.modulus) == pytest.approx(solved.e_star_pa, rel=1e-9)


def test_a_table_of_the_same_values_is_the_same_drive(specimen, dt):
    ramp = mc.drives.Ramp(height=1e-6, dt=dt, ramp_steps=50)
    table = mc.drives.Table(dt, np.arange(201) * dt, ramp.values(0, 201))
    assert np.allclose(table.values(0, 300), ramp.values(0, 300), rtol=1e-12)
    a, b = stepper(specimen, ramp), stepper(specimen, table)
    a.advance(150)
    b.advance(150)
    # rates of the two drives differ by rounding
    assert np.allclose(a.particles().displacement, b.particles().displacement, rtol=0, atol=1e-15)
    assert a.observe().step == 150 and a.observe().time == pytest.approx(150 * dt)


def test_states_go_there_and_back(specimen, dt):
    ramp = mc.drives.Ramp(height=1e-6, dt=dt, ramp_steps=50)
    one = stepper(specimen, ramp)
    one.advance(60)
    state = {name: np.array(values) for name, values in one.state().items()}
    one.advance(40)
    other = stepper(specimen, ramp)
    other.set_state(state)
    assert other.observe().step == 60
    other.advance(40)
    for name in ("displacement", "rotation", "velocity", "spin", "force", "moment"):
        assert np.array_equal(getattr(one.particles(), name), getattr(other.particles(), name)), name
    for wrong, message in (({}, "step"), ({**state, "sums": state["sums"][:-1]}, "sums"), ({"x": "y"}, "x: expected")):
        with pytest.raises(mc.Error, match=message):
            other.set_state(wrong)
    assert np.array_equal(one.particles().force, other.particles().force)  # nothing was changed


def test_forces_balance(specimen, dt):
    drive = mc.drives.ConstantRate(speed=1e-3, dt=dt, duration=1000 * dt)
    stepping = stepper(specimen, drive)
    stepping.advance(100)
    contacts, state = specimen.contacts, stepping.contacts()
    force = np.zeros((len(specimen), 3))
    np.add.at(force, contacts.a, state.force)
    inner = contacts.b >= 0
    np.subtract.at(force, contacts.b[inner], state.force[inner])
    scale = abs(state.force).max()
    assert np.allclose(force, stepping.particles().force, rtol=0, atol=1e-12 * scale)  # some twenty terms each
    assert state.chain_begin.shape == (len(contacts) + 1,) and state.relative.shape == (len(contacts), 6)


def test_boundaries(specimen, dt):
    n = len(specimen)
    held = np.flatnonzero(specimen.centre[:, 2] < 2e-3)
    force = np.zeros((n, 3))
    force[:, 2] = -1e-3
    boundary = mc.Boundary().fix(held.astype(np.int32)).body_force(force)
    stepping = mc.Stepper(specimen, boundary, backend="cpu", dt=dt, density_scaling=1e6)
    stepping.advance(50)
    moved = stepping.particles().displacement
    assert not moved[held].any() and moved[:, 2].min() < 0
    loaded = mc.Boundary().load("+z", "z", mc.drives.Ramp(height=-1.0, dt=dt), mass=1e-3)
    platen = mc.Stepper(specimen, loaded, backend="cpu", density_scaling=1e6)
    platen.advance(50)
    assert platen.observe().wall_displacement[5, 2] < 0 and platen.observe().wall_force.shape == (6, 3)
    pushed = mc.Stepper(specimen, mc.Boundary(), backend="cpu", safety=0.5, threads=1)
    velocity = np.full((n, 3), 1e-6)
    pushed.set_velocities(velocity, np.zeros((n, 3)))
    assert pushed.dt == 0.5 * mc.critical_step(specimen)
    assert np.allclose(pushed.particles().velocity, velocity) and pushed.first_divergent == -1
    assert pushed.device_motion() is None and pushed.bytes > 0 and pushed.traffic > 0


@pytest.mark.parametrize(("change", "message"), [
    ({"precision": "half"}, r'precision: found "half", expected one of double\|mixed\|single'),
    ({"form": "x"}, "form"), ({"geometry": "x"}, "geometry"), ({"damping_kind": "x"}, "damping_kind"),
    ({"backend": "x"}, "backend"), ({"device": 0}, "device: found 0 beside backend cpu"), ({"dt": -1.0}, "step|dt"),
])
def test_options_are_refused_by_name(change, message, specimen, dt):
    with pytest.raises(mc.InputError, match=message):
        stepper(specimen, mc.drives.Ramp(height=1e-6, dt=dt), **change)


def test_wrong_drives_and_walls(specimen, dt):
    ramp = mc.drives.Ramp(height=1e-6, dt=dt)
    for call, message in ((lambda: mc.Boundary().move("top", "z", ramp), r'wall: found "top"'),
                          (lambda: mc.Boundary().move("+z", "w", ramp), "axis"),
                          (lambda: mc.drives.Table(dt, [0.0, 1.0, 0.5], [0.0, 1.0, 2.0]), "row 3"),
                          (lambda: mc.drives.Table(dt, [0.0], [0.0]), "two at least"),
                          (lambda: stepper(specimen, ramp).advance(-1), "-1 steps"),
                          (lambda: stepper(specimen, ramp).set_velocities(np.zeros((3, 3)), np.zeros((3, 3))), "as many")):
        with pytest.raises(mc.InputError, match=message):
            call()
