// SPDX-License-Identifier: GPL-3.0-or-later
// foreign_packing.cpp  Reads columns of numbers, whatever separates them.
#include "host/specimen/foreign_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

#include "host/base/in_quotes.hpp"
#include "host/files/result_files.hpp"
#include "macadam/domains/domain.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr std::string_view separators = " \t,;\r";

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; (at = line.find_first_not_of(separators, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    out.push_back(line.substr(at, end - at));
    at = end;
  }
  return out;
}

std::optional<double> number_in(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return {};
  return value;
}

std::string in_lower_case(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Indices of the columns with x, y, z and the size.
struct Columns {
  std::array<std::size_t, 4> index{0, 1, 2, 3};
  bool diameter = false;  ///< whether the last one is a diameter
  std::size_t names = 0;  ///< number of columns; 0: the file has no names
};

/// Reads the spheres of one file.
class Reader {
 public:
  Reader(const std::filesystem::path& file, double unit) : file_(file.string()), unit_(unit), text_(read_whole(file)) {}

  ForeignPacking read() {
    std::string_view line;
    while (next(line)) {
      const std::vector<std::string_view> words = words_of(line);
      if (words.empty()) continue;
      if (words[0] == "ITEM:")
        item(words);
      else if (dump_)
        atom(words);
      else
        row(line, words);
    }
    if (out_.centre.empty()) refuse(0, "spheres", "none", "rows with x, y, z and a radius");
    if (expected_ && *expected_ != static_cast<double>(out_.centre.size()))
      refuse(number_, "spheres of the last snapshot", fmt::format("{}", out_.centre.size()),
             fmt::format("{} as the dump says; the file may be incomplete", *expected_));
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& what, const std::string& found,
                           const std::string& expected) const {
    throw InputError(file_, line, what, found, expected);
  }

  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = std::string_view(text_).substr(at_, end - at_);
    if (at_ == 0 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // a byte-order mark
    at_ = end + 1, ++number_;
    return true;
  }

  /// Returns the columns with these names; nothing if a name is missing.
  static std::optional<Columns> columns_of(const std::vector<std::string_view>& names) {
    const auto find = [&](std::initializer_list<std::string_view> any) -> std::optional<std::size_t> {
      for (const std::string_view name : any)
        for (std::size_t k = 0; k < names.size(); ++k)
          if (in_lower_case(names[k]) == name) return k;
      return {};
    };
    const auto x = find({"x", "xu"}), y = find({"y", "yu"}), z = find({"z", "zu"}), r = find({"radius", "r", "rad"}),
               d = find({"diameter", "d"});
    if (!x || !y || !z || !(r || d)) return {};
    return Columns{{*x, *y, *z, r ? *r : *d}, !r, names.size()};
  }

  /// A line of a dump that begins with ITEM:. A new snapshot replaces the previous one.
  void item(const std::vector<std::string_view>& words) {
    dump_ = true, atoms_ = false;
    counts_ = words.size() > 1 && words[1] == "NUMBER";
    if (words.size() < 2 || words[1] != "ATOMS") return;
    atoms_ = true;
    out_ = {};
    out_.format = "LAMMPS dump";
    const auto columns = columns_of({words.begin() + 2, words.end()});
    if (!columns) {
      refuse(number_, "columns of the dump",
             in_quotes(fmt::format("{}", fmt::join(words.begin() + 2, words.end(), " "))),
             "x y z (or xu yu zu) and radius or diameter, as in: dump 1 all custom 1 FILE id x y z radius");
    }
    columns_ = *columns;
  }

  void atom(const std::vector<std::string_view>& words) {
    if (atoms_) return sphere(words);  // other lines are the number of the step, the number of atoms and the box
    if (counts_) expected_ = number_in(words[0]);
    counts_ = false;
  }

  /// A line of a text. Names of columns may stand in a line before all spheres.
  void row(std::string_view line, std::vector<std::string_view> words) {
    const bool comment = words[0].starts_with('#');
    if (comment || !number_in(words[0])) {
      if (comment) words = words_of(line.substr(line.find('#') + 1));
      if (!out_.centre.empty() && comment) return;
      const auto columns = columns_of(words);
      if (columns && out_.centre.empty()) {
        columns_ = *columns, out_.format = "text with column names";
      } else if (!comment) {
        refuse(number_, out_.centre.empty() ? "columns" : "x", in_quotes(std::string(words[0])),
               out_.centre.empty() ? "the names x, y, z and radius (or r, diameter), or numbers" : "a number");
      }
      return;
    }
    if (columns_.names == 0 && line.find(';') != std::string_view::npos && line.find(',') != std::string_view::npos)
      refuse(number_, "numbers", in_quotes(std::string(line)), "decimal points, not commas");
    if (out_.format.empty()) out_.format = "text";
    sphere(words);
  }

  void sphere(const std::vector<std::string_view>& words) {
    constexpr std::array<const char*, 4> names{"x", "y", "z", "radius"};
    if (columns_.names > 0 && words.size() != columns_.names)
      refuse(number_, "columns", fmt::format("{}", words.size()),
             fmt::format("{} as names, numbers with decimal points, and no empty cells", columns_.names));
    std::array<double, 4> value{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t column = columns_.index[k];
      if (column >= words.size()) refuse(number_, names[k], fmt::format("{} columns", words.size()), "one more column");
      const auto number = number_in(words[column]);
      if (!number || !std::isfinite(*number))
        refuse(number_, names[k], in_quotes(std::string(words[column])), "a number");
      value[k] = *number * unit_;
    }
    if (!(value[3] > 0)) refuse(number_, names[3], std::string(words[columns_.index[3]]), "a positive number");
    out_.centre.push_back({value[0], value[1], value[2]});
    out_.radius.push_back(columns_.diameter ? 0.5 * value[3] : value[3]);
  }

  std::string file_;
  double unit_;
  std::string text_;
  std::size_t at_ = 0;
  int number_ = 0;  ///< of the line that was read last
  bool dump_ = false, atoms_ = false;
  bool counts_ = false;             ///< whether the next line has the number of atoms
  std::optional<double> expected_;  ///< number of atoms of the last snapshot, if the dump says it
  Columns columns_;
  ForeignPacking out_;
};

}  // namespace

