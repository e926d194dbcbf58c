// SPDX-License-Identifier: GPL-3.0-or-later
// report.cpp  Writes the results of the stability cases as CSV.
#include "bench/stability/report.hpp"

#include <fmt/format.h>

#include <fstream>

#include "macadam/error.hpp"

namespace macadam::stability {
namespace {

std::string number(double x) {
  return x == 0 ? "0" : std::abs(x) >= 0.01 && std::abs(x) < 1e4 ? fmt::format("{:.4g}", x) : fmt::format("{:.2g}", x);
}

std::string expected(const Row& row) {
  if (row.low == -row.high) return "± " + number(row.high);
  if (row.low == 0) return "≤ " + number(row.high);
  return number(row.low) + " … " + number(row.high);
}

const char* verdict(const Row& row) { return row.pass() ? "pass" : "FAIL"; }

std::string quoted(std::string text) {
  for (std::size_t k = 0; (k = text.find('"', k)) != std::string::npos; k += 2) text.insert(k, 1, '"');
  return '"' + text + '"';
}

std::ofstream opened(const std::filesystem::path& file) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  if (!out) throw RunError(file.string() + ": cannot be written");
  return out;
}

}  // namespace

int Outcome::failed() const {
  int out = error.empty() ? 0 : 1;
  for (const Row& row : rows) out += !row.pass();
  return out;
}

std::string to_line(const Row& row) {
  return fmt::format("  {} {} | {} | {}: {} (expected {})", verdict(row), row.what, row.setting, row.quantity,
                     number(row.measured), expected(row));
}

void write_csv(const std::filesystem::path& file, const std::vector<Outcome>& outcomes, const Circumstances& where) {
  std::ofstream out = opened(file);
  double seconds = 0;
  for (const Outcome& outcome : outcomes) seconds += outcome.seconds;
  out << fmt::format("# stability_bench, {} run; {}; {}; commit {}; {:.0f} s of computing; cuda: {}\n", where.effort,
                     where.processor, where.date, where.commit, seconds, where.cuda);
  for (const Outcome& outcome : outcomes) out << fmt::format("# case {}: {}\n", outcome.of.name, outcome.of.title);
  out << "case,variant,setting,quantity,expected_low,expected_high,because,measured,verdict,detail\n";
  for (const Outcome& outcome : outcomes) {
    for (const Row& row : outcome.rows) {
      out << fmt::format("{},{},{},{},{:.6g},{:.6g},{},{:.6g},{},{}\n", outcome.of.name, quoted(row.what),
                         quoted(row.setting), quoted(row.quantity), row.low, row.high, quoted(row.reason), row.measured,
                         verdict(row), row.detail ? 1 : 0);
    }
    if (!outcome.error.empty()) {
      out << fmt::format("{},{},,,,,,,FAIL,0\n", outcome.of.name, quoted("stopped: " + outcome.error));
    }
  }
}

}  // namespace macadam::stability
