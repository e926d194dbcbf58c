// SPDX-License-Identifier: GPL-3.0-or-later
// step_frequencies.cpp  Follows the cyclic test in time, by steps or by increments, one frequency after another.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <system_error>
#include <utility>

#include "host/run/sampled_run.hpp"
#include "host/run/cracks.hpp"
#include "host/run/step_settings.hpp"
#include "host/run/skips.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/network/free_sides.hpp"
#include "host/files/result_files.hpp"
#include "host/experiments/cyclic/finished_frequency.hpp"
#include "host/experiments/cyclic/increment_plan.hpp"
#include "host/experiments/cyclic/run_state.hpp"
#include "host/run/error_model.hpp"
#include "host/experiments/cyclic/judgement.hpp"
#include "host/run/phases.hpp"
#include "host/experiments/cyclic/plan.hpp"
#include "host/experiments/cyclic/methods.hpp"
#include "kernels/step/block_length.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::SteppedCyclic;
using experiments::SteppedFrequency;

namespace {

/// The fraction of the tolerance that the error of stepping in blocks may reach. During a block of steps the
/// viscoelastic states of the contacts are not updated.
constexpr double block_share = 0.02;
/// Number of times per cycle at which broken contact points are counted. Reading them takes longer than a step.
constexpr std::int64_t looks_per_cycle = 50;
/// Least number of times per cycle at which the lateral strain is measured, if there are so many samples. The fit needs
/// 16; copying the displacements takes longer than a step on a device.
constexpr std::int64_t lateral_per_cycle = 20;

/// Returns the number of samples from one measurement of the lateral strain to the next. It divides the samples of a
/// cycle, so that the measurements of a cycle are evenly spaced.
std::int64_t between_lateral(std::int64_t per_cycle) {
  std::int64_t out = std::max<std::int64_t>(1, per_cycle / lateral_per_cycle);
  while (per_cycle % out != 0) --out;
  return out;
}

/// Returns the options that the steppers of all frequencies have in common.
StepperOptions common_options(const Plan& plan, const SolverSpec& solver) {
  StepperOptions options = stepper_options(solver, plan.form, plan.geometry, plan.precision);
  if (solver.tolerance) options.blocks = blocks_within(block_share * *solver.tolerance);
  return options;
}

/// Reports the length of the blocks of steps among the decisions if three conditions hold: the length follows from a
/// tolerance, the backend may step in blocks, and blocks have an error.
void decide_blocks(const Scene& scene, Backend backend, Plan& plan) {
  const SolverSpec& solver = scene.solver;
  const bool may = backend != Backend::reference && plan.form == ContactForm::condensed &&
                   !kernels::blocks_are_exact(plan.geometry, facts_of(scene.laws));
  if (!may || plan.precision == Precision::double_ || !solver.tolerance) return;
  const double blocks = common_options(plan, solver).blocks;
  plan.decisions.push_back(fmt::format(
      "viscoelastic states are not updated in every step but {:.0f} times within the shortest characteristic time of "
      "the load and the laws; the error that the rarer updates cause is at most {:.1e}",
      std::ceil(blocks), block_error(blocks)));
}

/// Returns the stepper of one frequency. If `from`, the state in a checkpoint, is not empty, the stepper continues from
/// it. Otherwise it begins with the steady state `start` or, without a steady state, from rest. `used`: the stepper of
/// the previous frequency, whose data are reused.
std::unique_ptr<Stepper> stepper_of(const Scene& scene, const Preparation& prepared, const Inertia& inertia,
                                    Backend backend, const Plan& plan, const FrequencyPlan& p,
                                    const DeviceList& devices, const std::vector<StateArray>& from,
                                    const StartState* start, std::unique_ptr<Stepper> used) {
  StepperOptions options = common_options(plan, scene.solver);
  options.devices = devices;
  options.density_scaling = p.density_scaling;
  options.boundary = moving_top(p.loading);
  options.dt = p.loading.dt();
  if (scene.solver.tolerance) options.observed_every = p.loading.steps_per_period / scene.cyclic().samples_per_cycle;
  options.start = start;
  return stepper_from(from, backend, scene, prepared, inertia, options, std::move(used));
}

/// Returns the line of a sample in response.csv.
std::string line_of(const ResponseSample& s) {
  return fmt::format("{},{},{},{}", s.frequency_hz, s.time_s, s.strain, s.stress_pa);
}

/// A stepped cyclic test whose plan has been made.
class Steps : public PlannedExperiment {
 public:
  Steps(const Scene& scene, const Preparation& prepared, const Watcher& watcher, const Inertia& inertia, RunState at,
        bool resumed)
      : scene_(scene),
        prepared_(prepared),
        watcher_(watcher),
        inertia_(inertia),
        at_(std::move(at)),
        devices_(scene.solver.devices),
        owns_checkpoint_(resumed) {
    if (scene.network.lateral_walls) return;
    sides_.emplace(prepared.specimen, prepared.tessellation);
    if (!sides_->known()) sides_.reset();
  }

