// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_kinematics.hpp  Converts the motion of two bodies to the six relative rates of a facet, and the forces
/// of the facet to loads on the bodies: docs/model.md, sections 5, 7 and 8.
///
/// T is a scalar (one contact) or a SIMD pack (one contact per lane). A point of the facet is at x0 + s·ŝ + t·t̂. From
/// centre A it is at arm_a·n + s·ŝ + t·t̂, from centre B at −arm_b·n + s·ŝ + t·t̂. Model (5.3):
///   opening  u[0] + s·u[1] + t·u[2],   slip along ŝ  u[3] − t·u[5],   slip along t̂  u[4] + s·u[5].
#pragma once

#include <type_traits>

#include "macadam/numeric.hpp"

namespace macadam::kernels {

/// Velocity and spin of a body, or force and moment on it.
template <class T>
struct Twist {
  Vec3<T> linear, angular;
};

/// Frame of a facet and the lever arms from the centres to its reference point x0.
template <class T>
struct Placement {
  Vec3<T> n, s, t;
  T arm_a, arm_b;
};

/// Returns 1/x for 1 ≤ |x| ≤ 2. On a GPU this is faster than a division, which must also handle very small and very
/// large numbers.
template <class T>
MACADAM_HD T reciprocal_near_one(const T& x) {
#ifdef __CUDA_ARCH__
  if constexpr (std::is_same_v<T, float>) {
    float r;
    asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(r) : "f"(x));
    return fmaf(r, fmaf(-x, r, 1.0f), r);
  }
#endif
  return T(1) / x;
}

/// Returns the canonical frame of a unit normal (Duff et al. 2017); `sign` is copysign(1, n.z).
template <class T>
MACADAM_HD Placement<T> canonical_placement(const Vec3<T>& n, const T& sign, const T& arm_a, const T& arm_b) {
  const T a = -reciprocal_near_one(sign + n.z);
  const T b = n.x * n.y * a;
  return {n, {T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, arm_a, arm_b};
}

/// Computes the six relative rates u[0…5] of B with respect to A, opening positive [m/s, 1/s, 1/s, m/s, m/s, 1/s].
template <class T>
MACADAM_HD void relative_rates(const Placement<T>& f, const Twist<T>& a, const Twist<T>& b, T (&u)[6]) {
  const Vec3<T> v = b.linear - a.linear;
  const Vec3<T> w = b.angular - a.angular;
  const Vec3<T> q = multiply_add(f.arm_b, b.angular, f.arm_a * a.angular);
  u[0] = dot(v, f.n);
  u[1] = -dot(w, f.t);
  u[2] = dot(w, f.s);
  u[3] = dot(v, f.s) - dot(q, f.t);
  u[4] = dot(v, f.t) + dot(q, f.s);
  u[5] = dot(w, f.n);
}

/// The load that a facet transmits: force along (n, s, t) and moment about x0 along (n, s, t), both acting on A.
template <class T>
struct FacetLoad {
  T n{}, s{}, t{};
  T moment_n{}, moment_s{}, moment_t{};
};

/// Returns the load of a facet by equations (7.1) and (7.2) of the model. d is the contact's length (Contact::length).
/// f[c] are the six force densities: f[c]/d is a force per unit of area. m are the area moments divided by d.
template <class T>
MACADAM_HD FacetLoad<T> condensed_load(const T (&f)[6], const T& alpha, const T (&m)[6]) {
  const T slip_s = alpha * f[3], slip_t = alpha * f[4], twist = alpha * f[5];
  FacetLoad<T> load;
  const Vec3<T> normal{f[0], f[1], f[2]};
  load.n = dot(normal, Vec3<T>{m[0], m[1], m[2]});
  load.moment_t = -dot(normal, Vec3<T>{m[1], m[3], m[4]});
  load.moment_s = dot(normal, Vec3<T>{m[2], m[4], m[5]});
  load.s = multiply_add(slip_s, m[0], -(twist * m[2]));
  load.t = multiply_add(slip_t, m[0], twist * m[1]);
  load.moment_n = dot(Vec3<T>{twist, slip_t, -slip_s}, Vec3<T>{m[3] + m[5], m[1], m[2]});
  return load;
}

/// Loads of a contact on its two bodies by model (8.2): the force on A (the force on B is opposite), and the moments
/// about the two centres.
template <class T>
struct ContactLoad {
  Vec3<T> force_a, moment_a, moment_b;
};

/// Moves the load of a facet from x0 to the two centres, model (8.2).
template <class T>
MACADAM_HD ContactLoad<T> to_centres(const Placement<T>& f, const FacetLoad<T>& load) {
  const auto seen = [&f](const T& n, const T& s, const T& t) {
    return multiply_add(t, f.t, multiply_add(s, f.s, n * f.n));
  };
  const Vec3<T> m0 = seen(load.moment_n, load.moment_s, load.moment_t);
  const Vec3<T> lever = multiply_add(load.s, f.t, -(load.t * f.s));  // n × force
  return {seen(load.n, load.s, load.t), multiply_add(f.arm_a, lever, m0), multiply_add(f.arm_b, lever, -m0)};
}

}  // namespace macadam::kernels
