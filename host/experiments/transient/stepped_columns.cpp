// SPDX-License-Identifier: GPL-3.0-or-later
// stepped_columns.cpp  Writes stresses at the walls, broken points and energies of a point of a stepped test.
#include "host/experiments/transient/stepped_columns.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace macadam {

using experiments::Energies;
using experiments::SteppedPoint;

namespace {

using Column = std::pair<const char*, double Energies::*>;
constexpr std::array<Column, 8> energy_columns{{{"crack_energy_j", &Energies::crack_j},
                                                {"viscous_energy_j", &Energies::viscous_j},
                                                {"elastic_energy_j", &Energies::elastic_j},
                                                {"friction_energy_j", &Energies::friction_j},
                                                {"kinetic_energy_j", &Energies::kinetic_j},
                                                {"work_j", &Energies::work_j},
                                                {"damping_energy_j", &Energies::damping_j},
                                                {"thermal_work_j", &Energies::thermal_j}}};

/// Calls f(name, member) for each energy that has a column.
template <class F>
void each_energy(bool damping, bool thermal, F&& f) {
  for (const auto& [name, member] : energy_columns) {
    if ((damping || member != &Energies::damping_j) && (thermal || member != &Energies::thermal_j)) f(name, member);
  }
}

}  // namespace

std::string SteppedColumns::head() const {
  std::string out = length > 0 ? "displacement_m,load_n," : "";
  out += fmt::format("error,{}bottom_pa,kinetic_j", top ? "top_pa," : "");
  if (energies) out += ",cracked_points";
  if (broken) out += ",broken_points";
  if (energies)
    each_energy(damping, temperature, [&](const char* name, double Energies::*) { out += fmt::format(",{}", name); });
  if (sides) out += ",poisson_ratio";
  if (temperature) out += ",temperature_c";
  return out;
}

std::string SteppedColumns::line(const SteppedPoint& p) const {
  std::string out = length > 0 ? fmt::format("{},{},", -p.strain * length, -p.stress_pa * section) : "";
  out += fmt::format("{:.2e},{}{},{}", p.error, top ? fmt::format("{},", p.top_pa) : "", p.bottom_pa, p.kinetic_j);
  if (energies) out += fmt::format(",{}", p.cracks.cracked);
  if (broken) out += fmt::format(",{}", p.broken_points);
  if (energies) {
    each_energy(damping, temperature,
                [&](const char*, double Energies::*member) { out += fmt::format(",{}", p.energies.*member); });
  }
  if (sides) out += std::isfinite(p.poisson_ratio) ? fmt::format(",{}", p.poisson_ratio) : ",";
  if (temperature) out += fmt::format(",{}", p.temperature_c);
  return out;
}

void add_energies(const Energies& energies, bool damping, bool thermal, nlohmann::ordered_json& point) {
  each_energy(damping, thermal, [&](const char* name, double Energies::*member) {
    const double value = energies.*member;
    point[name] = std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  });
}

}  // namespace macadam