  /// Makes the first stepper. The stepper is made before any file is changed, so that all files stay as they were if
  /// the stepper refuses the scene.
  void make_first(RunResult& result, const std::filesystem::path& checkpoint) {
    if (at_.seconds.size() == at_.plan.frequencies.size()) return;
    const bool resumed = !at_.state.empty();
    try {
      stepper_ = make(at_.seconds.size(), std::exchange(at_.state, {}), result);
    } catch (const Error& error) {
      if (resumed)
        throw InputError(checkpoint.string() + ": this machine cannot continue the checkpoint: " + error.what());
      throw;
    }
  }

  /// Fills in the results that are known before the first step, and the results of the frequencies that were finished
  /// when the checkpoint was written.
  void begin(RunResult& result) {
    result.decisions = at_.plan.decisions;
    SteppedCyclic& found = result.found.emplace<SteppedCyclic>();
    found.form = at_.plan.form;
    found.geometry = at_.plan.geometry;
    found.precision = at_.plan.precision;
    found.critical_particle = at_.plan.critical.particle;
    found.critical_dt_s = at_.plan.critical.dt;
    found.seconds_planning = at_.seconds_planning;
    result.skips = find_skips(scene_, prepared_, at_.plan.form, at_.plan.geometry, scene_.cyclic().strain_amplitude);
    result.warnings = at_.warnings;
    for (std::size_t i = 0; i < at_.seconds.size(); ++i) finish(i, result);
  }

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override {
    SampledRuns sampled_runs(scene_, prepared_, watcher_, result, out, owns_checkpoint_,
                             [&](const std::string& warning) { warn(warning, result); });
    std::optional<LineWriter> writer;
    if (scene_.output.response) {
      writer.emplace(out / "response.csv", "frequency_hz,time_s,strain,stress_pa");
      // a resumed run writes the whole file again, so that no sample is missing or written twice
      for (const ResponseSample& s : at_.samples) writer->add(line_of(s));
    }
    begin_cracks(out);
    for (std::size_t i = at_.seconds.size(); i < at_.plan.frequencies.size(); ++i) {
      step(i, writer ? &*writer : nullptr, sampled_runs, save, result);
      finish(i, result);
      owns_checkpoint_ = sampled_runs.own_checkpoint();
    }
    if (writer) writer->close();
    if (cracks_writer_) cracks_writer_->close();
    require_sense(scene_, result.stepped());
  }

  bool owns_checkpoint() const override { return owns_checkpoint_; }

 private:
  void warn(const std::string& warning, RunResult& result) {
    at_.warnings.push_back(warning);
    result.warnings.push_back(warning);
    if (watcher_.warn) watcher_.warn(warning);
  }

  bool is_quasi_static() const { return scene_.solver.method == SolverMethod::quasi_static; }

  /// Makes the increments of a frequency.
  std::unique_ptr<Stepper> make_increments(std::size_t i, const std::vector<StateArray>& from, RunResult& result) {
    const InPhase in(result.phases, &PhaseSeconds::stepper);
    auto made = make_cycle_increments(scene_, prepared_, at_.plan, at_.plan.frequencies[i], from);
    increments_ = made.get();
    return made;
  }
  /// Returns the numbers of increments of the frequency that has been run.
  experiments::Increments increments_found() const {
    const quasi_static::CourseReport& report = increments_->report();
    experiments::Increments out;
    out.increments = report.increments, out.rejected = report.rejected, out.systems = report.passes;
    out.error = report.error, out.loose = report.loose;
    return out;
  }

