// SPDX-License-Identifier: GPL-3.0-or-later
// bench_command.cpp  Implements `macadam bench [SCENE]…`.
#include "host/cli/tool_commands/bench_command.hpp"

#include <algorithm>
#include <fstream>
#include <memory>

#include "host/tools/bench/json.hpp"
#include "host/cli/terminal/as_rank.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/backends/rank_device.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

struct BenchArguments {
  std::vector<std::string> scenes;
  bench::BenchAxes axes;
  std::string json, against, only;
  bool ranks = false;
};

/// Prints a row as a line: time, spread, and fractions of the bandwidths that the machine can reach.
void say_row(const bench::BenchRow& row, const bench::MachineSpeed& machine) {
  const double step = bench::median(row.seconds);
  const auto [least, most] = std::minmax_element(row.seconds.begin(), row.seconds.end());
  std::string shares;
  const auto add_share = [&](const char* of, const char* counter, double possible) {
    if (possible > 0 && row.of(counter) > 0) shares += fmt::format(" {}:{:.2f}", of, row.of(counter) / possible);
  };
  double cache = 0, shared = 0;
  for (const DeviceSpeed& d : machine.devices) cache += d.cache, shared += d.shared;
  add_share("memory", "memory_bytes_per_s", machine.copy);
  add_share("cache", "cache_bytes_per_s", cache);
  add_share("shared", "shared_bytes_per_s", shared);
  say("{:64} {:>12.2f} {:>6.1f}% {:>10.3g}{}\n", row.name, 1e6 * step, 100 * (*most - *least) / step,
      row.of("contacts_per_s"), shares);
  std::string parts;
  for (const auto& [name, value] : row.counters) {
    const std::string part = "part_us ";
    if (name.starts_with(part))
      parts += fmt::format("{}{} {:.2f}", parts.empty() ? "" : ", ", name.substr(part.size()), value);
  }
  say("  {}{}\n", row.label, parts.empty() ? "" : "; us: " + parts);
  flush_output();
}

void say_machine(const bench::MachineSpeed& machine) {
  for (const DeviceSpeed& d : machine.devices) {
    say("{}: {} multiprocessors at {:.0f} MHz, CUDA {}.{}; copy {:.2f} TB/s, second-level cache of {} MB {:.2f} TB/s, "
        "shared memory {:.1f} TB/s\n",
        d.name, d.multiprocessors, 1e-6 * d.clock, d.driver / 1000, d.driver % 1000 / 10, 1e-12 * d.copy,
        d.cache_bytes >> 20, 1e-12 * d.cache, 1e-12 * d.shared);
  }
  if (machine.devices.empty()) say("processor: copy {:.1f} GB/s\n", 1e-9 * machine.copy);
  say("{:64} {:>12} {:>7} {:>10} {}\n", "median", "us", "spread", "contacts/s", "share of bandwidth");
}

/// Prints the old and the new time of each row. Returns whether any row became slower.
bool say_changes(const std::vector<bench::BenchRow>& before, const std::vector<bench::BenchRow>& rows,
                 const std::string& file) {
  bool slower = false;
  const auto found = bench::compare(before, rows);
  say("\n{:64} {:>12} {:>12} {:>7}\n", "against " + file, "us before", "us now", "ratio");
  for (const bench::Comparison& c : found) {
    slower = slower || c.slower;
    say("{:64} {:>12.2f} {:>12.2f} {:>7.3f}{}\n", c.name, 1e6 * c.before, 1e6 * c.now, c.now / c.before,
        c.slower   ? "  slower"
        : c.faster ? "  faster"
                   : "");
  }
  if (found.size() < rows.size()) say("{} rows are new\n", rows.size() - found.size());
  return slower;
}

void time_scenes(BenchArguments arguments) {
  std::vector<bench::BenchRow> before;
  if (!arguments.against.empty())
    before = bench::read_rows(arguments.against);  // first, so that a missing file is reported before the work
  if (!arguments.only.empty()) {
    arguments.axes.steps = arguments.only == "step";
    arguments.axes.harmonic = arguments.only == "harmonic";
    arguments.axes.preparation = arguments.only == "preparation";
  }
  if (arguments.scenes.empty()) arguments.scenes = {"lattice:1e4", "lattice:1e5"};
  const bench::BenchAxes& axes = arguments.axes;
  const Backend backend = select_backend(axes.backend, nullptr, axes.devices);
  const int most = *std::max_element(axes.threads.begin(), axes.threads.end());
  const bool all = std::count(axes.threads.begin(), axes.threads.end(), 0) > 0;
  const bench::MachineSpeed machine = bench::measure_machine(axes.backend, axes.devices, all ? 0 : most);
  say_machine(machine);
  const nlohmann::ordered_json context = bench::context_of(machine, backend);
  std::vector<bench::BenchRow> rows;
  for (const std::string& scene : arguments.scenes) {
    const bench::BenchCase timed = bench::case_of(scene);
    bench::time_case(timed, axes, [&](const bench::BenchRow& row) {
      say_row(row, machine);
      rows.push_back(row);
      if (arguments.json.empty()) return;
      // written after every row, so that an interrupted run leaves what was measured
      std::ofstream out(arguments.json);
      if (!(out << bench::json_of(context, rows).dump(1) << '\n').flush())
        throw RunError(arguments.json + ": cannot be written");
    });
  }
  if (!arguments.against.empty() && say_changes(before, rows, arguments.against))
    throw RunError("some rows are slower than in " + arguments.against +
                   " by more than the scatter of the measurements");
}

