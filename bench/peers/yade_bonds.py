# SPDX-License-Identifier: GPL-3.0-or-later
"""Times steps of Yade over given spheres and bonds. Called by bench/peers/run with `yade -x -n -jTHREADS`.

usage: yade_bonds.py SPECIMEN.csv CONTACTS.csv

Every contact between two particles becomes an unbreakable cohesive bond with normal, shear, bending and twisting
stiffness. There is no search for contacts: bonds are made once. Prints the number of bonds and the milliseconds per
step, the median of seven runs."""
import csv
import random
import statistics
import sys
import time

from yade import O, utils  # noqa: F401
from yade.wrapper import (CohFrictMat, ForceResetter, Ig2_Sphere_Sphere_ScGeom6D, InteractionLoop,
                          Ip2_CohFrictMat_CohFrictMat_CohFrictPhys, Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
                          NewtonIntegrator)

specimen, contacts = sys.argv[1:3]
O.materials.append(CohFrictMat(young=1e9, poisson=0.25, density=2500, frictionAngle=0.5, normalCohesion=1e30,
                               shearCohesion=1e30, momentRotationLaw=True, isCohesive=True, fragile=False,
                               etaRoll=-1, etaTwist=-1, alphaKr=1, alphaKtw=1))
random.seed(1)
with open(specimen) as f:
    for row in csv.DictReader(line for line in f if not line.startswith("#")):
        O.bodies.append(utils.sphere([float(row[k]) for k in "xyz"], float(row["radius"])))
for body in O.bodies:
    body.state.vel = [random.uniform(-1e-6, 1e-6) for _ in range(3)]
    body.state.angVel = [random.uniform(-1e-4, 1e-4) for _ in range(3)]
O.engines = [ForceResetter(),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D()],
                             [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
                             [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=True,
                                                                       always_use_moment_law=True)]),
             NewtonIntegrator(damping=0)]
with open(contacts) as f:
    for row in csv.DictReader(line for line in f if not line.startswith("#")):
        if int(row["b"]) >= 0:
            utils.createInteraction(int(row["a"]), int(row["b"]))
O.dt = 1e-9  # the computing time of a step does not depend on its length
O.run(5, True)
bonds = sum(1 for i in O.interactions if i.isReal and i.phys.cohesionBroken is False)
times = []
for _ in range(7):
    start = time.perf_counter()
    O.run(10, True)
    times.append((time.perf_counter() - start) / 10)
print(f"bonds {bonds} ms {1e3 * statistics.median(times):.2f}")
