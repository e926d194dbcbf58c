// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fractions.hpp  Defines options that take a fraction, as a number or in per cent.
#pragma once

#include "host/cli/terminal/options.hpp"
#include "host/base/units.hpp"

namespace macadam {

/// Adds an option that takes a fraction in [low, high], given as a decimal number (0.04) or in per cent ("4 %").
template <class T>
CLI::Option* add_fraction(CLI::App& app, const std::string& name, T& target, const std::string& description, double low,
                          double high) {
  const auto read = [&target, name, low, high](const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool plain = error == std::errc{} && stop == end;
    const std::optional<double> found = plain ? std::optional(value) : scene::parse(text, scene::ratio);
    if (!found || !(*found >= low && *found <= high))
      options::refuse(name, text,
                      fmt::format("a number from {} to {}, or {} % to {} %", low, high, 100 * low, 100 * high));
    target = *found;
  };
  CLI::Option* option = options::add(app, name, description, read)->type_name("NUMBER");
  if constexpr (std::is_arithmetic_v<T>) option->default_str(fmt::format("{}", target));
  return option;
}

}  // namespace macadam
