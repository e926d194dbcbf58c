// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_rows.hpp  K*(ω) without a matrix: every particle adds up the loads of its own contacts.
#pragma once

#include <vector>

#include "host/harmonic/contact_operator.hpp"
#include "host/harmonic/iterative/lanes.hpp"
#include "kernels/layout.hpp"

namespace macadam::harmonic {

/// A contact as one of its ends sees it: the normal points away from it. Each contact is computed by both ends, which
/// costs less than to sort out who adds where, and gives the same bits for any number of threads.
struct ContactEnd {
  double n[3], s[3];  ///< t = n × s
  double arm, arm_other;
  double moments[6];   ///< over the distance [m] [m²] [m³]
  std::int32_t other;  ///< body of the other end; `wall_at_rest` for walls
  std::int32_t pair;
};
inline constexpr std::int32_t wall_at_rest = -1;

/// Bodies in the order of a layout.
class ContactRows {
 public:
  ContactRows(const ContactNetwork& network, const kernels::Layout& layout);

  std::size_t bodies() const { return begin_.size() - 1; }
  const ContactEnd* begin(std::size_t body) const { return ends_.data() + begin_[body]; }
  const ContactEnd* end(std::size_t body) const { return ends_.data() + begin_[body + 1]; }

 private:
  std::vector<std::size_t> begin_;
  std::vector<ContactEnd> ends_;
};

/// Stiffness of each pair at F frequencies, and the inertia that is taken off: ω²·scaling − iωβ·scaling.
template <int F>
struct BlockStiffness {
  std::array<Factor<F>, pair_types> k{};
  std::array<double, pair_types> alpha{};
  Factor<F> inertia{};
  bool inert = true;  ///< no inertia at any frequency
};

/// (K* − inertia·M)·x of one body; `mass` has its six entries of M.
template <int F>
void apply_row(const ContactRows& rows, const BlockStiffness<F>& stiffness, const double* mass, std::size_t body,
               const LaneVector<F>& x, Lanes<F> (&out)[6]);

extern template void apply_row<1>(const ContactRows&, const BlockStiffness<1>&, const double*, std::size_t,
                                  const LaneVector<1>&, Lanes<1> (&)[6]);
extern template void apply_row<4>(const ContactRows&, const BlockStiffness<4>&, const double*, std::size_t,
                                  const LaneVector<4>&, Lanes<4> (&)[6]);

}  // namespace macadam::harmonic
