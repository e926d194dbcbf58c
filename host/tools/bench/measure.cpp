// SPDX-License-Identifier: GPL-3.0-or-later
// measure.cpp  Times repetitions of many steps with all particles moving, of whole frequency-domain solutions, and of
// the preparation before the first step.
#include "host/tools/bench/measure.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "host/backends/cuda_code.hpp"
#include "macadam/error.hpp"
#include "macadam/ranks.hpp"

namespace macadam::bench {
namespace {

using Clock = std::chrono::steady_clock;
/// Returns the wall time of a call [s].
double seconds_of(const std::function<void()>& f) {
  const auto start = Clock::now();
  f();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Copies 256 MiB nine times with `threads` threads. Returns the rate of the fastest copy [byte/s], because any
/// disturbance only makes a copy slower.
double processor_copy(int threads) {
  constexpr std::size_t size = std::size_t{256} << 20;
  std::vector<char> from(size, 1), to(size, 2);
  double best = 0;
  for (int k = 0; k < 9; ++k) {
    const double time = seconds_of([&] {
#pragma omp parallel num_threads(threads)
      {
        const std::size_t part = size / static_cast<std::size_t>(omp_get_num_threads());
        const std::size_t first = part * static_cast<std::size_t>(omp_get_thread_num());
        std::memcpy(to.data() + first, from.data() + first, part);
      }
    });
    best = std::max(best, 2.0 * size / time);
  }
  return best;
}

/// Returns the name of a row: the quantity, the specimen and the settings. Settings at the end of the name are left out
/// if they have their default value.
std::string name_of(const std::string& what, const BenchCase& timed, const StepperOptions& o, Backend backend,
                    int units) {
  std::string out = fmt::format("{}/{}/{}/{}/{}/{}", what, timed.name, to_string(backend), to_string(o.form),
                                to_string(o.precision), to_string(o.geometry));
  if (units >= 0) out += fmt::format("/units:{}", units);
  if (o.blocks != StepperOptions{}.blocks) out += fmt::format("/blocks:{:g}", o.blocks);
  if (o.multiprocessors > 0) out += fmt::format("/multiprocessors:{}", o.multiprocessors);
  if (o.devices.size() > 1) out += fmt::format("/devices:{}", o.devices.size());
  if (o.ranks) out += fmt::format("/ranks:{}", o.ranks->count());
  return out;
}

/// Measures one specimen; each method adds one row.
class Measured {
 public:
  Measured(const BenchCase& timed, const BenchAxes& axes, const std::function<void(const BenchRow&)>& told)
      : case_(timed), axes_(axes), told_(told), backend_(select_backend(axes.backend, nullptr, axes.devices)) {
    if (backend_ == Backend::cuda) devices_ = device_numbers(axes.devices);
  }

  /// Times steps. The number of steps per repetition is doubled until a repetition takes BenchAxes::seconds. Then the
  /// parts of a step are timed separately. \throws RunError if the particles diverge.
  void steps(StepperOptions options, int units) {
    const LawTable laws = axes_.elastic ? elastic(case_.laws) : units < 0 ? case_.laws : with_units(case_.laws, units);
    const bool without_points = case_.network.point_area.empty();
    if (options.form == ContactForm::points && without_points) return;  // a lattice has no points
    drive(options, critical_step(case_.network, laws, case_.inertia, options).dt);
    const auto stepper = make_stepper(backend_, case_.specimen, case_.network, laws, case_.inertia, options);
    set_in_motion(*stepper);
    BenchRow row =
        row_of(name_of(axes_.elastic ? "elastic step" : "step", case_, options, backend_, units), options.threads);
    row.label = stepper->description();
    row.iterations = 4;
    double took = 0;
    while ((took = of_first_rank(seconds_of([&] { stepper->advance(row.iterations); }))) < axes_.seconds)
      row.iterations *= 2;
    for (int k = 0; k < axes_.repetitions; ++k) {
      row.seconds.push_back(seconds_of([&] { stepper->advance(row.iterations); }) /
                            static_cast<double>(row.iterations));
    }
    // the times of each part of a step, one per repetition; their median is used, because one repetition may be
    // disturbed
    std::map<std::string, std::vector<double>> parts;
    for (int k = 0; k < axes_.repetitions; ++k) {
      for (const PartTime& part : stepper->advance_timed(std::min<std::int64_t>(row.iterations, 2000)))
        parts[part.name].push_back(part.seconds);
    }
    if (stepper->first_divergent() >= 0) throw RunError(row.name + ": diverged");
    count(row, *stepper, parts);
    told_(row);
  }

  /// Times iterative solutions of `loads` frequencies at the same time: 20, 10, 5, … Hz.
  void harmonic(int loads, int threads) {
    BenchRow row = row_of(fmt::format("harmonic/{}/{}/loads:{}", case_.name, to_string(backend_), loads), threads);
    if (devices_.size() > 1) row.name += fmt::format("/devices:{}", devices_.size());
    if (threads > 0) omp_set_num_threads(threads);
    HarmonicOptions options;
    options.tolerance = 1e-8;
    options.linear = LinearMethod::iterative;
    options.backend = backend_;
    options.devices = devices_;
    constexpr double typical = 6;
    std::unique_ptr<Harmonic> solver;
    const double setup = seconds_of([&] {
      solver = std::make_unique<Harmonic>(case_.specimen, case_.network, case_.laws, case_.inertia, options, typical);
    });
    std::vector<HarmonicLoad> asked;
    for (int k = 0; k < loads; ++k) asked.push_back({.frequency_hz = 20.0 / (1 << k)});
    std::vector<HarmonicResult> found;
    for (int k = 0; k < axes_.repetitions; ++k)
      row.seconds.push_back(seconds_of([&] { found = solver->solve(asked); }));
    int iterations = 0;
    for (const HarmonicResult& r : found) iterations = std::max(iterations, r.iterations);
    row.label = fmt::format("conjugate gradients, {}", to_string(backend_));
    row.counters = {{"particles", static_cast<double>(case_.specimen.size())},
                    {"contacts", static_cast<double>(case_.network.contacts.size())},
                    {"setup_s", setup},
                    {"cg_iterations", iterations},
                    {"e_star_pa", found.front().top.e_star_pa},
                    {"phase_deg", found.front().top.phase_deg}};
    told_(row);
  }

  /// Times the preparation from particles to the first step: tessellation, contact network, critical time step, and the
  /// arrays of the stepper with one step.
  void preparation(StepperOptions options) {
    BenchRow row = row_of(name_of("preparation", case_, options, backend_, -1), options.threads);
    if (options.threads > 0) omp_set_num_threads(options.threads);
    std::vector<std::pair<std::string, double>> parts;
    const auto part = [&](const char* name, const std::function<void()>& f) {
      parts.emplace_back(name, seconds_of(f));
    };
    double all = 0;
    while (row.seconds.empty() || (static_cast<int>(row.seconds.size()) < axes_.repetitions && all < long_enough)) {
      parts.clear();
      Tessellation cells;
      ContactNetwork network;
      std::unique_ptr<Stepper> stepper;
      part("tessellation", [&] { cells = tessellate(case_.specimen); });
      part("network", [&] { network = build_network(case_.specimen, cells, {}); });
      cells = {};
      part("critical step", [&] { drive(options, critical_step(network, case_.laws, case_.inertia, options).dt); });
      part("stepper", [&] {
        stepper = make_stepper(backend_, case_.specimen, network, case_.laws, case_.inertia, options);
        stepper->advance(1);
      });
      row.label = stepper->description();
      row.counters = {{"particles", static_cast<double>(case_.specimen.size())},
                      {"contacts", static_cast<double>(network.contacts.size())}};
      row.seconds.push_back(0);
      for (const auto& [name, seconds] : parts) row.seconds.back() += seconds;
      all += row.seconds.back();
    }
    for (const auto& [name, seconds] : parts) row.counters.emplace_back("part_us " + name, 1e6 * seconds);
    told_(row);
  }

  int all_threads() const { return report_backends().threads; }
  Backend backend() const { return backend_; }

 private:
  static constexpr double long_enough = 30;  ///< no further repetitions of a preparation after this total time [s]

  BenchRow row_of(std::string name, int threads) const {
    BenchRow out;
    out.name = std::move(name);
    out.threads = threads > 0 ? threads : backend_ == Backend::cpu ? all_threads() : 1;
    if (backend_ == Backend::cpu) out.name += fmt::format("/threads:{}", out.threads);
    return out;
  }

  /// Sets up cyclic loading at 20 Hz with 0.8 of the critical time step.
  void drive(StepperOptions& options, double critical) const {
    drives::Cyclic loading{1e-4 * gauge_length(case_.specimen), 20, 1, 0};
    loading.steps_per_period = std::llround(std::ceil(1 / (loading.frequency * 0.8 * critical)));
    options.boundary = moving_top(loading);
    options.dt = loading.dt();
    options.devices = devices_;
    options.ranks = ranks();
  }

  /// Gives all particles random velocities and runs some steps, so that no state is zero.
  void set_in_motion(Stepper& stepper) const {
    std::mt19937 random(2);
    const auto draw = [&](double most) { return most * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
    std::vector<Vec3d> v(case_.specimen.size()), w(case_.specimen.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      v[i] = {draw(1e-4), draw(1e-4), draw(1e-4)};
      w[i] = {draw(1e-1), draw(1e-1), draw(1e-1)};
    }
    stepper.set_velocities(v, w);
    stepper.advance(backend_ == Backend::cuda ? 256 : 8);
  }

  /// Adds the counters of a row: sizes, rates, bytes moved, parts of a step, and resources of the kernels.
  void count(BenchRow& row, const Stepper& stepper, const std::map<std::string, std::vector<double>>& parts) const {
    const auto contacts = static_cast<double>(case_.network.contacts.size());
    const double step = median(row.seconds);
    const Traffic bytes = stepper.traffic_by_place();
    const auto rate = [&](std::int64_t moved) { return static_cast<double>(moved) / step; };
    row.counters = {{"particles", static_cast<double>(case_.specimen.size())},
                    {"contacts", contacts},
                    {"contacts_per_s", contacts / step},
                    {"bytes_per_contact", static_cast<double>(stepper.traffic()) / contacts},
                    {"held_bytes_per_contact", static_cast<double>(stepper.bytes()) / contacts},
                    {"memory_bytes_per_s", rate(bytes.memory)},
                    {"cache_bytes_per_s", rate(bytes.cache)},
                    {"shared_bytes_per_s", rate(bytes.shared)}};
    for (const auto& [name, seconds] : parts) row.counters.emplace_back("part_us " + name, 1e6 * median(seconds));
    for (const KernelUse& k : stepper.kernels()) {
      row.counters.emplace_back("registers " + k.name, k.registers);
      row.counters.emplace_back("occupancy " + k.name, k.occupancy);
      row.counters.emplace_back("shared_bytes " + k.name, static_cast<double>(k.shared_bytes));
    }
  }

  const BenchCase& case_;
  const BenchAxes& axes_;
  const std::function<void(const BenchRow&)>& told_;
  Backend backend_;
  DeviceList devices_;
};

}  // namespace

double BenchRow::of(const std::string& counter) const {
  for (const auto& [name, value] : counters) {
    if (name == counter) return value;
  }
  return 0;
}

double median(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  const std::size_t half = list.size() / 2;
  return list.size() % 2 ? list[half] : 0.5 * (list[half - 1] + list[half]);
}

MachineSpeed measure_machine(Backend backend, const DeviceList& devices, int threads) {
  MachineSpeed out;
  if (select_backend(backend, nullptr, devices) != Backend::cuda) {
    out.copy = processor_copy(threads > 0 ? threads : report_backends().threads);
    return out;
  }
  for (const int device : device_numbers(devices)) {
    out.devices.push_back(measure_device(device));
    out.copy += out.devices.back().copy;
  }
  if (const Ranks* team = ranks()) {  // assumes that all ranks have devices of the same model
    out.devices.resize(static_cast<std::size_t>(team->count()), out.devices.front());
    out.copy *= team->count();
  }
  return out;
}

void time_case(const BenchCase& timed, const BenchAxes& axes, const std::function<void(const BenchRow&)>& told) {
  Measured measured(timed, axes, told);
  const bool on_device = measured.backend() == Backend::cuda;
  const int usual = omp_get_max_threads();
  for (const int threads : on_device ? std::vector<int>{0} : axes.threads) {
    for (const ContactForm form : axes.forms) {
      for (const Precision precision : axes.precisions) {
        for (const Geometry geometry : axes.geometries) {
          for (const double blocks : axes.blocks) {
            for (const int units : axes.units) {
              for (const int multiprocessors : on_device ? axes.multiprocessors : std::vector<int>{0}) {
                StepperOptions options;
                options.form = form;
                options.precision = precision;
                options.geometry = geometry;
                options.threads = threads;
                options.blocks = blocks;
                options.multiprocessors = multiprocessors;
                if (axes.steps) measured.steps(options, units);
                if (axes.preparation) measured.preparation(options);
              }
            }
          }
        }
      }
    }
    for (const int loads : axes.loads) {
      if (axes.harmonic) measured.harmonic(loads, threads);
    }
    omp_set_num_threads(usual);
  }
}

}  // namespace macadam::bench
