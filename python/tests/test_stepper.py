# SPDX-License-Identifier: GPL-3.0-or-later
"""Steppers that Python advances itself: they are compared with a run, use drives written in Python, and save their
states."""
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
    # The tolerance 1e-3 covers the error of the time stepping, which is of second order in the step.
    assert abs(e_star) == pytest.approx(solved.e_star_pa, rel=1e-3)
    assert np.degrees(np.angle(e_star)) == pytest.approx(solved.phase_deg, abs=0.05)
    assert solved.motion.shape == (len(specimen), 6) and solved.motion.dtype == complex
    assert abs(solved.modulus) == pytest.approx(solved.e_star_pa, rel=1e-9)
    without = mc.HarmonicSolver(specimen).solve([HZ])[0]
    assert sum(without.shares.values()) == pytest.approx(1) and without.linear == "iterative"
    assert without.bottom_e_star_pa == pytest.approx(without.e_star_pa, rel=1e-6)


def test_samples_of_ones_own_are_evaluated():
    time = np.linspace(0, 2 / HZ, 401)
    angle = 2 * np.pi * HZ * time
    found = mc.evaluate_cyclic(time, 1e-4 * np.sin(angle), 1e6 * np.sin(angle + np.radians(20)), HZ, fit_cycles=2)
    assert found["e_star_pa"] == pytest.approx(1e10) and found["phase_deg"] == pytest.approx(20)
    # The tolerance is 1e-3, because peaks are found by parabolas through three samples, and a period has 200 samples.
    assert found["e_star_peaks_pa"] == pytest.approx(1e10, rel=1e-3) and found["fit_rms"] < 1e-9
    with pytest.raises(mc.InputError, match=r"strain: found numbers of shape \(2,\), expected .*\(3,\)"):
        mc.evaluate_cyclic([0.0, 1.0, 2.0], [0.0, 1.0], [0.0, 1.0], HZ)
    with pytest.raises(mc.InputError, match="1 cycle|at least 1"):
        mc.evaluate_cyclic(list(time[:50]), list(time[:50]), list(time[:50]), HZ)


def test_a_table_of_the_same_values_is_the_same_drive(specimen, dt):
    ramp = mc.drives.Ramp(height=1e-6, dt=dt, ramp_steps=50)
    table = mc.drives.Table(ramp.values(0, 201), np.arange(201) * dt, dt=dt)
    assert np.allclose(table.values(0, 300), ramp.values(0, 300), rtol=1e-12)
    a, b = stepper(specimen, ramp), stepper(specimen, table)
    a.advance(150)
    b.advance(150)
    # the rates of the two drives differ by rounding
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
    for wrong, message in (({}, "step"), ({**state, "sums": state["sums"][:-1]}, "sums"), ({"x": "y"}, "x: found text, expected")):
        with pytest.raises(mc.Error, match=message):
            other.set_state(wrong)
    assert np.array_equal(one.particles().force, other.particles().force)  # the refused states changed nothing


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
    # the tolerance is the rounding of a sum of some twenty terms
    assert np.allclose(force, stepping.particles().force, rtol=0, atol=1e-12 * scale)
    assert state.chain_begin.shape == (len(contacts) + 1,) and state.relative.shape == (len(contacts), 6)


def test_pulses_and_what_drives_say_of_themselves(specimen, dt):
    pulses = mc.drives.Haversine(height=-1e-6, dt=dt, pulse_steps=40, rest_steps=60, pulses=2)
    k = np.arange(250)
    expected = np.where((k % 100 < 40) & (k < 200), -1e-6 * np.sin(np.pi * (k % 100) / 40) ** 2, 0)
    assert np.allclose(pulses.values(0, 250), expected, rtol=0, atol=1e-20)
    assert pulses.rate(3) == pytest.approx((expected[4] - expected[3]) / dt) and pulses.shortest_time == 40 * dt
    assert pulses.fastest == pytest.approx(np.pi * 1e-6 / (40 * dt))
    stepping = stepper(specimen, pulses)
    stepping.advance(20)
    now = stepping.observe()
    assert now.wall_displacement[5, 2] == pytest.approx(-1e-6) and now.wall_velocity.shape == (6, 3)
    assert now.wall_velocity[5, 2] == pytest.approx(pulses.rate(19)) and stepping.kernels == []


def test_stresses_of_cells_are_those_of_the_whole(specimen, dt):
    """The mean of the cells' stresses, weighted by volume, equals the stress on the walls. This is exact in
    equilibrium, when all particles are at rest."""
    ramp = mc.drives.Ramp(height=1e-6, dt=dt, ramp_steps=200)
    stepping = stepper(specimen, ramp, damping_kind="viscous", damping=0.05 / dt)
    stepping.advance(3000)
    box = specimen.box
    mean = (stepping.stress() * specimen.cells.volume[:, None]).sum(axis=0) / (box[0] * box[1] * box[2])
    wall = -stepping.observe().top_force / (box[0] * box[1])
    assert stepping.stress().shape == (len(specimen), 6)
    assert mean[2] == pytest.approx(wall, rel=0.05)  # 5 %: the specimen still flows, and some waves are not damped yet


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
    ({"backend": "x"}, "backend"), ({"device": 0}, "device: found 0 with backend cpu"), ({"dt": -1.0}, "step|dt"),
])
def test_options_are_refused_by_name(change, message, specimen, dt):
    with pytest.raises(mc.InputError, match=message):
        stepper(specimen, mc.drives.Ramp(height=1e-6, dt=dt), **change)


