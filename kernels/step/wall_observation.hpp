// SPDX-License-Identifier: GPL-3.0-or-later
/// \file wall_observation.hpp  Makes the observation of a step from the forces on the walls and from their motion.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/step/particle_motion.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Returns the observation after step `step`. `forces`: [wall], exerted by the particles. `moved`, `speed`: [wall][8],
/// displacements and velocities of the walls, read only if walls are driven by forces. `in_motion`: whether the walls
/// had a velocity before step 0.
template <class R>
Observation observe_walls(const StepperOptions& options, std::int64_t step, const std::vector<Twist<R>>& forces,
                          const std::vector<double>& moved, const std::vector<R>& speed, bool in_motion) {
  Observation out;
  out.step = step;
  out.time = static_cast<double>(step) * options.dt;
  for (std::size_t w = 0; w < walls; ++w) {
    const auto& f = forces[w].linear;
    out.wall_force[w] = {f.x, f.y, f.z};
    double* u[3] = {&out.wall_displacement[w].x, &out.wall_displacement[w].y, &out.wall_displacement[w].z};
    double* v[3] = {&out.wall_velocity[w].x, &out.wall_velocity[w].y, &out.wall_velocity[w].z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const WallAxis& a = options.boundary.wall[w].axis[axis];
      if (a.by == DrivenBy::displacement) {
        *u[axis] = a.drive->value(step);
        if (step > 0 || in_motion) *v[axis] = a.drive->rate(step - 1);
      } else if (a.by == DrivenBy::force) {
        *u[axis] = moved[w * displacement_words + axis];
        *v[axis] = static_cast<double>(speed[w * velocity_words + axis]);
      }
    }
  }
  return out;
}

}  // namespace macadam::kernels
