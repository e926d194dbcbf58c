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
#include "host/stepping/cuda_code.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr int at_once_on_a_device = 4;

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
    const int cores = omp_get_max_threads(),
              usual = devices.empty() ? cores : at_once_on_a_device * int(devices.size());
    workers_ = std::clamp(options.at_once > 0 ? options.at_once : std::min(usual, cores), 1, int(jobs.size()));
    if (!devices.empty())  // they wake up while the first specimens are made
      usable_ = std::async(std::launch::async, [there] { return usable(there); }).share();
    // While a device steps one specimen, the next is made by all cores. The first is there early then; specimens that
    // are made at the same time are there at the same time, and late.
    may_prepare_ = devices.empty() ? workers_ : std::min(workers_, int(devices.size()));
    threads_ = std::max(1, cores / may_prepare_);
    beside_ = devices.empty() ? 1 : (workers_ + int(devices.size()) - 1) / int(devices.size());
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
      try {
        Scene scene = jobs_[job].scene;
        const Watcher watcher = watcher_of(job);
        const Preparation prepared = prepare_in_turn(scene, watcher);
        device = take_device(scene.solver);
        if (device) scene.solver.devices = {*device}, scene.solver.side_by_side = beside_;
        const bool resume = options_.resume && has_checkpoint(jobs_[job].out);
        outcome.result = macadam::run(scene, prepared, jobs_[job].out, watcher, resume);
      } catch (...) { outcome.error = std::current_exception(); }
      const std::lock_guard lock(mutex_);
      if (device) --running_[*device];
      try {
        if (options_.done) options_.done(job, outcome);
      } catch (...) { thrown_ = std::current_exception(); }
    }
  }

  Preparation prepare_in_turn(const Scene& scene, const Watcher& watcher) {
    {
      std::unique_lock lock(mutex_);
      prepared_.wait(lock, [&] { return may_prepare_ > 0; });
      --may_prepare_;
    }
    struct Turn {
      Pool& pool;
      ~Turn() {
        const std::lock_guard lock(pool.mutex_);
        ++pool.may_prepare_;
        pool.prepared_.notify_one();
      }
    } const turn{*this};
    if (options_.stop && options_.stop()) throw InterruptedError("interrupted before it began");
    return prepare(scene, watcher.progress);
  }

  /// None where the processor runs the scene.
  std::optional<int> take_device(const SolverSpec& solver) {
    if (select_backend(solver.backend, nullptr, solver.devices) != Backend::cuda) return {};
    DeviceList meant = solver.devices.empty() ? usable_.get() : device_numbers(solver.devices);
    if (const DeviceList answer = usable(meant); !answer.empty()) meant = answer;
    const std::lock_guard lock(mutex_);
    const int least =
        *std::min_element(meant.begin(), meant.end(), [&](int a, int b) { return running_[a] < running_[b]; });
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
  std::shared_future<DeviceList> usable_;
  std::mutex mutex_;  // of what follows, and of the options' functions
  std::condition_variable prepared_;
  int may_prepare_ = 1;
  std::size_t next_ = 0;
  std::map<int, int> running_;  // device: scenes
  std::exception_ptr thrown_;   // by an option's function
  std::vector<JobOutcome> outcomes_;
};

}  // namespace

std::vector<JobOutcome> run_many(const std::vector<SceneJob>& jobs, const ManyOptions& options) {
  require_folders_differ(jobs);
  if (jobs.empty()) return {};
  return Pool(jobs, options).run();
}

}  // namespace macadam
