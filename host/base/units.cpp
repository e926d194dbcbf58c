// SPDX-License-Identifier: GPL-3.0-or-later
/// \file units.cpp  Defines the table of units, and the functions that look up units in this table.
#include "host/base/units.hpp"

#include <charconv>

namespace macadam::scene {
namespace {

// Both code points that print as µ (micro sign, Greek mu) and the usual ways to type a product or a power are accepted.
constexpr Unit lengths[] = {{"m", 0}, {"cm", -2}, {"mm", -3}, {"um", -6}, {"\u00b5m", -6}, {"\u03bcm", -6}};
constexpr Unit moduli[] = {{"Pa", 0}, {"kPa", 3}, {"MPa", 6}, {"GPa", 9}};
constexpr Unit viscosities[] = {{"Pa s", 0},      {"kPa s", 3},      {"MPa s", 6},      {"GPa s", 9},
                                {"Pa*s", 0},      {"kPa*s", 3},      {"MPa*s", 6},      {"GPa*s", 9},
                                {"Pa\u00b7s", 0}, {"kPa\u00b7s", 3}, {"MPa\u00b7s", 6}, {"GPa\u00b7s", 9}};
constexpr Unit densities[] = {{"kg/m3", 0},      {"g/cm3", 3},      {"t/m3", 3},      {"kg/m^3", 0}, {"g/cm^3", 3},
                              {"kg/m\u00b3", 0}, {"g/cm\u00b3", 3}, {"t/m\u00b3", 3}, {"t/m^3", 3}};
constexpr Unit masses[] = {{"kg", 0}, {"g", -3}, {"mg", -6}, {"t", 3}};
constexpr Unit frequencies[] = {{"Hz", 0}, {"mHz", -3}, {"kHz", 3}};
constexpr Unit durations[] = {{"s", 0},        {"ms", -3}, {"us", -6},     {"\u00b5s", -6},
                              {"\u03bcs", -6}, {"ns", -9}, {"min", 0, 60}, {"h", 0, 3600}};
constexpr Unit rates[] = {{"1/s", 0}, {"s^-1", 0}, {"1/ms", 3}};
constexpr Unit speeds[] = {{"m/s", 0}, {"mm/s", -3}, {"mm/min", -3, 1.0 / 60}};
constexpr Unit temperatures[] = {{"degC", 0}, {"\u00b0C", 0}, {"C", 0}};
constexpr Unit differences[] = {{"K", 0}, {"degC", 0}, {"\u00b0C", 0}};
constexpr Unit warming_rates[] = {{"K/s", 0},
                                  {"K/min", 0, 1.0 / 60},
                                  {"K/h", 0, 1.0 / 3600},
                                  {"degC/min", 0, 1.0 / 60},
                                  {"degC/h", 0, 1.0 / 3600},
                                  {"\u00b0C/min", 0, 1.0 / 60},
                                  {"\u00b0C/h", 0, 1.0 / 3600}};
constexpr Unit expansions[] = {{"1/K", 0}, {"K^-1", 0}, {"1/degC", 0}};
constexpr Unit molar_energies[] = {{"J/mol", 0}, {"kJ/mol", 3}};
constexpr Unit fracture_energies[] = {{"J/m2", 0},   {"J/m^2", 0},      {"J/m\u00b2", 0}, {"kJ/m2", 3},
                                      {"kJ/m^2", 3}, {"kJ/m\u00b2", 3}, {"N/m", 0},       {"N/mm", 3}};
constexpr Unit ratios[] = {{"%", -2}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t";
  const auto begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

/// Returns the double nearest to the decimal number `digits`·10^shift.
std::optional<double> scaled(std::string_view digits, int shift) {
  const auto mark = digits.find_first_of("eE");
  int exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view text = digits.substr(mark + 1);
    if (text.starts_with('+')) text.remove_prefix(1);
    if (std::from_chars(text.data(), text.data() + text.size(), exponent).ec != std::errc()) return {};
  }
  const std::string shifted = std::string(digits.substr(0, mark)) + "e" + std::to_string(exponent + shift);
  double value = 0;
  const auto [end, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (error != std::errc() || end != shifted.data() + shifted.size()) return {};
  return value;
}

}  // namespace

const Quantity length{"length", lengths};
const Quantity modulus{"modulus", moduli};
const Quantity viscosity{"viscosity", viscosities};
const Quantity density{"density", densities};
const Quantity mass{"mass", masses};
const Quantity frequency{"frequency", frequencies};
const Quantity duration{"time", durations};
const Quantity rate{"rate", rates};
const Quantity speed{"speed", speeds};
const Quantity temperature{"temperature", temperatures};
const Quantity temperature_difference{"difference of temperatures", differences};
const Quantity warming_rate{"rate of a temperature", warming_rates};
const Quantity expansion{"coefficient of expansion", expansions};
const Quantity molar_energy{"molar energy", molar_energies};
const Quantity fracture_energy{"fracture energy", fracture_energies};
const Quantity ratio{"ratio", ratios};

std::string accepted(const Quantity& quantity) {
  if (quantity.units.data() == ratios) return "a number without unit, or text in %";
  std::string list;
  for (const Unit& unit : quantity.units) list += (list.empty() ? "" : ", ") + std::string(unit.name);
  return std::string("a ") + quantity.name + ": a number in " + std::string(quantity.units.front().name) +
         ", or text with one of the units " + list;
}

std::optional<double> parse(std::string_view text, const Quantity& quantity) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;  // only needed to see where the digits end; `scaled` computes the value
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return {};
  const auto count = static_cast<std::size_t>(end - text.data());
  const std::string_view digits = text.substr(0, count), name = trimmed(text.substr(count));
  for (const Unit& unit : quantity.units) {
    if (name != unit.name) continue;
    const std::optional<double> value = scaled(digits, unit.exponent);
    return value ? unit.factor * *value : value;
  }
  return {};
}

}  // namespace macadam::scene
