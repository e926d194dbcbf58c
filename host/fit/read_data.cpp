// SPDX-License-Identifier: GPL-3.0-or-later
// read_data.cpp  Measured moduli from a CSV file whose header names the columns.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "host/in_quotes.hpp"
#include "host/nearest.hpp"
#include "macadam/error.hpp"
#include "macadam/fit.hpp"

namespace macadam {
namespace {

constexpr std::uintmax_t longest_file = 10u << 20;
constexpr std::size_t most_points = 10'000;  // the least squares are dense

struct Column {
  const char* name;
  double low, high;  ///< what makes sense; the ends do not belong to it
  const char* words;
};
constexpr double infinity = std::numeric_limits<double>::infinity();
// Measured angles scatter beyond 0 and 90 degrees; a negative sign throughout is another convention.
constexpr std::array<Column, 10> columns{{{"frequency_hz", 0, infinity, "a positive number of Hz"},
                                          {"e_star_pa", 0, infinity, "a positive number of Pa"},
                                          {"g_star_pa", 0, infinity, "a positive number of Pa"},
                                          {"phase_deg", -5, 95, "degrees between -5 and 95"},
                                          {"temperature_c", -laws::zero_celsius, 1000, "degrees Celsius"},
                                          {"e_star_std", 0, infinity, "a positive number of Pa"},
                                          {"g_star_std", 0, infinity, "a positive number of Pa"},
                                          {"phase_std", 0, infinity, "a positive number of degrees"},
                                          {"e_prime_pa", 0, infinity, "a positive number of Pa"},
                                          {"e_double_prime_pa", -infinity, infinity, "a number of Pa"}}};
enum : std::size_t { frequency, e_star, g_star, phase, temperature, e_std, g_std, phase_std, storage, loss };

std::vector<std::string> known_names() {
  std::vector<std::string> out;
  for (const Column& column : columns) out.emplace_back(column.name);
  return out;
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t end = line.find(',');
    out.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return out;
    line.remove_prefix(end + 1);
  }
}

/// Reads one file: knows its name and the line at hand, which every message needs.
class DataReader {
 public:
  DataReader(const std::filesystem::path& file, std::optional<double> poisson) : poisson_(poisson) {
    data_.source = file.string();
  }

