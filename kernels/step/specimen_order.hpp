// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_order.hpp  Converts the arrays of bodies between the order of a device and the order of the specimen.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/base/parallel.hpp"
#include "kernels/layout/layout.hpp"
#include "kernels/step/particle_motion.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Returns the state of all particles. `v`: [body][8] [m/s, rad/s]; `u`: [body][8] [m, rad]; `forces`: [particle]
/// [N, N·m]; `body_force`: added to the forces, [particle] in the order of the specimen [N]; empty or null:
/// none.
template <class R>
ParticleState particle_state(const Layout& layout, const std::vector<R>& v, const std::vector<double>& u,
                             const std::vector<Twist<R>>& forces, const std::vector<Vec3d>* body_force) {
  const std::size_t n = layout.particles();
  const bool weigh = body_force && !body_force->empty();
  ParticleState out;
  for (auto* list : {&out.displacement, &out.rotation, &out.velocity, &out.spin, &out.force, &out.moment})
    list->resize(n);
  for_each_of(n, [&](std::size_t b) {
    const auto i = static_cast<std::size_t>(layout.particle[b]);
    const R* vb = &v[b * velocity_words];
    const double* ub = &u[b * displacement_words];
    const auto& f = forces[b];
    out.displacement[i] = {ub[0], ub[1], ub[2]};
    out.rotation[i] = {ub[4], ub[5], ub[6]};
    out.velocity[i] = {vb[0], vb[1], vb[2]};
    out.spin[i] = {vb[4], vb[5], vb[6]};
    out.force[i] = {f.linear.x, f.linear.y, f.linear.z};
    if (weigh) out.force[i] += (*body_force)[i];
    out.moment[i] = {f.angular.x, f.angular.y, f.angular.z};
  });
  return out;
}

/// Returns displacements and rotations of some particles. `u`: [body][8].
inline std::vector<MotionOfParticle> motions_of_particles(const Layout& layout, const std::vector<double>& u,
                                                          const std::vector<std::int32_t>& of) {
  std::vector<MotionOfParticle> out;
  out.reserve(of.size());
  for (const std::int32_t particle : of) {
    const double* ub = &u[static_cast<std::size_t>(layout.body_of(particle)) * displacement_words];
    out.push_back({ub[0], ub[1], ub[2], ub[4], ub[5], ub[6]});
  }
  return out;
}

/// Writes velocities and spins of all particles, given in the order of the specimen, into `v`, [body][8]. The particles
/// in `fixed` are at rest.
template <class R>
void put_velocities(const Layout& layout, const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& spin,
                    const std::vector<std::int32_t>& fixed, std::vector<R>& v) {
  for (std::size_t b = 0; b < layout.particles(); ++b) {
    const auto i = static_cast<std::size_t>(layout.particle[b]);
    const double words[velocity_words] = {velocity[i].x, velocity[i].y, velocity[i].z, 0,
                                          spin[i].x,     spin[i].y,     spin[i].z,     0};
    for (int w = 0; w < velocity_words; ++w)
      v[b * velocity_words + static_cast<std::size_t>(w)] = static_cast<R>(words[w]);
  }
  for (const std::int32_t i : fixed) {
    const auto first = v.begin() + static_cast<std::ptrdiff_t>(layout.body_of(i)) * velocity_words;
    std::fill(first, first + velocity_words, R(0));
  }
}

/// Writes displacements and rotations of all particles, and the displacements of walls at step −1, into `u`, [body][8].
inline void put_start(const Layout& layout, const StartState& start, const Boundary& boundary, std::vector<double>& u) {
  for (std::size_t b = 0; b < layout.particles(); ++b) {
    const auto i = static_cast<std::size_t>(layout.particle[b]);
    const Vec3d &at = start.displacement[i], &turn = start.rotation[i];
    const double words[displacement_words] = {at.x, at.y, at.z, 0, turn.x, turn.y, turn.z, 0};
    std::copy(words, words + displacement_words, &u[b * displacement_words]);
  }
  for (std::size_t w = 0; w < wall_count; ++w) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const WallAxis& a = boundary.wall[w].axis[axis];
      if (a.by == DrivenBy::displacement) u[(layout.particles() + w) * displacement_words + axis] = a.drive->value(-1);
    }
  }
}

}  // namespace macadam::kernels
