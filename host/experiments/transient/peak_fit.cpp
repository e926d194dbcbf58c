// SPDX-License-Identifier: GPL-3.0-or-later
// peak_fit.cpp  Fits a cubic polynomial to the stress of a strength test around its peak.
#include "host/experiments/transient/peak_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace macadam {
namespace {

/// The fit covers strains up to this fraction of the peak's strain on each side of the peak.
constexpr double range = 0.25;
constexpr std::size_t least_samples = 20;
constexpr double most_deviation = 0.02;  ///< root mean square, divided by the peak
constexpr double covered = 0.9;          ///< fraction of the range on each side that must contain samples

/// Fits the stress around `strain`, tension and compression both positive.
std::optional<experiments::FittedPeak> fit_around(std::span<const StressSample> samples, double sign, double strain) {
  const double unit = range * std::abs(strain);
  std::vector<double> at, stress;
  for (const StressSample& s : samples) {
    const double z = (s.strain - strain) * sign / unit;
    if (!(std::abs(z) <= 1)) continue;
    at.push_back(z), stress.push_back(sign * s.stress_pa);
  }
  if (at.size() < least_samples) return {};
  const auto [least, most] = std::minmax_element(at.begin(), at.end());
  if (*least > -covered || *most < covered) return {};

  const auto rows = static_cast<Eigen::Index>(at.size());
  const Eigen::Map<const Eigen::VectorXd> z(at.data(), rows), values(stress.data(), rows);
  Eigen::MatrixXd powers(rows, 4);
  powers.col(0).setOnes();
  for (Eigen::Index k = 1; k < 4; ++k) powers.col(k) = powers.col(k - 1).cwiseProduct(z);
  const Eigen::Vector4d p = powers.colPivHouseholderQr().solve(values);

  // The maximum is the root of 3·p3·z² + 2·p2·z + p1 where the second derivative is negative
  const double root = p[2] * p[2] - 3 * p[3] * p[1];
  if (!(root > 0)) return {};
  const double top = p[1] / (-p[2] + std::sqrt(root));
  if (!(std::abs(top) < 1)) return {};
  experiments::FittedPeak out;
  out.strain = strain + sign * unit * top;
  out.stress_pa = sign * (p[0] + top * (p[1] + top * (p[2] + top * p[3])));
  out.deviation_pa = std::sqrt((powers * p - values).squaredNorm() / static_cast<double>(rows));
  if (out.deviation_pa > most_deviation * std::abs(out.stress_pa)) return {};
  return out;
}

/// A parabola whose vertex is above the largest stress by more than this part of it is not used.
constexpr double most_above = 5e-3;

}  // namespace

std::optional<experiments::FittedPeak> fit_peak(std::span<const StressSample> samples, const experiments::Peak& peak) {
  if (peak.strain == 0) return {};
  const double sign = std::copysign(1.0, peak.strain);
  const auto first = fit_around(samples, sign, peak.strain);
  if (!first) return {};
  const auto second = fit_around(samples, sign, first->strain);
  return second ? second : first;
}

std::optional<experiments::FittedPeak> interpolate_peak(std::span<const StressSample> samples) {
  if (samples.size() < 3) return {};
  const double sign = std::copysign(1.0, samples.front().strain);
  const auto top = std::max_element(samples.begin(), samples.end(), [sign](const auto& a, const auto& b) {
    return sign * a.stress_pa < sign * b.stress_pa;
  });
  if (top == samples.begin() || top + 1 == samples.end()) return {};
  const double before = (top - 1)->strain - top->strain, after = (top + 1)->strain - top->strain;
  const double fall = (top - 1)->stress_pa - top->stress_pa, next = (top + 1)->stress_pa - top->stress_pa;
  const double bend = (next / after - fall / before) / (after - before), slope = fall / before - bend * before;
  if (!(before * after < 0) || !(sign * bend < 0)) return {};
  const double at = -0.5 * slope / bend, above = 0.5 * slope * at;
  // a parabola does not describe a stress that drops suddenly after its largest value
  if (sign * above > most_above * std::abs(top->stress_pa)) return {};
  return experiments::FittedPeak{top->strain + at, top->stress_pa + above, 0};
}

experiments::FittedPeak peak_of(const experiments::SteppedResponse& found) {
  return found.fitted.value_or(experiments::FittedPeak{found.peak->strain, found.peak->stress_pa, 0});
}

bool passed_peak(const experiments::SteppedResponse& found, double peak_pa) {
  if (found.rupture || (found.increments && found.increments->sudden_break)) return true;
  if (!found.cracks || found.points.empty()) return false;
  constexpr double fallen = 0.99;
  const bool damaged = found.cracks->points() > 0 || (found.cracks->sums && found.cracks->sums->cracked > 0);
  return damaged && std::abs(found.points.back().stress_pa) < fallen * std::abs(peak_pa);
}

}  // namespace macadam
