// SPDX-License-Identifier: GPL-3.0-or-later
// step_frequencies.cpp  The cyclic test stepped in time, one frequency after another.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "host/fields/field_output.hpp"
#include "host/results/files.hpp"
#include "host/experiments/cyclic/run_state.hpp"
#include "host/simulation/checkpoints.hpp"
#include "host/experiments/cyclic/error_model.hpp"
#include "host/experiments/cyclic/judgement.hpp"
#include "host/simulation/phases.hpp"
#include "host/experiments/cyclic/plan.hpp"
#include "host/experiments/cyclic/skips.hpp"
#include "host/experiments/cyclic/methods.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

using experiments::SteppedCyclic;
using experiments::SteppedFrequency;

namespace {

/// The share of the tolerance that steps in blocks may cost, where a device takes them so.
constexpr double block_share = 0.02;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Advances in pieces of some tenths of a second, so that a signal is answered soon however long a step takes. The bits
/// do not depend on where a run is cut.
class Pieces {
 public:
  /// Goes from one step to another and calls look() after each piece, once at least.
  void advance(Stepper& stepper, std::int64_t from, std::int64_t to, const std::function<void()>& look) {
    do {
      const auto start = Clock::now();
      const std::int64_t piece = std::min(piece_, to - from);
      if (piece > 0) stepper.advance(piece);
      from += piece;
      const double seconds = seconds_since(start);
      if (piece == piece_ && seconds < 0.1) piece_ *= 2;
      if (seconds > 0.4) piece_ = std::max<std::int64_t>(1, piece_ / 2);
      look();
    } while (from < to);
  }

 private:
  std::int64_t piece_ = 16;
};

/// Runs one frequency from where the stepper stands; every sample goes to `samples` and `writer` at once. Without a
/// writer, only the cycles that are fitted and the one before, which shows the change from cycle to cycle, are
/// observed. `look` is called between steps, before the sample of the step that was reached is taken. `frame` adds a
/// frame to the fields, where they want one. \throws DivergenceError naming the particle that left the range of sense
/// first.
void run_cyclic(const Scene& scene, const Specimen& specimen, Stepper& stepper, const FrequencyPlan& plan,
                std::vector<ResponseSample>& samples, ResponseWriter* writer, const FieldOutput& fields,
                const std::function<void()>& look, const std::function<void(double)>& frame,
                const std::function<void(std::int64_t)>& stepped, const Watcher& watcher) {
  const drives::Cyclic& loading = plan.loading;
  const int per_cycle = scene.cyclic().samples_per_cycle;
  const std::int64_t samples_wanted = static_cast<std::int64_t>(plan.cycles) * per_cycle;
  const std::int64_t stride = loading.steps_per_period / per_cycle;
  const double area = specimen.box.size.x * specimen.box.size.y, height = specimen.box.size.z;
  const std::int64_t first = writer ? 0 : std::int64_t{std::max(0, plan.cycles - plan.fit_cycles - 1)} * per_cycle;
  const std::int64_t every = watcher.stepped ? watcher.every : 0;
  Pieces pieces;
  std::int64_t step = stepper.observe().step;
  for (std::int64_t k = (step + stride - 1) / stride; k <= samples_wanted; ++k) {
    do {  // stops on the way where the watcher wants to be told
      const std::int64_t next = every > 0 ? std::min(k * stride, (step / every + 1) * every) : k * stride;
      pieces.advance(stepper, step, next, look);
      if (every > 0 && next > step && next % every == 0) watcher.stepped(stepper, loading.frequency);
      step = next;
    } while (step < k * stride);
    if (k < first && k % per_cycle != 0 && !fields.wants(k)) continue;
    const Observation now = stepper.observe();
    const double stress = -now.top_force() / area;  // particles pull a wall that moves away from them
    if (const std::int64_t particle = stepper.first_divergent(); particle >= 0 || !std::isfinite(stress)) {
      const std::string what =
          particle >= 0 ? fmt::format("particle {} moves more than its radius in a step, or not finitely", particle)
                        : "the stress at the top wall is not finite";
      throw DivergenceError(
          fmt::format("the time stepping diverged: {}, at t = {:.6g} s ({} Hz, step {}, dt = {:.6g} s); use a smaller "
                      "time_step or safety",
                      what, now.time, loading.frequency, now.step, loading.dt()),
          particle, now.time);
    }
    if (k >= first) samples.push_back({loading.frequency, now.time, now.top_displacement() / height, stress});
    if (writer) writer->add(samples.back());
    if (fields.wants(k)) frame(now.time);
    stepped(step);
  }
}

/// The samples of one frequency, which stand together, from number `first` on.
std::span<const ResponseSample> samples_of(const std::vector<ResponseSample>& samples, std::size_t first,
                                           double frequency) {
  std::size_t end = first;
  while (end < samples.size() && samples[end].frequency_hz == frequency) ++end;
  return std::span(samples).subspan(first, end - first);
}

/// What a finished frequency says.
SteppedFrequency finished(const Plan& whole, std::size_t number, std::span<const ResponseSample> samples,
                          double seconds, std::optional<double> tolerance) {
  const FrequencyPlan& plan = whole.frequencies[number];
  SteppedFrequency f;
  f.frequency_hz = plan.loading.frequency;
  f.density_scaling = plan.density_scaling;
  f.dt_s = plan.loading.dt();
  f.cycles = plan.cycles;
  f.start = plan.start;
  f.steps = plan.loading.steps_per_period * plan.cycles;
  f.cyclic = evaluate_cyclic(samples, f.frequency_hz, plan.fit_cycles);
  f.stiffness = f.cyclic.fit;
  f.predicted = plan.predicted;
  if (plan.known) f.achieved = difference(f.stiffness, *plan.known);
  if (plan.known && tolerance) f.kept = largest(*f.achieved) + whole.geometry_error <= *tolerance;
  f.seconds = seconds;
  return f;
}

/// What all frequencies have in common.
StepperOptions common_options(const Plan& plan, const SolverSpec& solver) {
  StepperOptions options;
  options.form = plan.form;
  options.geometry = plan.geometry;
  options.precision = plan.precision;
  options.damping_kind = solver.damping_kind;
  options.damping = solver.damping;
  options.threads = solver.threads;
  options.device = solver.device;
  if (solver.tolerance) options.blocks = blocks_within(block_share * *solver.tolerance);
  return options;
}

/// Says how long blocks of steps are, where a tolerance decides it and the backend may take them.
void decide_blocks(const SolverSpec& solver, Backend backend, Plan& plan) {
  const bool may = backend == Backend::cuda && plan.form == ContactForm::condensed;
  if (!may || plan.precision == Precision::double_ || !solver.tolerance) return;
  const double blocks = common_options(plan, solver).blocks;
  plan.decisions.push_back(
      fmt::format("laws settled {:.0f} times in the shortest time of load and laws: that costs at most {:.1e}",
                  std::ceil(blocks), block_error(blocks)));
}

/// The stepper of one frequency: from rest, from the steady state, or, where there is one, from a checkpoint's state.
/// `used`: that of the frequency before.
std::unique_ptr<Stepper> stepper_of(const Scene& scene, const Preparation& prepared, const Inertia& inertia,
                                    Backend backend, const Plan& plan, const FrequencyPlan& p,
                                    const std::vector<StateArray>& from, std::unique_ptr<Stepper> used) {
  StepperOptions options = common_options(plan, scene.solver);
  options.density_scaling = p.density_scaling;
  options.boundary = moving_top(p.loading);
  options.dt = p.loading.dt();
  if (scene.solver.tolerance) options.observed_every = p.loading.steps_per_period / scene.cyclic().samples_per_cycle;
  StartState start;
  if (p.start == Start::steady && from.empty()) {
    start = steady_start(prepared.network, scene.laws, p.motion, p.loading);
    options.start = &start;
  }
  auto stepper =
      make_stepper(backend, prepared.specimen, prepared.network, scene.laws, inertia, options, std::move(used));
  if (!from.empty()) stepper->set_state(from);
  return stepper;
}

/// A stepped run from its plan on.
class Steps : public Solution {
 public:
  Steps(const Scene& scene, const Preparation& prepared, const Watcher& watcher, const Inertia& inertia, RunState at,
        bool resumed)
      : scene_(scene),
        prepared_(prepared),
        watcher_(watcher),
        inertia_(inertia),
        at_(std::move(at)),
        owns_checkpoint_(resumed) {}

