// SPDX-License-Identifier: GPL-3.0-or-later
// run_many.cpp  Gives scenes to threads that have become free, and a device to each scene before its steps begin.
#include "macadam/run_many.hpp"

#include <omp.h>

#include <algorithm>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "host/run/checkpoints.hpp"
#include "host/simulation/device_shares.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "host/simulation/run_scene.hpp"
#include "host/backends/cuda_code.hpp"
#include "macadam/error.hpp"
#include "macadam/ranks.hpp"

namespace macadam {
namespace {

/// Number of scenes that run on a device at a time.
constexpr int at_once_on_a_device = 4;
/// Number of specimens per device that are prepared at the same time. With a larger number, many specimens would share
/// the cores and all of them would be ready late. With one, preparing a specimen could take longer than the steps of
/// the previous specimen (bench/results/many.csv). With several devices, the first two specimens of each device are
/// prepared one after the other with twice the number of cores; otherwise the device would wait for its second
/// specimen. One device is assumed until the devices are counted.
constexpr int prepared_for_a_device = 2;

/// Returns the devices that answer. On a device that does not answer, one scene after the other would fail.
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

/// Checks that every scene has its own folder. \throws InputError if two scenes have the same folder.
void require_folders_differ(const std::vector<SceneJob>& jobs) {
  std::set<std::filesystem::path> folders;
  for (const SceneJob& job : jobs) {
    if (!folders.insert(std::filesystem::weakly_canonical(job.out)).second)
      throw InputError(job.out.string() +
                       ": found two scenes with this results folder, expected a separate folder for each scene");
  }
}

/// Returns the devices on which at least one scene may be stepped. Counts the devices, which takes some tenths of a
/// second, only if a scene may use one.
DeviceList meant_devices(const std::vector<SceneJob>& jobs) {
  const auto may = [](const SceneJob& job) {
    const Backend backend = requested_backend(job.scene);
    return backend == Backend::cuda || backend == Backend::automatic;
  };
  if (std::ranges::none_of(jobs, may)) return {};
  DeviceList out;
  for (const DeviceInfo& device : report_backends().devices) {
    const auto means_it = [&](const SceneJob& job) {
      const DeviceList& named = job.scene.solver.devices;
      return may(job) &&
             (named.empty() || named == DeviceList{every_device} || std::ranges::count(named, device.number));
    };
    if (std::ranges::any_of(jobs, means_it)) out.push_back(device.number);
  }
  return out;
}

/// Runs the scenes on worker threads. Each scene waits for a share of the processor's cores and is prepared on them.
/// Then it gets a device, if its backend is cuda. A scene that is stepped on a device returns its cores when the steps
/// begin; any other scene keeps them until it ends.
class Pool {
 public:
  Pool(const std::vector<SceneJob>& jobs, const ManyOptions& options)
      : jobs_(jobs), options_(options), devices_taken_(jobs.size()), outcomes_(jobs.size()) {}

  std::vector<JobOutcome> run() {
    try {
      const bool are_counted = devices_.wait_for(none_is_known_within) == std::future_status::ready;
      // the first specimens are made while devices are counted
      if (!are_counted) employ(std::min(prepared_for_a_device, cores_), prepared_for_a_device, cores_);
      share_out(static_cast<int>(devices_.get().size()));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      thrown_ = std::current_exception();
      beside_ = 1, changed_.notify_all();
    }
    for (std::thread& t : workers_) t.join();
    if (thrown_) std::rethrow_exception(thrown_);
    return std::move(outcomes_);
  }

 private:
  /// Divides cores and scenes among the devices once the devices are counted. Without devices, divides the cores among
  /// the scenes.
  void share_out(int devices) {
    const int usual = devices == 0 ? cores_ : std::min(at_once_on_a_device * devices, cores_);
    const int number = at_most(options_.at_once > 0 ? options_.at_once : usual);
    // threads that wait for a device need a core too, so one core per device is not given to scenes
    const int spared = 8 * devices <= cores_ ? devices : 0;
    {
      const std::lock_guard lock(mutex_);
      beside_ = devices == 0 ? number : (number + devices - 1) / devices;
      urgent_ += prepared_for_a_device * devices;
      for_urgent_ = (cores_ - spared) / std::min(number, std::max(prepared_for_a_device, devices));
    }
    employ(number, devices == 0 ? number : prepared_for_a_device * devices, cores_ - spared);
  }

