// SPDX-License-Identifier: GPL-3.0-or-later
// triangulation.cpp  Computes CGAL's regular triangulation with exact predicates. This is the only file that includes
// CGAL's triangulations.
#include "host/tessellation/triangulation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

namespace macadam {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                               CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using PlainCell =
    CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel, CGAL::Triangulation_cell_base_3<Kernel>>;
// Hidden points are not stored: they would be needed only if points were removed.
using CellBase = CGAL::Regular_triangulation_cell_base_3<Kernel, PlainCell, CGAL::Discard_hidden_points>;
using Regular = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

Regular::Weighted_point point_of(const WeightedSite& site) {
  return {{site.centre.x, site.centre.y, site.centre.z}, site.weight};
}

/// Sorts the corners, each together with the neighbour opposite to it.
void put_in_order(Tetrahedron& t) {
  for (int i = 1; i < 4; ++i) {
    for (int k = i; k > 0 && comes_before(t.site[k], t.site[k - 1]); --k)
      std::swap(t.site[k], t.site[k - 1]), std::swap(t.neighbour[k], t.neighbour[k - 1]);
  }
}

}  // namespace

class Triangulation::Implementation {
 public:
  explicit Implementation(const WeightedSites& sites) : sites_(sites) {
    for (std::int32_t number = -1; number >= -bounding_site_count; --number)
      regular_.insert(point_of(sites[number]))->info() = number;
  }

  void insert(const std::vector<std::int32_t>& particles) {
    std::vector<std::pair<Regular::Weighted_point, std::int32_t>> points;
    points.reserve(particles.size());
    for (const std::int32_t i : particles) points.emplace_back(point_of(sites_[i]), i);
    regular_.insert(points.begin(), points.end());
  }

  std::vector<Tetrahedron> tetrahedra() {
    std::int32_t number = 0;
    for (const auto cell : regular_.all_cell_handles()) cell->info() = regular_.is_infinite(cell) ? -1 : number++;
    std::vector<Tetrahedron> out;
    out.reserve(static_cast<std::size_t>(number));
    for (const auto cell : regular_.all_cell_handles()) {
      if (cell->info() < 0) continue;
      Tetrahedron& t = out.emplace_back();
      for (int k = 0; k < 4; ++k) t.site[k] = cell->vertex(k)->info(), t.neighbour[k] = cell->neighbor(k)->info();
      put_in_order(t);
    }
    return out;
  }

 private:
  const WeightedSites& sites_;
  Regular regular_;
};

Triangulation::Triangulation(const WeightedSites& sites) : implementation_(std::make_unique<Implementation>(sites)) {}
Triangulation::~Triangulation() = default;
void Triangulation::insert(const std::vector<std::int32_t>& particles) { implementation_->insert(particles); }
std::vector<Tetrahedron> Triangulation::tetrahedra() { return implementation_->tetrahedra(); }

}  // namespace macadam
