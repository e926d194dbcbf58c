// SPDX-License-Identifier: GPL-3.0-or-later
/// \file group_lanes.hpp  Gathers frame, area moments and largest load of a group of contacts in SIMD registers. In a
/// group of four contacts, each lane has one contact. In a group of one contact, all lanes have the same contact.
#pragma once

#include <cmath>

#include "host/harmonic/particle_contacts.hpp"
#include "kernels/contact/contact_kinematics.hpp"

namespace macadam::harmonic {

/// Returns a property `of(f)` of the N contacts of a group.
template <int N, class Of>
MACADAM_HD FourNumbers of_contact(Of&& of) {
  static_assert(N == at_once || N == 1);
  if constexpr (N == at_once)
    return real_lanes(of);
  else
    return FourNumbers(of(0));
}

/// Returns the frames of the contacts, seen from the particle.
template <int N>
MACADAM_HD kernels::Placement<FourNumbers> frame_of(const ContactGroup<N>& g) {
  const auto at = [&g](int f) -> const Contact& { return *g.contact[f]; };
  return {{of_contact<N>([&](int f) { return g.sign[f] * at(f).n.x; }),
           of_contact<N>([&](int f) { return g.sign[f] * at(f).n.y; }),
           of_contact<N>([&](int f) { return g.sign[f] * at(f).n.z; })},
          {of_contact<N>([&](int f) { return at(f).s.x; }), of_contact<N>([&](int f) { return at(f).s.y; }),
           of_contact<N>([&](int f) { return at(f).s.z; })},
          {of_contact<N>([&](int f) { return g.sign[f] * at(f).t.x; }),
           of_contact<N>([&](int f) { return g.sign[f] * at(f).t.y; }),
           of_contact<N>([&](int f) { return g.sign[f] * at(f).t.z; })},
          of_contact<N>([&](int f) { return g.own_arm[f]; }),
          of_contact<N>([&](int f) { return g.far_arm[f]; })};
}

/// Computes the area moments of the contacts over their lengths, seen from the particle, in the order of
/// kernels::condensed_load().
template <int N>
MACADAM_HD void moments_over_length(const ContactGroup<N>& g, FourNumbers (&m)[6]) {
  const FourNumbers over_d = of_contact<N>([&](int f) { return g.over_d[f]; }),
                    turned = of_contact<N>([&](int f) { return g.sign[f]; }) * over_d;
  const auto moment = [&](double AreaMoments::*which) {
    return of_contact<N>([&](int f) { return g.contact[f]->moments.*which; });
  };
  m[0] = moment(&AreaMoments::a) * over_d, m[1] = moment(&AreaMoments::s) * over_d;
  m[2] = moment(&AreaMoments::t) * turned, m[3] = moment(&AreaMoments::ss) * over_d;
  m[4] = moment(&AreaMoments::st) * turned, m[5] = moment(&AreaMoments::tt) * over_d;
}

/// Force and moment on a particle, without directions.
struct LoadSizes {
  FourNumbers force, moment;
};

/// Returns the loads of the contacts for the worst case, in which the motions of the two ends do not cancel: the
/// magnitudes of the motions are added. `k`: stiffness in opening; `own`, `other`: motions of the two ends.
template <int N>
MACADAM_HD LoadSizes largest_load(const ContactGroup<N>& g, const Factor<at_once>& k,
                                  const kernels::Twist<FourNumbers>& own, const kernels::Twist<FourNumbers>& other) {
  const auto three = [](const Vec3<FourNumbers>& v) { return size_of(v.x) + size_of(v.y) + size_of(v.z); };
  const auto moments = [&g](int f) -> const AreaMoments& { return g.contact[f]->moments; };
  const FourNumbers own_arm = of_contact<N>([&](int f) { return std::abs(g.own_arm[f]); });
  const FourNumbers far_arm = of_contact<N>([&](int f) { return std::abs(g.far_arm[f]); });
  // the motion of a wall is exact
  const FourNumbers moves = of_contact<N>([&](int f) { return g.far[f] < 0 ? 0.0 : 1.0; });
  const FourNumbers area = of_contact<N>([&](int f) { return moments(f).a * g.over_d[f]; });
  const FourNumbers second = of_contact<N>([&](int f) { return (moments(f).ss + moments(f).tt) * g.over_d[f]; });
  const FourNumbers stiff = real_lanes([&](int f) { return std::abs(k.real.v[f]) + std::abs(k.imaginary.v[f]); });
  const FourNumbers turns = three(own.angular) + moves * three(other.angular);
  const FourNumbers force = area * stiff *
                            (three(own.linear) + own_arm * three(own.angular) +
                             moves * (three(other.linear) + far_arm * three(other.angular)));
  return {force, second * stiff * turns + own_arm * force};
}

}  // namespace macadam::harmonic