  /// Makes the first stepper: what it refuses is refused before a file is touched.
  void make_first(RunResult& result, const std::filesystem::path& checkpoint) {
    if (at_.seconds.size() == at_.plan.frequencies.size()) return;
    const FrequencyPlan& p = at_.plan.frequencies[at_.seconds.size()];
    const bool resumed = !at_.state.empty();
    try {
      stepper_ = make(p, std::exchange(at_.state, {}), result);
    } catch (const Error& error) {
      if (resumed) throw InputError(checkpoint.string() + ": checkpoint of another machine: " + error.what());
      throw;
    }
  }

  /// What is known before the first step, and the frequencies that a checkpoint has finished.
  void begin(RunResult& result) {
    result.decisions = at_.plan.decisions;
    SteppedCyclic& found = result.found.emplace<SteppedCyclic>();
    found.form = at_.plan.form;
    found.geometry = at_.plan.geometry;
    found.precision = at_.plan.precision;
    found.critical_particle = at_.plan.critical.particle;
    found.critical_dt_s = at_.plan.critical.dt;
    found.seconds_planning = at_.seconds_planning;
    result.skips = find_skips(scene_, prepared_, at_.plan);
    result.warnings = at_.warnings;
    for (std::size_t i = 0; i < at_.seconds.size(); ++i) finish(i, result);
  }

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override {
    Checkpoints checkpoints(
        out / checkpoint_name, scene_, prepared_, result.backend, watcher_.stop,
        [&](const std::string& warning) { warn(warning, result); }, owns_checkpoint_);
    fields_.emplace(scene_, prepared_, out);
    std::optional<ResponseWriter> writer;
    if (scene_.output.response) {
      writer.emplace(out / "response.csv");
      for (const ResponseSample& s : at_.samples) writer->add(s);  // none is lost or doubled, whatever became of it
    }
    for (std::size_t i = at_.seconds.size(); i < at_.plan.frequencies.size(); ++i) {
      step(i, writer ? &*writer : nullptr, checkpoints, save, result);
      finish(i, result);
      owns_checkpoint_ = checkpoints.own();
    }
    require_sense(scene_, result.stepped());
  }

