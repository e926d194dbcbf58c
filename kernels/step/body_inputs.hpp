// SPDX-License-Identifier: GPL-3.0-or-later
/// \file body_inputs.hpp  Computes the numbers of the bodies that no step changes: Δt over mass, and body forces.
#pragma once

#include <vector>

#include "kernels/layout/layout.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Returns Δt/m [s/kg] and Δt/I [s/(kg·m²)] of each body, [body][2], with density scaling; 0 for bodies that forces do
/// not move or turn. R: precision of the particles.
template <class R>
std::vector<R> inverse_masses(const Layout& layout, const Inertia& inertia, const StepperOptions& options) {
  std::vector<R> out(2 * (layout.particles() + walls), R(0));
  for (std::size_t b = 0; b < layout.particles(); ++b) {
    const auto i = static_cast<std::size_t>(layout.particle[b]);
    out[2 * b] = static_cast<R>(options.dt / (inertia.mass[i] * options.density_scaling));
    if (!options.skip_rotations)
      out[2 * b + 1] = static_cast<R>(options.dt / (inertia.inertia[i] * options.density_scaling));
  }
  for (const std::int32_t i : options.boundary.fixed) {
    const auto b = static_cast<std::size_t>(layout.body_of(i));
    out[2 * b] = out[2 * b + 1] = R(0);
  }
  for (std::size_t w = 0; w < wall_count; ++w) {  // with the same density scaling as the particles
    const double mass = options.boundary.wall[w].mass * options.density_scaling;
    if (mass > 0) out[2 * (layout.particles() + w)] = static_cast<R>(options.dt / mass);
  }
  return out;
}

/// Returns the body forces of the particles, [particle][4] in device order [N]; empty without body forces.
template <class R>
std::vector<R> body_forces(const Layout& layout, const Boundary& boundary) {
  std::vector<R> out(boundary.body_force.empty() ? 0 : 4 * layout.particles(), R(0));
  for (std::size_t b = 0; 4 * b < out.size(); ++b) {
    const Vec3d& force = boundary.body_force[static_cast<std::size_t>(layout.particle[b])];
    const double words[3] = {force.x, force.y, force.z};
    for (std::size_t w = 0; w < 3; ++w) out[4 * b + w] = static_cast<R>(words[w]);
  }
  return out;
}

}  // namespace macadam::kernels