  /// Makes the stepper of a frequency. If there is a stepper of another frequency, reuses its data. At this point the
  /// run may move to other devices (GPUs).
  std::unique_ptr<Stepper> make(std::size_t i, const std::vector<StateArray>& from, RunResult& result) {
    if (is_quasi_static()) return make_increments(i, from, result);
    const InPhase in(result.phases, &PhaseSeconds::stepper);
    const auto& all = at_.plan.frequencies;
    std::optional<StartState> start;
    if (all[i].start == Start::steady && from.empty()) start = next_start_.valid() ? next_start_.get() : start_of(i);
    const auto on = [&](const DeviceList& devices) {
      return stepper_of(scene_, prepared_, inertia_, result.backend, at_.plan, all[i], devices, from,
                        start ? &*start : nullptr, std::move(stepper_));
    };
    const DeviceList before = devices_;
    if (may_move_ && watcher_.devices && result.backend == Backend::cuda) {
      std::int64_t steps = 0;
      for (std::size_t k = i; k < all.size(); ++k) steps += all[k].loading.steps_per_period * all[k].cycles;
      if (DeviceList named = watcher_.devices(steps); !named.empty()) devices_ = std::move(named);
    }
    std::unique_ptr<Stepper> made;
    try {
      made = on(devices_);
    } catch (const RunError&) {
      // The stepper could not be made on the new device, for example because it has too little memory. The run returns
      // to its old device; if it was on this device already, the error ends the run.
      if (devices_ == before) throw;
      devices_ = before, may_move_ = false;
      made = on(devices_);
    }
    if (result.backend == Backend::cuda && i + 1 < all.size() && all[i + 1].start == Start::steady) begin_start(i + 1);
    return made;
  }

  /// Begins to compute the steady start of a frequency in another thread, while a device takes the steps of the
  /// previous frequency.
  void begin_start(std::size_t i) {
    try {
      next_start_ = std::async(std::launch::async, [this, i] {
        omp_set_num_threads(1);
        return start_of(i);
      });
    } catch (const std::system_error&) {}  // no thread is available: the start is computed when it is needed
  }
  StartState start_of(std::size_t i) const {
    const FrequencyPlan& p = at_.plan.frequencies[i];
    return steady_start(prepared_.network, scene_.laws, p.motion, p.loading);
  }

  void step(std::size_t i, LineWriter* writer, SampledRuns& sampled_runs, const Saving& save, RunResult& result) {
    const auto start = Clock::now();
    const double before = std::exchange(at_.seconds_running, 0);
    const FrequencyPlan& p = at_.plan.frequencies[i];
    if (used_) stepper_ = make(i, {}, result);
    used_ = true;
    result.solver = stepper_->description();
    std::get<SteppedCyclic>(result.found).bytes = stepper_->bytes();
    save("running");
    CrackWatch cracks(scene_, prepared_, at_.cracks[i].events);
    const Course course =
        course_of(i, writer, cracks, [&](Checkpoint& to) { add_to(to, at_, before + seconds_since(start)); });
    sampled_runs.begin_fields(fmt::format("{}Hz", p.loading.frequency), at_.plan.samples_per_cycle,
                              stepper_->observe().time);
    sampled_runs.run(*stepper_, course, at_.plan.form, at_.plan.geometry);
    warn_of_cracks(i, cracks.found(), result);
    at_.seconds.push_back(before + seconds_since(start));
    if (is_quasi_static()) at_.increments.push_back(increments_found());
  }

  /// Creates cracks.csv if a law of the scene can break, and writes the events of a checkpoint into it.
  void begin_cracks(const std::filesystem::path& out) {
    if (!counts_cracks(scene_)) return;
    cracks_writer_.emplace(out / cracks_file, "frequency_hz," + crack_head(can_crack(facts_of(scene_.laws))));
    for (std::size_t i = 0; i < at_.cracks.size(); ++i) write_cracks(i, at_.cracks[i].events);
  }
  void write_cracks(std::size_t i, const std::vector<experiments::CrackEvent>& events) {
    for (const experiments::CrackEvent& event : events) {
      cracks_writer_->add(fmt::format("{},{}", at_.plan.frequencies[i].loading.frequency,
                                      crack_line(prepared_, event, can_crack(facts_of(scene_.laws)))));
    }
  }