  ModulusData read() {
    const std::string text = whole_text();
    std::string_view rest = text;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // spreadsheets' byte-order mark
    while (!rest.empty()) {
      ++line_;
      const std::size_t end = rest.find('\n');
      // cut within its last number, a file would be read as another one
      if (end == std::string_view::npos)
        fail("last line", "no newline at its end", "one: without it the file may be cut off");
      std::string_view line = rest.substr(0, end);
      rest.remove_prefix(end + 1);
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (trimmed(line).empty() || line.starts_with('#')) continue;
      if (order_.empty()) {
        header(line);
      } else {
        record(line);
      }
    }
    line_ = 0;
    if (order_.empty()) fail("measurements", "an empty file", "a header such as frequency_hz,e_star_pa,phase_deg");
    if (data_.points.empty()) fail("measurements", "a header alone", "lines of numbers");
    return std::move(data_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& found, const std::string& expected) const {
    throw InputError(data_.source, line_, what, found, expected);
  }

  std::string whole_text() const {
    const std::filesystem::path file = data_.source;
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    const char* expected = "a CSV file of measured moduli";
    if (!std::filesystem::exists(status)) fail("measurements", "no such file", expected);
    if (!std::filesystem::is_regular_file(status)) fail("measurements", "no regular file", expected);
    const auto bytes = std::filesystem::file_size(file, error);
    if (!error && bytes > longest_file) {
      fail("measurements", fmt::format("{} bytes", bytes), fmt::format("at most {}", longest_file));
    }
    std::ifstream in(file, std::ios::binary);
    std::string text(error ? 0 : bytes, '\0');
    if (!in || !in.read(text.data(), std::ssize(text))) fail("measurements", "a file that cannot be read", expected);
    return text;
  }

  bool has(std::size_t column) const { return std::find(order_.begin(), order_.end(), column) != order_.end(); }

  void header(std::string_view line) {
    const std::vector<std::string> known = known_names();
    for (const std::string_view name : fields_of(line)) {
      const auto at = std::find(known.begin(), known.end(), name);
      if (at == known.end()) {
        fail("header", in_quotes(name), fmt::format("{}, separated by commas", expected_one_of(name, known)));
      }
      const auto column = static_cast<std::size_t>(at - known.begin());
      if (has(column)) fail("header", in_quotes(name) + " twice", "each column once");
      order_.push_back(column);
    }
    const bool parts = has(storage) || has(loss);
    for (const std::size_t column : {frequency, parts ? storage : phase, parts ? loss : phase})
      if (!has(column)) fail("header", in_quotes(line), fmt::format("a column {}", columns[column].name));
    if (has(e_star) + has(g_star) + parts != 1 || (parts && has(phase)))
      fail("header", in_quotes(line), "e_star_pa or g_star_pa with phase_deg, or e_prime_pa with e_double_prime_pa");
    if (has(has(g_star) ? e_std : g_std))
      fail("header", in_quotes(line), "the standard deviation of the modulus that is there");
    data_.temperatures = has(temperature);
    data_.deviations = has(phase_std);
    if (data_.deviations != (has(e_std) || has(g_std))) {
      fail("header", in_quotes(line), "standard deviations of both modulus and phase, or of none");
    }
    if (has(g_star) && !poisson_) {
      fail("column g_star_pa", "no Poisson's ratio", "one (--poisson): |E*| = 2 (1 + ratio) |G*|");
    }
    if (!has(g_star) && poisson_) fail("column e_star_pa", "a Poisson's ratio", "none: |E*| is what is fitted");
    if (poisson_ && !(*poisson_ > -1 && *poisson_ <= 0.5)) {
      fail("Poisson's ratio", fmt::format("{}", *poisson_), "a number above -1, at most 0.5");
    }
  }

  double number(std::string_view field, const Column& column) const {
    double value = 0;
    const char* begin = field.data() + (field.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !(value > column.low && value < column.high))
      fail(fmt::format("column {}", column.name), in_quotes(field), column.words);
    return value;
  }

  void record(std::string_view line) {
    const std::vector<std::string_view> fields = fields_of(line);
    if (fields.size() != order_.size()) {
      fail("columns", fmt::format("{} in {}", fields.size(), in_quotes(line)), fmt::format("{}", order_.size()));
    }
    if (data_.points.size() == most_points) fail("measurements", "one more", fmt::format("at most {}", most_points));
    std::array<double, columns.size()> value{};
    for (std::size_t i = 0; i < fields.size(); ++i) value[order_[i]] = number(fields[i], columns[order_[i]]);
    const double factor = has(g_star) ? 2 * (1 + *poisson_) : 1;
    ModulusPoint p;
    p.frequency_hz = value[frequency];
    p.e_star_pa = factor * value[has(g_star) ? g_star : e_star];
    p.phase_deg = value[phase];
    if (has(storage)) {
      p.e_star_pa = std::hypot(value[storage], value[loss]);
      p.phase_deg = std::atan2(value[loss], value[storage]) * 180 / std::numbers::pi;
      if (!(p.phase_deg > columns[phase].low && p.phase_deg < columns[phase].high)) {
        fail("columns e_prime_pa and e_double_prime_pa", fmt::format("a phase of {:.3g} degrees", p.phase_deg),
             columns[phase].words);
      }
    }
    p.temperature_c = value[temperature];
    p.e_star_std = factor * value[has(g_star) ? g_std : e_std];
    p.phase_std = value[phase_std];
    data_.points.push_back(p);
  }

  std::optional<double> poisson_;
  ModulusData data_;
  std::vector<std::size_t> order_;  ///< which column stands where
  int line_ = 0;
};

}  // namespace

ModulusData read_modulus_data(const std::filesystem::path& file, std::optional<double> poisson) {
  return DataReader(file, poisson).read();
}

}  // namespace macadam
