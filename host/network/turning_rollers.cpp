// SPDX-License-Identifier: GPL-3.0-or-later
// turning_rollers.cpp  Moves the points of contacts with rollers to the middles of the rollers.
#include "host/network/turning_rollers.hpp"

#include <algorithm>
#include <cmath>

namespace macadam {

void let_rollers_turn(const Specimen& specimen, ContactNetwork& network) {
  const domains::Rollers* rollers = specimen.box.rollers();
  if (!rollers || !rollers->turn) return;
  for (Contact& c : network.contacts) {
    if (c.b != wall_z_lo && c.b != wall_z_hi) continue;
    if (c.s.x != 1) continue;  // on the crown of a half disc; on a flat wall s is along x
    const double centre = specimen.centre[c.a].x, centroid = centre + c.moments.s / c.moments.a;
    const std::vector<double>& middles = rollers->on(static_cast<int>(wall_index(c.b)));
    const double middle =
        *std::ranges::min_element(middles, {}, [centroid](double x) { return std::abs(x - centroid); });
    const double s = middle - centre;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) network.point_s[j] = s;
    const AreaMoments old = c.moments;
    c.moments = {old.a, old.a * s, old.t, old.a * s * s, old.t * s, old.tt};
  }
}

}  // namespace macadam
