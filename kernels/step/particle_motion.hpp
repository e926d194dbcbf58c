// SPDX-License-Identifier: GPL-3.0-or-later
/// \file particle_motion.hpp  Moves one body over one step, Eq. 1–2 (docs/model.md, section 10): damping, leapfrog,
/// displacement.
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/contact/contact_step.hpp"
#include "macadam/backend.hpp"
#include "kernels/step/wall_motion.hpp"

namespace macadam::kernels {

/// Arrays of the bodies; the walls are last. Contacts read `velocity`, in precision Geometry. The step integrates
/// `master`, in precision Particle. If the precisions are the same, the two pointers refer to one array.
template <class P>
struct BodyView {
  typename P::Geometry* velocity;  ///< [body][8] v [m/s], ω [rad/s]
  typename P::Particle* master;    ///< [body][8] v [m/s], ω [rad/s]
  double* displacement;            ///< [body][8] u [m], θ [rad]
  /// [body][2] Δt/m [s/kg], Δt/I [s/(kg·m²)]; 0 for bodies that forces do not move.
  const typename P::Particle* inverse;
  const typename P::Particle* weight;  ///< [particle][4] body force [N]; null: none
  std::int32_t particles;
};

/// Moves one body by one step.
template <class P>
struct ParticleMotion {
  using R = typename P::Particle;
  BodyView<P> body;
  Damping damping;
  R chi;  ///< local damping; 0: none
  /// Factors of v and of the force in viscous damping, model (10.1): (1 − βΔt/2)/(1 + βΔt/2) and 1/(1 + βΔt/2). Both
  /// are 1 without viscous damping.
  R damping_factor, force_factor;
  double dt;  ///< [s]
  WallMotion<R> wall;

  /// Moves body i: for a particle v ← v + Δt·(F + F_d)/m, u ← u + Δt·v, and likewise its spin and rotation; a wall
  /// moves as row k of its table prescribes.
  MACADAM_HD void operator()(std::int32_t i, const Twist<R>& force, std::int64_t k) const {
    const R f[6] = {force.linear.x, force.linear.y, force.linear.z, force.angular.x, force.angular.y, force.angular.z};
    const bool particle = i < body.particles;
    const R by_mass = body.inverse[2 * i], by_inertia = body.inverse[2 * i + 1];
    const R* weight = particle && body.weight ? body.weight + static_cast<std::size_t>(i) * 4 : nullptr;
    for (int c = 0; c < (particle ? 6 : 3); ++c) {
      const std::size_t at = place(i, c < 3 ? c : c + 1);
      if (particle)
        set(at, moved(body.master[at], weight && c < 3 ? f[c] + weight[c] : f[c], c < 3 ? by_mass : by_inertia));
      else
        set(at, of_wall<true>(i, c, body.master[at], f[c], k));
    }
  }

  /// Moves one word of body i: word w of [v, –, ω, –], under word w of [force, –, moment, –]. Each word has its own
  /// thread. `has_external_loads`: there are body forces, or walls driven by forces.
  template <bool has_external_loads>
  MACADAM_HD void word(std::int32_t i, int w, R force, std::int64_t k) const {
    const std::size_t at = place(i, w);
    if (i < body.particles) {
      if (has_external_loads && body.weight && w < 3)
        force += body.weight[static_cast<std::size_t>(i) * 4 + std::size_t(w)];
      set(at, moved(body.master[at], force, body.inverse[2 * i + w / 4]));
    } else if (w < 3) {
      set(at, of_wall<has_external_loads>(i, w, body.master[at], force, k));
    }
  }

  /// Sets word `at` of the velocities to v, and moves the displacement by Δt·v.
  MACADAM_HD void set(std::size_t at, R v) const {
    if constexpr (!std::is_same_v<typename P::Geometry, R>) body.velocity[at] = static_cast<typename P::Geometry>(v);
    displace(at, v);
  }
  /// Sets word `at` of the integrated velocities to v, and moves the displacement by Δt·v.
  MACADAM_HD void displace(std::size_t at, R v) const {
    body.master[at] = v;
    if (at % 4 != 3) body.displacement[at] = multiply_add(dt, double(v), body.displacement[at]);
  }
  /// Returns the index of word w of body i in the arrays of velocities and of displacements.
  MACADAM_HD static std::size_t place(std::int32_t i, int w) {
    static_assert(velocity_words == displacement_words);
    return static_cast<std::size_t>(i) * velocity_words + static_cast<std::size_t>(w);
  }

  /// Returns the velocity of a wall along an axis after step k. `force`: exerted by the particles on it.
  template <bool has_external_loads>
  MACADAM_HD R of_wall(std::int32_t i, int axis, R v, R force, std::int64_t k) const {
    const int number = i - body.particles;
    if (!wall.moves(number)) return v;
    const R given = wall.row(number, k)[axis];
    return has_external_loads && wall.loaded(3 * number + axis) ? moved(v, force + given, body.inverse[2 * i]) : given;
  }

#ifdef __CUDA_ARCH__
  static constexpr bool on_device = true;
#else
  static constexpr bool on_device = false;
#endif
  /// Returns the velocity half a step after the time of the force f. `v` is the velocity half a step before that time.
  /// Includes damping.
  MACADAM_HD R moved(R v, R f, R inverse) const {
    if (on_device || damping == Damping::local) {  // on a GPU, computing with χ = 0 costs less than a branch
      const R against = v == 0 ? R(0) : std::copysign(chi, -v);  // F_d = −χ·|F|·sign(v)
      f = multiply_add(against, f < 0 ? -f : f, f);
    }
    return multiply_add(damping_factor, v, force_factor * inverse * f);
  }
};

}  // namespace macadam::kernels
