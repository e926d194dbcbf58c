// SPDX-License-Identifier: GPL-3.0-or-later
/// \file laboratory_table.hpp  Reads tables as laboratories and spreadsheets write them: cells as text, before the
/// columns have a meaning.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace macadam::fitting {

/// Collects the faults of a file, so that one message reports them together.
class Complaints {
 public:
  explicit Complaints(std::string source) : source_(std::move(source)) {}

  /// Adds `source:line: what: found F, expected E`. Line 0 means that no line applies.
  void add(int line, const std::string& what, const std::string& found, const std::string& expected);
  bool empty() const { return lines_.empty(); }
  std::size_t count() const { return lines_.size(); }
  /// \throws InputError with one line per fault, if there are any; at most ten are shown, with the number of the
  /// others.
  void throw_if_any() const;

 private:
  std::string source_;
  std::vector<std::string> lines_;
};

/// A table with its cells as text.
struct LaboratoryTable {
  struct Row {
    int line = 0;
    std::vector<std::string> cells;  ///< one per column, without quotes and without blanks at the ends
  };
  std::vector<std::string> names;  ///< names of the columns; a name may be empty
  int header_line = 0;
  std::optional<Row> units;  ///< the row below the names, if none of its cells is a number
  std::vector<Row> rows;
  char separator = ',';
};

/// Reads a text table. Columns are separated by commas, semicolons or tabs, and cells may stand in double quotes. Lines
/// that begin with #, empty lines and a byte-order mark are skipped. A row with too many or too few cells is added to
/// `complaints`. \throws InputError when the file cannot be read or is larger than 10 MiB.
LaboratoryTable read_laboratory_table(const std::filesystem::path& file, Complaints& complaints);

/// Returns the number in a cell; empty if it is not a number. Decimals follow a point, or a comma if commas do not
/// separate the cells.
std::optional<double> number_in(const LaboratoryTable& table, const std::string& cell);

}  // namespace macadam::fitting
