// SPDX-License-Identifier: GPL-3.0-or-later
// stability_bench.cpp  Runs the cases and writes the table. The exit code is 1 if a line fails.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <mutex>
#include <thread>

#include "bench/stability/report.hpp"

namespace {

using namespace macadam::stability;

/// Returns the processor's name from /proc/cpuinfo.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

/// Prints the verdict of a case and its main rows. Rows with details are printed only if they fail.
void print(const Outcome& outcome) {
  std::string text = fmt::format("{}: {} lines, {} failed, {:.1f} s\n", outcome.of.name, outcome.rows.size(),
                                 outcome.failed(), outcome.seconds);
  if (!outcome.error.empty()) text += fmt::format("  FAIL stopped: {}\n", outcome.error);
  for (const Row& row : outcome.rows) {
    if (!row.detail || !row.pass()) text += to_line(row) + '\n';
  }
  fmt::print("{}", text);
  std::fflush(stdout);
}

/// Runs a case and measures its time; an exception becomes its error.
void run_case(Outcome& out, Effort effort) {
  const auto start = std::chrono::steady_clock::now();
  try {
    out.rows = out.of.run(effort);
  } catch (const std::exception& e) { out.error = e.what(); }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs `jobs` cases in parallel, the longest first. Each case steps on one thread.
void run_all(std::vector<Outcome>& outcomes, Effort effort, int jobs) {
  std::vector<Outcome*> order;
  for (Outcome& outcome : outcomes) order.push_back(&outcome);
  std::stable_partition(order.begin(), order.end(), [](const Outcome* o) { return o->of.name == "long_driven"; });
  std::stable_partition(order.begin(), order.end(), [](const Outcome* o) { return o->of.name.rfind("long", 0) == 0; });
  std::atomic<std::size_t> next{0};
  std::mutex printing;
  std::vector<std::jthread> workers;
  for (int j = 0; j < jobs; ++j) {
    workers.emplace_back([&] {
      for (std::size_t k; (k = next++) < order.size();) {
        run_case(*order[k], effort);
        const std::scoped_lock lock(printing);
        print(*order[k]);
      }
    });
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Stability under stress: expected results, measured results, and the verdict");
  bool quick = false;
  int jobs = 2;
  std::vector<std::string> names;
  std::string csv, date = "no date given", commit = "unknown";
  app.add_flag("--quick", quick, "below a minute: fewer steps, smaller scenes");
  app.add_option("--cases", names, "only these")->delimiter(',');
  app.add_option("--jobs", jobs, "cases side by side")->check(CLI::PositiveNumber);
  app.add_option("--csv", csv, "file of the whole table");
  app.add_option("--date", date, "for its head");
  app.add_option("--commit", commit, "likewise");
  CLI11_PARSE(app, argc, argv);

  Circumstances where{date, commit, processor(), quick ? "quick" : "full", ""};
  const auto backends = macadam::report_backends();
  where.cuda = backends.devices.empty() ? "skipped, " + backends.cuda_status : "run on " + backends.devices[0].name;
  fmt::print("cuda: {}\n", where.cuda);
  std::vector<Outcome> outcomes;
  for (const Case& of : cases()) {
    if (names.empty() || std::find(names.begin(), names.end(), of.name) != names.end())
      outcomes.push_back({of, {}, 0, ""});
  }
  if (outcomes.size() != (names.empty() ? cases().size() : names.size())) {
    fmt::print(stderr, "no such case among {}\n", fmt::join(names, ", "));
    return 2;
  }
  run_all(outcomes, quick ? Effort::quick : Effort::full, jobs);
  int failed = 0;
  for (const Outcome& outcome : outcomes) failed += outcome.failed();
  if (!csv.empty()) write_csv(csv, outcomes, where);
  return failed > 0 ? 1 : 0;
}
