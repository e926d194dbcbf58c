// SPDX-License-Identifier: GPL-3.0-or-later
// modulus_scene.cpp  Evaluates the law of the mastic at each frequency and temperature.
#include "host/tools/ct/continuum/modulus_scene.hpp"

#include <fmt/format.h>

#include <complex>
#include <numbers>

#include "host/harmonic/law_stiffness.hpp"
#include "macadam/error.hpp"

namespace macadam::continuum {
namespace {

/// Returns the law of a phase as a material. \throws InputError if the modulus is not positive and finite.
Material material_of(const Scene& scene, const char* phase, std::complex<double> modulus, double poisson) {
  const double degrees = std::arg(modulus) * 180 / std::numbers::pi;
  if (!std::isfinite(std::abs(modulus)) || !(modulus.real() > 0) || !(degrees > -1e-9 && degrees < 90))
    throw InputError(scene.file.string(), 0, std::string("modulus of the ") + phase,
                     fmt::format("{:g} Pa with a phase angle of {:g} degrees", std::abs(modulus), degrees),
                     "a finite modulus above 0 with a phase angle from 0 to 90 degrees");
  return {std::abs(modulus), degrees, poisson};
}

/// Returns the value of a key. \throws InputError if the scene has no such key.
double given(const Scene& scene, const std::optional<double>& value, const char* key, const char* why) {
  if (!value) throw InputError(scene.file.string(), 0, key, "nothing", why);
  return *value;
}

}  // namespace

ScanPhases phases_of(const Scene& scene) {
  const std::string file = scene.file.string();
  if (scene.network.rule != ContactRule::series)
    throw InputError(file, 0, "rule in [network]", std::string("\"") + to_string(scene.network.rule) + '"',
                     "\"series\", with the laws of the phases in [materials.mastic] and [materials.aggregate]");
  if (scene.network.lateral_walls)
    throw InputError(file, 0, "lateral_walls in [network]", "true", "false, because the sides of a scan are free");
  const auto& law = scene.laws[static_cast<std::size_t>(PairType::mm)];
  if (!law)
    throw InputError(file, 0, "law in [materials.mastic]", "nothing", "a law, \"generalised_kelvin\" or \"elastic\"");
  const double rock = given(scene, scene.materials.rock_modulus, "law in [materials.aggregate]",
                            "law = \"elastic\", and E, the modulus of the rock");
  const double nu = given(scene, scene.materials.mastic_poisson_ratio, "poisson_ratio in [materials.mastic]",
                          "Poisson's ratio of the mastic");
  ScanPhases out{material_of(scene, "aggregate", rock,
                             given(scene, scene.materials.aggregate_poisson_ratio,
                                   "poisson_ratio in [materials.aggregate]", "Poisson's ratio of the rock")),
                 {}};
  const std::vector<double> frequencies = frequencies_of(scene.experiment);
  if (frequencies.empty() || std::holds_alternative<experiments::Torsion>(scene.experiment))
    throw InputError(file, 0, "kind in [loading]", std::string("\"") + kind_of(scene.experiment) + '"',
                     "\"cyclic\" or \"sweep\", which give the frequencies");
  const auto add = [&](const LawTable& laws, std::optional<double> temperature) {
    for (const double frequency : frequencies) {
      const std::complex<double> s{0, 2 * std::numbers::pi * frequency};
      const auto modulus = with_stiffness<std::complex<double>>(
          PairType::mm, *laws[static_cast<std::size_t>(PairType::mm)], [&](const auto& l) { return l.stiffness(s); });
      out.points.push_back({frequency, temperature, material_of(scene, "mastic", modulus, nu)});
    }
  };
  const std::vector<double> temperatures = temperatures_of(scene.experiment);
  if (temperatures.empty()) add(scene.laws, scene.materials.temperature);
  for (const double temperature : temperatures) add(laws_at(scene, temperature), temperature);
  return out;
}

}  // namespace macadam::continuum
