// SPDX-License-Identifier: GPL-3.0-or-later
/// \file particle_motion.hpp  Eq. 1–2 of one body (docs/model.md, section 10): damping, leapfrog, displacement.
#pragma once

#include <cstdint>

#include "kernels/contact_forces.hpp"
#include "macadam/backend.hpp"
#include "kernels/wall_motion.hpp"

namespace macadam::kernels {

/// Arrays of the bodies; walls last. `velocity` is what contacts gather (Geometry precision), `master` what is
/// integrated (Particle precision); the two are one array where the precisions are the same.
template <class P>
struct BodyView {
  typename P::Geometry* velocity;       ///< [body][8] v [m/s], ω [rad/s]
  typename P::Particle* master;         ///< [body][8] likewise
  double* displacement;                 ///< [body][8] u [m], θ [rad]
  const typename P::Particle* inverse;  ///< [body][2] Δt/m [s/kg], Δt/I [s/(kg·m²)]; 0 for what no force moves
  const typename P::Particle* weight;   ///< [particle][4] body force [N]; null: none
  std::int32_t particles;
};

/// Moves one body by one step.
template <class P>
struct ParticleMotion {
  using R = typename P::Particle;
  BodyView<P> body;
  Damping damping;
  R chi;         ///< local damping
  R keep, gain;  ///< of viscous damping, model (10.1): (1 − βΔt/2)/(1 + βΔt/2) and 1/(1 + βΔt/2); 1 and 1 without
  double dt;     ///< [s]
  WallMotion wall;

  /// v ← v + Δt·(F + F_d)/m, u ← u + Δt·v for a particle, likewise its spin and rotation; walls do what row k of their
  /// table says.
  MACADAM_HD void operator()(std::int32_t i, Twist<R> force, std::int64_t k) const {
    R* v = body.master + static_cast<std::size_t>(i) * velocity_words;
    double* u = body.displacement + static_cast<std::size_t>(i) * displacement_words;
    if (i < body.particles) {
      const R by_mass = body.inverse[2 * i], by_inertia = body.inverse[2 * i + 1];
      if (body.weight) {
        const R* w = body.weight + static_cast<std::size_t>(i) * 4;
        force.linear += Vec3<R>{w[0], w[1], w[2]};
      }
      v[0] = moved(v[0], force.linear.x, by_mass);
      v[1] = moved(v[1], force.linear.y, by_mass);
      v[2] = moved(v[2], force.linear.z, by_mass);
      v[4] = moved(v[4], force.angular.x, by_inertia);
      v[5] = moved(v[5], force.angular.y, by_inertia);
      v[6] = moved(v[6], force.angular.z, by_inertia);
    } else {
      const R sum[3] = {force.linear.x, force.linear.y, force.linear.z};
      for (int axis = 0; axis < 3; ++axis) v[axis] = of_wall(i, axis, v[axis], sum[axis], k);
    }
    for (const int w : {0, 1, 2, 4, 5, 6}) u[w] += dt * v[w];
    if constexpr (!std::is_same_v<typename P::Geometry, R>) {
      for (int w = 0; w < velocity_words; ++w) {
        body.velocity[static_cast<std::size_t>(i) * velocity_words + static_cast<std::size_t>(w)] =
            static_cast<typename P::Geometry>(v[w]);
      }
    }
  }

  /// The same for word w of [v, –, ω, –] alone, with word w of force and moment: a thread a word. `pushed`: there are
  /// body forces, or walls under forces.
  template <bool pushed>
  MACADAM_HD void word(std::int32_t i, int w, R force, std::int64_t k) const {
    const auto at = static_cast<std::size_t>(i) * velocity_words + static_cast<std::size_t>(w);
    R v = body.master[at];
    if (i < body.particles) {
      if (pushed && body.weight && w < 3)
        force += body.weight[static_cast<std::size_t>(i) * 4 + static_cast<std::size_t>(w)];
      v = moved(v, force, body.inverse[2 * i + w / 4]);
    } else if (w < 3) {
      v = of_wall<pushed>(i, w, v, force, k);
    }
    body.master[at] = v;
    if constexpr (!std::is_same_v<typename P::Geometry, R>) body.velocity[at] = static_cast<typename P::Geometry>(v);
    if (w % 4 != 3) {
      body.displacement[static_cast<std::size_t>(i) * displacement_words + static_cast<std::size_t>(w)] += dt * v;
    }
  }

  /// Velocity of a wall along an axis; `force`: of the particles on it.
  template <bool pushed = true>
  MACADAM_HD R of_wall(std::int32_t i, int axis, R v, R force, std::int64_t k) const {
    const int number = i - body.particles;
    if (!wall.moves(number)) return v;
    const R given = static_cast<R>(wall.at(number, axis, k));
    return pushed && wall.loaded(number, axis) ? moved(v, force + given, body.inverse[2 * i]) : given;
  }

  /// v half a step later.
  MACADAM_HD R moved(R v, R f, R inverse) const {
    if (damping == Damping::local) {
      const R drag = chi * (f < 0 ? -f : f);  // F_d = −χ·|F|·sign(v)
      f -= v > 0 ? drag : v < 0 ? -drag : R(0);
    }
    return keep * v + gain * inverse * f;
  }
};

}  // namespace macadam::kernels
