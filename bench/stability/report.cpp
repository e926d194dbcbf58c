// SPDX-License-Identifier: GPL-3.0-or-later
// report.cpp  The table as CSV and as a page.
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
  out << fmt::format("# stability_bench, {}; {}, {}, commit {}; cuda: {}\n", where.effort, where.processor, where.date,
                     where.commit, where.cuda);
  out << "case,variant,setting,quantity,expected_low,expected_high,measured,verdict\n";
  for (const Outcome& outcome : outcomes) {
    for (const Row& row : outcome.rows) {
      out << fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{}\n", outcome.of.name, quoted(row.what),
                         quoted(row.setting), quoted(row.quantity), row.low, row.high, row.measured, verdict(row));
    }
    if (!outcome.error.empty()) {
      out << fmt::format("{},{},,,,,,FAIL\n", outcome.of.name, quoted("stopped: " + outcome.error));
    }
  }
}

void write_page(const std::filesystem::path& file, const std::vector<Outcome>& outcomes, const Circumstances& where) {
  int rows = 0, failed = 0;
  double seconds = 0;
  for (const Outcome& outcome : outcomes) {
    rows += static_cast<int>(outcome.rows.size()), failed += outcome.failed(), seconds += outcome.seconds;
  }
  std::ofstream out = opened(file);
  out << "# Stability under stress\n\nWritten by `bench/stability/run`; not to be edited. Each line states what must "
         "come "
         "out and why, what was\nmeasured, and the verdict that follows from the two.\n\n";
  out << fmt::format("{}, commit {}, {}, {} run, {:.0f} s of computing. cuda: {}.\n\n", where.date, where.commit,
                     where.processor, where.effort, seconds, where.cuda);
  out << fmt::format("{} of {} lines pass{}.", rows - failed, rows, failed ? "; those that fail are marked FAIL" : "");
  for (const Outcome& outcome : outcomes) {
    const std::string sentence = outcome.of.conclusion ? outcome.of.conclusion(outcome.rows) : "";
    if (!sentence.empty()) out << "\n" << sentence;
  }
  out << "\n";
  for (const Outcome& outcome : outcomes) {
    out << fmt::format("\n## {} (`{}`)\n\n", outcome.of.title, outcome.of.name);
    if (!outcome.error.empty()) out << fmt::format("FAIL: the case stopped: {}\n\n", outcome.error);
    out << "| case | backend, precision | measured quantity | expected | because | measured | verdict |\n"
           "|---|---|---|---|---|---|---|\n";
    for (const Row& row : outcome.rows) {
      if (row.detail && row.pass()) continue;
      out << fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", row.what, row.setting, row.quantity, expected(row),
                         row.reason, number(row.measured), verdict(row));
    }
  }
}

}  // namespace macadam::stability
