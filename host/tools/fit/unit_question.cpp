// SPDX-License-Identifier: GPL-3.0-or-later
// unit_question.cpp  Recognises moduli in kPa or MPa, phases in radians and temperatures in kelvins by their size.
#include "host/tools/fit/unit_question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace macadam::fitting {
namespace {

/// Larger moduli are questioned [Pa]: no solid is stiffer than diamond, 1.2e12 Pa.
constexpr double stiffest_solid = 2e12;
/// Returns the modulus, |E*| or |G*| [Pa], below which the user is asked about the unit. `phase_deg` is the phase of
/// the stiffest measurement of the file. For bitumen, mastics, mixtures and other polymers this measurement is 1e8 Pa
/// or more if its phase is below 10 degrees (below the glass transition), and 1e6 Pa or more if its phase is below 45
/// degrees. Fluids have larger phases and smaller moduli. Rubber, gels and hot oils are softer. Their moduli can be
/// given in kPa or MPa, which are not questioned.
double smallest_modulus(double phase_deg) {
  if (phase_deg < 10) return 1e8;
  if (phase_deg < 45) return 1e6;
  if (phase_deg < 60) return 1e4;
  if (phase_deg < 75) return 1e3;
  return phase_deg < 85 ? 100 : 10;
}
/// Phases in radians are at most π/2, a little more with scatter.
constexpr double largest_radians = 1.66;
/// Temperatures beyond these are questioned [°C]. No material whose moduli shift with temperature is tested above 200
/// degrees C or below -123.15 degrees C (150 K).
constexpr double hottest = 200, coldest = -123.15;

void ask_about_moduli(const ModulusData& data, const ColumnsRead& columns, Complaints& complaints) {
  const std::string& column = columns.modulus;
  const auto less = [](const ModulusPoint& a, const ModulusPoint& b) { return a.e_star_pa < b.e_star_pa; };
  const auto [softest, stiffest] = std::minmax_element(data.points.begin(), data.points.end(), less);
  const double low = softest->e_star_pa / columns.modulus_factor, high = stiffest->e_star_pa / columns.modulus_factor;
  if (stiffest->e_star_pa > stiffest_solid) {
    complaints.add(0, "column " + column, fmt::format("moduli of up to {:.3g} Pa", high),
                   "less than 2e12 Pa; the moduli may be in another unit than the name of the column says");
  }
  const double phase = data.phases ? stiffest->phase_deg : 44;  // without phases, the limit for solids applies
  const double smallest = smallest_modulus(phase);
  if (!column.ends_with("_pa") || high >= smallest) return;
  complaints.add(
      0, "column " + column,
      fmt::format("moduli of {:.4g} to {:.4g} Pa{}", low, high,
                  data.phases ? fmt::format(" with a phase of {:.3g} degrees at the largest modulus", phase) : ""),
      fmt::format(
          "a largest modulus of at least {:.0e} Pa: is it in Pa? Moduli in MPa, GPa or kPa have a column such as "
          "{}_mpa",
          smallest, column.substr(0, column.size() - 3)));
}

/// Returns whether the moduli rise too steeply with frequency for the phases. The phase of a material is about 90
/// degrees times the slope d ln|E*|/d ln f (Kramers–Kronig relation). If phases are in radians, they are 57 times too
/// small for the slope.
bool moduli_contradict_phases(const ModulusData& data) {
  std::map<double, std::pair<const ModulusPoint*, const ModulusPoint*>> ends;  // slowest and fastest by temperature
  for (const ModulusPoint& p : data.points) {
    auto& [slow, fast] = ends.try_emplace(data.temperatures ? p.temperature_c : 0, &p, &p).first->second;
    if (p.frequency_hz < slow->frequency_hz) slow = &p;
    if (p.frequency_hz > fast->frequency_hz) fast = &p;
  }
  for (const auto& [temperature, slow_and_fast] : ends) {
    const auto& [slow, fast] = slow_and_fast;
    if (!(fast->frequency_hz >= 2 * slow->frequency_hz)) continue;
    const double slope =
        std::log(fast->e_star_pa / slow->e_star_pa) / std::log(fast->frequency_hz / slow->frequency_hz);
    // `90 * slope` is the expected phase; scatter of the moduli by some per cent does not raise it above 5 degrees
    if (90 * slope > std::max(5.0, 10 * std::max(slow->phase_deg, fast->phase_deg))) return true;
  }
  const auto less = [](const ModulusPoint& a, const ModulusPoint& b) { return a.e_star_pa < b.e_star_pa; };
  const auto [softest, stiffest] = std::minmax_element(data.points.begin(), data.points.end(), less);
  // The phases are at most 1.66. If they were in degrees, the material would be nearly elastic at every temperature and
  // frequency, and its moduli would hardly differ. So moduli that differ by more than a factor of two contradict the
  // phases.
  return stiffest->e_star_pa > 2 * softest->e_star_pa;
}

void ask_about_phases(const ModulusData& data, const ColumnsRead& columns, Complaints& complaints) {
  if (columns.phase != "phase_deg") return;
  const auto less = [](const ModulusPoint& a, const ModulusPoint& b) { return a.phase_deg < b.phase_deg; };
  const auto [low, high] = std::minmax_element(data.points.begin(), data.points.end(), less);
  if (high->phase_deg > largest_radians) return;
  // without moduli, phases of 0.2 radians (11 degrees) and more are taken for radians
  if (data.moduli ? !moduli_contradict_phases(data) : high->phase_deg < 0.2) return;
  complaints.add(
      0, "column phase_deg", fmt::format("phases of {:.3g} to {:.3g}", low->phase_deg, high->phase_deg),
      data.moduli
          ? "larger phases in degrees for such a change of the moduli; if these are radians, name the column phase_rad"
          : "larger phases in degrees; if these are radians, name the column phase_rad");
}

void ask_about_temperatures(const ModulusData& data, const std::string& column, Complaints& complaints) {
  const auto less = [](const ModulusPoint& a, const ModulusPoint& b) { return a.temperature_c < b.temperature_c; };
  const auto [low, high] = std::minmax_element(data.points.begin(), data.points.end(), less);
  if (column == "temperature_c" && low->temperature_c > hottest) {
    complaints.add(0, "column temperature_c",
                   fmt::format("temperatures of {} to {}", low->temperature_c, high->temperature_c),
                   "degrees Celsius; if these are kelvins, name the column temperature_k");
  }
  if (column == "temperature_k" && high->temperature_c < coldest) {
    constexpr double zero = laws::zero_celsius;
    complaints.add(
        0, "column temperature_k",
        fmt::format("temperatures of {:.4g} to {:.4g}", low->temperature_c + zero, high->temperature_c + zero),
        "kelvins; if these are degrees Celsius, name the column temperature_c");
  }
}

}  // namespace

void ask_about_units(const ModulusData& data, const ColumnsRead& columns, Complaints& complaints) {
  if (data.points.empty()) return;
  if (data.moduli) ask_about_moduli(data, columns, complaints);
  if (data.phases) ask_about_phases(data, columns, complaints);
  if (data.temperatures) ask_about_temperatures(data, columns.temperature, complaints);
}

}  // namespace macadam::fitting
