// SPDX-License-Identifier: GPL-3.0-or-later
// main.cpp  Measures run time and error for all settings that a user can choose, and writes one CSV. Called by
// bench/accuracy/run.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>

#include "bench/accuracy/precision.hpp"
#include "macadam/error.hpp"

namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string describe(const macadam::accuracy::Case& c) {
  return fmt::format("{} {} {} {:g} Hz, scaling {:g}, {} {} {} {}, share {:g}, from {}", c.study, c.scene, c.mix,
                     c.frequency, c.density_scaling, to_string(c.backend), to_string(c.precision), to_string(c.form),
                     to_string(c.geometry), c.step_share, to_string(c.start));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace macadam;
  using namespace macadam::accuracy;
  CLI::App app("Error of |E*| and phi against the harmonic solution, and run time, over all settings");
  bool quick = false, full = false, precision = false;
  Backend backend = Backend::cpu;
  std::string root, csv, only;
  app.add_flag("--quick", quick, "the short list: a minute");
  app.add_flag("--full", full, "the full specimen, and nothing else");
  app.add_flag("--precision", precision, "mixed and single against double, and nothing else");
  app.add_option("--backend", backend, "of --precision")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Backend>{{"cpu", Backend::cpu}, {"cuda", Backend::cuda}}));
  app.add_option("--only", only, "only runs whose printed description contains this text");
  app.add_option("root", root, "of the repository")->required();
  app.add_option("csv", csv, "file to write")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    const BackendReport report = report_backends();
    const bool cuda = !report.devices.empty();
    const std::filesystem::path scratch = std::filesystem::path(csv).concat(".run");
    Runner runner(root, scratch);
    if (precision) {
      measure_precision(runner, backend, csv, cuda && backend == Backend::cuda ? report.devices[0].name : processor(),
                        only);
      std::filesystem::remove_all(scratch);
      return 0;
    }
    Table table(csv, {fmt::format("machine: {}{}; one thread", processor(), cuda ? ", " + report.devices[0].name : ""),
                      fmt::format("date: {:%Y-%m-%d}", std::chrono::system_clock::now()),
                      fmt::format("list: {}{}",
                                  quick  ? "quick"
                                  : full ? "full"
                                         : "standard",
                                  only.empty() ? only : fmt::format(", only '{}'", only))});
    std::vector<Case> list = studies(quick, full, cuda);
    std::erase_if(list, [&](const Case& c) {
      return (full && c.scene != "full") || describe(c).find(only) == std::string::npos;
    });
    for (std::size_t i = 0; i < list.size(); ++i) {
      Case& c = list[i];
      std::vector<Outcome> outcomes;
      try {
        outcomes = runner.run(c);
      } catch (const InputError& error) {  // filters may disconnect the specimen
        outcomes.emplace_back().status = error.what();
      }
      for (const Outcome& o : outcomes) table.add(c, o);
      const Outcome& last = outcomes.back();
      fmt::print(stderr, "{}/{} {}: {}, |E*| {:+.1e}, phi {:+.1e}, {:.2f} s\n", i + 1, list.size(), describe(c),
                 last.status, last.found.e_star_pa / last.truth.e_star_pa - 1,
                 last.found.phase_deg - last.truth.phase_deg, last.seconds);
    }
    std::filesystem::remove_all(scratch);
  } catch (const std::exception& error) {
    fmt::print(stderr, "accuracy: {}\n", error.what());
    return 1;
  }
}