  /// Counts the contact points that are broken at a sample of frequency i. If the top wall pulls and no path of intact
  /// contacts joins the walls, ends the steps of this frequency. In compression broken points still bear load, so the
  /// steps go on.
  void look_for_cracks(std::size_t i, CrackWatch& watch, const Observation& now) {
    FrequencyCracks& cracks = at_.cracks[i];
    write_cracks(i, watch.look(read_contact_state(scene_, *stepper_, prepared_.network), now.time));
    cracks.events = watch.found().events;
    const double strain = now.top_displacement() / gauge_length(prepared_.specimen);
    if (strain > 0 && !watch.joins_walls()) cracks.rupture = {now.time, strain, cracks.time_s, cracks.strain};
    cracks.time_s = now.time, cracks.strain = strain;
  }

  /// Warns of contact points that broke during a frequency, because the specimen then changed while its |E*| was
  /// measured.
  void warn_of_cracks(std::size_t i, const experiments::Cracks& found, RunResult& result) {
    const std::string name = fmt::format("{} Hz", at_.plan.frequencies[i].loading.frequency);
    if (const auto& rupture = at_.cracks[i].rupture) {
      warn(fmt::format("{}: {} |E*| and phi could not be measured.", name, rupture_words(*rupture)), result);
    } else if (found.points() > 0) {
      warn(fmt::format("{}: {}", name, cracks_words(found)), result);
    }
  }

