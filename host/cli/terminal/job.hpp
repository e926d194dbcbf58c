// SPDX-License-Identifier: GPL-3.0-or-later
/// \file job.hpp  Does the common part of the commands `run` and `specimen`: reads the scene, applies the options of
/// the command line to it, and prints the specimen.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/progress_line.hpp"
#include "macadam/overrides.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// Options that `run` and `specimen` have in common.
struct Job {
  std::string scene, out;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set = {};  ///< texts KEY=VALUE that change values of the scene
};

/// Title in the help for options that replace keys of the scene.
inline constexpr const char* instead_of_scene = "Options that replace keys of the scene";

/// Reads a list of devices: "0", "0,1" or "all".
DeviceList devices_of(const std::string& text);

/// Adds SCENE, --out and --seed.
void add_job_options(CLI::App& command, Job& job);
/// Adds --out and --seed only.
void add_out_and_seed(CLI::App& command, Job& job);

/// Adds --set, which may be given several times.
void add_set(CLI::App& command, std::vector<std::string>& set);

/// Adds --backend, --precision, --method, --linear, --threads and --device.
void add_overrides(CLI::App& command, Overrides& instead);

/// Adds --device only: "0", "0,1" or "all".
template <class Target>  // DeviceList or std::optional<DeviceList>
CLI::Option* add_devices(CLI::App& command, Target& target) {
  return options::add(command, "--device,--devices",
                      "number of a CUDA device in the list of macadam info, or of several devices that share the "
                      "specimen: 0,1,… or all",
                      [&target](const std::string& text) { target = devices_of(text); })
      ->type_name("LIST");
}

/// Adds --ranks.
inline void add_ranks(CLI::App& command, bool& ranks) {
  command.add_flag("--ranks", ranks,
                   "step one specimen with all processes that mpirun started, each on a CUDA device of its own");
}

/// Reads the scene with the values of --set and replaces its seed if the command line gives one. \throws InputError.
Scene scene_of(const Job& job);

/// Prints the volumes and densities that follow from a recipe by mass, and the gradation that the specimen reached.
/// Prints nothing without a recipe.
void say_recipe(const Scene& scene, const Preparation& prepared);

/// Prints composition, contacts and times of a specimen on standard output.
void say_preparation(const Preparation& prepared);

/// Shows how far the work is. \throws InterruptedError if a signal asked to stop; no file has been written by then.
void show_or_stop(ProgressLine& line, const std::string& stage, double share);

}  // namespace macadam
