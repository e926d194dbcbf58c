// SPDX-License-Identifier: GPL-3.0-or-later
// shape_generator.cpp  Generates crushed stones. Stretches and wears each stone until its measures match the targets of
// the library.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/base/parallel.hpp"
#include "host/shapes/library/crushed_stone.hpp"
#include "host/shapes/library/library_targets.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

// Coordinates are multiples of 1 nm, so that they are short in a file and are read back to the same bits.
constexpr double grid = 1e9;

Surface rounded(Surface s) {
  for (Vec3d& p : s.points)
    p = {std::round(p.x * grid) / grid, std::round(p.y * grid) / grid, std::round(p.z * grid) / grid};
  return s;
}

/// Returns the stretch factors that would bring D^L, D^I and D^S to their targets.
std::array<double, 3> factors(const ShapeMeasure& target, const ShapeMeasure& found) {
  return {target.d_long / found.d_long, target.d_intermediate / found.d_intermediate, target.d_short / found.d_short};
}

std::array<Vec3d, 3> axes(const ShapeMeasure& m) { return {m.axis_long, m.axis_intermediate, m.axis_short}; }

/// Returns the deviation of a stone from its target: the largest relative deviation of D^L, D^I, D^S, and half of the
/// relative deviation of ψ^w.
double deviation(const ShapeMeasure& target, const ShapeMeasure& found) {
  double largest = 0.5 * std::abs(found.sphericity_true / target.sphericity_true - 1);
  for (const double f : factors(target, found)) largest = std::max(largest, std::abs(f - 1));
  return largest;
}

/// Largest accepted deviation of the three lengths; the deviation of ψ^w may be twice as large.
constexpr double near_enough = 0.004;

/// The best stone so far and its deviation from the target.
struct Fit {
  Surface surface;
  double deviation = std::numeric_limits<double>::infinity();
  bool too_round = false;  ///< ψ^w is above the target
};

/// Fits one stone to its target by fixed-point iteration. Each step stretches the stone along its own chords by the
/// ratios of target and measured lengths, and increases or decreases the wear to correct the sphericity. Finally the
/// finished surface, with rounded coordinates, is stretched again to match the lengths only.
Fit fit_stone(const CrushedStone& stone, const ShapeMeasure& target) {
  constexpr int shapings = 8, stretchings = 4;
  constexpr double least_wear = 0.03, most_wear = 0.6, wear_per_sphericity = 4;
  Stretching stretching;
  stretching.stretch({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                     {target.d_long / 2, target.d_intermediate / 2, target.d_short / 2});
  double wear = 0.15;
  Surface surface;
  ShapeMeasure found;
  for (int i = 0; i < shapings; ++i) {
    surface = stone.surface(stretching, wear, static_cast<int>(target.points));
    found = measure_shape(surface);
    const double lacking = target.sphericity_true - found.sphericity_true;
    const bool stuck = wear == (lacking > 0 ? most_wear : least_wear);
    if (deviation(target, found) < 2 * near_enough || (stuck && i > 2)) break;
    stretching.stretch(axes(found), factors(target, found));
    wear = std::clamp(wear + wear_per_sphericity * lacking, least_wear, most_wear);
  }
  Fit best;
  for (int i = 0; i < stretchings && best.deviation > near_enough / 4; ++i) {
    Stretching last;
    last.stretch(axes(found), factors(target, found));
    for (Vec3d& p : surface.points) p = last.point(p);
    const Surface candidate = rounded(surface);
    found = measure_shape(candidate);
    if (const double m = deviation(target, found); m < best.deviation) {
      best = {candidate, m, found.sphericity_true > target.sphericity_true};
    }
  }
  return best;
}

/// Returns the first stone that is close enough to its target, or otherwise the best of all attempts. If a stone is too
/// round, the next stone has fewer faces; otherwise the next stone has more.
Surface make_stone(std::uint64_t seed, int number, const ShapeMeasure& target) {
  constexpr int attempts = 10;
  int fewest = 8, most = 28;
  RandomStream random(seed, static_cast<std::uint64_t>(number));
  Fit best;
  for (int i = 0; i < attempts && best.deviation > near_enough; ++i) {
    const int faces = fewest + static_cast<int>(random.index(most - fewest + 1));
    Fit fit = fit_stone(CrushedStone(random, faces), target);
    if (fit.too_round) {
      most = std::max(fewest, faces - 1);
    } else {
      fewest = std::min(most, faces + 1);
    }
    if (fit.deviation < best.deviation) best = std::move(fit);
  }
  return best.surface;
}

}  // namespace

std::vector<Surface> generate_shape_library(std::uint64_t seed, int shapes) {
  constexpr int most = 1'000;  // takes about a minute
  if (shapes < 1 || shapes > most)
    throw InputError("shape library", 0, "shapes", fmt::format("{}", shapes), fmt::format("1 to {}", most));
  RandomStream random(seed, 0);
  const std::vector<ShapeMeasure> targets = draw_library_targets(random, shapes);
  std::vector<Surface> library(targets.size());
  const std::size_t digits = std::max<std::size_t>(2, fmt::formatted_size("{}", shapes));
  for_each_in_parallel(library.size(), [&](std::size_t i) {
    const int number = static_cast<int>(i) + 1;
    library[i] = make_stone(seed, number, targets[i]);
    library[i].name = fmt::format("aggregate_{:0{}}", number, digits);
  });
  return library;
}

}  // namespace macadam
