# SPDX-License-Identifier: GPL-3.0-or-later
"""Two spheres of 10 mm, joined by one bond, in Yade: the force when the upper sphere has moved by 1e-6 m."""
from yade import O, utils  # noqa: F401
from yade.wrapper import (CohFrictMat, ForceResetter, Ig2_Sphere_Sphere_ScGeom6D, InteractionLoop,
                          Ip2_CohFrictMat_CohFrictMat_CohFrictPhys, Law2_ScGeom6D_CohFrictPhys_CohesionMoment)

# the normal stiffness of two equal spheres is young * radius: 2e9 Pa * 5 mm = 1e7 N/m
O.materials.append(CohFrictMat(young=2e9, poisson=0.1, density=2500, frictionAngle=0.5, normalCohesion=1e30,
                               shearCohesion=1e30, momentRotationLaw=True, isCohesive=True))
lower = O.bodies.append(utils.sphere([0.005, 0.005, 0.005], 0.005, fixed=True))
upper = O.bodies.append(utils.sphere([0.005, 0.005, 0.015], 0.005, fixed=True))
O.engines = [ForceResetter(),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D()],
                             [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
                             [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()])]
bond = utils.createInteraction(lower, upper)
O.dt = 1e-9
O.step()
O.bodies[upper].state.pos += [0, 0, 1e-6]
O.step()
print(f"bond force {O.forces.f(lower)[2]:.12g} N, kn {bond.phys.kn:.12g} N/m")
