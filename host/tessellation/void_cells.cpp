// SPDX-License-Identifier: GPL-3.0-or-later
/// \file void_cells.cpp  Chooses the weights of voids such that their cells have the volumes of the voids.
#include <algorithm>
#include <cmath>
#include <utility>

#include "host/spheres/size_law.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {
namespace {

constexpr double tolerance = 1e-3;     // largest difference between the volumes of a void and its cell, over the void's
constexpr double least_radius = 0.01;  // smallest root of a weight, over the void's radius
constexpr int most_rounds = 12;        // eight rounds reach the smallest weight; three to six are usual

/// Returns the derivative of the volume of each void's cell with respect to its weight [m]. A facet moves by
/// 1/(2·distance of the centres) per unit of weight; a wall does not move.
std::vector<double> growth_of_cells(const Specimen& specimen, const Tessellation& cells) {
  const auto first = static_cast<std::int32_t>(specimen.size());
  const auto centre = [&](std::int32_t cell) {
    return cell < first ? specimen.centre[static_cast<std::size_t>(cell)]
                        : specimen.voids[static_cast<std::size_t>(cell - first)].centre;
  };
  std::vector<double> out(specimen.voids.size(), 0);
  for (const Facet& f : cells.facets) {
    if (f.b < first) continue;  // the cells of voids have the highest numbers
    const double growth = f.area / (2 * norm(centre(f.b) - centre(f.a)));
    out[static_cast<std::size_t>(f.b - first)] += growth;
    if (f.a >= first) out[static_cast<std::size_t>(f.a - first)] += growth;
  }
  return out;
}

/// Changes the radii of `weighted` by one Newton step per void, towards cells with the volumes of the spheres of
/// `specimen`. Returns whether a cell differed by more than the tolerance.
bool correct(const Specimen& specimen, const Tessellation& cells, Specimen& weighted) {
  const std::vector<double> growth = growth_of_cells(specimen, cells);
  bool differs = false;
  for (std::size_t k = 0; k < growth.size(); ++k) {
    const double wanted = sphere_volume(2 * specimen.voids[k].radius);
    const double missing = wanted - cells.cell_volume[specimen.size() + k];
    double& radius = weighted.voids[k].radius;
    const bool is_least = missing < 0 && radius <= least_radius * specimen.voids[k].radius;
    if (is_least || !(growth[k] > 0) || std::abs(missing) <= tolerance * wanted) continue;
    differs = true;
    // the limits keep the weight positive, and a neighbour's cell from vanishing in one step
    radius *= std::sqrt(std::clamp(1 + missing / growth[k] / (radius * radius), 0.25, 2.0));
  }
  return differs;
}

}  // namespace

Tessellation tessellate_with_void_volumes(const Specimen& specimen) {
  Tessellation cells = tessellate(specimen);
  Specimen weighted = specimen;
  for (int round = 0; round < most_rounds && correct(specimen, cells, weighted); ++round) {
    Tessellation next = tessellate(weighted);
    if (next.hidden.size() > cells.hidden.size()) break;
    cells = std::move(next);
    cells.void_radius.clear();
    for (const VoidSphere& v : weighted.voids) cells.void_radius.push_back(v.radius);
  }
  return cells;
}

}  // namespace macadam
