// SPDX-License-Identifier: GPL-3.0-or-later
/// \file void_cells.cpp  Chooses the weights of voids such that their cells have the volumes of the voids.
#include "host/tessellation/void_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/spheres/size_law.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {
namespace {

/// Largest difference between the volumes of a void and its cell, divided by the volume of the void.
constexpr double tolerance = 1e-3;
constexpr int most_rounds = 20;  // four to nine rounds are usual

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

/// Changes the weights by one Newton step per void, towards cells with the volumes of the voids' spheres. Returns
/// whether a cell differed by more than the tolerance.
bool correct(const Specimen& specimen, const Tessellation& cells, std::vector<double>& weights) {
  const std::vector<double> growth = growth_of_cells(specimen, cells);
  bool differs = false;
  for (std::size_t k = 0; k < growth.size(); ++k) {
    const double radius = specimen.voids[k].radius, wanted = sphere_volume(2 * radius);
    const double missing = wanted - cells.cell_volume[specimen.size() + k];
    if (!(growth[k] > 0) || std::abs(missing) <= tolerance * wanted) continue;
    differs = true;
    // If a cell must shrink, its weight may change without a limit, because the volume falls more slowly than the
    // derivative predicts (except at a wall). A cell that grows without a limit could take the whole cell of a
    // neighbour.
    weights[k] += std::min(missing / growth[k], radius * radius);
  }
  return differs;
}

}  // namespace

Specimen with_void_weights(const Specimen& specimen, std::span<const double> weights) {
  Specimen out = specimen;
  if (weights.empty()) return out;
  const auto least = static_cast<std::size_t>(std::ranges::min_element(weights) - weights.begin());
  const double raised =
      weights[least] > 0 ? 0 : specimen.voids[least].radius * specimen.voids[least].radius - weights[least];
  for (std::size_t k = 0; k < weights.size(); ++k) out.voids[k].radius = std::sqrt(weights[k] + raised);
  if (raised > 0)
    for (double& radius : out.radius) radius = std::sqrt(radius * radius + raised);
  return out;
}

Tessellation tessellate_with_void_volumes(const Specimen& specimen) {
  Tessellation cells = tessellate(specimen);
  std::vector<double> weights;
  for (const VoidSphere& v : specimen.voids) weights.push_back(v.radius * v.radius);
  for (int round = 0; round < most_rounds && correct(specimen, cells, weights); ++round) {
    Tessellation next = tessellate(with_void_weights(specimen, weights));
    if (next.hidden.size() > cells.hidden.size()) break;
    cells = std::move(next);
    cells.void_weight = weights;
  }
  return cells;
}

}  // namespace macadam
