// SPDX-License-Identifier: GPL-3.0-or-later
// error_model.cpp  Estimates the errors that the settings of a run cause. The formulas are fitted to errors measured on
// specimens of asphalt (docs/verification.md), with a factor of safety.
#include "host/run/error_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace macadam {

ErrorEstimate difference(const Stiffness& found, const Stiffness& expected) {
  return {found.e_star_pa / expected.e_star_pa - 1, (found.phase_deg - expected.phase_deg) * std::numbers::pi / 180};
}

double largest(const ErrorEstimate& error) { return std::max(std::abs(error.e_star), std::abs(error.phase_rad)); }

double stiffness_at(const Law& any, double omega) {
  return std::visit(
      [&]<class L>(const L& law) {
        if constexpr (has_stiffness<L>)
          return std::abs(law.stiffness(std::complex<double>(0, omega)));
        else
          return law.instantaneous();
      },
      any);
}

std::pair<double, double> stiffness_range(const Scene& scene, const ContactNetwork& network, double omega, bool shear) {
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  const auto add = [&](double stiffness) {
    least = std::min(least, stiffness);
    largest = std::max(largest, stiffness);
  };
  std::array<std::complex<double>, pair_types> k{};
  std::array<double, pair_types> alpha{};
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (network.count[pair] == 0) continue;
    std::visit(
        [&]<class L>(const L& law) {
          alpha[pair] = law.alpha;
          if constexpr (has_stiffness<L>)
            k[pair] = law.stiffness(std::complex<double>(0, omega));
          else
            k[pair] = law.instantaneous();
        },
        *scene.laws[pair]);
    if (network.rule != ContactRule::centres) continue;
    add(std::abs(k[pair]));
    if (shear) largest = std::max(largest, alpha[pair] * std::abs(k[pair]));
  }
  if (network.rule == ContactRule::centres) return {least, largest};
  for (const Contact& c : network.contacts) {
    const auto pair = static_cast<std::size_t>(c.pair);
    const double per_length = c.distance / c.length;
    add(per_length * std::abs(k[pair] / (1.0 + c.series * k[pair])));
    const std::complex<double> slip = alpha[pair] * k[pair];
    if (shear) largest = std::max(largest, per_length * std::abs(slip / (1.0 + c.series * slip)));
  }
  return {least, largest};
}

namespace {

/// Largest relative rounding error of a float.
constexpr double roundoff = 0x1p-24;

/// Returns the angle θ = u·N/2π, where u is the rounding error of a float. A number that oscillates with N steps per
/// period changes by less than half of its last bit per step as long as its phase is within θ of a peak.
double angle_lost(const RoundingScale& s) { return roundoff * static_cast<double>(s.steps) / (2 * std::numbers::pi); }

}  // namespace

double inertia_estimate(const Scene& scene, const Preparation& prepared, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  const double height = gauge_length(prepared.specimen);
  const double density = std::max(scene.materials.aggregate, scene.materials.mastic);
  // E is taken as a third of the softest stiffness, so 3·E in the denominator is the softest stiffness
  return omega * omega * height * height * density / stiffness_range(scene, prepared.network, omega).first;
}

RoundingScale rounding_scale(const Scene& scene, const Preparation& prepared, double frequency, std::int64_t steps,
                             double density_scaling) {
  double distances = 0;
  for (const Contact& c : prepared.network.contacts) distances += c.distance;
  const auto [softest, stiffest] = stiffness_range(scene, prepared.network, 2 * std::numbers::pi * frequency);
  return {steps, gauge_length(prepared.specimen) * static_cast<double>(prepared.network.contacts.size()) / distances,
          stiffest / softest, density_scaling * inertia_estimate(scene, prepared, frequency)};
}

