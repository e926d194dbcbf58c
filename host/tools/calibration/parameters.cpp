// SPDX-License-Identifier: GPL-3.0-or-later
// parameters.cpp  Lists the parameters of a scene's laws with their values, and changes them.
#include "host/tools/calibration/parameters.hpp"

#include <cmath>

#include "macadam/error.hpp"
#include "macadam/laws/values.hpp"
#include "macadam/sensitivity.hpp"

namespace macadam::calibration {

using laws::each_value;
using laws::ValueKind;

namespace {

/// Returns the factor by which the temperature of the scene multiplies the viscosities of a pair's law. The scene's
/// laws are at the scene's temperature, but the file gives them at the reference temperature.
double shift_of(const Scene& scene, std::size_t pair) {
  return scene.materials.temperature
             ? std::pow(10.0, laws::log10_shift(scene.shifts[pair], *scene.materials.temperature))
             : 1;
}

/// Returns the parameters of the phases, for the rule "series".
std::vector<Parameter> parameters_of_phases(const Scene& scene) {
  std::vector<Parameter> out;
  constexpr auto mm = static_cast<std::size_t>(PairType::mm);
  if (scene.laws[mm]) {
    Law law = *scene.laws[mm];
    const double shift = shift_of(scene, mm);
    std::visit(
        [&](auto& l) {
          each_value(l, [&](const std::string& key, double& value, ValueKind kind, laws::ValueNeed) {
            const bool viscous = kind == ValueKind::viscosity;
            if (value > 0 && std::isfinite(value))
              out.push_back({"mastic." + key, viscous ? "Pa s" : "Pa", Phase::mastic, PairType::mm, key,
                             value / (viscous ? shift : 1)});
          });
        },
        law);
  }
  constexpr auto inner = static_cast<std::size_t>(PairType::inner);
  if (scene.laws[inner])
    out.push_back(
        {"aggregate.E", "Pa", Phase::aggregate, PairType::inner, "E", std::get<laws::Elastic>(*scene.laws[inner]).E});
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(const Scene& scene) {
  if (scene.network.rule == ContactRule::volumetric)
    throw InputError(
        scene.file.string(), 0, "rule in [network]", "\"volumetric\"",
        "\"centres\" or \"series\", because the reduced model of calibration does not contain the pressures of "
        "cells");
  if (scene.network.rule == ContactRule::series) return parameters_of_phases(scene);
  std::vector<Parameter> out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!scene.laws[pair]) continue;
    const auto add = [&](const std::string& key, const char* unit, double value) {
      if (value > 0 && std::isfinite(value))
        out.push_back({std::string(to_string(static_cast<PairType>(pair))) + "." + key,
                       unit,
                       {},
                       static_cast<PairType>(pair),
                       key,
                       value});
    };
    const double delta = scene.deltas[pair], shift = shift_of(scene, pair);
    add("delta", "", delta);
    Law law = *scene.laws[pair];
    std::visit(
        [&](auto& l) {
          add("alpha", "", l.alpha);
          each_value(l, [&](const std::string& key, double& value, ValueKind kind, laws::ValueNeed) {
            const bool viscous = kind == ValueKind::viscosity;
            const double factor = kind == ValueKind::strength ? 1 : delta;
            add(key, viscous ? "Pa s" : "Pa", value / factor / (viscous ? shift : 1));
          });
        },
        law);
  }
  return out;
}

namespace {

/// Multiplies a parameter of one law by a factor.
void multiply(Law& own, const Parameter& parameter, double factor) {
  std::visit(
      [&](auto& law) {
        if (parameter.key == "alpha") law.alpha *= factor;
        each_value(law, [&](const std::string& key, double& value, ValueKind kind, laws::ValueNeed) {
          const bool scaled = parameter.key == "delta" && kind != ValueKind::strength;
          if (scaled || parameter.key == key) value *= factor;
        });
      },
      own);
}

}  // namespace

void multiply(LawTable& laws, const Parameter& parameter, double factor) {
  if (!parameter.phase) return multiply(*laws[static_cast<std::size_t>(parameter.pair)], parameter, factor);
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const bool of_phase = is_of_mastic(static_cast<PairType>(pair)) == (*parameter.phase == Phase::mastic);
    if (laws[pair] && of_phase) multiply(*laws[pair], parameter, factor);
  }
}

double rock_compliance(const Scene& scene, const LawTable& laws) {
  const auto& rock = laws[static_cast<std::size_t>(PairType::inner)];
  if (scene.network.rule != ContactRule::series || !rock || !scene.materials.rock_modulus) return 1;
  return *scene.materials.rock_modulus / std::get<laws::Elastic>(*rock).E;
}

}  // namespace macadam::calibration
