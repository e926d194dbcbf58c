// SPDX-License-Identifier: GPL-3.0-or-later
/// \file power_diagram.cpp  The only file that includes CGAL's triangulations: exact predicates, plain arrays out.
#include "host/tessellation/power_diagram.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cmath>
#include <utility>

#include "host/spheres/parallel_blocks.hpp"

namespace macadam {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                               CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using PlainCell =
    CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel, CGAL::Triangulation_cell_base_3<Kernel>>;
// Hidden points never come back (nothing is removed), so they need not be stored.
using CellBase = CGAL::Regular_triangulation_cell_base_3<Kernel, PlainCell, CGAL::Discard_hidden_points>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Site = Triangulation::Weighted_point;

/// Six sites on the axes through the box's centre, at L = 4·(Lx + Ly + Lz) from it, weight 0.
///
/// They cut nothing inside the box: for x in the box and any particle p, pow_p(x) = |x − p|² − R² ≤ diagonal², while
/// a bounding site q has pow_q(x) = |x − q|² ≥ (L − half an edge)² > (3·(Lx + Ly + Lz))² > diagonal². This holds for
/// every radius. Their hull |x| + |y| + |z| ≤ L about the centre holds the box, whose half edges sum to L/8, in its
/// interior, so no edge between particles is on the hull and all its tetrahedra are finite. As corners of the hull they
/// are never hidden, whatever the weights.
std::vector<Site> bounding_sites(const Vec3d& box) {
  const double far = 4 * (box.x + box.y + box.z);
  const Vec3d c = 0.5 * box;
  return {Site({c.x - far, c.y, c.z}, 0), Site({c.x + far, c.y, c.z}, 0), Site({c.x, c.y - far, c.z}, 0),
          Site({c.x, c.y + far, c.z}, 0), Site({c.x, c.y, c.z - far}, 0), Site({c.x, c.y, c.z + far}, 0)};
}

/// 2·q_k·c = b_k for k = 0, 1, 2 by Cramer's rule: numerators of c and their common denominator.
template <class T>
struct Cramer {
  T nx, ny, nz, den;

  Cramer(const std::array<Vec3<T>, 3>& q, const std::array<T, 3>& b) {
    const Vec3<T> q12 = cross(q[1], q[2]), q20 = cross(q[2], q[0]), q01 = cross(q[0], q[1]);
    nx = b[0] * q12.x + b[1] * q20.x + b[2] * q01.x;
    ny = b[0] * q12.y + b[1] * q20.y + b[2] * q01.y;
    nz = b[0] * q12.z + b[1] * q20.z + b[2] * q01.z;
    den = T(2) * dot(q[0], q12);
  }
};

/// The point of equal power to four sites, relative to the first, which must be a particle (bounding sites are so far
/// away that differences from them would be nearly parallel).
class DualPoint {
 public:
  explicit DualPoint(const std::array<const Site*, 4>& site) : site_(site) {}

  Vec3d operator()() const {
    std::array<Vec3d, 3> q;
    std::array<double, 3> b;
    equations(q, b);
    const Cramer<double> c(q, b);
    // Rounding moves c by about ε·|q|/flatness: below 1e-3 the error would show in the facets, so it is done exactly.
    // (The dual of a flat tetrahedron of nearly cospherical sites may lie anywhere on a line when rounded badly.)
    constexpr double flat = 1e-3;
    if (std::abs(c.den) > 2 * flat * norm(q[0]) * norm(q[1]) * norm(q[2]))
      return origin() + Vec3d{c.nx / c.den, c.ny / c.den, c.nz / c.den};
    return exact();
  }

 private:
  Vec3d origin() const { return {site_[0]->x(), site_[0]->y(), site_[0]->z()}; }

  template <class T>
  void equations(std::array<Vec3<T>, 3>& q, std::array<T, 3>& b) const {
    for (int k = 0; k < 3; ++k) {
      const Site &p = *site_[k + 1], &o = *site_[0];
      q[k] = {T(p.x()) - T(o.x()), T(p.y()) - T(o.y()), T(p.z()) - T(o.z())};
      b[k] = dot(q[k], q[k]) + (T(o.weight()) - T(p.weight()));
    }
  }

  Vec3d exact() const {
    using Exact = CGAL::MP_Float;  // sums and products of doubles without rounding
    std::array<Vec3<Exact>, 3> q;
    std::array<Exact, 3> b;
    equations(q, b);
    const Cramer<Exact> c(q, b);
    const double den = CGAL::to_double(c.den);  // not 0: the triangulation has no exactly flat tetrahedron
    return origin() + Vec3d{CGAL::to_double(c.nx) / den, CGAL::to_double(c.ny) / den, CGAL::to_double(c.nz) / den};
  }

  std::array<const Site*, 4> site_;
};

Triangulation triangulate(const Specimen& specimen, const std::vector<std::uint8_t>& active) {
  std::vector<std::pair<Site, std::int32_t>> sites;
  sites.reserve(specimen.size());
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    if (!active[i]) continue;
    const Vec3d& p = specimen.centre[i];
    sites.emplace_back(Site({p.x, p.y, p.z}, specimen.radius[i] * specimen.radius[i]), static_cast<std::int32_t>(i));
  }
  Triangulation triangulation;
  std::int32_t number = -1;
  for (const Site& site : bounding_sites(specimen.box.size)) triangulation.insert(site)->info() = number--;
  triangulation.insert(sites.begin(), sites.end());
  return triangulation;
}

}  // namespace

PowerDiagram power_diagram(const Specimen& specimen, const std::vector<std::uint8_t>& active) {
  const Triangulation triangulation = triangulate(specimen, active);
  std::vector<Triangulation::Cell_handle> cells;
  for (const auto cell : triangulation.all_cell_handles()) {
    cell->info() = triangulation.is_infinite(cell) ? -1 : static_cast<std::int32_t>(cells.size());
    if (cell->info() >= 0) cells.push_back(cell);
  }
  PowerDiagram diagram;
  diagram.tetrahedra.resize(cells.size());
  diagram.dual.resize(cells.size());
  for_each_in_blocks(cells.size(), true, [&](std::size_t t) {  // exact numbers take memory
    std::array<const Site*, 4> site;
    int particle = 0;
    for (int k = 0; k < 4; ++k) {
      diagram.tetrahedra[t].site[k] = cells[t]->vertex(k)->info();
      diagram.tetrahedra[t].neighbour[k] = cells[t]->neighbor(k)->info();
      site[k] = &cells[t]->vertex(k)->point();
      if (diagram.tetrahedra[t].site[k] >= 0) particle = k;
    }
    std::swap(site[0], site[particle]);
    diagram.dual[t] = DualPoint(site)();
  });
  return diagram;
}

}  // namespace macadam