// A block (the steps between two updates of the viscoelastic states) takes 1/N of the shortest characteristic time. The
// error of a contact within a block is a saw-tooth of height (2π/N)²/8 that returns to zero at the end of the block; a
// part of the saw-tooth remains at the frequency of the load. The measured error of |E*| is at most (2π/N)²/38, for N =
// 30 to 4,000, two binders, 2 to 20 Hz and one to three cycles (bench/block_lengths.cpp,
// bench/results/block-lengths.csv).
double block_error(double blocks) {
  const double turn = 2 * std::numbers::pi / blocks;
  return turn * turn / 20;
}
double blocks_within(double error) { return std::min(4000.0, 2 * std::numbers::pi / std::sqrt(20 * error)); }

// The velocities that contacts read have a relative error of u = 2⁻²⁴. These velocities are about `layers` times as
// large as the relative velocities of two neighbouring layers, so the relative error of relative velocities is
// layers·u. Normals, arms and moments have a relative error of u. In precision `mixed`, states, the velocities that are
// integrated, and sums are in double precision. But a device that takes the steps in blocks stores the change of a
// force within a block in single precision. Where stiff walls carry inertia, a part of this change is lost, as a part
// of the velocity is in precision `single` (see below). θ = u·N/2π; see angle_lost().
double mixed_precision_error(const RoundingScale& s) {
  return roundoff * (10 + s.layers) + 2 * angle_lost(s) * s.inertia;
}

// Precision `single` has the errors of `mixed` and further ones. A chain's f and x_l change in one step by 2π/N of
// their amplitude, times the cosine of the phase. Near their peaks this change is less than half of the last bit and is
// lost. This happens within the angle θ = u·N/2π on either side of a peak. Over this angle f and x_l should have
// changed by θ²/2 of their amplitude. In long runs other rounding errors, which act as noise, remove most of this error
// but not all of it; therefore the estimate is 4·θ². A run of many cycles loses less than one cycle with the same
// number of steps. Likewise, a velocity changes only if the force moves it by half of its last bit in a step. So up to
// the fraction θ/2 of the effect of inertia is lost.
double single_precision_error(const RoundingScale& s) {
  const double theta = angle_lost(s);
  return mixed_precision_error(s) + 4 * theta * theta;
}

std::string beyond(const RoundingScale& scale, const RoundingMeasured& measured) {
  // the comparisons below are written so that a NaN counts as beyond the range
  const RoundingScale& up_to = measured.up_to;
  if (!(scale.steps <= up_to.steps))
    return fmt::format("{} steps (errors were measured up to {})", scale.steps, up_to.steps);
  if (!(scale.layers <= up_to.layers)) {
    return fmt::format("{:.0f} layers of particles (errors were measured up to {:.0f})", scale.layers, up_to.layers);
  }
  if (!(scale.contrast <= up_to.contrast)) {
    return fmt::format("stiffnesses with a ratio of {:.0e} (errors were measured up to {:.0e})", scale.contrast,
                       up_to.contrast);
  }
  if (!(scale.inertia <= up_to.inertia)) {
    return fmt::format("inertia of about {:.2g} of |E*| (errors were measured up to {:.2g})", scale.inertia,
                       up_to.inertia);
  }
  return {};
}

// The next two functions are based on bench/results/accuracy.csv (relative error of |E*|, error of φ in radians), with
// a margin: a factor of 2.5 for the fixed geometry, and a fortieth of the tolerance for the number of cycles.

// Measured for specimen t8: 1.2·ε² at strains of 1e-3, 3e-3 and 1e-2.
double fixed_geometry_error(double strain) { return 3 * strain * strain; }

// With a ramp of one cycle, the 4th cycle differs from the steady state by at most 4e-5, the 6th by 1.3e-5 and the 12th
// by 2.3e-6 (specimens t8 and demo, 2 and 20 Hz). The difference falls with the number of cycles n as n^−2.6. The
// number of cycles is chosen so that the difference is at most a fortieth of the tolerance. Without a ramp, nothing
// damps the waves that the start causes; they leave a random difference of 1e-5 to 1e-3, however many cycles there are.
int cycles_from_rest(double tolerance) {
  return std::max(4, static_cast<int>(std::ceil(4 * std::pow(4e-5 / (tolerance / 40), 1 / 2.6))));
}

}  // namespace macadam
