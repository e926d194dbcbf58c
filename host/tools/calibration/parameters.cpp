// SPDX-License-Identifier: GPL-3.0-or-later
// parameters.cpp  Lists the parameters of a scene's laws with their values, and changes them.
#include "host/tools/calibration/parameters.hpp"

#include <cmath>

#include "macadam/laws/values.hpp"

namespace macadam::calibration {

using laws::each_value;
using laws::ValueKind;

std::vector<Parameter> parameters_of(const Scene& scene) {
  std::vector<Parameter> out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!scene.laws[pair]) continue;
    const auto add = [&](const std::string& key, const char* unit, double value) {
      if (value > 0 && std::isfinite(value))
        out.push_back({std::string(to_string(static_cast<PairType>(pair))) + "." + key, unit,
                       static_cast<PairType>(pair), key, value});
    };
    const double delta = scene.deltas[pair];
    // the scene's laws are at the scene's temperature, but the file gives them at the reference temperature
    const double shift = scene.materials.temperature
                             ? std::pow(10.0, laws::log10_shift(scene.shifts[pair], *scene.materials.temperature))
                             : 1;
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

void multiply(LawTable& laws, const Parameter& parameter, double factor) {
  std::visit(
      [&](auto& law) {
        if (parameter.key == "alpha") law.alpha *= factor;
        each_value(law, [&](const std::string& key, double& value, ValueKind kind, laws::ValueNeed) {
          const bool scaled = parameter.key == "delta" && kind != ValueKind::strength;
          if (scaled || parameter.key == key) value *= factor;
        });
      },
      *laws[static_cast<std::size_t>(parameter.pair)]);
}

}  // namespace macadam::calibration
