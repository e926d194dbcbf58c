// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laboratory_table.hpp  Tables as laboratories and spreadsheets write them, before their columns have a meaning.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace macadam::fitting {

/// What is wrong in a file, collected so that one message has all of it.
class Complaints {
 public:
  explicit Complaints(std::string source) : source_(std::move(source)) {}

  /// Adds `source:line: what: found F, expected E`; line 0 means that no line applies.
  void add(int line, const std::string& what, const std::string& found, const std::string& expected);
  bool empty() const { return lines_.empty(); }
  /// \throws InputError with one line for each complaint, if there are any; of many the first ten and their number.
  void throw_if_any() const;

 private:
  std::string source_;
  std::vector<std::string> lines_;
};

/// Cells as text.
struct LaboratoryTable {
  struct Row {
    int line = 0;
    std::vector<std::string> cells;  ///< as many as there are names, without quotes and blanks around them
  };
  std::vector<std::string> names;  ///< of the columns, may be empty
  int header_line = 0;
  std::optional<Row> units;  ///< the row below the names, where none of its cells is a number
  std::vector<Row> rows;
  char separator = ',';
};

/// Reads a table of text: columns are separated by commas, semicolons or tabs, cells may stand in double quotes, lines
/// that begin with # are comments, empty lines and a byte-order mark are passed over. A row with too many or too few
/// cells is a complaint. \throws InputError for a file that is no such table.
LaboratoryTable read_laboratory_table(const std::filesystem::path& file, Complaints& complaints);

/// The number in a cell, with a point or, where cells are not separated by commas, a comma before its decimals.
std::optional<double> number_in(const LaboratoryTable& table, const std::string& cell);

}  // namespace macadam::fitting
