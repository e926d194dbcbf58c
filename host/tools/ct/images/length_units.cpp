// SPDX-License-Identifier: GPL-3.0-or-later
// length_units.cpp  Recognises names of length units: singular and plural, in American and British spelling.
#include "host/tools/ct/images/length_units.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace macadam::ct {

std::optional<double> metres_of_unit(std::string_view name) {
  struct Unit {
    std::string_view name;
    double metres;
  };
  // µ occurs as the micro sign, as the Greek letter, and as the single Latin-1 byte that older programs write
  constexpr Unit units[] = {{"m", 1},         {"cm", 1e-2},         {"mm", 1e-3},         {"um", 1e-6},
                            {"nm", 1e-9},     {"\u00b5m", 1e-6},    {"\u03bcm", 1e-6},    {"\xb5m", 1e-6},
                            {"meter", 1},     {"centimeter", 1e-2}, {"millimeter", 1e-3}, {"micrometer", 1e-6},
                            {"micron", 1e-6}, {"nanometer", 1e-9},  {"inch", 0.0254},     {"inches", 0.0254}};
  std::string text(name);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (text.size() > 5 && text.ends_with('s') && !text.ends_with("es")) text.pop_back();
  if (text.ends_with("metres")) text.pop_back();
  if (text.ends_with("metre")) text.replace(text.size() - 2, 2, "er");
  const auto* unit = std::ranges::find(units, std::string_view(text), &Unit::name);
  return unit != std::end(units) ? std::optional(unit->metres) : std::nullopt;
}

}  // namespace macadam::ct