def test_wrong_drives_and_walls(specimen, dt):
    ramp = mc.drives.Ramp(height=1e-6, dt=dt)
    for call, message in ((lambda: mc.Boundary().move("top", "z", ramp), r'wall: found "top"'),
                          (lambda: mc.Boundary().move("+z", "w", ramp), "axis"),
                          (lambda: mc.drives.Table([0.0, 1.0, 2.0], [0.0, 1.0, 0.5], dt=dt), "row 3"),
                          (lambda: mc.drives.Table([0.0], [0.0], dt=dt), "at least two"),
                          (lambda: mc.drives.Table([0.0, 1.0], [0.0, 1.0], dt=0), "dt: found 0"),
                          (lambda: mc.drives.Cyclic(1e-6, 10, steps_per_period=0), "steps_per_period: found 0"),
                          (lambda: mc.drives.Cyclic(1e-6, 0, steps_per_period=10), "frequency: found 0"),
                          (lambda: mc.drives.Ramp(1e-6, dt=-dt), "dt: found -"),
                          (lambda: mc.drives.Haversine(1e-6, 0, dt=dt), "pulse_steps: found 0"),
                          (lambda: stepper(specimen, ramp, blocks=0.0), "blocks: found 0"),
                          (lambda: stepper(specimen, ramp).advance(-1), "-1 steps"),
                          (lambda: stepper(specimen, ramp).set_velocities(np.zeros((3, 3)), np.zeros((3, 3))), "velocity: found")):
        with pytest.raises(mc.InputError, match=message):
            call()


def test_broken_points_of_contacts(scene):
    brittle = [dict(pair=c["pair"], law="brittle_bond", E=1e10, tensile_strength=1e4, alpha=0.1) if c["pair"] == "M-M" else c
               for c in scene.as_dict()["contacts"]]
    specimen = mc.specimen(mc.Scene(scene, contacts=brittle))
    dt = 0.5 * mc.critical_step(specimen, density_scaling=1e6)
    drive = mc.drives.ConstantRate(speed=1e-3, dt=dt, duration=1000 * dt)
    stepping = stepper(specimen, drive, form="points")
    assert not stepping.contacts().broken.any() and not stepping.contacts().point_breaks.any()
    stepping.advance(400)
    contacts, state = specimen.contacts, stepping.contacts()
    assert state.broken.shape == (len(contacts),) and 0 < state.broken.max() <= 1
    begin, breaks, bond = state.chain_begin, [], mc.pair_names.index("M-M")
    for c, pair in enumerate(contacts.pair):
        # The state of a point of a bonded contact has six values: the force and the opening in the normal
        # direction, then for each of the two slips the force and the break (not 0 if the point is broken).
        of_points = state.chain[begin[c]:begin[c + 1]].reshape(-1, 6)[:, 3] if pair == bond else np.zeros(1)
        assert state.broken[c] == pytest.approx(np.count_nonzero(of_points) / len(of_points))
        breaks += list(of_points[of_points != 0])
    assert np.array_equal(state.point_breaks[state.point_breaks != 0], breaks)


def test_cracks_of_contact_points(scene):
    crack = dict(tensile_strength=1e4, fracture_energy="0.2 J/m2", shear_strength=2e4)
    cracking = [dict(pair=c["pair"], law="elastic", E=1e10, alpha=0.5, crack=crack) if c["pair"] == "M-M" else c
                for c in scene.as_dict()["contacts"]]
    specimen = mc.specimen(mc.Scene(scene, contacts=cracking))
    dt = 0.5 * mc.critical_step(specimen, density_scaling=1e6)
    drive = mc.drives.ConstantRate(speed=1e-3, dt=dt, duration=1000 * dt)
    stepping = stepper(specimen, drive, form="points")
    assert not stepping.contacts().point_cracks.any()
    stepping.advance(400)
    opening, slip, damage, energy, friction = stepping.contacts().point_cracks.T
    assert 0 < damage.max() <= 1 and (damage >= 0).all()
    assert np.abs(friction).max() <= 1e-12 * energy.max()  # without friction only rounding errors do work
    assert ((opening > 0) | (slip > 0))[damage > 0].all() and not opening[damage == 0].any()
    assert (energy[damage > 0] > 0).all() and energy.max() <= 0.2 * (1 + 1e-9)  # both modes take 0.2 J/m²


def test_laws_that_cannot_break_have_no_broken_points(specimen, dt):
    ramp = mc.drives.Ramp(height=1e-6, dt=dt, ramp_steps=50)
    state = stepper(specimen, ramp).contacts()
    assert state.broken.size == 0 and state.point_breaks.size == 0 and state.point_cracks.shape == (0, 5)
