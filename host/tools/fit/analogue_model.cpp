// SPDX-License-Identifier: GPL-3.0-or-later
// analogue_model.cpp  Computes the modulus of 2S2P1D and Huet–Sayegh, and the Kelvin chain that replaces them in a
// contact law.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/tools/fit/chain_fit.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Returns frequencies from low to high, both included, with at least `a_decade` per decade.
std::vector<double> between(double low, double high, double a_decade) {
  const auto steps = static_cast<int>(std::ceil(std::max(a_decade * std::log10(high / low), 1.0)));
  std::vector<double> out;
  for (int i = 0; i <= steps; ++i) out.push_back(low * std::pow(high / low, static_cast<double>(i) / steps));
  return out;
}

std::complex<double> s_of(double frequency_hz) { return {0, 2 * std::numbers::pi * frequency_hz}; }

}  // namespace

std::complex<double> AnalogueModel::stiffness(std::complex<double> s) const {
  const std::complex<double> log_time = std::log(s * tau);
  std::complex<double> sum = 1.0 + delta * std::exp(-k * log_time) + std::exp(-h * log_time);
  if (std::isfinite(beta)) sum += 1.0 / (s * beta * tau);
  return E_00 + (E_0 - E_00) / sum;
}

KelvinConversion to_kelvin(const AnalogueModel& model, double lowest_hz, double highest_hz, double largest_error) {
  using namespace fitting;
  const auto refuse = [](const char* what, const std::string& found, const std::string& expected) {
    throw InputError("Kelvin chain", 0, what, found, expected);
  };
  if (!(lowest_hz > 0 && highest_hz > lowest_hz && std::isfinite(highest_hz) && highest_hz / lowest_hz < 1e30)) {
    refuse("range", fmt::format("{} to {} Hz", lowest_hz, highest_hz), "two positive frequencies, the lower one first");
  }
  if (!(largest_error >= 1e-6 && largest_error <= 0.5)) {
    refuse("largest error", fmt::format("{}", largest_error), "a number from 1e-6 to 0.5");
  }
  // Times are in units of the middle of the range, and their logarithms are rounded to 10 digits. If the same curve is
  // given at another reference temperature, its constants have other rounding errors, but the chain stays the same.
  const double middle = std::sqrt(lowest_hz) * std::sqrt(highest_hz);
  const auto rounded = [](double value) { return std::exp(std::round(std::log(value) * 1e10) / 1e10); };
  AnalogueModel scaled = model;
  scaled.tau = rounded(model.tau * middle);
  const double reach = rounded(highest_hz / middle);
  std::vector<Target> targets;
  for (const double f : between(1 / reach, reach, 12)) {
    Target t;
    t.place.omega = 2 * std::numbers::pi * f;
    const std::complex<double> modulus = scaled.stiffness(s_of(f));
    t.log_modulus = std::log(std::abs(modulus));
    t.phase = std::arg(modulus);
    if (!std::isfinite(t.log_modulus))
      refuse("modulus", fmt::format("{} at {} Hz", std::abs(modulus), f * middle), "a finite modulus");
    targets.push_back(t);
  }
  const std::vector<double> fine = between(lowest_hz, highest_hz, 100);
  std::optional<Chain> fewer;
  double smallest_error = std::numeric_limits<double>::infinity();
  constexpr int most_units = laws::GeneralisedKelvin::max_units;
  for (int units = 0; units <= most_units; ++units) {
    Unknowns u;
    u.units = units;
    u.flow = model.E_00 == 0 && std::isfinite(model.beta);
    if (u.count() > 2 * targets.size()) break;
    std::vector<const Chain*> starts;
    if (fewer) starts.push_back(&*fewer);
    Chain chain{u, fit_chain(u, targets, chain_limits(u, targets, {}), {}, starts, 1e-7)};
    KelvinConversion out{chain_of(u, chain.minimum.theta), 0};
    if (u.flow) out.law.C_m /= middle;
    for (double& viscosity : out.law.C) viscosity /= middle;
    for (const double f : fine) {
      const std::complex<double> exact = model.stiffness(s_of(f));
      out.largest_error = std::max(out.largest_error, std::abs(out.law.stiffness(s_of(f)) - exact) / std::abs(exact));
    }
    if (out.largest_error <= largest_error) return out;
    smallest_error = std::min(smallest_error, out.largest_error);
    fewer = std::move(chain);
  }
  refuse("largest error", fmt::format("{} from {} to {} Hz", largest_error, lowest_hz, highest_hz),
         fmt::format("at least {:.3g}, the smallest error that up to {} units reach, or a shorter range",
                     smallest_error, most_units));
  return {};
}

}  // namespace macadam