ForeignPacking read_packing(const std::filesystem::path& file, double unit) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(file.string(), 0, "packing", "no such file", "a file with spheres");
  return Reader(file, unit).read();
}

Specimen specimen_of(const ForeignPacking& packing, bool cylinder, const std::string& source) {
  Vec3d low = packing.centre.front(), high = low;
  for (std::size_t k = 0; k < packing.centre.size(); ++k) {
    const Vec3d& c = packing.centre[k];
    const double r = packing.radius[k];
    low = {std::min(low.x, c.x - r), std::min(low.y, c.y - r), std::min(low.z, c.z - r)};
    high = {std::max(high.x, c.x + r), std::max(high.y, c.y + r), std::max(high.z, c.z + r)};
  }
  if (cylinder) {
    const double x = 0.5 * (low.x + high.x), y = 0.5 * (low.y + high.y);
    double radius = 0;
    for (std::size_t k = 0; k < packing.centre.size(); ++k)
      radius = std::max(radius, std::hypot(packing.centre[k].x - x, packing.centre[k].y - y) + packing.radius[k]);
    low = {x - radius, y - radius, low.z}, high = {x + radius, y + radius, high.z};
  }
  Specimen out;
  const Vec3d size{high.x - low.x, high.y - low.y, high.z - low.z};
  out.box = cylinder ? cylinder_domain(size.x, size.z) : Domain{size};
  for (const Vec3d& c : packing.centre) out.centre.push_back({c.x - low.x, c.y - low.y, c.z - low.z});
  out.radius = packing.radius;
  out.phase.assign(out.centre.size(), Phase::mastic);
  out.body.assign(out.centre.size(), -1);
  out.source = source;
  validate(out, source);
  return out;
}

}  // namespace macadam
