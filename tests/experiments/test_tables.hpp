// SPDX-License-Identifier: GPL-3.0-or-later
/// \file test_tables.hpp  Reads CSV tables that a run or a measurement wrote.
#pragma once

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace macadam::test {

/// Returns the rows of a CSV text, each by the names of the columns. Skips lines that begin with #. Fields contain no
/// commas.
inline std::vector<std::map<std::string, std::string>> table_of(const std::string& text) {
  std::vector<std::map<std::string, std::string>> out;
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    if (names.empty()) {
      names = fields;
      continue;
    }
    out.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) out.back()[names[i]] = fields[i];
  }
  return out;
}

}  // namespace macadam::test
