# SPDX-License-Identifier: GPL-3.0-or-later
"""A user's script, for mypy: the types in it must be known, and wrong types must be reported."""
import numpy as np
import numpy.typing as npt

import macadam as mc


def narrower(file: str) -> mc.Result:
    made = mc.harmonic(file, frequencies=[10.0], specimen={"box": [0.01, 0.01, 0.02]})
    return mc.harmonic(made.scene, specimen=made.specimen)


def modulus(file: str, hz: list[float]) -> npt.NDArray[np.float64]:
    scene = mc.Scene(file, seed=3)
    specimen: mc.Specimen = mc.specimen(scene)
    result: mc.Result = mc.harmonic(specimen, frequencies=hz)
    found: npt.NDArray[np.float64] = result.table["e_star_pa"].to_numpy()
    return found


def look(step: mc.Step) -> None:
    print(step.time + step.stress_pa, step.particles().velocity.shape)


def stepped(specimen: mc.Specimen) -> float:
    dt: float = mc.critical_step(specimen) / 2
    pull = mc.drives.Haversine(height=1e-6, dt=dt, pulse_steps=100)
    stepper = mc.Stepper(specimen, mc.Boundary().move("+z", "z", pull), backend="cpu")
    stepper.advance(10)
    kept: mc.Snapshot = stepper.snapshot()
    stepper.restore(kept)
    specimen.plot("section").savefig("section.png")
    mc.run(specimen, on_step=look, every=100)
    return stepper.observe().top_force
