// SPDX-License-Identifier: GPL-3.0-or-later
// laboratory_columns.cpp  Lists the names that columns may have: every quantity with its units.
#include "host/tools/fit/laboratory_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "macadam/laws/shift.hpp"

namespace macadam::fitting {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::vector<LaboratoryColumn> make_columns() {
  using enum Quantity;
  constexpr double pi = std::numbers::pi;
  std::vector<LaboratoryColumn> out{{"frequency_hz", frequency, "Hz"}, {"omega_rad_s", frequency, "rad/s", 0.5 / pi}};
  for (const auto& [name, quantity] : {std::pair{"e_star", e_star},
                                       {"g_star", g_star},
                                       {"e_prime", e_prime},
                                       {"e_double_prime", e_double_prime},
                                       {"g_prime", g_prime},
                                       {"g_double_prime", g_double_prime}}) {
    for (const auto& [unit, factor] : {std::pair{"Pa", 1.0}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}})
      out.push_back({fmt::format("{}_{}", name, lower(unit)), quantity, unit, factor});
  }
  out.push_back({"phase_deg", phase, "degrees"});
  out.push_back({"phase_rad", phase, "radians", 180 / pi});
  out.push_back({"temperature_c", temperature, "degrees Celsius"});
  out.push_back({"temperature_k", temperature, "kelvins", 1, -laws::zero_celsius});
  out.push_back({"e_star_std", e_star_std, ""});
  out.push_back({"g_star_std", g_star_std, ""});
  out.push_back({"phase_std", phase_std, ""});
  return out;
}

}  // namespace

const std::vector<LaboratoryColumn>& laboratory_columns() {
  static const std::vector<LaboratoryColumn> columns = make_columns();
  return columns;
}

const LaboratoryColumn* find_column(std::string_view name) {
  const std::string wanted = lower(name);
  for (const LaboratoryColumn& column : laboratory_columns())
    if (column.name == wanted) return &column;
  return nullptr;
}

std::string unit_suffix(std::string_view cell) {
  std::string out;
  for (const char c : lower(cell))
    if (std::string_view(" ()[]").find(c) == std::string_view::npos) out += c;
  constexpr std::string_view degree_sign = "\xC2\xB0";
  if (const auto at = out.find(degree_sign); at != std::string::npos) out.replace(at, degree_sign.size(), "deg");
  if (out == "rad/s" || out == "1/s" || out == "s-1") return "rad_s";
  if (out == "degc" || out == "celsius") return "c";
  if (out == "degree" || out == "degrees") return "deg";
  if (out == "kelvin") return "k";
  return out;
}

std::string expected_of(const LaboratoryColumn& column, double value) {
  using enum Quantity;
  switch (column.quantity) {
    // measured angles scatter beyond 0 and 90 degrees; if all are negative, the file has another sign convention
    case phase:
      if (value > -5 && value < 95) return "";
      return column.factor == 1 ? "degrees between -5 and 95" : "radians between -0.087 and 1.66";
    case temperature:
      return value > -laws::zero_celsius && value < 1000 ? "" : column.unit;
    case e_double_prime:
    case g_double_prime:
      return std::isfinite(value) ? "" : "a number in " + column.unit;
    default:
      return value > 0 && std::isfinite(value) ? "" : "a positive number in " + column.unit;
  }
}

}  // namespace macadam::fitting
