// SPDX-License-Identifier: GPL-3.0-or-later
// error_model.cpp  Figures measured on specimens of asphalt (docs/accuracy.md) with a factor of safety.
#include "host/simulation/error_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace macadam {

ErrorEstimate difference(const Stiffness& found, const Stiffness& expected) {
  return {found.e_star_pa / expected.e_star_pa - 1, (found.phase_deg - expected.phase_deg) * std::numbers::pi / 180};
}

double largest(const ErrorEstimate& error) { return std::max(std::abs(error.e_star), std::abs(error.phase_rad)); }

double inertia_estimate(const Scene& scene, const Preparation& prepared, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  double softest = std::numeric_limits<double>::infinity();
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (prepared.network.count[pair] == 0) continue;
    softest = std::min(softest,
                       std::visit([&](const auto& law) { return std::abs(law.stiffness(omega)); }, *scene.laws[pair]));
  }
  const double height = prepared.specimen.box.size.z;
  const double density = std::max(scene.materials.aggregate, scene.materials.mastic);
  return omega * omega * height * height * density / softest;  // 3 · E = softest
}

// Upper envelopes, about twice what bench/accuracy measured (bench/results/accuracy.csv), of |E*| and φ in radians.

// t8: 1.8e-7 or less at 3.7e4 steps, 1e-6 at 3.7e5, 9e-5 at 3.7e6 (φ at 2 Hz, one cycle); the demo, with thirteen times
// the particles: 1.7e-7 at 2.6e4, 1.6e-6 at 8.3e4. Many cycles of large steps drift less.
double single_precision_error(std::int64_t steps) {
  const double millions = static_cast<double>(steps) / 1e6;
  return 4e-7 + 5e-4 * millions * millions;
}

// What a contact misses within a block of the share 1/N of the shortest time is a saw-tooth of (2π/N)²/8, which returns
// to nothing at the block's end; the fundamental keeps a part of it. Measured: at most (2π/N)²/38, of N = 30 to 4,000,
// both binders, 2 to 20 Hz, one to three cycles (bench/block_lengths.cpp, bench/results/block-lengths.csv).
double block_error(double blocks) {
  const double turn = 2 * std::numbers::pi / blocks;
  return turn * turn / 20;
}
double blocks_within(double error) { return std::min(4000.0, 2 * std::numbers::pi / std::sqrt(20 * error)); }

// t8: 1.2·ε² at strains of 1e-3, 3e-3 and 1e-2.
double fixed_geometry_error(double strain) { return 3 * strain * strain; }

// With a ramp of one cycle: 4 cycles come within 4e-5, 6 within 1.3e-5, 12 within 2.3e-6 (t8 and demo, 2 and 20 Hz):
// as n^−2.6. It may be a fortieth of the tolerance. Without a ramp nothing damps the waves of the start, which leave
// 1e-5 to 1e-3 at random, however many cycles.
int cycles_from_rest(double tolerance) {
  return std::max(4, static_cast<int>(std::ceil(4 * std::pow(4e-5 / (tolerance / 40), 1 / 2.6))));
}

}  // namespace macadam
