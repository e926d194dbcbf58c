// SPDX-License-Identifier: GPL-3.0-or-later
/// \file job.hpp  What the commands `run` and `specimen` share: the scene as the command line changes it, and what is
/// said of a specimen.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "host/cli/options.hpp"
#include "host/cli/progress_line.hpp"
#include "host/scene/overrides.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// What both were asked on the command line.
struct Job {
  std::string scene, out;
  std::optional<std::uint64_t> seed;
};

/// Options that stand for keys of the scene, in the help.
inline constexpr const char* instead_of_scene = "Instead of the scene's own";

/// "0", "0,1", "all".
DeviceList devices_of(const std::string& text);

/// SCENE, --out and --seed.
void add_job_options(CLI::App& command, Job& job);
/// --out and --seed alone.
void add_out_and_seed(CLI::App& command, Job& job);

/// --backend, --precision, --method, --linear, --threads and --device.
void add_overrides(CLI::App& command, Overrides& instead);

/// --device alone: "0", "0,1" or "all".
template <class Target>  // DeviceList, or an optional one
CLI::Option* add_devices(CLI::App& command, Target& target) {
  return options::add(command, "--device,--devices",
                      "number of the CUDA device, as macadam info lists them, or 0,1,… or all: they share the specimen",
                      [&target](const std::string& text) { target = devices_of(text); })
      ->type_name("LIST");
}

/// --ranks
inline void add_ranks(CLI::App& command, bool& ranks) {
  command.add_flag("--ranks", ranks,
                   "step one specimen by all the processes that mpirun began, each with a CUDA device");
}

/// Reads the scene. \throws InputError.
Scene scene_of(const Job& job);

/// What follows from a recipe by mass, and what the specimen reached of its curve; nothing where there is none.
void say_recipe(const Scene& scene, const Preparation& prepared);

/// Composition, contacts and times of a specimen, on standard output.
void say_preparation(const Preparation& prepared);

/// Shows how far the work is. \throws InterruptedError where a signal asked to stop: nothing is written yet.
void show_or_stop(ProgressLine& line, const std::string& stage, double share);

}  // namespace macadam
