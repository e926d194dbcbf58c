// SPDX-License-Identifier: GPL-3.0-or-later
// apply_row.cpp  Applies the contact kinematics of kernels/ to SIMD registers, each of which holds one number of every
// solution.
#include "host/harmonic/iterative/apply_row.hpp"

#include "kernels/harmonic/particle_block.hpp"

namespace macadam::harmonic {

using kernels::ContactEnd;
using kernels::Twist;

namespace {

/// Centroid of a facet with respect to the centre of a body, along n, s and t of a contact end [m].
struct FacetCentroid {
  double n, s, t;
};
FacetCentroid centroid_of(const ContactEnd& e) {
  return {e.arm, e.moments[1] / e.moments[0], e.moments[2] / e.moments[0]};
}

/// Computes the six relative displacements of a contact seen from a body that moves by `own`.
template <int F>
void displacements(const ContactEnd& e, const Twist<Lanes<F>>& own, const LaneVector<F>& x, Lanes<F> (&u)[6]) {
  kernels::relative_rates(
      kernels::frame_of<Lanes<F>>(e), own,
      e.other >= 0 ? kernels::to_twist(&x[6 * static_cast<std::size_t>(e.other)]) : Twist<Lanes<F>>{}, u);
}

/// Returns the load of a contact on a body that moves by `own`, where pressures act on the contact like additional
/// displacements.
template <int F, class Times>
Twist<Lanes<F>> load_with_pressure(const ContactEnd& e, const Twist<Lanes<F>>& own, const LaneVector<F>& x,
                                   Lanes<F> own_pressure, const LaneVector<F>& pressures, Times&& times, double alpha) {
  using T = Lanes<F>;
  T u[6];
  displacements<F>(e, own, x, u);
  const FacetCentroid lever = centroid_of(e);
  const T other = e.other >= 0 ? pressures[static_cast<std::size_t>(e.other)] : T(), along = own_pressure - other;
  u[0] += lever.n * own_pressure + e.arm_other * other;
  u[3] += lever.s * along, u[4] += lever.t * along;
  return kernels::load_on_end(e, u, times, T(alpha));
}

}  // namespace

template <int F>
Lanes<F> pressure_of(const kernels::LinearSystem& system, const BlockStiffness<F>& stiffness, std::size_t body,
                     const LaneVector<F>& x) {
  using T = Lanes<F>;
  const CellStiffness& cell = system.cells[body];
  const Twist<T> own = kernels::to_twist(&x[6 * body]);
  T sum;
  for (std::size_t i = system.row_begin[body]; i < system.row_begin[body + 1]; ++i) {
    const ContactEnd& e = system.ends[i];
    const auto pair = static_cast<std::size_t>(e.pair);
    const double alpha = stiffness.alpha[pair], series = system.series_of(i);
    const Factor<F> normal = in_series(stiffness.k[pair], T(series)),
                    shear = in_series(stiffness.k[pair], T(alpha * series));
    T u[6];
    displacements<F>(e, own, x, u);
    const auto load = kernels::spring_load(
        e, u, [&](T v, bool in_shear) { return in_shear ? shear(v) : normal(v); }, T(alpha));
    const FacetCentroid lever = centroid_of(e);
    sum += lever.n * load.n + lever.s * load.s + lever.t * load.t;
  }
  return cell.weight * stiffness.compliance[static_cast<std::size_t>(cell.law)](sum);
}

template <int F>
void apply_row(const kernels::LinearSystem& system, const BlockStiffness<F>& stiffness, std::size_t body,
               const LaneVector<F>& x, const LaneVector<F>& pressures, Lanes<F> (&out)[6]) {
  using T = Lanes<F>;
  const Twist<T> own = kernels::to_twist(&x[6 * body]);
  Twist<T> sum;
  for (std::size_t i = system.row_begin[body]; i < system.row_begin[body + 1]; ++i) {
    const ContactEnd& e = system.ends[i];
    const auto pair = static_cast<std::size_t>(e.pair);
    const double alpha = stiffness.alpha[pair];
    const auto load_by = [&](const Factor<F>& normal, const Factor<F>& shear) {
      const auto times = [&](T u, bool in_shear) { return in_shear ? shear(u) : normal(u); };
      if (!system.cells.empty()) return load_with_pressure<F>(e, own, x, pressures[body], pressures, times, alpha);
      return kernels::end_load(e, own,
                               e.other >= 0 ? kernels::to_twist(&x[6 * static_cast<std::size_t>(e.other)]) : Twist<T>{},
                               times, T(alpha));
    };
    const Factor<F>& k = stiffness.k[pair];
    const double series = system.series_of(i);
    const Twist<T> load =
        series == 0 ? load_by(k, k) : load_by(in_series(k, T(series)), in_series(k, T(alpha * series)));
    sum.linear += load.linear;
    sum.angular += load.angular;
  }
  T load[6];
  kernels::to_array(sum, load);
  for (std::size_t c = 0; c < 6; ++c) {
    out[c] = -load[c];  // the load that holds the motion is opposite to the load that the contacts exert
    if (!stiffness.inert) out[c] -= system.mass[2 * body + c / 3] * stiffness.inertia(x[6 * body + c]);
  }
}

template Lanes<1> pressure_of<1>(const kernels::LinearSystem&, const BlockStiffness<1>&, std::size_t,
                                 const LaneVector<1>&);
template Lanes<4> pressure_of<4>(const kernels::LinearSystem&, const BlockStiffness<4>&, std::size_t,
                                 const LaneVector<4>&);
template void apply_row<1>(const kernels::LinearSystem&, const BlockStiffness<1>&, std::size_t, const LaneVector<1>&,
                           const LaneVector<1>&, Lanes<1> (&)[6]);
template void apply_row<4>(const kernels::LinearSystem&, const BlockStiffness<4>&, std::size_t, const LaneVector<4>&,
                           const LaneVector<4>&, Lanes<4> (&)[6]);

}  // namespace macadam::harmonic