  bool owns_checkpoint() const override { return owns_checkpoint_; }

 private:
  void warn(const std::string& warning, RunResult& result) {
    at_.warnings.push_back(warning);
    result.warnings.push_back(warning);
    if (watcher_.warn) watcher_.warn(warning);
  }

  /// From the stepper of another frequency, where there is one.
  std::unique_ptr<Stepper> make(const FrequencyPlan& p, const std::vector<StateArray>& from, RunResult& result) {
    const InPhase in(result.phases, &PhaseSeconds::stepper);
    return stepper_of(scene_, prepared_, inertia_, result.backend, at_.plan, p, from, std::move(stepper_));
  }

  void step(std::size_t i, ResponseWriter* writer, Checkpoints& checkpoints, const Saving& save, RunResult& result) {
    const InPhase stepping(result.phases, &PhaseSeconds::stepping);
    const auto start = Clock::now();
    const double before = std::exchange(at_.seconds_running, 0);
    const FrequencyPlan& p = at_.plan.frequencies[i];
    if (used_) stepper_ = make(p, {}, result);
    used_ = true;
    result.solver = stepper_->description();
    std::get<SteppedCyclic>(result.found).bytes = stepper_->bytes();
    save("running");
    const double per_cycle = static_cast<double>(p.loading.steps_per_period);
    const std::int64_t begun = stepper_->observe().step;
    const auto look = [&] {
      const InPhase writing(result.phases, &PhaseSeconds::writing);  // nearly nothing where no checkpoint is due
      checkpoints.look([&](Checkpoint& to) { add_to(to, at_, before + seconds_since(start)); }, *stepper_,
                       fmt::format("{} Hz", p.loading.frequency));
    };
    for (const std::string& gap : fields_->begin(p.loading.frequency, stepper_->observe().time)) warn(gap, result);
    const auto frame = [&](double time) {
      const InPhase writing(result.phases, &PhaseSeconds::writing);
      fields_->add(*stepper_, at_.plan.form, at_.plan.geometry, time);
    };
    const auto stepped = [&](std::int64_t done) {
      if (!watcher_.progress || done == 0) return;
      const auto steps = static_cast<double>(done);
      watcher_.progress(fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}, {:.0f} steps/s", p.loading.frequency, i + 1,
                                    at_.plan.frequencies.size(), steps / per_cycle, p.cycles,
                                    static_cast<double>(done - begun) / seconds_since(start)),
                        steps / (per_cycle * p.cycles));
    };
    run_cyclic(scene_, prepared_.specimen, *stepper_, p, at_.samples, writer, *fields_, look, frame, stepped, watcher_);
    at_.seconds.push_back(before + seconds_since(start));
  }

  void finish(std::size_t i, RunResult& result) {
    const auto samples = samples_of(at_.samples, samples_read_, at_.plan.frequencies[i].loading.frequency);
    samples_read_ += samples.size();
    auto& frequencies = std::get<SteppedCyclic>(result.found).frequencies;
    frequencies.push_back(finished(at_.plan, i, samples, at_.seconds[i], scene_.solver.tolerance));
    SteppedFrequency& f = frequencies.back();
    f.temperature_c = scene_.materials.temperature;
    judge(f, stiffest_contact(scene_, prepared_.network, f.frequency_hz), scene_.solver.tolerance, result.warnings);
  }

  const Scene& scene_;
  const Preparation& prepared_;
  const Watcher& watcher_;
  Inertia inertia_;
  RunState at_;
  std::optional<FieldOutput> fields_;
  std::unique_ptr<Stepper> stepper_;  ///< of the frequency that runs, or is to run first
  bool used_ = false;                 ///< it has run one
  std::size_t samples_read_ = 0;      ///< of finished frequencies
  bool owns_checkpoint_;
};

}  // namespace

std::unique_ptr<Solution> plan_steps(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                     std::optional<Resumed> resumed, RunResult& result) {
  const InPhase planning(result.phases, &PhaseSeconds::planning);
  const auto start = Clock::now();
  const Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  RunState at;
  if (resumed) {
    at = to_run_state(std::move(resumed->checkpoint), resumed->file);
  } else {
    at.plan = make_plan(scene, prepared, inertia, watcher, result.backend, result.phases);
    decide_blocks(scene.solver, result.backend, at.plan);
    at.seconds_planning = seconds_since(start);
  }
  auto steps = std::make_unique<Steps>(scene, prepared, watcher, inertia, std::move(at), resumed.has_value());
  steps->make_first(result, resumed ? resumed->file : std::filesystem::path());
  steps->begin(result);
  return steps;
}

}  // namespace macadam
