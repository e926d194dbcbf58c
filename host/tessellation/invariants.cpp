// SPDX-License-Identifier: GPL-3.0-or-later
/// \file invariants.cpp  Computes how far a tessellation deviates from the properties that every Laguerre diagram has.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "host/tessellation/facets.hpp"
#include "host/tessellation/void_cells.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

TessellationInvariants measure_invariants(const Specimen& particles, const Tessellation& tessellation) {
  const Specimen specimen = with_voids_as_cells(with_void_weights(particles, tessellation.void_weight));
  TessellationInvariants out;
  std::vector<Vec3d> closing(specimen.size());
  std::vector<double> surface(specimen.size(), 0);
  std::array<double, wall_count> wall_area{};
  for (const Facet& f : tessellation.facets) {
    closing[f.a] += f.area * f.normal;
    surface[f.a] += f.area;
    const Vec3d& pa = specimen.centre[f.a];
    if (f.b < 0) {
      wall_area[-1 - f.b] += f.area;
      // The scale is the distance between the particle and its mirror image, which is twice the distance from the wall.
      // It is at least the radius, because the centre may lie on the wall.
      const double scale = std::max(2 * std::abs(height_above_wall(specimen.box, f, pa)), specimen.radius[f.a]);
      for (const Vec3d& v : tessellation.polygon(f))
        out.flatness = std::max(out.flatness, std::abs(height_above_wall(specimen.box, f, v)) / scale);
      continue;
    }
    closing[f.b] -= f.area * f.normal;
    surface[f.b] += f.area;
    const Bisector plane(specimen, f.a, f.b);
    for (const Vec3d& v : tessellation.polygon(f)) {
      const double off = dot(v - pa, plane.normal) - plane.arm;
      out.flatness = std::max(out.flatness, std::abs(dot(v - f.centroid, f.normal)) / plane.distance);
      // pow_a − pow_b = 2·d·(height above the plane). In this form no digits cancel when the powers are large.
      out.power = std::max(out.power, 2 * std::abs(off) / plane.distance);
    }
  }
  for (std::size_t i = 0; i < specimen.size(); ++i)
    if (surface[i] > 0) out.closure = std::max(out.closure, norm(closing[i]) / surface[i]);
  for (int k = 0; k < wall_count; ++k) {
    const double area = specimen.box.wall_area(k);
    if (area > 0) out.walls = std::max(out.walls, std::abs(wall_area[k] - area) / area);
  }
  const auto& volume = tessellation.cell_volume;
  // The sum uses long double: in double precision, a sum of n equal volumes could have a relative error of up to n·ε/2.
  const long double sum = std::accumulate(volume.begin(), volume.end(), 0.0L);
  out.volume = static_cast<double>(std::abs(sum - specimen.box.volume()) / specimen.box.volume());
  return out;
}

}  // namespace macadam
