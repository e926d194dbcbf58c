// SPDX-License-Identifier: GPL-3.0-or-later
// packing_check.cpp  Detects cells that reach far beyond their spheres, and spheres that fill more than their box.
//
// Reasons for most_radii, most_spacings and most_fill: in the committed examples cells reach at most 1.5 radii beyond
// their spheres. Spheres placed at random without overlap fill 10 to 30 % of their box. Their cells reach 7 radii
// beyond the spheres if the sizes are similar, and far more radii where spheres are small, but at most 1.8 mean
// spacings (measured with up to 3,000 spheres). A ball with a radius of 2 mean spacings contains the centres of 33
// spheres on average (4π/3·2³), so the probability that such a ball in the interior is empty is exp(-33). A region of
// large spheres in a specimen of mostly small spheres has holes of many mean spacings, but these holes are smaller than
// 2 radii of the large spheres. A cell that exceeds both bounds therefore belongs to neither kind of packing.
// Overlapping mastic fills up to 102 % of the box in the examples. If diameters are given as radii, the filled fraction
// becomes eight times as large. The wrong fraction then exceeds 150 % for any packing whose true fraction is 19 % or
// more.
#include "macadam/tessellation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "host/spheres/sparse_box.hpp"
#include "kernels/base/parallel.hpp"

namespace macadam {
namespace {

constexpr double most_radii = 4, most_spacings = 2, most_fill = 1.5;

double sphere_volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

/// Returns the volume of all spheres, divided by the volume of the box. If an aggregate consists of several spheres,
/// each of them counts with at most the volume of its cell.
double filled_fraction(const Specimen& all, const Tessellation& tessellation) {
  std::unordered_map<std::int32_t, int> spheres_of;
  for (const std::int32_t body : all.body) ++spheres_of[body];
  double volume = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double sphere = sphere_volume(all.radius[i]);
    const bool in_cluster = all.body[i] >= 0 && spheres_of[all.body[i]] > 1;
    volume += in_cluster ? std::min(sphere, tessellation.cell_volume[i]) : sphere;
  }
  return volume / all.box.volume();
}

/// The point of a cell that is farthest from the surface of the cell's sphere.
struct Reach {
  double radii = 0;         ///< distance, divided by the largest radius of the particle and its neighbours
  double distance = 0;      ///< distance from the sphere's surface [m]
  std::int32_t cell = -1;   ///< particle or void; −1 if no cell reaches too far
  std::int32_t other = -1;  ///< other side of the facet: a particle, a void or a Wall
  Vec3d point{};            ///< [m]
  Reach& operator+=(const Reach& o) {
    if (o.radii > radii) *this = o;  // if several are equal, the first is kept
    return *this;
  }
};

/// Returns, for each cell, the largest radius of its sphere and its neighbours' spheres.
std::vector<double> largest_radii_of_neighbours(const Specimen& all, const Tessellation& tessellation) {
  std::vector<double> out = all.radius;
  for (const Facet& f : tessellation.facets) {
    if (f.b < 0) continue;
    out[f.a] = std::max(out[f.a], all.radius[f.b]);
    out[f.b] = std::max(out[f.b], all.radius[f.a]);
  }
  return out;
}

/// Returns the farthest point of all cells that exceed both bounds on the reach, most_radii and most_spacings.
Reach farthest_reach(const Specimen& all, const Tessellation& tessellation) {
  const std::vector<double> largest = largest_radii_of_neighbours(all, tessellation);
  const double spacing = std::cbrt(all.box.volume() / static_cast<double>(all.size()));
  return sum_in_parallel<Reach>(tessellation.facets.size(), [&](std::size_t k) {
    const Facet& f = tessellation.facets[k];
    Reach out;
    for (const auto& [cell, other] : {std::pair{f.a, f.b}, std::pair{f.b, f.a}}) {
      if (cell < 0) continue;
      for (const Vec3d& point : tessellation.polygon(f)) {
        const double distance = norm(point - all.centre[cell]) - all.radius[cell];
        if (distance > most_radii * largest[cell] && distance > most_spacings * spacing)
          out += Reach{distance / largest[cell], distance, cell, other, point};
      }
    }
    return out;
  });
}

/// Selects, among the facets that contain the cell's farthest point, the facet whose plane is farthest from the
/// sphere's centre. Returns the cell or the wall on the other side of this facet. If the box is too high, the result is
/// the top wall and not one of the two side walls that meet in the same corner.
std::int32_t farthest_side(const Specimen& all, const Tessellation& tessellation, const Reach& reach) {
  const Vec3d arm = reach.point - all.centre[reach.cell];
  double farthest = -1;
  std::int32_t out = reach.other;
  for (const Facet& f : tessellation.facets) {
    if (f.a != reach.cell && f.b != reach.cell) continue;
    const auto polygon = tessellation.polygon(f);
    const bool meets = std::ranges::any_of(
        polygon, [&](const Vec3d& p) { return norm(p - reach.point) <= 1e-9 * norm(arm); });  // rounding of vertices
    const double plane = std::abs(dot(f.normal, arm));
    if (meets && plane > farthest) farthest = plane, out = f.a == reach.cell ? f.b : f.a;
  }
  return out;
}

std::string name_of(const Specimen& specimen, std::int32_t cell) {
  if (cell < 0) return fmt::format("the {} wall", specimen.box.wall_name(-1 - cell));
  const auto number = static_cast<std::size_t>(cell);
  return number < specimen.size() ? fmt::format("particle {}", number)
                                  : fmt::format("void {}", number - specimen.size());
}

}  // namespace

std::vector<std::string> packing_warnings(const Specimen& specimen, const Tessellation& tessellation) {
  if (std::string sparse = sparse_box(specimen); !sparse.empty()) return {std::move(sparse)};
  const Specimen all = with_voids_as_cells(specimen);
  const double fill = filled_fraction(all, tessellation);
  const std::string filled = fmt::format("spheres fill {:.3g} % of the {}", 100 * fill, specimen.box.dimensions());
  std::vector<std::string> out;
  if (const Reach reach = farthest_reach(all, tessellation); reach.cell >= 0) {
    const std::string cell = name_of(specimen, reach.cell);
    out.push_back(fmt::format(
        "the packing does not fill its {}: the program treats the gap between {} and {} as solid material "
        "that carries load. The cell of {} reaches {:.3g} m from the surface of its sphere, {:.3g} times the "
        "largest radius of this sphere and its neighbours (expected at most {:g} times); {}",
        specimen.box.name(), cell, name_of(specimen, farthest_side(all, tessellation, reach)), cell, reach.distance,
        reach.radii, most_radii, filled));
  }
  if (fill > most_fill)
    out.push_back(
        fmt::format("{}, expected at most {:g} %; the column radius may hold diameters", filled, 100 * most_fill));
  return out;
}

}  // namespace macadam
