// SPDX-License-Identifier: GPL-3.0-or-later
// run_many.cpp  Scenes handed to threads as these become free, and devices to scenes as they begin.
#include "macadam/run_many.hpp"

#include <omp.h>

#include <algorithm>
#include <condition_variable>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include "host/simulation/checkpoints.hpp"
#include "host/simulation/run_scene.hpp"
#include "host/stepping/cuda_code.hpp"
#include "macadam/error.hpp"
#include "macadam/ranks.hpp"

namespace macadam {
namespace {

constexpr int at_once_on_a_device = 4;
/// While a device steps one specimen, so many are made, by all cores. More at a time would all be there late; one after
/// the other they can take longer than their steps (bench/results/many-h100-2026-11-25.csv).
constexpr int prepared_for_a_device = 2;

/// Of devices, those that answer: one that does not would fail a scene after the other.
DeviceList usable(const DeviceList& devices) {
  DeviceList out;
  for (const int d : devices) {
    try {
      select_backend(Backend::cuda, nullptr, {d});
      out.push_back(d);
    } catch (const RunError&) {}
  }
  return out;
}

void require_folders_differ(const std::vector<SceneJob>& jobs) {
  std::set<std::filesystem::path> folders;
  for (const SceneJob& job : jobs) {
    if (!folders.insert(std::filesystem::weakly_canonical(job.out)).second)
      throw InputError(job.out.string() + ": found two scenes with this folder, expected a folder for each");
  }
}

class Pool {
 public:
  Pool(const std::vector<SceneJob>& jobs, const ManyOptions& options)
      : jobs_(jobs), options_(options), outcomes_(jobs.size()) {
    std::set<int> devices;
    DeviceList there;
    if (!report_backends().devices.empty()) there = device_numbers({every_device});
    for (const SceneJob& job : jobs) {
      const SolverSpec& solver = job.scene.solver;
      const bool may = solver.backend == Backend::cuda || solver.backend == Backend::automatic;
      for (const int d : there) {
        const bool meant = solver.devices.empty() || solver.devices == DeviceList{every_device} ||
                           std::count(solver.devices.begin(), solver.devices.end(), d) > 0;
        if (may && meant) devices.insert(d);
      }
    }
    const int cores = omp_get_max_threads(), number = static_cast<int>(devices.size());
    const int usual = number == 0 ? cores : std::min(at_once_on_a_device * number, cores);
    workers_ = may_prepare_ = std::clamp(options.at_once > 0 ? options.at_once : usual, 1, int(jobs.size()));
    if (number > 0) {
      may_prepare_ = std::min(workers_, prepared_for_a_device * number);
      beside_ = (workers_ + number - 1) / number;
      usable_ = std::async(std::launch::async, [there] { return usable(there); }).share();
    }
    threads_ = std::max(1, cores / may_prepare_);
  }

  std::vector<JobOutcome> run() {
    std::vector<std::thread> workers;  // not this one, whose number of threads stays as it is
    try {
      for (int k = 0; k < workers_; ++k) workers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      if (workers.empty()) throw;  // else fewer do it
    }
    for (std::thread& t : workers) t.join();
    if (thrown_) std::rethrow_exception(thrown_);
    return std::move(outcomes_);
  }

 private:
  void work() {
    omp_set_num_threads(threads_);
    for (;;) {
      std::size_t job = 0;
      {
        const std::lock_guard lock(mutex_);
        if (next_ == jobs_.size() || thrown_) return;
        job = next_++;
      }
      JobOutcome& outcome = outcomes_[job];
      std::optional<int> device;
      RunParts parts;
      parts.prepare = [this](const Scene& scene, const Progress& progress) { return prepare_in_turn(scene, progress); };
      parts.place = [&](SolverSpec& solver) {
        device = take_device(solver);
        solver.devices = {*device}, solver.side_by_side = beside_;
      };
      try {
        if (options_.stop && options_.stop()) throw InterruptedError("interrupted before it began");
        const SceneJob& asked = jobs_[job];
        const bool resume = options_.resume && has_checkpoint(asked.out);
        outcome.result = run_scene(asked.scene, asked.out, watcher_of(job), resume, parts);
      } catch (...) { outcome.error = std::current_exception(); }
      const std::lock_guard lock(mutex_);
      if (device) --running_[*device], changed_.notify_all();
      try {
        if (options_.done) options_.done(job, outcome);
      } catch (...) { thrown_ = std::current_exception(); }
    }
  }

  Preparation prepare_in_turn(const Scene& scene, const Progress& progress) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return may_prepare_ > 0; });
      --may_prepare_;
    }
    struct Turn {
      Pool& pool;
      ~Turn() {
        const std::lock_guard lock(pool.mutex_);
        ++pool.may_prepare_;
        pool.changed_.notify_all();
      }
    } const turn{*this};
    if (options_.stop && options_.stop()) throw InterruptedError("interrupted before it began");
    return prepare(scene, progress);
  }

  /// Of those that are meant and answer, the one that runs the fewest; waits where all have as many as they may.
  int take_device(const SolverSpec& solver) {
    DeviceList meant = solver.devices.empty() ? usable_.get() : usable(device_numbers(solver.devices));
    if (meant.empty()) meant = device_numbers(solver.devices);  // making the stepper says why it cannot
    std::unique_lock lock(mutex_);
    int least = 0;
    changed_.wait(lock, [&] {
      least = *std::min_element(meant.begin(), meant.end(), [&](int a, int b) { return running_[a] < running_[b]; });
      return running_[least] < beside_;
    });
    ++running_[least];
    return least;
  }

  Watcher watcher_of(std::size_t job) {
    Watcher out;
    out.stop = options_.stop;
    const auto begun = std::make_shared<bool>(false);
    out.planned = [begun](const RunResult&) { *begun = true; };
    out.progress = [this, job, begun](const std::string& stage, double share) {
      if (!*begun && options_.stop && options_.stop())
        throw InterruptedError("interrupted at: " + stage + "; nothing was written, what the folder held is as it was");
      const std::lock_guard lock(mutex_);
      if (options_.progress) options_.progress(job, stage, share);
    };
    out.warn = [this, job](const std::string& warning) {
      const std::lock_guard lock(mutex_);
      if (options_.warn) options_.warn(job, warning);
    };
    return out;
  }

  const std::vector<SceneJob>& jobs_;
  const ManyOptions& options_;
  int workers_ = 1, threads_ = 1, beside_ = 1;
  std::shared_future<DeviceList> usable_;  // known once devices are awake, while the first specimens are made
  std::mutex mutex_;                       // of what follows, and of the options' functions
  std::condition_variable changed_;
  int may_prepare_ = 1;
  std::size_t next_ = 0;
  std::map<int, int> running_;  // device: scenes
  std::exception_ptr thrown_;   // by an option's function
  std::vector<JobOutcome> outcomes_;
};

}  // namespace

std::vector<JobOutcome> run_many(const std::vector<SceneJob>& jobs, const ManyOptions& options) {
  if (const Ranks* team = ranks()) {
    throw InputError("scenes: found several beside " + std::to_string(team->count()) +
                     " ranks, expected one: a process alone runs them side by side on all devices of its host");
  }
  require_folders_differ(jobs);
  if (jobs.empty()) return {};
  return Pool(jobs, options).run();
}

}  // namespace macadam
