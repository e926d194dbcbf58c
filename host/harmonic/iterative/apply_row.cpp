// SPDX-License-Identifier: GPL-3.0-or-later
// apply_row.cpp  Applies the contact kinematics of kernels/ to SIMD registers, each of which holds one number of every
// solution.
#include "host/harmonic/iterative/apply_row.hpp"

#include "kernels/harmonic/particle_block.hpp"

namespace macadam::harmonic {

using kernels::ContactEnd;
using kernels::Twist;

template <int F>
void apply_row(const kernels::LinearSystem& system, const BlockStiffness<F>& stiffness, std::size_t body,
               const LaneVector<F>& x, Lanes<F> (&out)[6]) {
  using T = Lanes<F>;
  const Twist<T> own = kernels::to_twist(&x[6 * body]);
  Twist<T> sum;
  for (std::size_t i = system.row_begin[body]; i < system.row_begin[body + 1]; ++i) {
    const ContactEnd& e = system.ends[i];
    const auto pair = static_cast<std::size_t>(e.pair);
    const double alpha = stiffness.alpha[pair];
    const auto load_by = [&](const Factor<F>& normal, const Factor<F>& shear) {
      return kernels::end_load(
          e, own, e.other >= 0 ? kernels::to_twist(&x[6 * static_cast<std::size_t>(e.other)]) : Twist<T>{},
          [&](T u, bool in_shear) { return in_shear ? shear(u) : normal(u); }, T(alpha));
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

template void apply_row<1>(const kernels::LinearSystem&, const BlockStiffness<1>&, std::size_t, const LaneVector<1>&,
                           Lanes<1> (&)[6]);
template void apply_row<4>(const kernels::LinearSystem&, const BlockStiffness<4>&, std::size_t, const LaneVector<4>&,
                           Lanes<4> (&)[6]);

}  // namespace macadam::harmonic
