// SPDX-License-Identifier: GPL-3.0-or-later
// lengths.cpp  Converts texts of the command line into metres.
#include "macadam/lengths.hpp"

#include <charconv>

#include "host/base/units.hpp"
#include "macadam/error.hpp"

namespace macadam {

double length_of(const std::string& text, const std::string& option) {
  double metres = 0;
  const char* end = text.data() + text.size();
  if (const auto [stop, error] = std::from_chars(text.data(), end, metres); error == std::errc{} && stop == end)
    return metres;
  if (const auto value = scene::parse(text, scene::length)) return *value;
  throw InputError("command line", 0, option, "\"" + text + "\"", scene::accepted(scene::length));
}

Vec3d lengths_of(const std::vector<std::string>& texts, const std::string& option) {
  if (texts.size() != 1 && texts.size() != 3)
    throw InputError("command line", 0, option, std::to_string(texts.size()) + " lengths", "one or three");
  for (const std::string& text : texts) {
    if (!(length_of(text, option) > 0))
      throw InputError("command line", 0, option, "\"" + text + "\"", "a positive length");
  }
  return {length_of(texts.front(), option), length_of(texts[texts.size() / 2], option),
          length_of(texts.back(), option)};
}

}  // namespace macadam
