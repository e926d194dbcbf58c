// SPDX-License-Identifier: GPL-3.0-or-later
// step_frequencies.cpp  Follows the cyclic test in time, by steps or by increments, one frequency after another.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "host/experiments/cyclic/cyclic_steps.hpp"
#include "host/experiments/cyclic/finished_frequency.hpp"
#include "host/experiments/cyclic/judgement.hpp"
#include "host/experiments/cyclic/methods.hpp"
#include "host/run/increment_words.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/run/error_model.hpp"
#include "host/run/phases.hpp"
#include "host/run/skips.hpp"
#include "host/run/step_settings.hpp"
#include "kernels/step/block_length.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::SteppedCyclic;
using experiments::SteppedFrequency;

namespace {

/// The fraction of the tolerance that the error of stepping in blocks may reach. During a block of steps the
/// viscoelastic states of the contacts are not updated.
constexpr double block_share = 0.02;

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

}  // namespace

CyclicSteps::CyclicSteps(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                         const Inertia& inertia, RunState at, bool resumed)
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

void CyclicSteps::make_first(RunResult& result, const std::filesystem::path& checkpoint) {
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

void CyclicSteps::begin(RunResult& result) {
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

void CyclicSteps::solve(const std::filesystem::path& out, const Saving& save, RunResult& result) {
  SampledRuns sampled_runs(scene_, prepared_, watcher_, result, out, owns_checkpoint_,
                           [&](const std::string& warning) { warn(warning, result); });
  std::optional<LineWriter> writer;
  if (scene_.output.response) {
    writer.emplace(out / "response.csv", "frequency_hz,time_s,strain,stress_pa");
    // a resumed run writes the whole file again, so that no sample is missing or written twice
    for (const ResponseSample& s : at_.samples) writer->add(response_line(s));
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

void CyclicSteps::warn(const std::string& warning, RunResult& result) {
  at_.warnings.push_back(warning);
  result.warnings.push_back(warning);
  if (watcher_.warn) watcher_.warn(warning);
}

bool CyclicSteps::is_quasi_static() const { return scene_.solver.method == SolverMethod::quasi_static; }

std::unique_ptr<Stepper> CyclicSteps::make_increments(std::size_t i, const std::vector<StateArray>& from,
                                                      RunResult& result) {
  const InPhase in(result.phases, &PhaseSeconds::stepper);
  auto made = make_cycle_increments(scene_, prepared_, at_.plan, at_.plan.frequencies[i], from, result.backend);
  increments_ = made.get();
  return made;
}
std::unique_ptr<Stepper> CyclicSteps::make(std::size_t i, const std::vector<StateArray>& from, RunResult& result) {
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

void CyclicSteps::begin_start(std::size_t i) {
  try {
    next_start_ = std::async(std::launch::async, [this, i] {
      omp_set_num_threads(1);
      return start_of(i);
    });
  } catch (const std::system_error&) {}  // no thread is available: the start is computed when it is needed
}

StartState CyclicSteps::start_of(std::size_t i) const {
  const FrequencyPlan& p = at_.plan.frequencies[i];
  return steady_start(prepared_.network, scene_.laws, p.motion, p.loading);
}

void CyclicSteps::step(std::size_t i, LineWriter* writer, SampledRuns& sampled_runs, const Saving& save,
                       RunResult& result) {
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
  if (is_quasi_static()) {
    at_.increments.push_back(increments_found(*increments_));
    for (const std::string& warning : increment_warnings(*increments_))
      warn(fmt::format("{} Hz: {}", p.loading.frequency, warning), result);
  }
}

void CyclicSteps::finish(std::size_t i, RunResult& result) {
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
  auto steps = std::make_unique<CyclicSteps>(scene, prepared, watcher, inertia, std::move(at), resumed.has_value());
  steps->make_first(result, resumed ? resumed->file : std::filesystem::path());
  steps->begin(result);
  return steps;
}

}  // namespace macadam
