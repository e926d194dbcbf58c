// SPDX-License-Identifier: GPL-3.0-or-later
// problem.cpp  Checks that the measurements are valid and that there are enough temperatures to fit the shift law.
#include "host/tools/fit/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/tools/fit/isotherms.hpp"
#include "macadam/error.hpp"

namespace macadam::fitting {
namespace {

/// \throws InputError when measurements are invalid or options out of range.
void check(const ModulusData& data, const FitOptions& options) {
  const auto refuse = [&](const std::string& what, const std::string& found, const std::string& expected) {
    throw InputError(data.source, 0, what, found, expected);
  };
  if (data.points.empty()) refuse("measurements", "none", "at least two");
  if (!data.moduli || !data.phases)
    refuse("measurements", data.moduli ? "no phase angles" : "no moduli",
           "both, because a law is fitted to modulus and phase");
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const ModulusPoint& p = data.points[i];
    const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
    if (!positive(p.frequency_hz) || !positive(p.e_star_pa) || !std::isfinite(p.phase_deg) ||
        (data.temperatures && !(p.temperature_c > -laws::zero_celsius && std::isfinite(p.temperature_c))) ||
        (data.deviations && !(positive(p.e_star_std) && positive(p.phase_std)))) {
      refuse(fmt::format("measurement {}", i + 1), "an invalid number",
             "finite numbers, and a positive frequency, |E*| and standard deviations");
    }
  }
  constexpr int most_possible = laws::GeneralisedKelvin::max_units;
  if (options.units && (*options.units < 0 || *options.units > most_possible)) {
    refuse("units", fmt::format("{}", *options.units), fmt::format("0 to {}", most_possible));
  }
  if (options.most_units < 0 || options.most_units > most_possible) {
    refuse("most units", fmt::format("{}", options.most_units), fmt::format("0 to {}", most_possible));
  }
  if (!(options.e_star_deviation > 0 && options.phase_deviation > 0)) {
    refuse("standard deviations", fmt::format("{} and {}", options.e_star_deviation, options.phase_deviation),
           "positive numbers");
  }
}

/// \throws InputError when the measured temperatures do not determine the shift law that the user asks for.
void check_shift(const ModulusData& data, const FitOptions& options, const std::vector<Isotherm>& isotherms) {
  const auto refuse = [&](const std::string& what, const std::string& found, const std::string& expected) {
    throw InputError(data.source, 0, what, found, expected);
  };
  const std::size_t count = isotherms.size();
  if (options.shift == ShiftKind::none && count > 1) {
    refuse("temperatures", fmt::format("{} temperatures", count), "one, or a shift law: wlf, arrhenius or free");
  }
  const std::size_t needed = options.shift == ShiftKind::none ? 0 : options.shift == ShiftKind::wlf ? 3 : 2;
  if (count < needed) {
    refuse(fmt::format("temperatures for the shift law {}", to_string(options.shift)),
           data.temperatures ? fmt::format("{}", count) : "no column temperature_c",
           fmt::format("at least {}", needed));
  }
  if (options.shift == ShiftKind::free) {
    for (std::size_t i = 1; i < count; ++i) {
      if (isotherms[i].lowest - isotherms[i - 1].highest > same_isotherm) continue;
      refuse(
          "column temperature_c",
          fmt::format("readings without a gap from {} to {} degrees C", isotherms[i - 1].lowest, isotherms[i].highest),
          fmt::format("temperatures whose readings lie within {} K, or the shift law wlf or arrhenius",
                      widest_isotherm));
    }
  }
  if (!options.reference_temperature) return;
  const double wanted = *options.reference_temperature;
  const bool measured = std::any_of(isotherms.begin(), isotherms.end(), [&](const Isotherm& isotherm) {
    return distance_from(isotherm, wanted) <= same_isotherm;
  });
  if (options.shift == ShiftKind::none && !(count == 1 && data.temperatures && measured)) {
    refuse("reference temperature", fmt::format("{} degrees C without a shift law", wanted),
           "no reference temperature, or measurements at several temperatures and a shift law");
  }
  if (!(wanted > -laws::zero_celsius && std::isfinite(wanted))) {
    refuse("reference temperature", fmt::format("{}", wanted), "a temperature in degrees Celsius");
  }
  if (options.shift == ShiftKind::free && !measured) {
    std::vector<double> temperatures;
    for (const Isotherm& isotherm : isotherms) temperatures.push_back(isotherm.temperature);
    refuse("reference temperature", fmt::format("{}", wanted),
           fmt::format("one of the measured temperatures, because the shift is \"free\": {} degrees C",
                       fmt::join(temperatures, ", ")));
  }
}

}  // namespace

std::vector<ShiftKind> contained_shift_laws(const Problem& problem) {
  const ShiftKind shift = problem.unknowns.shift;
  if (shift != ShiftKind::wlf && shift != ShiftKind::free) return {};
  if (shift == ShiftKind::wlf || problem.temperatures.size() < 3) return {ShiftKind::arrhenius};
  return {ShiftKind::arrhenius, ShiftKind::wlf};
}

Problem make_problem(const ModulusData& data, const FitOptions& options) {
  check(data, options);
  Problem out;
  std::vector<double> readings;
  for (const ModulusPoint& p : data.points) readings.push_back(data.temperatures ? p.temperature_c : 0);
  const std::vector<Isotherm> isotherms = isotherms_of(std::move(readings));
  check_shift(data, options, isotherms);
  for (const Isotherm& isotherm : isotherms) out.temperatures.push_back(isotherm.temperature);
  Unknowns& u = out.unknowns;
  u.model = options.model;
  u.shift = options.shift;
  u.isotherms = isotherms.size();
  u.reference_isotherm = (isotherms.size() - 1) / 2;
  u.reference_temperature = out.temperatures[u.reference_isotherm];
  out.wanted_reference = options.reference_temperature.value_or(u.reference_temperature);
  out.wanted_isotherm = isotherm_at(isotherms, out.wanted_reference);
  for (const ModulusPoint& p : data.points) {
    Target t;
    t.place = {2 * std::numbers::pi * p.frequency_hz, data.temperatures ? p.temperature_c : 0, 0};
    t.place.isotherm = isotherm_at(isotherms, t.place.temperature);
    t.log_modulus = std::log(p.e_star_pa);
    t.phase = p.phase_deg * degree;
    t.modulus_deviation = data.deviations ? p.e_star_std / p.e_star_pa : options.e_star_deviation;
    t.phase_deviation = (data.deviations ? p.phase_std : options.phase_deviation) * degree;
    out.targets.push_back(t);
  }
  return out;
}

}  // namespace macadam::fitting