  /// Returns the course of a frequency: its samples, and the functions that are called at them. Every sample is stored
  /// in `at_` and written at once. Without a writer, only the fitted cycles and the cycle before them are stored; the
  /// cycle before them is needed to compute the change from cycle to cycle.
  Course course_of(std::size_t i, LineWriter* writer, CrackWatch& cracks, const Content& content) {
    const FrequencyPlan& p = at_.plan.frequencies[i];
    const std::int64_t per_cycle = at_.plan.samples_per_cycle, per_period = p.loading.steps_per_period;
    const std::int64_t stride = per_period / per_cycle;
    const std::int64_t kept = writer ? 0 : std::int64_t{std::max(0, p.cycles - p.fit_cycles - 1)} * per_cycle;
    Course course;
    course.name = fmt::format("{} Hz", p.loading.frequency);
    course.dt = p.loading.dt();
    course.frequency = p.loading.frequency;
    course.first = (stepper_->observe().step + stride - 1) / stride;
    course.last = p.cycles * per_cycle;
    course.step_of = [stride](std::int64_t k) { return k * stride; };
    const std::int64_t between_looks = std::max<std::int64_t>(1, per_cycle / looks_per_cycle);
    const auto looks = [=, active = cracks.active()](std::int64_t k) {
      return active && (k % between_looks == 0 || k % per_cycle == 0);
    };
    // the lateral strain is measured only in the cycles that are fitted
    const std::int64_t lateral_from = course.last - p.fit_cycles * per_cycle, between = between_lateral(per_cycle);
    const auto has_lateral = [=, last = course.last, known = sides_.has_value()](std::int64_t k) {
      return known && k > lateral_from && (last - k) % between == 0;
    };
    course.uses_stepper = [=](std::int64_t k) { return looks(k) || has_lateral(k); };
    course.ended = [this, i] { return at_.cracks[i].rupture.has_value(); };
    course.taken = [=](std::int64_t k) { return k >= kept || k % per_cycle == 0 || looks(k); };
    course.take = [=, this, &p, &cracks](std::int64_t k, const Observation& now) {
      if (looks(k)) look_for_cracks(i, cracks, now);
      if (k < kept) return;
      const Specimen& specimen = prepared_.specimen;
      // in tension the particles pull the top wall down, so the force on the wall is negative
      at_.samples.push_back({p.loading.frequency, now.time, now.top_displacement() / gauge_length(specimen),
                             -now.top_force() / section_area(specimen)});
      if (has_lateral(k)) at_.samples.back().lateral_strain = lateral_strain();
      if (writer) writer->add(line_of(at_.samples.back()));
    };
    course.shown = [=, this, &p](std::int64_t step, double steps_a_second) {
      if (is_quasi_static())
        return fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}", p.loading.frequency, i + 1,
                           at_.plan.frequencies.size(), static_cast<double>(step) / static_cast<double>(per_period),
                           p.cycles);
      return fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}, {:.0f} steps/s", p.loading.frequency, i + 1,
                         at_.plan.frequencies.size(), static_cast<double>(step) / static_cast<double>(per_period),
                         p.cycles, steps_a_second);
    };
    course.content = content;
    return course;
  }

  /// Returns the lateral strain at the stepper's present step.
  double lateral_strain() const {
    return -sides_->contraction(stepper_->motions(sides_->particles())) / gauge_length(prepared_.specimen);
  }

  void finish(std::size_t i, RunResult& result) {
    const auto samples = samples_of(at_.samples, samples_read_, at_.plan.frequencies[i].loading.frequency);
    samples_read_ += samples.size();
    auto& frequencies = std::get<SteppedCyclic>(result.found).frequencies;
    const FrequencyCracks& cracks = at_.cracks[i];
    SteppedFrequency& f =
        frequencies.emplace_back(finished_frequency(scene_, at_.plan, i, samples, at_.seconds[i], cracks.rupture));
    if (counts_cracks(scene_)) {
      f.cracks = CrackWatch(scene_, prepared_, cracks.events).found();
      f.cracks->sums.reset();  // the stepper of this frequency may no longer exist
    }
    if (is_quasi_static()) {
      f.increments = i < at_.increments.size() ? at_.increments[i] : experiments::Increments{};
      if (f.cracks) f.cycle_stiffness = stiffness_of_cycles(samples, f.frequency_hz);
    }
    if (f.rupture) return;
    const bool linear = !first_without_stiffness(scene_.laws);
    judge(f, linear ? std::optional(stiffest_contact(scene_, prepared_.network, f.frequency_hz)) : std::nullopt,
          scene_.solver.tolerance, result.warnings);
  }

  const Scene& scene_;
  const Preparation& prepared_;
  const Watcher& watcher_;
  Inertia inertia_;
  RunState at_;
  DeviceList devices_;                              ///< devices of the stepper
  bool may_move_ = true;                            ///< whether the run may move to other devices
  std::unique_ptr<Stepper> stepper_;                ///< stepper of the running frequency or of the first one
  const QuasiStaticStepper* increments_ = nullptr;  ///< `stepper_`, if the method is quasi-static
  bool used_ = false;                               ///< whether the stepper has run a frequency
  std::optional<FreeSides> sides_;                  ///< empty if a side is held or has no cell
  std::optional<LineWriter> cracks_writer_;
  std::size_t samples_read_ = 0;  ///< number of samples of finished frequencies
  bool owns_checkpoint_;
  /// Start of the next frequency; it is the last member, so that it is destroyed first, because its thread uses the
  /// other members.
  std::future<StartState> next_start_;
};

}  // namespace

std::unique_ptr<PlannedExperiment> plan_steps(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                              std::optional<Resumed> resumed, RunResult& result) {
  const InPhase planning(result.phases, &PhaseSeconds::planning);
  const auto start = Clock::now();
  const Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  RunState at;
  if (resumed) {
    at = to_run_state(std::move(resumed->checkpoint), resumed->file);
  } else {
    const bool steps = scene.solver.method == SolverMethod::explicit_;
    at.plan = steps ? make_plan(scene, prepared, inertia, watcher, result.backend, result.phases)
                    : make_increment_plan(scene, prepared, inertia, watcher, result.backend, result.phases);
    at.cracks.resize(at.plan.frequencies.size());
    if (steps) decide_blocks(scene, result.backend, at.plan);
    if (const auto without = first_without_stiffness(scene.laws)) {
      at.warnings.push_back(fmt::format(
          "law {} of {} has no complex stiffness: |E*| and phi describe the fundamental of the stepped loops at this "
          "strain amplitude and after this number of cycles, and no harmonic solution can check these values",
          without->law, to_string(without->pair)));
    }
    at.seconds_planning = seconds_since(start);
  }
  auto steps = std::make_unique<Steps>(scene, prepared, watcher, inertia, std::move(at), resumed.has_value());
  steps->make_first(result, resumed ? resumed->file : std::filesystem::path());
  steps->begin(result);
  return steps;
}

}  // namespace macadam
