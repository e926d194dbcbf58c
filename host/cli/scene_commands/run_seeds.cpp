// SPDX-License-Identifier: GPL-3.0-or-later
// run_seeds.cpp  Passes a scene, its seeds and the options of its runs to a study of the Python package.
#include "host/cli/scene_commands/run_seeds.hpp"

#include "host/cli/terminal/python_package.hpp"
#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "host/simulation/preparation_files.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Returns the options of the command line that replace keys of the scene, except the seed and the values of --set.
std::vector<std::string> options_of_runs(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_lnames().empty() ? "" : option->get_lnames().front();
    if (option->get_group() != instead_of_scene || option->count() == 0 || name == "seed" || name == "set") continue;
    out.push_back("--run-option=--" + name + "=" + option->results().back());
  }
  return out;
}

}  // namespace

void run_seeds(const CLI::App& command, const Job& job, const Overrides& instead, int seeds, int at_once) {
  Scene scene = read_changed_scene(job.scene, job.set);
  if (scene.specimen.file) {
    throw InputError(scene.file.string(), 0, "--seeds",
                     "the specimen of the file " + scene.specimen.file->string() + ", which has no seed",
                     "a scene whose specimen is generated");
  }
  apply(instead, scene);
  require_combination(scene);
  std::string file = job.scene;
  if (!job.set.empty()) {
    const ResultFolder folder(job.out);  // made if it does not exist
    const std::filesystem::path changed = std::filesystem::path(job.out) / changed_scene_file;
    write_whole(changed, changed_scene_text(scene, job.out));
    file = changed.string();
  }
  std::vector<std::string> arguments{file,
                                     "--out",
                                     job.out,
                                     "--seeds",
                                     fmt::format("{}", seeds),
                                     "--first-seed",
                                     fmt::format("{}", job.seed.value_or(scene.specimen.seed))};
  if (at_once > 0) arguments.insert(arguments.end(), {"--workers", fmt::format("{}", at_once)});
  for (std::string& option : options_of_runs(command)) arguments.push_back(std::move(option));
  run_python("study", arguments);
}

}  // namespace macadam
