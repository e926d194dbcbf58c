// SPDX-License-Identifier: GPL-3.0-or-later
/// \file size_law.cpp  Computes quantiles and means of the size laws, and draws stratified samples with a given total
/// volume.
#include "host/spheres/size_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace macadam {

double sphere_volume(double diameter) { return std::numbers::pi / 6 * diameter * diameter * diameter; }

double SizeRange::quantile(double u) const {
  double d = min;
  switch (law) {
    case SizeLaw::log_uniform:
      d = min * std::exp(u * std::log(max / min));
      break;
    case SizeLaw::uniform:
      d = min + u * (max - min);
      break;
    case SizeLaw::volume_uniform: {
      const double ratio = min / max;
      d = min / std::sqrt(1 - u * (1 - ratio * ratio));
    }
  }
  return std::clamp(d, min, max);  // rounding must not leave the range of the sieves
}

double SizeRange::mean_volume() const {
  const double a = min, b = max, q = std::log(b / a);
  double mean_cube = 0;
  switch (law) {
    case SizeLaw::log_uniform:
      mean_cube = q > 0 ? a * a * a * std::expm1(3 * q) / (3 * q) : a * a * a;
      break;
    case SizeLaw::uniform:
      mean_cube = (a + b) * (a * a + b * b) / 4;
      break;
    case SizeLaw::volume_uniform:
      mean_cube = 2 * a * a * b * b / (a + b);
  }
  return std::numbers::pi / 6 * mean_cube;
}

std::vector<double> draw_diameters(const SizeRange& range, std::int64_t count, double volume, RandomStream& random) {
  return draw_sizes(range, count, volume, random, [](std::size_t, double d) { return sphere_volume(d); });
}

std::vector<double> draw_sizes(const SizeRange& range, std::int64_t count, double volume, RandomStream& random,
                               const std::function<double(std::size_t i, double d)>& volume_of) {
  const auto n = static_cast<std::size_t>(count);
  std::vector<double> log_share(n), diameter(n);
  for (std::size_t i = 0; i < n; ++i)
    log_share[i] = std::log((static_cast<double>(i) + random.uniform()) / static_cast<double>(n));
  // Sets the diameters for the exponent t of the map u → u^t and returns the sum of the volumes.
  const auto bend = [&](double t) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      diameter[n - 1 - i] = range.quantile(std::exp(t * log_share[i]));
      sum += volume_of(n - 1 - i, diameter[n - 1 - i]);
    }
    return sum;
  };
  // The sum decreases with t, so t is found by bisection of log t. At the ends of the interval all probabilities are 1
  // or 0 up to rounding.
  double low = -40, high = 40;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    const double excess = bend(std::exp(middle)) - volume;
    if (std::abs(excess) <= 1e-13 * volume) break;
    (excess > 0 ? low : high) = middle;
  }
  return diameter;
}

}  // namespace macadam
