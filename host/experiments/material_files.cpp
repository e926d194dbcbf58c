// SPDX-License-Identifier: GPL-3.0-or-later
// material_files.cpp  Writes the Prony series and the Kelvin chain of a material in four file formats. Each file states
// the units of measurement and the assumptions.
#include "host/experiments/material_files.hpp"

#include <fmt/format.h>

#include "host/experiments/material_solution.hpp"
#include "host/files/result_files.hpp"

namespace macadam {
namespace {

using experiments::Material;

/// Factor on the fractions g_i/E(0) of the units of a fluid. A fluid has no long-term modulus, so without this factor
/// the fractions would add up to 1, which finite-element programs refuse.
constexpr double of_a_fluid = 1 - 1e-8;

/// Returns the comment lines at the top of every table, each after `mark`.
std::string comments(const Material& m, const char* mark) {
  return fmt::format(
      "{0} Relaxation of a specimen, {1}; units Pa and s.\n"
      "{0} Valid from {2:g} to {3:g} s, where E(t) of this table differs from E(t) of the specimen by at most "
      "{4:.1e}.\n",
      mark, modulus_words(m.confined), m.shortest_s, m.longest_s, m.table_error + m.error());
}

std::string isotropy(double poisson_ratio, const char* mark) {
  return fmt::format(
      "{0} Poisson's ratio {1:g} is an assumption. It is constant in time, so that shear and bulk moduli relax "
      "alike.\n{0} The modulus is the instantaneous modulus, and the fractions are relative to this modulus.\n",
      mark, poisson_ratio);
}

std::string prony_csv(const Material& m) {
  const double at_once = m.relaxation.instantaneous();
  std::string out = comments(m, "#") +
                    "# E(t) = sum of modulus_pa * exp(-t / time_s); the last row is the long-term modulus.\n" +
                    "time_s,modulus_pa,share\n";
  for (const auto& u : m.relaxation.units) out += fmt::format("{},{},{}\n", u.time, u.modulus, u.modulus / at_once);
  return out + fmt::format("inf,{},{}\n", m.relaxation.long_term, m.relaxation.long_term / at_once);
}

std::string kelvin_csv(const Material& m) {
  std::string out =
      comments(m, "#") +
      "# J(t) = 1/E_m + t/C_m + sum of (1 - exp(-t / time_s)) / E over the Kelvin units, springs E and dashpots C.\n"
      "unit,time_s,compliance_1_pa,E_pa,C_pa_s\n";
  out += fmt::format("maxwell,,{},{},{}\n", m.creep.instantaneous, 1 / m.creep.instantaneous,
                     m.creep.fluidity > 0 ? fmt::format("{}", 1 / m.creep.fluidity) : "inf");
  for (std::size_t i = 0; i < m.creep.units.size(); ++i) {
    const auto& u = m.creep.units[i];
    out += fmt::format("kelvin_{},{},{},{},{}\n", i + 1, u.time, u.compliance, 1 / u.compliance, u.time / u.compliance);
  }
  return out;
}

/// Returns a unit's fraction of the instantaneous modulus.
double share(const Material& m, const PronySeries::Unit& unit) {
  return unit.modulus / m.relaxation.instantaneous() * (m.relaxation.long_term > 0 ? 1 : of_a_fluid);
}

std::string abaqus(const Material& m, double poisson_ratio) {
  std::string out = comments(m, "**") + isotropy(poisson_ratio, "**");
  out += fmt::format("*MATERIAL, NAME=MIXTURE\n*ELASTIC, MODULI=INSTANTANEOUS\n{:.9e}, {:g}\n",
                     m.relaxation.instantaneous(), poisson_ratio);
  if (m.relaxation.units.empty()) return out;
  out += "*VISCOELASTIC, TIME=PRONY\n** shear fraction, bulk fraction, time\n";
  for (const auto& u : m.relaxation.units) out += fmt::format("{0:.9e}, {0:.9e}, {1:.9e}\n", share(m, u), u.time);
  return out;
}

std::string ansys(const Material& m, double poisson_ratio) {
  std::string out = comments(m, "!") + isotropy(poisson_ratio, "!");
  out += fmt::format("MP,EX,1,{:.9e}\nMP,PRXY,1,{:g}\n", m.relaxation.instantaneous(), poisson_ratio);
  if (m.relaxation.units.empty()) return out;
  constexpr std::size_t pairs_a_line = 3;  // TBDATA takes six numbers, two per unit
  for (const char* of : {"SHEAR", "BULK"}) {
    out += fmt::format("TB,PRONY,1,1,{},{}\n", m.relaxation.units.size(), of);
    for (std::size_t i = 0; i < m.relaxation.units.size(); ++i) {
      const auto& u = m.relaxation.units[i];
      if (i % pairs_a_line == 0) out += fmt::format("{}TBDATA,{}", i == 0 ? "" : "\n", 2 * i + 1);
      out += fmt::format(",{:.9e},{:.9e}", share(m, u), u.time);
    }
    out += "\n";
  }
  return out;
}

}  // namespace

std::vector<std::string> material_files(bool confined) {
  std::vector<std::string> out{"prony.csv", "kelvin.csv"};
  if (!confined) out.insert(out.end(), {"prony_abaqus.inp", "prony_ansys.txt"});
  return out;
}

void write_material(const std::filesystem::path& out, const Material& material, double poisson_ratio) {
  write_whole(out / "prony.csv", prony_csv(material));
  write_whole(out / "kelvin.csv", kelvin_csv(material));
  if (material.confined) return;
  write_whole(out / "prony_abaqus.inp", abaqus(material, poisson_ratio));
  write_whole(out / "prony_ansys.txt", ansys(material, poisson_ratio));
}

}  // namespace macadam
