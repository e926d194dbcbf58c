// SPDX-License-Identifier: GPL-3.0-or-later
// chain_of_curve.cpp  Finds a Kelvin chain that approximates a computed curve of moduli.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "macadam/error.hpp"
#include "macadam/fit.hpp"

namespace macadam {
namespace {

/// Errors allowed for a chain that replaces a 2S2P1D model. They are tried in this order.
constexpr double allowed[] = {0.01, 0.02, 0.05};
/// If such a chain differs from the curve by at most this fraction, no chain is fitted to the points.
constexpr double good = 0.02;

double largest_difference(const laws::GeneralisedKelvin& law, const ModulusData& curve) {
  double out = 0;
  for (const ModulusPoint& p : curve.points) {
    const std::complex<double> modulus = std::polar(p.e_star_pa, p.phase_deg * std::numbers::pi / 180);
    const std::complex<double> s(0, 2 * std::numbers::pi * p.frequency_hz);
    out = std::max(out, std::abs(law.stiffness(s) / modulus - 1.0));
  }
  return out;
}

/// Returns the chain that replaces a 2S2P1D model of the curve. \throws InputError, RunError
laws::GeneralisedKelvin by_model(const ModulusData& curve) {
  FitOptions options;
  options.model = FitModel::two_s2p1d;
  const Fit fit = fit_modulus(curve, options);
  const auto [low, high] = fit.reduced_range();
  const auto& model = std::get<AnalogueModel>(fit.model);
  for (const double error : allowed) {
    try {
      return to_kelvin(model, low, high, error).law;
    } catch (const InputError&) {
      if (error == *std::rbegin(allowed)) throw;
    }
  }
  return {};
}

/// Returns a chain that is fitted to the points. \throws InputError, RunError
laws::GeneralisedKelvin by_points(const ModulusData& curve) {
  FitOptions options;
  options.most_units = laws::GeneralisedKelvin::max_units;
  return std::get<laws::GeneralisedKelvin>(fit_modulus(curve, options).model);
}

}  // namespace

CurveChain chain_of_curve(const ModulusData& curve) {
  if (curve.temperatures)
    throw InputError(curve.source, 0, "measurements", "a column of temperatures",
                     "a curve at one temperature, over the reduced frequency");
  std::optional<CurveChain> best;
  std::string fault;
  for (const auto way : {by_model, by_points}) {
    if (best && best->largest_difference <= good) break;
    try {
      laws::GeneralisedKelvin law = way(curve);
      const double difference = largest_difference(law, curve);
      if (!best || difference < best->largest_difference) best = CurveChain{std::move(law), difference};
    } catch (const Error& error) { fault = error.what(); }
  }
  if (!best) throw RunError(fmt::format("{}: no Kelvin chain stands for this curve: {}", curve.source, fault));
  return *best;
}

}  // namespace macadam