  /// Returns the number of workers, limited by the option and by the number of scenes; at least one.
  int at_most(int workers) const {
    const int asked = options_.at_once > 0 ? std::min(workers, options_.at_once) : workers;
    return std::clamp(asked, 1, static_cast<int>(jobs_.size()));
  }

  /// Raises the number of worker threads to `number`; the number never falls. From now on, `shares` scenes at a time
  /// are prepared, each with an equal part of `cores`.
  void employ(int number, int shares, int cores) {
    number = at_most(number), shares = std::min(number, shares);
    {
      const std::lock_guard lock(mutex_);
      share_ = std::max(1, cores / shares);
      cores = std::max(cores, shares);  // the user may ask for more scenes at a time than cores
      free_ += cores - std::exchange(all_, cores);
      turns_ += shares - std::exchange(all_turns_, shares);
      changed_.notify_all();
    }
    try {  // scenes change the number of OpenMP threads, so they must not run in this thread
      while (std::ssize(workers_) < number) workers_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      if (workers_.empty()) throw;  // otherwise the threads that were started run all scenes
    }
  }

  /// Runs one scene after the other until all are done. Each worker thread does this.
  void work() {
    for (;;) {
      std::size_t job = 0;
      {
        const std::lock_guard lock(mutex_);
        if (next_ == jobs_.size() || thrown_) return;
        job = next_++;
      }
      JobOutcome& outcome = outcomes_[job];
      double contacts = 0;
      RunParts parts;
      std::optional<Cores> cores;
      parts.prepare = [&](const Scene& scene, const Progress& progress) {
        return prepare_in_turn(scene, progress, cores);
      };
      parts.place = [&](SolverSpec& solver) { take_device(job, solver, cores); };
      try {
        if (options_.stop && options_.stop()) throw InterruptedError("interrupted before the run began");
        const SceneJob& asked = jobs_[job];
        const bool resume = options_.resume && has_checkpoint(asked.out);
        Watcher watcher = watcher_of(job);
        watcher.prepared = [&](const Preparation& all) { contacts = static_cast<double>(all.network.contacts.size()); };
        watcher.devices = [&](std::int64_t steps) {
          return devices_for_next_frequency(job, static_cast<double>(steps) * contacts);
        };
        watcher.planned = [&, begun = watcher.planned](const RunResult& result) {
          if (result.backend == Backend::cuda) cores.reset();
          begun(result);
        };
        outcome.result = run_scene(asked.scene, asked.out, watcher, resume, parts);
      } catch (...) { outcome.error = std::current_exception(); }
      cores.reset();
      const std::lock_guard lock(mutex_);
      devices_taken_.end(job), changed_.notify_all();
      try {
        if (options_.done) options_.done(job, outcome);
      } catch (...) { thrown_ = std::current_exception(); }
    }
  }

  /// The cores reserved for a scene. A scene that is stepped on a device gives them back when its steps begin, any
  /// other scene when it ends.
  class Cores {
   public:
    /// `most`: largest number of threads that the scene may use; 0: the number of cores that it has reserved.
    Cores(Pool& pool, bool first_of_scene, int most) : pool_(pool), most_(most) {
      std::unique_lock lock(pool_.mutex_);
      ++pool_.waiting_;
      // A scene begins when half of the cores meant for one scene are free, because a running scene frees only half of
      // its cores for the scenes that wait.
      pool_.changed_.wait(lock, [&] { return pool_.turns_ > 0 && pool_.free_ >= (pool_.share_ + 1) / 2; });
      --pool_.waiting_;
      number_ = std::min(pool_.share_, pool_.free_);
      if (first_of_scene && pool_.urgent_-- > 0) number_ = std::clamp(pool_.for_urgent_, number_, pool_.free_);
      --pool_.turns_, pool_.free_ -= number_;
      set_threads();
    }
    Cores(const Cores&) = delete;
    ~Cores() {
      const std::lock_guard lock(pool_.mutex_);
      give_back(number_);
    }

    /// Frees half of the cores of this scene, and its turn (see all_turns_), if other scenes wait for cores.
    void share() {
      const std::lock_guard lock(pool_.mutex_);
      if (!has_turn_ || pool_.waiting_ == 0) return;
      give_back(number_ / 2);
      set_threads();
    }

