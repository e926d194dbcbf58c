// SPDX-License-Identifier: GPL-3.0-or-later
// contact_rows.cpp  The kernels' kinematics on registers of frequencies.
#include "host/harmonic/iterative/contact_rows.hpp"

#include "kernels/contact_kinematics.hpp"

namespace macadam::harmonic {

using kernels::Placement;
using kernels::Twist;

namespace {

ContactEnd seen_from_a(const Contact& c, const kernels::Layout& layout) {
  const double d = c.distance;
  const AreaMoments& m = c.moments;
  return {{c.n.x, c.n.y, c.n.z},
          {c.s.x, c.s.y, c.s.z},
          c.arm_a,
          c.arm_b,
          {m.a / d, m.s / d, m.t / d, m.ss / d, m.st / d, m.tt / d},
          c.b >= 0 ? layout.body_of(c.b) : wall_at_rest,
          static_cast<std::int32_t>(c.pair)};
}

/// The frame (−n, s, −t): local coordinates t change their sign.
ContactEnd seen_from_b(const Contact& c, const kernels::Layout& layout) {
  ContactEnd e = seen_from_a(c, layout);
  for (double& x : e.n) x = -x;
  std::swap(e.arm, e.arm_other);
  e.moments[2] = -e.moments[2];
  e.moments[4] = -e.moments[4];
  e.other = layout.body_of(c.a);
  return e;
}

}  // namespace

ContactRows::ContactRows(const ContactNetwork& network, const kernels::Layout& layout)
    : begin_(layout.particles() + 1, 0) {
  for (std::size_t body = 0; body < layout.particles(); ++body) {
    begin_[body + 1] = begin_[body] + network.row(static_cast<std::size_t>(layout.particle[body])).size();
  }
  ends_.resize(begin_.back());
#pragma omp parallel for schedule(static)
  for (std::size_t body = 0; body < layout.particles(); ++body) {
    const std::int32_t particle = layout.particle[body];
    ContactEnd* to = ends_.data() + begin_[body];
    for (const std::uint32_t number : network.row(static_cast<std::size_t>(particle))) {
      const Contact& c = network.contacts[number];
      *to++ = c.a == particle ? seen_from_a(c, layout) : seen_from_b(c, layout);
    }
  }
}

template <int F>
void apply_row(const ContactRows& rows, const BlockStiffness<F>& stiffness, const double* mass, std::size_t body,
               const LaneVector<F>& x, Lanes<F> (&out)[6]) {
  using T = Lanes<F>;
  const auto wide = [](const double(&v)[3]) { return Vec3<T>{T(v[0]), T(v[1]), T(v[2])}; };
  const auto twist = [&](std::size_t i) -> Twist<T> {
    const T* p = &x[6 * i];
    return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}};
  };
  const Twist<T> own = twist(body);
  Vec3<T> force, moment;
  for (const ContactEnd *e = rows.begin(body), *end = rows.end(body); e != end; ++e) {
    const Vec3<double> n{e->n[0], e->n[1], e->n[2]}, s{e->s[0], e->s[1], e->s[2]}, t = cross(n, s);
    const double across[3] = {t.x, t.y, t.z};
    const Placement<T> frame{wide(e->n), wide(e->s), wide(across), T(e->arm), T(e->arm_other)};
    T u[6], m[6];
    kernels::relative_rates(frame, own, e->other >= 0 ? twist(static_cast<std::size_t>(e->other)) : Twist<T>{}, u);
    for (int c = 0; c < 6; ++c) {
      u[c] = stiffness.k[static_cast<std::size_t>(e->pair)](u[c]);
      m[c] = T(e->moments[c]);
    }
    const auto load = kernels::to_centres(
        frame, kernels::condensed_load(u, T(stiffness.alpha[static_cast<std::size_t>(e->pair)]), m));
    force += load.force_a;
    moment += load.moment_a;
  }
  const T sum[6] = {force.x, force.y, force.z, moment.x, moment.y, moment.z};
  for (int c = 0; c < 6; ++c) {
    out[c] = -sum[c];  // the load that holds the motion is opposite to what contacts exert
    if (!stiffness.inert) out[c] -= mass[c] * stiffness.inertia(x[6 * body + static_cast<std::size_t>(c)]);
  }
}

template void apply_row<1>(const ContactRows&, const BlockStiffness<1>&, const double*, std::size_t,
                           const LaneVector<1>&, Lanes<1> (&)[6]);
template void apply_row<4>(const ContactRows&, const BlockStiffness<4>&, const double*, std::size_t,
                           const LaneVector<4>&, Lanes<4> (&)[6]);

}  // namespace macadam::harmonic
