// SPDX-License-Identifier: GPL-3.0-or-later
// free_parameters.cpp  Finds the free parameters and their bounds, and checks the user's options.
#include "host/tools/calibration/free_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/in_quotes.hpp"
#include "host/base/nearest.hpp"
#include "macadam/error.hpp"

namespace macadam::calibration {
namespace {

/// Factor by which a parameter without bounds may change in each direction (four decades). A larger change is not
/// plausible.
constexpr double unbounded = 1e4;
[[noreturn]] void refuse(const std::string& what, const std::string& found, const std::string& expected) {
  throw InputError("calibration", 0, what, found, expected);
}

}  // namespace

void require_valid_input(const Scene& scene, const ModulusData& data, const CalibrationOptions& options) {
  const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
  if (!scene.specimen.box.has_uniform_section() || scene.specimen.box.rollers() ||
      std::holds_alternative<experiments::Torsion>(scene.experiment))
    throw InputError(scene.file.string(), 0, "kind in [loading]", std::string("\"") + kind_of(scene.experiment) + '"',
                     "\"cyclic\" or \"sweep\", whose moduli a calibration compares with the measured ones");
  if (data.points.empty()) throw InputError(data.source, 0, "measurements", "none", "at least one");
  const bool counts_modulus = options.misfit != Misfit::phase, counts_phase = options.misfit != Misfit::modulus;
  if ((counts_modulus && !data.moduli) || (counts_phase && !data.phases)) {
    throw InputError(data.source, 0, "measurements", data.moduli ? "no phase angles" : "no moduli",
                     fmt::format("{}, because misfit is \"{}\"", data.moduli ? "phase angles" : "moduli",
                                 to_string(options.misfit)));
  }
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const ModulusPoint& p = data.points[i];
    if (!positive(p.frequency_hz) || (data.moduli && !positive(p.e_star_pa)) || !(std::abs(p.phase_deg) < 180) ||
        (data.temperatures && !std::isfinite(p.temperature_c)) ||
        (data.deviations &&
         ((counts_modulus && !positive(p.e_star_std)) || (counts_phase && !positive(p.phase_std))))) {
      throw InputError(data.source, 0, fmt::format("measurement {}", i + 1), "an invalid number",
                       "finite numbers, and a positive frequency, |E*| and standard deviations");
    }
  }
  if (!positive(options.e_star_deviation) || !positive(options.phase_deviation)) {
    refuse("standard deviations", fmt::format("{} and {}", options.e_star_deviation, options.phase_deviation),
           "positive numbers");
  }
  if (options.seeds < 1) refuse("seeds", fmt::format("{}", options.seeds), "at least 1");
  if (options.seeds > 1 && scene.specimen.file) {
    refuse("seeds", fmt::format("{} for a specimen from a file", options.seeds),
           "1, because only generated specimens have seeds");
  }
}

std::vector<Parameter> free_parameters(const Scene& scene, const CalibrationOptions& options,
                                       std::vector<CalibratedParameter>& out) {
  const std::vector<Parameter> known = parameters_of(scene);
  std::vector<std::string> names;
  for (const Parameter& p : known) names.push_back(p.name);
  if (options.free.empty()) refuse("free parameters", "none", fmt::format("one or more of {}", fmt::join(names, ", ")));
  std::vector<Parameter> free;
  for (const FreeParameter& asked : options.free) {
    const auto at = std::find(names.begin(), names.end(), asked.name);
    if (at == names.end()) {
      refuse("free parameters", in_quotes(asked.name),
             names.empty() ? "no free parameter, because the scene has no laws" : expected_one_of(asked.name, names));
    }
    const Parameter& p = known[static_cast<std::size_t>(at - names.begin())];
    for (const Parameter& other : free)
      if (other.name == p.name) refuse("free parameters", p.name + " twice", "each parameter once");
    const double low = asked.low.value_or(p.value / unbounded), high = asked.high.value_or(p.value * unbounded);
    if (!(low > 0 && high > low && std::isfinite(high))) {
      refuse("bounds of " + p.name, fmt::format("{:g} and {:g}", low, high), "positive numbers, the lower one first");
    }
    if (asked.prior && !(*asked.prior > 0 && std::isfinite(*asked.prior) && asked.prior_deviation > 0 &&
                         std::isfinite(asked.prior_deviation))) {
      refuse("prior of " + p.name, fmt::format("{:g} with deviation {:g}", *asked.prior, asked.prior_deviation),
             "a positive value and a positive standard deviation of its natural logarithm");
    }
    free.push_back(p);
    out.push_back({p.name, p.unit, p.value, p.value, 0, low, high, false});
  }
  return free;
}

}  // namespace macadam::calibration
