// SPDX-License-Identifier: GPL-3.0-or-later
// laboratory_table.cpp  Splits a text table at its separators, with quotes and comments.
#include "host/tools/fit/laboratory_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/tokenizer.hpp>
#include <charconv>
#include <fstream>

#include "host/base/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::fitting {
namespace {

constexpr std::uintmax_t longest_file = 10u << 20;
constexpr std::size_t most_complaints = 10;

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Returns the cells of a line, which may stand in double quotes.
std::vector<std::string> cells_of(const std::string& line, char separator) {
  using Separator = boost::escaped_list_separator<char>;
  std::vector<std::string> out;
  for (const std::string& cell : boost::tokenizer<Separator>(line, Separator("", std::string(1, separator), "\"")))
    out.push_back(trimmed(cell));
  return out;
}

/// Returns the separator: a tab or a semicolon if the header has one, otherwise a comma.
char separator_of(const std::string& header) {
  for (const char c : {'\t', ';'})
    if (header.find(c) != std::string::npos) return c;
  return ',';
}

/// Returns the contents of a file. \throws InputError when it is not a regular file, too large, or unreadable.
std::string text_of(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& found, const std::string& expected) {
    throw InputError(file.string(), 0, "measurements", found, expected);
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const char* expected = "a CSV file of measured moduli";
  if (!std::filesystem::exists(status)) fail("no such file", expected);
  if (!std::filesystem::is_regular_file(status)) fail("no regular file", expected);
  const auto bytes = std::filesystem::file_size(file, error);
  if (!error && bytes > longest_file) fail(fmt::format("{} bytes", bytes), fmt::format("at most {}", longest_file));
  std::ifstream in(file, std::ios::binary);
  std::string text(error ? 0 : bytes, '\0');
  if (!in || !in.read(text.data(), std::ssize(text))) fail("a file that cannot be read", expected);
  return text;
}

}  // namespace

void Complaints::add(int line, const std::string& what, const std::string& found, const std::string& expected) {
  lines_.emplace_back(InputError(source_, line, what, found, expected).what());
}

void Complaints::throw_if_any() const {
  if (lines_.empty()) return;
  const std::size_t shown = std::min(lines_.size(), most_complaints);
  std::string text =
      fmt::format("{}", fmt::join(lines_.begin(), lines_.begin() + static_cast<std::ptrdiff_t>(shown), "\n"));
  if (lines_.size() > shown) text += fmt::format("\nand {} more in this file", lines_.size() - shown);
  throw InputError(text);
}

std::optional<double> number_in(const LaboratoryTable& table, const std::string& cell) {
  std::string text = cell;
  const bool comma = text.find(',') != std::string::npos;
  if (comma && (table.separator == ',' || text.find('.') != std::string::npos)) return {};
  std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

/// Adds a complaint if some numbers have a decimal comma and others a point: one of the two may separate thousands.
void require_one_decimal_sign(const LaboratoryTable& table, Complaints& complaints) {
  if (table.separator == ',') return;
  const LaboratoryTable::Row* first = nullptr;
  std::string number;
  for (const LaboratoryTable::Row& row : table.rows) {
    for (const std::string& cell : row.cells) {
      const std::size_t at = cell.find_first_of(",.");
      if (at == std::string::npos || !number_in(table, cell)) continue;
      if (!first) first = &row, number = cell;
      if (number[number.find_first_of(",.")] == cell[at]) continue;
      return complaints.add(row.line, "decimal sign", in_quotes(cell),
                            fmt::format("the same as in {} of line {}", in_quotes(number), first->line));
    }
  }
}

LaboratoryTable read_laboratory_table(const std::filesystem::path& file, Complaints& complaints) {
  LaboratoryTable out;
  const std::string text = text_of(file);
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // the byte-order mark that spreadsheets write
  int number = 0;
  const auto is_text = [&](const std::string& cell) { return !number_in(out, cell); };
  while (!rest.empty()) {
    ++number;
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string line(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.ends_with('\r')) line.pop_back();
    if (line.find_first_not_of(" \t,;") == std::string::npos || line.starts_with('#')) continue;
    if (std::count(line.begin(), line.end(), '"') % 2 != 0) {
      complaints.add(number, "quotes", in_quotes(line), "as many opening as closing quotes");
      continue;
    }
    if (out.names.empty()) {
      out.separator = separator_of(line);
      out.names = cells_of(line, out.separator);
      out.header_line = number;
      continue;
    }
    LaboratoryTable::Row row{number, cells_of(line, out.separator)};
    while (row.cells.size() > out.names.size() && row.cells.back().empty()) row.cells.pop_back();
    if (row.cells.size() != out.names.size()) {
      complaints.add(number, "columns", fmt::format("{} in {}", row.cells.size(), in_quotes(line)),
                     fmt::format("{}", out.names.size()));
    } else if (out.rows.empty() && !out.units && std::all_of(row.cells.begin(), row.cells.end(), is_text)) {
      out.units = std::move(row);
    } else {
      out.rows.push_back(std::move(row));
    }
  }
  require_one_decimal_sign(out, complaints);
  if (out.names.empty())
    complaints.add(0, "measurements", "an empty file", "a header such as frequency_hz,e_star_pa,phase_deg");
  return out;
}

}  // namespace macadam::fitting
