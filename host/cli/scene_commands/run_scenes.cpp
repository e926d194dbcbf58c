// SPDX-License-Identifier: GPL-3.0-or-later
// run_scenes.cpp  Names the scenes' folders and prints the result of each scene.
#include "host/cli/scene_commands/run_scenes.hpp"

#include <map>
#include <new>

#include "host/cli/scene_commands/run_events.hpp"
#include "host/cli/terminal/json_lines.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "macadam/error.hpp"
#include "macadam/run_many.hpp"

namespace macadam {
namespace {

/// Returns the name of the folder for the results of a scene.
std::string name_of(const std::filesystem::path& scene) {
  const std::filesystem::path whole = std::filesystem::absolute(scene).lexically_normal();
  return (whole.stem() == "scene" ? whole.parent_path().filename() : whole.stem()).string();
}

/// Reports the error of a scene.
void say_failure(const std::string& scene, const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& e) {
    const bool memory = dynamic_cast<const std::bad_alloc*>(&e) != nullptr;
    say_error("macadam: {}: {}\n", scene, memory ? "out of memory" : e.what());
    print_json_error(e, scene);
  }
}

bool is_interrupted(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InterruptedError&) { return true; } catch (...) {
    return false;
  }
}

}  // namespace

void run_scenes(const std::vector<std::string>& scenes, const Job& job, const Overrides& instead, int at_once,
                bool resume) {
  std::vector<SceneJob> jobs;
  std::map<std::string, std::string> scene_named;
  for (const std::string& file : scenes) {
    const std::string name = name_of(file);
    if (const auto [other, is_new] = scene_named.emplace(name, file); !is_new) {
      throw InputError(
          file + ": found the scene name \"" + name + "\", which is also the name of " + other->second +
          ", expected a different name for each scene, because the results folder of a scene has the scene's name");
    }
    Job one = job;
    one.scene = file;
    jobs.push_back({scene_of(one), std::filesystem::path(job.out) / name});
    apply(instead, jobs.back().scene);
  }
  std::vector<std::pair<std::string, std::filesystem::path>> folders;
  for (std::size_t k = 0; k < jobs.size(); ++k) folders.emplace_back(scenes[k], jobs[k].out);
  print_start_event(folders);
  ProgressLine line;
  std::size_t ended = 0, failed = 0, interrupted = 0;
  ManyOptions options;
  options.at_once = at_once;
  options.resume = resume;
  options.stop = stop_asked;
  options.progress = [&](std::size_t k, const std::string& stage, double share) {
    print_json_progress(scenes[k], stage, share);
    line.show(fmt::format("{} of {} scenes", ended, jobs.size()),
              static_cast<double>(ended) / static_cast<double>(jobs.size()));
  };
  options.warn = [&](std::size_t k, const std::string& warning) {
    line.clear();
    say_error("macadam: warning: {}: {}\n", scenes[k], warning);
    print_json_warning(scenes[k], warning);
  };
  options.done = [&](std::size_t k, const JobOutcome& outcome) {
    line.clear();
    ++ended;
    if (outcome.error && is_interrupted(outcome.error)) {
      ++interrupted;
    } else if (outcome.error) {
      ++failed;
      say_failure(scenes[k], outcome.error);
    } else {
      say("{}: {}\n{}", scenes[k], outcome.result->solver, results_table(*outcome.result));
      for (const std::string& warning : outcome.result->warnings) say("warning: {}\n", warning);
      say("\n");
      print_result_event(scenes[k], jobs[k].out, files_left(jobs[k].scene, jobs[k].out), *outcome.result);
      flush_output();
    }
  };
  listen_to_stop_signals();
  run_many(jobs, options);
  line.clear();
  if (interrupted > 0) {
    throw InterruptedError(
        fmt::format("interrupted: {} of {} scenes are not done; with --resume the same command continues scenes that "
                    "have a checkpoint and repeats the others",
                    interrupted + failed, jobs.size()));
  }
  if (failed > 0) throw RunError(fmt::format("{} of {} scenes failed", failed, jobs.size()));
  say("{} scenes | results in {}\n", jobs.size(), job.out);
}

}  // namespace macadam
