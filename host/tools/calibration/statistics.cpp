// SPDX-License-Identifier: GPL-3.0-or-later
// statistics.cpp  Computes the covariance and the undetermined combinations from the principal directions of the
// derivatives.
#include "host/tools/calibration/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace macadam::calibration {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A combination of parameters counts as undetermined when the standard deviation of its logarithm exceeds this (a
/// factor of 2).
constexpr double undetermined_deviation = 0.7;
/// A combination is a product of powers of parameters. Its name leaves out parameters whose exponent is smaller than
/// `smallest_exponent` times the largest exponent. A parameter belongs to an undetermined direction (a unit vector)
/// only if its component of this vector exceeds `smallest_component`.
constexpr double smallest_exponent = 0.02, smallest_component = 1e-3;

/// Returns the rows with only the columns in `kept`. `all`: number of columns.
std::vector<double> columns_of(const std::vector<double>& rows, std::size_t all, const std::vector<std::size_t>& kept) {
  std::vector<double> out;
  for (std::size_t row = 0; row < rows.size(); row += all)
    for (const std::size_t k : kept) out.push_back(rows[row + k]);
  return out;
}

/// Returns a direction of the kept parameters as a combination of all `count` parameters, scaled so that its largest
/// exponent is 1.
Combination combination(const std::vector<double>& vector, const std::vector<std::size_t>& kept, std::size_t count,
                        double deviation) {
  const double largest =
      *std::max_element(vector.begin(), vector.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  Combination out{std::vector<double>(count, 0), deviation / std::abs(largest)};
  for (std::size_t i = 0; i < kept.size(); ++i) out.exponents[kept[i]] = vector[i] / largest;
  return out;
}

}  // namespace

void add_statistics(Calibration& out, std::vector<double> data, std::vector<double> priors) {
  const std::size_t all = out.parameters.size();
  std::vector<std::size_t> kept;  // a parameter at its bound counts as fixed
  for (std::size_t i = 0; i < all; ++i)
    if (!out.parameters[i].at_bound) kept.push_back(i);
  const std::size_t n = kept.size();
  data = columns_of(data, all, kept), priors = columns_of(priors, all, kept);
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  out.covariance.assign(all * all, nothing);
  out.correlation.assign(all * all, nothing);
  for (std::size_t i = 0; i < all; ++i) out.parameters[i].deviation = infinity, out.correlation[i * all + i] = 1;
  out.degrees_of_freedom = 0;
  if (n == 0) return;
  const std::size_t measurements = data.size() / n;
  out.degrees_of_freedom = static_cast<double>(measurements) - static_cast<double>(n);
  // Assumed standard deviations are enlarged if the misfit shows larger ones.
  const double scale =
      !out.deviations && out.degrees_of_freedom > 0 ? std::max(1.0, std::sqrt(out.misfit / out.degrees_of_freedom)) : 1;
  for (double& v : data) v /= scale;
  const Directions by_data = directions(data, n);
  for (std::size_t i = 0; i < n; ++i) {
    if (by_data.deviation[i] > undetermined_deviation)
      out.combinations.push_back(combination(by_data.vector[i], kept, all, by_data.deviation[i]));
  }
  data.insert(data.end(), priors.begin(), priors.end());
  const Directions with_priors = directions(data, n);
  const auto is_undetermined = [&](std::size_t i) {
    for (std::size_t d = 0; d < n; ++d)
      if (!std::isfinite(with_priors.deviation[d]) && std::abs(with_priors.vector[d][i]) > smallest_component)
        return true;
    return false;
  };
  const auto covariance = [&](std::size_t i, std::size_t k) {
    double sum = 0;
    for (std::size_t d = 0; d < n; ++d) {
      if (std::isfinite(with_priors.deviation[d]))
        sum +=
            with_priors.vector[d][i] * with_priors.vector[d][k] * with_priors.deviation[d] * with_priors.deviation[d];
    }
    return sum;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (is_undetermined(i)) continue;
    CalibratedParameter& p = out.parameters[kept[i]];
    p.deviation = p.value * std::sqrt(covariance(i, i));
    for (std::size_t k = 0; k < n; ++k) {
      if (is_undetermined(k)) continue;
      const std::size_t at = kept[i] * all + kept[k];
      out.covariance[at] = covariance(i, k);
      if (i != k) out.correlation[at] = covariance(i, k) / std::sqrt(covariance(i, i) * covariance(k, k));
    }
  }
}

std::string name_of(const Calibration& calibration, const Combination& combination) {
  std::string out;
  for (std::size_t i = 0; i < combination.exponents.size(); ++i) {
    const double e = combination.exponents[i];
    if (std::abs(e) < smallest_exponent) continue;
    out += (out.empty() ? "" : " * ") + calibration.parameters[i].name;
    if (std::abs(e - 1) > 1e-6) out += fmt::format("^{:.2g}", e);
  }
  return out;
}

}  // namespace macadam::calibration
