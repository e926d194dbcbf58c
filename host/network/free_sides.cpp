// SPDX-License-Identifier: GPL-3.0-or-later
// free_sides.cpp  Finds the free facets at the sides of a specimen and the particles that have them.
#include "host/network/free_sides.hpp"

#include <algorithm>

namespace macadam {

FreeSides::FreeSides(const Specimen& specimen, const Tessellation& cells) : box_(specimen.box) {
  const bool is_box = box_.is_box(), is_column = box_.has_uniform_section();
  std::vector<const Facet*> facets;
  for (const Facet& f : cells.facets) {
    if (f.a >= static_cast<std::int32_t>(specimen.size())) continue;  // the cell of a void
    if (is_box ? f.b <= wall_x_lo && f.b >= wall_y_hi : is_column && f.b == wall_x_lo) facets.push_back(&f);
  }
  for (const Facet* f : facets) particles_.push_back(f->a);
  std::ranges::sort(particles_);
  particles_.erase(std::unique(particles_.begin(), particles_.end()), particles_.end());
  for (const Facet* f : facets) {
    Patch p;
    p.particle = static_cast<std::size_t>(std::ranges::lower_bound(particles_, f->a) - particles_.begin());
    p.side = static_cast<std::size_t>(-1 - f->b);
    p.area = f->area;
    p.normal = f->normal;
    p.arm = f->centroid - specimen.centre[static_cast<std::size_t>(f->a)];
    area_[p.side] += p.area;
    patches_.push_back(p);
  }
  known_ = is_box ? std::ranges::all_of(area_, [](double area) { return area > 0; }) : !patches_.empty();
}

}  // namespace macadam
