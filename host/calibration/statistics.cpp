// SPDX-License-Identifier: GPL-3.0-or-later
// statistics.cpp  Covariance and poorly determined combinations by the principal directions of the derivatives.
#include "host/calibration/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace macadam::calibration {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of a combination's logarithm, beyond which the measurements are said not to tell: half as much or twice as much.
constexpr double untold = 0.7;
/// Exponents of a combination below this share of the largest are not worth naming, parts in it none at all.
constexpr double named = 0.02, no_part = 1e-3;

Combination combination(const std::vector<double>& vector, double deviation) {
  const double largest =
      *std::max_element(vector.begin(), vector.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  Combination out{vector, deviation / std::abs(largest)};
  for (double& exponent : out.exponents) exponent /= largest;
  return out;
}

}  // namespace

void add_statistics(Calibration& out, const std::vector<double>& data, const std::vector<double>& priors) {
  const std::size_t n = out.parameters.size();
  // deviations that nobody stated are those that the misfit shows; numbers that were computed leave none, and then
  // priors must not vanish beside them
  constexpr double least = 1e-4;
  const bool scaled = !out.deviations && out.degrees_of_freedom > 0;
  const double scale = scaled ? std::max(std::sqrt(out.misfit / out.degrees_of_freedom), least) : 1;
  std::vector<double> all = data;
  for (double& v : all) v /= scale;
  const Directions by_data = directions(all, n);
  for (std::size_t i = 0; i < n; ++i) {
    // of an exact fit all deviations are small: what is flat as measured with the deviations assumed is named too
    const double deviation = by_data.deviation[i] / std::min(scale, 1.0);
    if (deviation > untold && n > 1) out.combinations.push_back(combination(by_data.vector[i], by_data.deviation[i]));
  }
  all.insert(all.end(), priors.begin(), priors.end());
  const Directions whole = directions(all, n);
  out.covariance.assign(n * n, 0);
  std::vector<bool> undetermined(n);
  for (std::size_t d = 0; d < n; ++d) {
    const std::vector<double>& v = whole.vector[d];
    const double variance = whole.deviation[d] * whole.deviation[d];
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(variance)) {
        if (std::abs(v[i]) > no_part) undetermined[i] = true;
        continue;
      }
      for (std::size_t k = 0; k < n; ++k) out.covariance[i * n + k] += v[i] * v[k] * variance;
    }
  }
  out.correlation.assign(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    CalibratedParameter& p = out.parameters[i];
    p.deviation = undetermined[i] ? infinity : p.value * std::sqrt(out.covariance[i * n + i]);
    for (std::size_t k = 0; k < n; ++k) {
      const double scale_of = std::sqrt(out.covariance[i * n + i] * out.covariance[k * n + k]);
      out.correlation[i * n + k] = i == k ? 1 : scale_of > 0 ? out.covariance[i * n + k] / scale_of : 0;
    }
  }
}

std::string words(const Calibration& calibration, const Combination& combination) {
  std::string out;
  for (std::size_t i = 0; i < combination.exponents.size(); ++i) {
    const double e = combination.exponents[i];
    if (std::abs(e) < named) continue;
    out += (out.empty() ? "" : " * ") + calibration.parameters[i].name;
    if (std::abs(e - 1) > 1e-6) out += fmt::format("^{:.2g}", e);
  }
  return out;
}

}  // namespace macadam::calibration
