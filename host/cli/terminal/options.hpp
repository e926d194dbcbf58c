// SPDX-License-Identifier: GPL-3.0-or-later
/// \file options.hpp  Defines options whose whole text must be a number or one of several names. CLI11's own
/// conversions accept too much: they read -1 as 2⁶⁴ − 1 and 010 as eight, they accept an empty text, and in place of a
/// name they accept its position in the list of names.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace macadam {

namespace options {

template <class T>
struct Value {
  using type = T;
};
template <class T>
struct Value<std::optional<T>> {
  using type = T;
};
/// The type of an option's value, whether its target is optional or not.
template <class T>
using value_t = typename Value<T>::type;

/// Refuses the value of an option. \throws CLI::ValidationError, which ends the program with exit code 2.
[[noreturn]] inline void refuse(const std::string& name, const std::string& found, const std::string& expected) {
  throw CLI::ValidationError(name, fmt::format("found \"{}\", expected {}", found, expected));
}

/// Adds an option that passes its text to `read`, also if the text is empty.
template <class Read>
CLI::Option* add(CLI::App& app, const std::string& name, const std::string& description, Read&& read) {
  return app.add_option(
      name,
      [read = std::forward<Read>(read)](const CLI::results_t& texts) {
        read(texts.back());
        return true;
      },
      description);
}

}  // namespace options

/// Adds an option that takes a decimal number in [low, high]. `target` holds the default; an optional may have none.
template <class T>
CLI::Option* add_number(CLI::App& app, const std::string& name, T& target, const std::string& description,
                        options::value_t<T> low, options::value_t<T> high) {
  using Number = options::value_t<T>;
  const auto read = [&target, name, low, high](const std::string& text) {
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || !(value >= low && value <= high)) {
      constexpr bool whole = std::is_integral_v<Number>;
      options::refuse(name, text, fmt::format("a {}number from {} to {}", whole ? "whole " : "", low, high));
    }
    target = value;
  };
  CLI::Option* option =
      options::add(app, name, description, read)->type_name(std::is_integral_v<Number> ? "INT" : "NUMBER");
  if constexpr (std::is_arithmetic_v<T>) option->default_str(fmt::format("{}", target));
  return option;
}

/// Adds an option that takes one of several names.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& target, const std::string& description,
                        const std::vector<std::pair<std::string, options::value_t<T>>>& choices) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.first;
  const auto read = [&target, name, choices, names](const std::string& text) {
    for (const auto& [known, value] : choices) {
      if (known == text) {
        target = value;
        return;
      }
    }
    options::refuse(name, text, "one of " + names);
  };
  CLI::Option* option = options::add(app, name, description, read)->type_name(names);
  if constexpr (std::is_same_v<T, options::value_t<T>>)
    for (const auto& [known, value] : choices)
      if (value == target) option->default_str(known);
  return option;
}

/// Adds an option that takes text that is not empty. `value` says in the help what the text is; with FILE and FOLDER
/// shells also complete paths.
inline CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& target,
                             const std::string& description, const std::string& value = "FILE") {
  const auto read = [&target, name](const std::string& text) {
    if (text.empty()) options::refuse(name, text, "a text that is not empty");
    target = text;
  };
  return options::add(app, name, description, read)->type_name(value);
}

/// Adds --out, the folder into which a command writes.
inline CLI::Option* add_out(CLI::App& app, std::string& target, const std::string& what = "of the results") {
  return add_text(app, "--out", target, "folder " + what + "; created if it does not exist", "FOLDER")->required();
}

/// Adds --scale, the length of one unit of surface files [m].
inline CLI::Option* add_scale(CLI::App& app, double& scale) {
  return add_number(app, "--scale", scale, "length of the files' unit in metres: 1e-3 if the files are in millimetres",
                    1e-12, 1e12);
}

}  // namespace macadam
