// SPDX-License-Identifier: GPL-3.0-or-later
// bands.cpp  Computes predictions of a fit between and beyond the measurements: curves with confidence limits. Also
// defines the names of the options.
#include <fmt/format.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <limits>
#include <numbers>

#include "host/tools/fit/least_squares.hpp"
#include "macadam/error.hpp"

namespace macadam {

const char* to_string(FitModel model) {
  switch (model) {
    case FitModel::kelvin:
      return "kelvin";
    case FitModel::two_s2p1d:
      return "2s2p1d";
    case FitModel::huet_sayegh:
      return "huet-sayegh";
  }
  return "unknown";
}
const char* to_string(ShiftKind shift) {
  switch (shift) {
    case ShiftKind::none:
      return "none";
    case ShiftKind::wlf:
      return "wlf";
    case ShiftKind::arrhenius:
      return "arrhenius";
    case ShiftKind::free:
      return "free";
  }
  return "unknown";
}
const char* to_string(Criterion criterion) {
  switch (criterion) {
    case Criterion::aicc:
      return "AICc";
    case Criterion::bic:
      return "BIC";
  }
  return "unknown";
}

std::complex<double> Fit::stiffness(std::complex<double> s) const {
  return std::visit([&](const auto& m) { return m.stiffness(s); }, model);
}

std::pair<double, double> Fit::reduced_range() const {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const FittedPoint& p : points) {
    const double f = p.measured.frequency_hz * std::pow(10.0, p.log10_a_T);
    low = std::min(low, f);
    high = std::max(high, f);
  }
  return {low, high};
}

laws::LawRange Fit::range() const {
  laws::LawRange out;
  std::tie(out.lowest_hz, out.highest_hz) = reduced_range();
  if (!temperatures) return out;
  const auto [coldest, warmest] = std::minmax_element(
      points.begin(), points.end(),
      [](const FittedPoint& a, const FittedPoint& b) { return a.measured.temperature_c < b.measured.temperature_c; });
  out.lowest_c = coldest->measured.temperature_c, out.highest_c = warmest->measured.temperature_c;
  return out;
}

std::vector<BandPoint> confidence_bands(const Fit& fit, const std::vector<double>& frequencies_hz, double level) {
  using namespace fitting;
  if (!(level > 0 && level < 1)) {
    throw InputError("confidence bands", 0, "level", fmt::format("{}", level), "a number between 0 and 1");
  }
  Unknowns u;  // at the reference temperature the shift factor is 1 and its parameters have no effect
  u.model = fit.options.model;
  if (const auto* chain = std::get_if<laws::GeneralisedKelvin>(&fit.model)) {
    u.units = chain->units();
    u.flow = std::isfinite(chain->C_m);
  }
  std::vector<double> theta;
  for (std::size_t i = 0; i < u.count(); ++i) {
    const FitParameter& p = fit.parameters[i];
    theta.push_back(p.logarithmic ? std::log(p.value) : p.value);
  }
  std::vector<Place> places;
  for (const double f : frequencies_hz) {
    if (!(f > 0 && std::isfinite(f))) {
      throw InputError("confidence bands", 0, "frequency", fmt::format("{} Hz", f), "a positive number");
    }
    places.push_back({2 * std::numbers::pi * f, 0, 0});
  }
  const double tail = 0.5 * (1 + level);
  const double times = fit.deviations ? boost::math::quantile(boost::math::normal(), tail)
                                      : boost::math::quantile(boost::math::students_t(fit.degrees_of_freedom), tail);
  const std::size_t row = fit.parameters.size();
  const auto deviation = [&](const std::vector<double>& by) {
    double sum = 0;
    for (std::size_t i = 0; i < by.size(); ++i)
      for (std::size_t k = 0; k < by.size(); ++k) sum += by[i] * fit.covariance[i * row + k] * by[k];
    return std::sqrt(std::max(sum, 0.0));
  };
  std::vector<BandPoint> out;
  const std::vector<Prediction> predictions = predict(u, places, theta);
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    const Prediction& p = predictions[i];
    constexpr double degree = std::numbers::pi / 180;
    const double modulus = times * deviation(p.log_modulus_by), phase = times * deviation(p.phase_by) / degree;
    BandPoint b;
    b.frequency_hz = frequencies_hz[i];
    b.e_star_pa = std::exp(p.value.log_modulus);
    b.e_star_low = b.e_star_pa * std::exp(-modulus);
    b.e_star_high = b.e_star_pa * std::exp(modulus);
    b.phase_deg = p.value.phase / degree;
    b.phase_low = b.phase_deg - phase;
    b.phase_high = b.phase_deg + phase;
    out.push_back(b);
  }
  return out;
}

}  // namespace macadam
