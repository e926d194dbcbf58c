// SPDX-License-Identifier: GPL-3.0-or-later
// run_command.cpp  Implements `macadam run SCENE… --out DIR`.
#include "host/cli/scene_commands/run_command.hpp"

#include <memory>

#include "host/cli/terminal/as_rank.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/json_lines.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/scene_commands/run_events.hpp"
#include "host/cli/scene_commands/run_scenes.hpp"
#include "host/cli/scene_commands/run_seeds.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "macadam/error.hpp"
#include "macadam/macadam.hpp"
#include "macadam/overrides.hpp"

namespace macadam {
namespace {

struct RunArguments {
  Job job;
  std::vector<std::string> scenes;
  Overrides instead;
  bool resume = false, ranks = false;
  int at_once = 0;
  std::optional<int> seeds;
  bool json = false;
};

/// Refuses options that have no effect with --seeds. \throws InputError.
void require_seeds_alone(const RunArguments& arguments) {
  const auto refuse = [](const std::string& found, const std::string& expected) {
    throw InputError("macadam run", 0, "--seeds", found, expected);
  };
  if (arguments.scenes.size() > 1) refuse(fmt::format("{} scenes", arguments.scenes.size()), "one scene");
  if (arguments.ranks) refuse("--ranks", "this option without --ranks, because the seeds are runs of their own");
  if (arguments.json) refuse("--json", "this option without --json; summary.json in the folder has the results");
  if (arguments.resume)
    refuse("--resume", "the same command without --resume, because it continues the seeds that have a checkpoint");
}

/// Runs one scene. Sets `stepping` to true when planning is done and the time steps begin.
void run_one(const RunArguments& arguments, bool* stepping = nullptr) {
  Scene scene = scene_of(arguments.job);
  apply(arguments.instead, scene);
  const std::string& file = arguments.job.scene;
  print_start_event({{file, arguments.job.out}});
  ProgressLine line;
  Watcher watcher;
  bool started = false;
  const bool speaks = is_first_rank();
  watcher.progress = [&](const std::string& stage, double share) {
    print_json_progress(file, stage, share);
    if (started || !speaks) {  // before the steps begin, only the first rank (process) reacts to signals
      line.show(stage, share);
    } else {
      show_or_stop(line, stage, share);
    }
  };
  watcher.prepared = [&](const Preparation& prepared) {
    line.clear();
    say_recipe(scene, prepared);
    say_preparation(prepared);
    print_prepared_event(file, prepared);
    flush_output();
  };
  watcher.planned = [&](const RunResult& planned) {
    line.clear();
    for (const std::string& decision : planned.decisions) say("{}\n", decision);
    for (const Skip& skip : planned.skips) say("skips {}: {}\n", skip.what, skip.why);
    print_planned_event(file, planned);
    flush_output();
    started = true;
    if (stepping) *stepping = true;
  };
  watcher.warn = [&](const std::string& warning) {
    line.clear();
    if (speaks) say_error("macadam: warning: {}\n", warning);
    print_json_warning(file, warning);
  };
  watcher.stop = stop_asked;
  listen_to_stop_signals();
  const RunResult result = run(scene, arguments.job.out, watcher, arguments.resume);
  line.clear();
  say("{}", results_table(result));
  for (const std::string& warning : result.warnings) say("warning: {}\n", warning);
  const std::vector<std::string> files = files_left(scene, arguments.job.out);
  say("\n{} | files in {}: {}\n", result.solver, arguments.job.out, fmt::join(files, " "));
  if (speaks) print_result_event(file, arguments.job.out, files, result);
}

void run_command(const CLI::App& command, RunArguments arguments) {
  arguments.job.scene = arguments.scenes.front();
  if (arguments.seeds) {
    require_seeds_alone(arguments);
    run_seeds(command, arguments.job, arguments.instead, *arguments.seeds, arguments.at_once);
  }
  const auto run_all = [&](bool* stepping) {
    if (arguments.scenes.size() == 1) return run_one(arguments, stepping);
    run_scenes(arguments.scenes, arguments.job, arguments.instead, arguments.at_once, arguments.resume);
  };
  Ranks* const team = arguments.ranks ? join_ranks() : nullptr;
  if (!team) return run_all(nullptr);
  as_rank(*team, [&](bool& stepping) { run_all(&stepping); });
}

}  // namespace

void add_run_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("run", "run a scene, or several side by side, and write the results");
  const auto arguments = std::make_shared<RunArguments>();
  command
      .add_option("scene", arguments->scenes,
                  "scene files (TOML); each of several scenes gets a folder of its own in the folder of --out")
      ->required()
      ->type_name("FILE");
  add_out_and_seed(command, arguments->job);
  command.add_flag("--resume", arguments->resume,
                   "continue from the checkpoint that an interrupted run left in the folder");
  add_ranks(command, arguments->ranks);
  add_number(command, "--at-once", arguments->at_once,
             "number of scenes or seeds that run at the same time; 0: four scenes on each CUDA device, or one on each "
             "CPU core",
             0, 1024);
  command
      .add_flag("--json", arguments->json,
                "print progress, results and errors as one JSON object per line, for other programs")
      ->disable_flag_override();
  add_number(
      command, "--seeds", arguments->seeds,
      "run the scene with this number of seeds, from its seed on, and write the mean and standard deviation of each "
      "result (by the Python package)",
      2, 10000);
  add_set(command, arguments->job.set);
  add_overrides(command, arguments->instead);
  add_examples(command, {"macadam run examples/demo/scene.toml --out results",
                         "macadam run examples/demo/scene.toml --out results/steady --method harmonic --seed 2",
                         "macadam run examples/demo/scene.toml --out results/fast --set solver.tolerance=1e-2 --set "
                         "\"loading.frequencies=[1, 10]\"",
                         "macadam run examples/demo/scene.toml --out results/seeds --method harmonic --seeds 3",
                         "macadam run mixes/*.toml --out results --at-once 4",
                         "mpirun -n 2 macadam run examples/demo/scene.toml --ranks --out results"});
  command.callback([&command, arguments] { run_command(command, *arguments); });
}

}  // namespace macadam
