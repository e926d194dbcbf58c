// SPDX-License-Identifier: GPL-3.0-or-later
// load_curve.cpp  Sums the work of a load, and finds where and how steeply the load falls.
#include "host/experiments/transient/load_curve.hpp"

#include <algorithm>

namespace macadam {
namespace {

/// The work counts until the load has fallen to this value [N] (ASTM D8225, AASHTO T 393). The standards have specimens
/// that bear some kN.
constexpr double end_of_work = 100;
/// The same for small specimens, as a part of the largest load.
constexpr double end_of_small_work = 0.1;

}  // namespace

LoadCurve::LoadCurve(std::span<const StressSample> samples, const experiments::FittedPeak& peak, const Domain& domain) {
  const double area = section_area(domain), length = gauge_length(domain);
  results_.load_n = -peak.stress_pa * area;
  results_.displacement_m = -peak.strain * length;
  samples_.reserve(samples.size() + 1);
  samples_.push_back({0, 0});
  for (const StressSample& s : samples) samples_.push_back({-s.strain * length, -s.stress_pa * area});

  const double least_load = std::min(end_of_work, end_of_small_work * results_.load_n);
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample &last = samples_[k - 1], &now = samples_[k];
    results_.work_j += 0.5 * (now.load + last.load) * (now.displacement - last.displacement);
    results_.last_part = now.load / results_.load_n;
    if (now.displacement > results_.displacement_m && now.load < least_load) break;
  }
}

std::optional<double> LoadCurve::displacement_at(double part) const {
  const double wanted = part * results_.load_n;
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample &last = samples_[k - 1], &now = samples_[k];
    if (!(now.displacement > results_.displacement_m) || now.load > wanted) continue;
    const double fall = last.load - now.load, fraction = fall > 0 ? (last.load - wanted) / fall : 1;
    return last.displacement + std::clamp(fraction, 0.0, 1.0) * (now.displacement - last.displacement);
  }
  return {};
}

int LoadCurve::samples_between(double from, double to) const {
  return static_cast<int>(
      std::ranges::count_if(samples_, [&](const Sample& s) { return s.displacement >= from && s.displacement <= to; }));
}

std::optional<double> LoadCurve::steepest_fall(double window) const {
  if (!(window > 0 && results_.displacement_m > 0)) return {};
  double steepest = 0;
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample& end = samples_[k];
    const double begin = end.displacement - window;
    if (!(begin >= results_.displacement_m)) continue;
    std::size_t before = k;  // the last sample before the window begins; the origin at the latest
    while (samples_[before].displacement > begin) --before;
    const Sample &low = samples_[before], &high = samples_[before + 1];
    const double fraction = (begin - low.displacement) / (high.displacement - low.displacement);
    const double load = low.load + fraction * (high.load - low.load);
    steepest = std::max(steepest, (load - end.load) / window);
  }
  return steepest > 0 ? std::optional(steepest) : std::nullopt;
}

}  // namespace macadam
