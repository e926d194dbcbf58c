// SPDX-License-Identifier: GPL-3.0-or-later
// run_command.cpp  Implements `macadam run SCENE… --out DIR`.
#include "host/cli/scene_commands/run_command.hpp"

#include <memory>

#include "host/cli/terminal/as_rank.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/scene_commands/run_scenes.hpp"
#include "host/cli/scene_commands/run_seeds.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "host/experiments/experiment.hpp"
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
};

/// Refuses options that have no effect with --seeds. \throws InputError.
void require_seeds_alone(const RunArguments& arguments) {
  const auto refuse = [](const std::string& found, const std::string& expected) {
    throw InputError("macadam run", 0, "--seeds", found, expected);
  };
  if (arguments.scenes.size() > 1) refuse(fmt::format("{} scenes", arguments.scenes.size()), "one scene");
  if (arguments.ranks) refuse("--ranks", "this option without --ranks, because the seeds are runs of their own");
  if (arguments.resume)
    refuse("--resume", "the same command without --resume, because it continues the seeds that have a checkpoint");
}

/// Runs one scene. Sets `stepping` to true when planning is done and the time steps begin.
void run_one(const RunArguments& arguments, bool* stepping = nullptr) {
  Scene scene = scene_of(arguments.job);
  apply(arguments.instead, scene);
  ProgressLine line;
  Watcher watcher;
  bool started = false;
  const bool speaks = is_first_rank();
  watcher.progress = [&](const std::string& stage, double share) {
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
    flush_output();
  };
  watcher.planned = [&](const RunResult& planned) {
    line.clear();
    for (const std::string& decision : planned.decisions) say("{}\n", decision);
    for (const Skip& skip : planned.skips) say("skips {}: {}\n", skip.what, skip.why);
    flush_output();
    started = true;
    if (stepping) *stepping = true;
  };
  watcher.warn = [&](const std::string& warning) {
    line.clear();
    if (speaks) say_error("macadam: warning: {}\n", warning);
  };
  watcher.stop = stop_asked;
  listen_to_stop_signals();
  const RunResult result = run(scene, arguments.job.out, watcher, arguments.resume);
  line.clear();
  say("{}", results_table(result));
  for (const std::string& warning : result.warnings) say("warning: {}\n", warning);
  std::string files;
  for (const std::string& name : files_of_run(scene, !scene.specimen.file)) {
    if (!std::filesystem::exists(std::filesystem::path(arguments.job.out) / name)) continue;
    files += (files.empty() ? "" : " ") + name;
  }
  if (scene.output.fields.any()) files += " fields/";
  say("\n{} | files in {}: {}\n", result.solver, arguments.job.out, files);
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
