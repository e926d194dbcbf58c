// SPDX-License-Identifier: GPL-3.0-or-later
// loaded_rollers.cpp  Looks for the facets of particles within each roller.
#include "host/network/loaded_rollers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "macadam/error.hpp"

namespace macadam {

void require_loaded_rollers(const Specimen& specimen, const Tessellation& cells) {
  const domains::Rollers* rollers = specimen.box.rollers();
  if (!rollers) return;
  for (const std::int32_t wall : {std::int32_t{wall_z_lo}, std::int32_t{wall_z_hi}}) {
    const int index = static_cast<int>(wall_index(wall));
    for (const double middle : rollers->on(index)) {
      const bool is_loaded = std::any_of(cells.facets.begin(), cells.facets.end(), [&](const Facet& f) {
        const bool of_particle = f.a < static_cast<std::int32_t>(specimen.size());
        return f.b == wall && of_particle && rollers->covers(middle, f.centroid.x);
      });
      if (is_loaded) continue;
      throw RunError(
          fmt::format("the roller at x = {:g} m on the wall {}, which is {:g} m wide, touches no particle: found no "
                      "facet whose centroid lies within the roller, expected wider rollers or a finer packing",
                      middle, specimen.box.wall_name(index), rollers->width));
    }
  }
}

}  // namespace macadam
