// SPDX-License-Identifier: GPL-3.0-or-later
// isotherms.cpp  Joins readings that differ by tenths of a kelvin into one temperature.
#include "host/tools/fit/isotherms.hpp"

#include <algorithm>
#include <cmath>

namespace macadam::fitting {

std::vector<Isotherm> isotherms_of(std::vector<double> readings) {
  std::sort(readings.begin(), readings.end());
  std::vector<Isotherm> out;
  auto first = readings.begin();
  while (first != readings.end()) {
    auto end = first + 1;
    while (end != readings.end() && *end - *(end - 1) <= same_isotherm && *end - *first <= widest_isotherm) ++end;
    double sum = 0;
    for (auto at = first; at != end; ++at) sum += *at;
    const double mean = sum / static_cast<double>(end - first);
    const bool same = *first == *(end - 1);
    out.push_back({same ? *first : std::round(100 * mean) / 100, *first, *(end - 1)});
    first = end;
  }
  return out;
}

double distance_from(const Isotherm& isotherm, double temperature) {
  return std::max({isotherm.lowest - temperature, temperature - isotherm.highest, 0.0});
}

std::size_t isotherm_at(const std::vector<Isotherm>& isotherms, double temperature) {
  const auto nearest = std::min_element(isotherms.begin(), isotherms.end(), [&](const auto& a, const auto& b) {
    return distance_from(a, temperature) < distance_from(b, temperature);
  });
  return static_cast<std::size_t>(nearest - isotherms.begin());
}

}  // namespace macadam::fitting