/// Times the scenes. With --ranks, every process uses another device, only steps are timed, and the first process
/// writes the results.
void bench_command(BenchArguments arguments) {
  Ranks* const team = arguments.ranks ? join_ranks() : nullptr;
  if (!team) return time_scenes(std::move(arguments));
  as_rank(*team, [&](bool&) {
    if (!arguments.only.empty() && arguments.only != "step")
      throw InputError("--only together with --ranks: found \"" + arguments.only + "\", expected \"step\"");
    if (arguments.axes.backend == Backend::cpu)
      throw InputError("--backend together with --ranks: found \"cpu\", expected \"cuda\"");
    arguments.only = "step";
    arguments.axes.devices = device_of(*team, arguments.axes.devices);
    if (team->number() > 0) arguments.json.clear(), arguments.against.clear();
    time_scenes(std::move(arguments));
  });
}

/// Adds an option that takes one or several of the names in `choices`, separated by commas.
template <class T>
void add_choices(CLI::App& command, const std::string& name, std::vector<T>& target, const std::string& description,
                 const std::vector<std::pair<std::string, T>>& choices) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : ",") + choice.first;
  options::add(command, name, description, [&target, name, choices, names](const std::string& text) {
    target.clear();
    for (const std::string& word : CLI::detail::split(text, ',')) {
      const auto known = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.first == word; });
      if (known == choices.end()) options::refuse(name, text, "one or more of " + names + ", with commas");
      target.push_back(known->second);
    }
  })->type_name("LIST");
}

/// Adds an option that takes several numbers, separated by commas.
template <class T>
void add_list(CLI::App& command, const std::string& name, std::vector<T>& target, const std::string& description, T low,
              T high) {
  options::add(command, name, description, [&target, name, low, high](const std::string& text) {
    target.clear();
    for (const std::string& word : CLI::detail::split(text, ',')) {
      T value{};
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || stop != word.data() + word.size() || !(value >= low && value <= high))
        options::refuse(name, text, fmt::format("numbers from {} to {}, separated by commas", low, high));
      target.push_back(value);
    }
  })->type_name("LIST");
}

}  // namespace

void add_bench_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("bench", "measure the speed of time steps and iterations on this machine");
  const auto arguments = std::make_shared<BenchArguments>();
  bench::BenchAxes& axes = arguments->axes;
  command
      .add_option("scene", arguments->scenes,
                  "scenes (TOML); SCENE.toml=specimen.csv for a specimen from a file; lattice:PARTICLES for a lattice "
                  "of spheres; default: lattice:1e4 lattice:1e5")
      ->type_name("FILE");
  add_choice(command, "--backend", axes.backend, "backend that computes",
             {{"auto", Backend::automatic}, {"cuda", Backend::cuda}, {"cpu", Backend::cpu}});
  add_devices(command, axes.devices);
  add_ranks(command, arguments->ranks);
  add_list(command, "--threads", axes.threads, "numbers of CPU threads, with one row for each number; 0: all threads",
           0, 1024);
  add_choices(command, "--form", axes.forms, "condensed,points",
              {{"condensed", ContactForm::condensed}, {"points", ContactForm::points}});
  add_choices(command, "--precision", axes.precisions, "double,mixed,single",
              {{"double", Precision::double_}, {"mixed", Precision::mixed}, {"single", Precision::single}});
  add_choices(command, "--geometry", axes.geometries, "fixed,updated",
              {{"fixed", Geometry::fixed}, {"updated", Geometry::updated}});
  add_list(command, "--blocks", axes.blocks,
           "number of updates of the viscoelastic states within the shortest characteristic time of the load and the "
           "laws, in place of "
           "an update in every step; 4000 is usual",
           1.0, 1e18);
  add_list(command, "--units", axes.units, "number of Kelvin units that every law gets; -1: as in the scene", -1, 16);
  command.add_flag("--elastic", axes.elastic, "replace every law by its instantaneous spring");
  add_list(command, "--multiprocessors", axes.multiprocessors,
           "number of multiprocessors of a device that are used; 0: all", 0, 4096);
  add_list(command, "--loads", axes.loads, "number of frequencies that are solved at the same time", 1, 4);
  add_choice(command, "--only", arguments->only,
             "measure only time steps, only solutions in the frequency domain, or the preparation of a run",
             {{"step", "step"}, {"harmonic", "harmonic"}, {"preparation", "preparation"}});
  add_number(command, "--repetitions", axes.repetitions, "number of measurements per row", 1, 1000);
  add_number(command, "--seconds", axes.seconds, "shortest duration of one repetition in seconds", 1e-6, 1e4);
  add_text(command, "--json", arguments->json,
           "file to which the rows are written in the JSON format of Google Benchmark");
  add_text(command, "--against", arguments->against,
           "file that --json wrote earlier; the command compares with it and ends with exit code 1 if a row is slower");
  add_examples(command, {"macadam bench examples/demo/scene.toml --json now.json",
                         "macadam bench lattice:1e6 --backend cuda --device all --precision single",
                         "macadam bench --backend cpu --threads 1,2 --only step --against before.json"});
  command.callback([arguments] { bench_command(*arguments); });
}

}  // namespace macadam
