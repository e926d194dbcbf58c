// SPDX-License-Identifier: GPL-3.0-or-later
// unit_question.cpp  Recognises moduli in MPa and temperatures in kelvins by their size.
#include "host/tools/fit/unit_question.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace macadam::fitting {
namespace {

/// Larger moduli are questioned [Pa]: no solid is stiffer than diamond, 1.2e12 Pa.
constexpr double stiffest_solid = 2e12;
/// Returns the modulus [Pa] below which the largest modulus of a file is questioned, for its phase. Bitumen, mastics,
/// mixtures and other polymers below their glass transition have 1e8 Pa and more at phases below 10 degrees, and 1e6 Pa
/// and more at phases below 45. Rubber and gels are softer, but their moduli are given in kPa or MPa, which is not
/// questioned.
double least_modulus(double phase_deg) { return phase_deg < 10 ? 1e8 : phase_deg < 45 ? 1e6 : 0; }
/// Temperatures beyond these are questioned [°C]. No material whose moduli shift with temperature is tested above 200
/// degrees C or below -123.15 degrees C (150 K).
constexpr double hottest = 200, coldest = -123.15;

void ask_about_moduli(const ModulusData& data, const std::string& column, Complaints& complaints) {
  const auto less = [](const ModulusPoint& a, const ModulusPoint& b) { return a.e_star_pa < b.e_star_pa; };
  const auto [softest, stiffest] = std::minmax_element(data.points.begin(), data.points.end(), less);
  if (stiffest->e_star_pa > stiffest_solid) {
    complaints.add(0, "column " + column, fmt::format("moduli of up to {:.3g} Pa", stiffest->e_star_pa),
                   "less than 2e12 Pa: are they in another unit than the name of the column says?");
  }
  const double phase = data.phases ? stiffest->phase_deg : 44;  // without phases the material is taken for a solid
  if (!column.ends_with("_pa") || stiffest->e_star_pa >= least_modulus(phase)) return;
  complaints.add(
      0, "column " + column,
      fmt::format("moduli of {:.4g} to {:.4g} Pa{}", softest->e_star_pa, stiffest->e_star_pa,
                  data.phases ? fmt::format(" with a phase of {:.3g} degrees at the stiffest", phase) : ""),
      fmt::format("at least {:.0e} Pa there: is it in Pa? Moduli in MPa, GPa or kPa have a column such as {}_mpa",
                  least_modulus(phase), column.substr(0, column.size() - 3)));
}

void ask_about_temperatures(const ModulusData& data, const std::string& column, Complaints& complaints) {
  const auto less = [](const ModulusPoint& a, const ModulusPoint& b) { return a.temperature_c < b.temperature_c; };
  const auto [low, high] = std::minmax_element(data.points.begin(), data.points.end(), less);
  if (column == "temperature_c" && low->temperature_c > hottest) {
    complaints.add(0, "column temperature_c",
                   fmt::format("temperatures of {} to {}", low->temperature_c, high->temperature_c),
                   "degrees Celsius: are these kelvins? They have a column temperature_k");
  }
  if (column == "temperature_k" && high->temperature_c < coldest) {
    constexpr double zero = laws::zero_celsius;
    complaints.add(
        0, "column temperature_k",
        fmt::format("temperatures of {:.4g} to {:.4g}", low->temperature_c + zero, high->temperature_c + zero),
        "kelvins: are these degrees Celsius? They have a column temperature_c");
  }
}

}  // namespace

void ask_about_units(const ModulusData& data, const std::string& modulus_column, const std::string& temperature_column,
                     Complaints& complaints) {
  if (data.points.empty()) return;
  if (data.moduli) ask_about_moduli(data, modulus_column, complaints);
  if (data.temperatures) ask_about_temperatures(data, temperature_column, complaints);
}

}  // namespace macadam::fitting
