// SPDX-License-Identifier: GPL-3.0-or-later
// error_model.cpp  Figures measured on specimens of asphalt (docs/accuracy.md) with a factor of safety.
#include "host/simulation/error_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace macadam {

ErrorEstimate inertia_error(const Stiffness& found, const Stiffness& expected) {
  return {found.e_star_pa / expected.e_star_pa - 1, (found.phase_deg - expected.phase_deg) * std::numbers::pi / 180};
}

double largest(const ErrorEstimate& error) { return std::max(std::abs(error.e_star), std::abs(error.phase_rad)); }

double inertia_bound(const Scene& scene, const Preparation& prepared, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  double softest = std::numeric_limits<double>::infinity();
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (prepared.network.count[pair] == 0) continue;
    softest = std::min(softest,
                       std::visit([&](const auto& law) { return std::abs(law.stiffness(omega)); }, *scene.laws[pair]));
  }
  const double height = prepared.specimen.box.size.z;
  const double density = std::max(scene.materials.aggregate, scene.materials.mastic);
  return omega * omega * height * height * density / (3 * softest);
}

double single_precision_error(std::int64_t steps) { return 1e-5 * std::pow(static_cast<double>(steps) / 1e5, 1.5); }

double fixed_geometry_error(double strain) { return 10 * strain * strain; }

int cycles_from_rest(double tolerance) { return tolerance >= 1e-2 ? 3 : 5; }

}  // namespace macadam
