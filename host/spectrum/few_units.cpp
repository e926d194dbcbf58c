// SPDX-License-Identifier: GPL-3.0-or-later
// few_units.cpp  Approximates a sum of exponentials by a sum of only a few of the same exponentials (units) with other
// moduli. A non-negative least-squares fit adds one unit at a time until the error is below the tolerance.
#include <algorithm>
#include <cmath>

#include "host/base/non_negative_least_squares.hpp"
#include "macadam/spectrum.hpp"

namespace macadam {
namespace {

/// Fraction of E(0) below which values of E(t) count as 0. Relative differences are differences divided by E(t) or, if
/// E(t) is smaller than this fraction of E(0), divided by this fraction of E(0).
constexpr double nothing = 1e-9;
/// Number of times per decade at which two series are compared.
constexpr int per_decade = 20;

/// Returns the times of the least-squares fit: 0, the given range, and the two decades before the range, in which E
/// falls from E(0) to E(shortest).
std::vector<double> places(double shortest, double longest) {
  std::vector<double> out = log_range(1e-2 * shortest, longest, per_decade);
  out.insert(out.begin(), 0);
  return out;
}

/// Returns the number by which a difference at time t is divided: E(t), but at least the fraction `least` of E(0).
double scale(const PronySeries& exact, double t, double least = nothing) {
  return std::max(exact.modulus(t), least * exact.instantaneous());
}

}  // namespace

double difference(const PronySeries& series, const PronySeries& exact, double shortest, double longest, double least) {
  double out = std::abs(series.instantaneous() / exact.instantaneous() - 1);
  for (const double t : log_range(shortest, longest, per_decade))
    out = std::max(out, std::abs(series.modulus(t) - exact.modulus(t)) / scale(exact, t, least));
  return out;
}

PronySeries few_units(const PronySeries& series, double shortest, double longest, double tolerance) {
  const std::vector<double> times = places(shortest, longest);
  const auto rows = std::ssize(times), units = std::ssize(series.units);
  Eigen::MatrixXd of_units(rows, units + 1);  // column j: unit j at each time; last column: the long-term modulus
  Eigen::VectorXd sum(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double t = times[static_cast<std::size_t>(i)], over = 1 / scale(series, t);
    for (Eigen::Index j = 0; j < units; ++j)
      of_units(i, j) = over * std::exp(-t / series.units[static_cast<std::size_t>(j)].time);
    of_units(i, units) = series.long_term > 0 ? over : 0;
    sum[i] = over * series.modulus(t);
  }
  const Eigen::VectorXd moduli = fitting::non_negative_least_squares(of_units, sum, tolerance);
  PronySeries out;
  out.long_term = moduli[units];
  for (Eigen::Index j = 0; j < units; ++j)
    if (moduli[j] > 0) out.units.push_back({moduli[j], series.units[static_cast<std::size_t>(j)].time});
  return out;
}

}  // namespace macadam
