// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_end.hpp  Stores a contact as seen from one of its ends, and computes the load that it puts on that
/// end.
///
/// Each contact is computed for both ends separately. So each thread adds only to its own particles. This costs less
/// than synchronising threads, and gives the same bits for any number of threads.
#pragma once

#include <cstdint>

#include "kernels/contact/contact_kinematics.hpp"

namespace macadam::kernels {

/// Data of one contact end. The size is 128 bytes, that is, two cache lines of 64 bytes if the array begins at the
/// beginning of a cache line. The normal points away from this end.
struct alignas(16) ContactEnd {
  double n[3], s[3];  ///< t = n × s
  double arm, arm_other;
  double moments[6];   ///< moments over the distance [m] [m²] [m³]
  std::int32_t other;  ///< body of the other end; `wall_at_rest` for walls
  std::int32_t pair;
};
inline constexpr std::int32_t wall_at_rest = -1;

/// Returns the stiffness of a law in series with a spring of compliance `series`: 1/(1/k + series). K is a real or a
/// complex number.
template <class K>
MACADAM_HD K in_series(const K& k, double series) {
  return series == 0 ? k : k / (1.0 + series * k);
}

/// Frame of a contact seen from one of its ends.
template <class T>
MACADAM_HD Placement<T> frame_of(const ContactEnd& e) {
  const Vec3<double> n{e.n[0], e.n[1], e.n[2]}, s{e.s[0], e.s[1], e.s[2]}, t = cross(n, s);
  return {{T(n.x), T(n.y), T(n.z)}, {T(s.x), T(s.y), T(s.z)}, {T(t.x), T(t.y), T(t.z)}, T(e.arm), T(e.arm_other)};
}

/// Returns the load that a contact's springs transmit to this end, about x0, at the relative displacements `u`. `times`
/// and `alpha` are as in end_load().
template <class T, class Times>
MACADAM_HD FacetLoad<T> spring_load(const ContactEnd& e, const T (&u)[6], Times&& times, T alpha) {
  T density[6], m[6];
  for (int c = 0; c < 6; ++c) {
    density[c] = times(u[c], c >= 3);
    m[c] = T(e.moments[c]);
  }
  return condensed_load(density, alpha, m);
}

/// Returns force and moment on this end at the relative displacements `u`.
template <class T, class Times>
MACADAM_HD Twist<T> load_on_end(const ContactEnd& e, const T (&u)[6], Times&& times, T alpha) {
  const ContactLoad<T> load = to_centres(frame_of<T>(e), spring_load(e, u, times, alpha));
  return {load.force_a, load.moment_a};
}

/// Returns force and moment on this end if the two ends move by `own` and `other`. T holds one or several real numbers
/// per component; `times(u, shear)` multiplies them by k*(s) of the contact, in shear (slip and twist) without α.
template <class T, class Times>
MACADAM_HD Twist<T> end_load(const ContactEnd& e, const Twist<T>& own, const Twist<T>& other, Times&& times, T alpha) {
  T u[6];
  relative_rates(frame_of<T>(e), own, other, u);
  return load_on_end(e, u, times, alpha);
}

}  // namespace macadam::kernels