   private:
    /// Sets the number of OpenMP threads of the calling thread, which runs the scene.
    void set_threads() const { omp_set_num_threads(most_ > 0 ? std::min(number_, most_) : number_); }
    void give_back(int cores) {
      if (std::exchange(has_turn_, false)) ++pool_.turns_;
      number_ -= cores, pool_.free_ += cores;
      pool_.changed_.notify_all();
    }

    Pool& pool_;
    int most_, number_ = 0;
    bool has_turn_ = true;
  };

  Preparation prepare_in_turn(const Scene& scene, const Progress& progress, std::optional<Cores>& cores) {
    cores.emplace(*this, true, scene.solver.threads);
    if (options_.stop && options_.stop()) throw InterruptedError("interrupted before the run began");
    return prepare(scene, [&](const std::string& stage, double share) {
      if (stage == network_stage) cores->share();  // one thread, or the device, does most of the work that follows
      progress(stage, share);
    });
  }

  /// Chooses one of the devices that the scene may use and that answer. If each of them already runs its largest number
  /// of scenes, waits; other scenes use the cores meanwhile.
  void take_device(std::size_t job, SolverSpec& solver, std::optional<Cores>& cores) {
    DeviceList meant = solver.devices.empty() ? usable_.get() : usable(device_numbers(solver.devices));
    if (meant.empty()) meant = device_numbers(solver.devices);  // making the stepper reports why these cannot run
    std::optional<int> device;
    const auto has_room = [&] { return (device = devices_taken_.choose(meant, beside_)).has_value(); };
    std::unique_lock lock(mutex_);
    const bool waits = !has_room();
    if (waits) {
      lock.unlock();
      cores.reset();
      lock.lock();
      changed_.wait(lock, has_room);
    }
    solver.devices = {*device}, solver.side_by_side = beside_;
    devices_taken_.put(job, *device, std::move(meant));
    lock.unlock();
    if (waits) cores.emplace(*this, false, solver.threads);
  }

  /// Returns the device on which a scene continues with its remaining work `work`.
  DeviceList devices_for_next_frequency(std::size_t job, double work) {
    const std::lock_guard lock(mutex_);
    return {devices_taken_.device_for_next_frequency(job, work, beside_)};
  }

  /// Returns a watcher that passes the progress and the warnings of a scene to the options' functions, one thread at a
  /// time.
  Watcher watcher_of(std::size_t job) {
    Watcher out;
    out.stop = options_.stop;
    const auto begun = std::make_shared<bool>(false);
    out.planned = [begun](const RunResult&) { *begun = true; };
    out.progress = [this, job, begun](const std::string& stage, double share) {
      if (!*begun && options_.stop && options_.stop())
        throw InterruptedError("interrupted at: " + stage +
                               "; nothing was written, and the files in the folder are unchanged");
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
  const int cores_ = omp_get_max_threads();
  std::vector<std::thread> workers_;
  std::mutex mutex_;  // guards the members below and the functions in the options
  std::condition_variable changed_;
  int all_ = 0, free_ = 0, share_ = 1;  // numbers of cores: for all scenes, free now, and for one scene
  // number of turns: in all, and free. A scene gets cores only together with a turn, so the turns limit how many scenes
  // are prepared at the same time.
  int all_turns_ = 0, turns_ = 0;
  int waiting_ = 0;                  // scenes that wait for cores
  int urgent_ = 0, for_urgent_ = 0;  // number of scenes that must begin before each device has work, and cores for each
  int beside_ = 0;                   // largest number of scenes on a device; 0 until the devices are counted
  std::size_t next_ = 0;
  DeviceShares devices_taken_;
  std::exception_ptr thrown_;  // exception thrown by a function of the options, or while devices were counted
  std::vector<JobOutcome> outcomes_;
  // the devices that scenes may use, and the usable ones among these devices; both lists become known while the first
  // specimens are made
  std::shared_future<DeviceList> devices_ = std::async([this] { return meant_devices(jobs_); });
  std::shared_future<DeviceList> usable_ = std::async([all = devices_] { return usable(all.get()); });
};

}  // namespace

std::vector<JobOutcome> run_many(const std::vector<SceneJob>& jobs, const ManyOptions& options) {
  if (const Ranks* team = ranks()) {
    throw InputError("scenes: found several scenes with " + std::to_string(team->count()) +
                     " ranks, expected one scene; without --ranks a single process runs several scenes side by side on "
                     "all devices of its host");
  }
  require_folders_differ(jobs);
  if (jobs.empty()) return {};
  return Pool(jobs, options).run();
}

}  // namespace macadam
