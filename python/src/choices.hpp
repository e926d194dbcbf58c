// SPDX-License-Identifier: GPL-3.0-or-later
/// \file choices.hpp  Checks arguments of Python calls that must be one of several names, a number in a range, or a
/// list of devices (GPUs). Names and limits are the same as for the command's options.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "macadam/macadam.hpp"

namespace macadam::python {

/// Returns the value with the name `text`. \throws InputError, listing the names, for any other text.
template <class T>
T choice(const char* name, const std::string& text, const std::vector<std::pair<const char*, T>>& choices) {
  std::string names;
  for (const auto& [known, value] : choices) {
    if (text == known) return value;
    names += (names.empty() ? "" : "|") + std::string(known);
  }
  throw InputError(std::string(name) + ": found \"" + text + "\", expected one of " + names);
}
template <class T>
std::optional<T> choice(const char* name, const std::optional<std::string>& text,
                        const std::vector<std::pair<const char*, T>>& choices) {
  if (!text) return {};
  return choice(name, *text, choices);
}

/// Returns the number, or nothing if it is not given. \throws InputError if the number is not between low and high.
template <class T>
std::optional<T> in_range(const char* name, const std::optional<T>& value, T low, T high) {
  if (value && !(*value >= low && *value <= high)) {
    constexpr bool is_whole = std::is_integral_v<T>;
    throw InputError(fmt::format("{}: found {}, expected a {}number from {} to {}", name, *value,
                                 is_whole ? "whole " : "", low, high));
  }
  return value;
}
template <class T>
T in_range(const char* name, T value, T low, T high) {
  return *in_range(name, std::optional<T>(value), low, high);
}

/// The argument `device`: one number, a list of numbers, or "all", as in the command's option.
using Devices = std::optional<std::variant<int, std::vector<int>, std::string>>;
/// Returns the devices. \throws InputError for another word, an empty list, a number outside 0 to 1023, or a number
/// that occurs twice.
inline std::optional<DeviceList> devices_of(const Devices& given) {
  if (!given) return {};
  if (const auto* word = std::get_if<std::string>(&*given)) {
    if (*word != "all") throw InputError("device: found \"" + *word + "\", expected numbers or \"all\"");
    return DeviceList{every_device};
  }
  const auto* one = std::get_if<int>(&*given);
  const DeviceList out = one ? DeviceList{*one} : std::get<std::vector<int>>(*given);
  if (out.empty()) throw InputError("device: found an empty list, expected at least one device");
  for (const int number : out) {
    if (out != DeviceList{every_device}) in_range("device", number, 0, 1023);
    if (std::count(out.begin(), out.end(), number) > 1)
      throw InputError(fmt::format("device: found {} twice, expected each device once", number));
  }
  return out;
}

inline const std::vector<std::pair<const char*, Backend>> backends{
    {"auto", Backend::automatic}, {"cuda", Backend::cuda}, {"cpu", Backend::cpu}, {"reference", Backend::reference}};
inline const std::vector<std::pair<const char*, Precision>> precisions{
    {"double", Precision::double_}, {"mixed", Precision::mixed}, {"single", Precision::single}};
inline const std::vector<std::pair<const char*, SolverMethod>> methods{{"explicit", SolverMethod::explicit_},
                                                                       {"harmonic", SolverMethod::harmonic},
                                                                       {"quasi_static", SolverMethod::quasi_static}};
inline const std::vector<std::pair<const char*, LinearMethod>> linear_methods{
    {"auto", LinearMethod::automatic}, {"iterative", LinearMethod::iterative}, {"direct", LinearMethod::direct}};
inline const std::vector<std::pair<const char*, ContactForm>> forms{{"condensed", ContactForm::condensed},
                                                                    {"points", ContactForm::points}};
inline const std::vector<std::pair<const char*, Geometry>> geometries{{"updated", Geometry::updated},
                                                                      {"fixed", Geometry::fixed}};
inline const std::vector<std::pair<const char*, Damping>> dampings{
    {"none", Damping::none}, {"local", Damping::local}, {"viscous", Damping::viscous}};
inline const std::vector<std::pair<const char*, Wall>> walls{{"-x", wall_x_lo}, {"+x", wall_x_hi}, {"-y", wall_y_lo},
                                                             {"+y", wall_y_hi}, {"-z", wall_z_lo}, {"+z", wall_z_hi}};
inline const std::vector<std::pair<const char*, int>> axes{{"x", 0}, {"y", 1}, {"z", 2}};

}  // namespace macadam::python
