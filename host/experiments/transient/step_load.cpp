// SPDX-License-Identifier: GPL-3.0-or-later
// step_load.cpp  Plans a stepped test with a load on the top wall, makes its stepper, and writes its files while the
// steps are taken.
#include "host/experiments/transient/step_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/experiments/transient/cooling_results.hpp"
#include "host/experiments/transient/load_judgement.hpp"
#include "host/experiments/transient/load_rules.hpp"
#include "host/experiments/transient/quasi_static_plan.hpp"
#include "host/experiments/transient/standard_results.hpp"
#include "host/experiments/transient/stepped_load.hpp"
#include "host/run/increment_words.hpp"
#include "host/files/result_files.hpp"
#include "host/run/damaged_contacts.hpp"
#include "host/run/phases.hpp"
#include "host/run/skips.hpp"
#include "host/run/step_settings.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

namespace {

/// If a run has more steps than this, the user is warned.
constexpr std::int64_t many_steps = 100'000'000;

/// Returns the mean density of the specimen's box, including the density scaling [kg/m³].
double heavy_density(const LoadPlan& plan, const Inertia& inertia, const Box& box) {
  double mass = 0;
  for (const double m : inertia.mass) mass += m;
  return plan.density_scaling * mass / box.volume();
}

}  // namespace

SteppedLoad::SteppedLoad(const TransientExperiment& test, const Scene& scene, const Preparation& prepared,
                         const Watcher& watcher, Inertia inertia, LoadState at, bool resumed)
    : test_(test),
      scene_(scene),
      prepared_(prepared),
      watcher_(watcher),
      inertia_(std::move(inertia)),
      at_(std::move(at)),
      errors_(test_, scene, prepared, heavy_density(at_.plan, inertia_, prepared.specimen.box), at_.plan,
              at_.unstepped),
      cracks_(scene, prepared, at_.cracks),
      ledger_(prepared.network, scene.laws, inertia_, at_.plan.density_scaling, at_.plan.dt,
              at_.plan.damping_kind != Damping::none, std::exchange(at_.ledger, {})),
      owns_checkpoint_(resumed) {
  if (scene.network.lateral_walls) return;
  sides_.emplace(prepared.specimen, prepared.tessellation);
  if (!sides_->known()) sides_.reset();
}

void SteppedLoad::make(RunResult& result, const std::filesystem::path& checkpoint) {
  const InPhase in(result.phases, &PhaseSeconds::stepper);
  const LoadPlan& p = at_.plan;
  StepperOptions options = stepper_options(scene_.solver, p.form, p.geometry, p.precision);
  options.damping_kind = p.damping_kind;
  options.damping = p.damping;
  options.density_scaling = p.density_scaling;
  options.dt = p.dt;
  options.boundary = boundary_of(test_, p, prepared_.specimen.box);
  drive_ = options.boundary.wall[wall_index(wall_z_hi)].axis[2].drive;
  const std::vector<StateArray> state = std::exchange(at_.state, {});
  try {
    if (is_quasi_static()) return make_quasi_static(options.boundary, state, result.backend);
    stepper_ = stepper_from(state, result.backend, scene_, prepared_, inertia_, options);
  } catch (const Error& error) {
    if (!state.empty())
      throw InputError(checkpoint.string() + ": this machine cannot continue the checkpoint: " + error.what());
    throw;
  }
  if (state.empty() && !test_.rows && starts_in_motion(test_, facts_of(scene_.laws))) set_in_motion();
}

void SteppedLoad::set_in_motion() {
  const std::vector<Vec3d>& centre = prepared_.specimen.centre;
  std::vector<Vec3d> velocity(centre.size()), spin(centre.size());
  const double rate = drive_->rate(0) / prepared_.specimen.box.size.z;
  for (std::size_t i = 0; i < centre.size(); ++i) velocity[i].z = rate * centre[i].z;
  stepper_->set_velocities(velocity, spin);
  ledger_.start(stepper_->particles());
}

void SteppedLoad::make_quasi_static(const Boundary& boundary, const std::vector<StateArray>& state, Backend backend) {
  quasi_static::CourseOptions options = course_options(test_, at_.plan, scene_, prepared_);
  options.solver.backend = backend;
  options.stop = watcher_.stop;
  if (backend == Backend::cuda) options.solver.devices = scene_.solver.devices;
  auto made = std::make_unique<QuasiStaticStepper>(prepared_.specimen, prepared_.network, scene_.laws, boundary,
                                                   std::move(options));
  if (!state.empty()) made->set_state(state);
  quasi_static_ = made.get();
  if (measures_peak() || test_.cools) made->after_each([this](const Observation& now) { follow_peak(now); });
  stepper_ = std::move(made);
}

void SteppedLoad::begin(RunResult& result) {
  const LoadPlan& p = at_.plan;
  result.decisions = p.decisions;
  if (const std::string ramp = errors_.ramp_words(); !ramp.empty()) result.decisions.push_back(ramp);
  result.skips = find_skips(scene_, prepared_, p.form, p.geometry, test_.strain);
  result.warnings = at_.warnings;
  result.solver = stepper_->description();
  SteppedResponse& found = result.found.emplace<SteppedResponse>();
  found.form = p.form;
  found.geometry = p.geometry;
  found.precision = p.precision;
  found.bytes = stepper_->bytes();
  found.critical_particle = p.critical.particle;
  found.critical_dt_s = p.critical.dt;
  found.seconds_planning = at_.seconds_planning;
  found.kind = test_.kind;
  found.confined = scene_.network.lateral_walls;
  found.ramp_s = p.ramp;
  found.platen_mass_kg = p.platen_mass;
  found.density_scaling = p.density_scaling;
  found.damping_kind = p.damping_kind;
  found.damping = p.damping;
  found.dt_s = p.dt;
  found.steps = p.step_at(test_.history.times.back());
  if (cracks_.active()) found.cracks = cracks_.found();
}

void SteppedLoad::warn_of_many_steps() const {
  if (is_quasi_static()) return;
  const std::int64_t steps = at_.plan.step_at(test_.history.times.back());
  if (steps > many_steps && watcher_.warn) {
    watcher_.warn(fmt::format("the run takes {} time steps of {:.3g} s until t = {:g} s; {}", steps, at_.plan.dt,
                              test_.history.times.back(), fewer_steps()));
  }
}

std::string SteppedLoad::head(const LoadWords& words) const {
  const std::string ratio =
      words.ratio ? fmt::format("{}: ratio of the strain and stress in its row; ", words.ratio) : "";
  return fmt::format("# {}, {}; {}{}\n{},{}", test_.rows ? test_.rows : modulus_words(scene_.network.lateral_walls),
                     is_quasi_static() ? "solved by increments" : "stepped in time", ratio, errors_.meaning(),
                     csv_head(words), columns().head());
}

SteppedColumns SteppedLoad::columns() const {
  // a drag dissipates energy in large specimens whose stress drops suddenly
  const bool drag = is_quasi_static() && cracks_.sums() && test_.grows && !test_.by_stress &&
                    !QuasiStaticOptions{}.solves_directly(prepared_.specimen.size());
  SteppedColumns out{test_.by_stress,    cracks_.active(),
                     cracks_.sums(),     drag || at_.plan.damping_kind != Damping::none,
                     sides_.has_value(), !test_.temperature.empty()};
  const Box& box = prepared_.specimen.box;
  if (test_.rows) out.length = gauge_length(box), out.section = section_area(box);
  return out;
}

void SteppedLoad::solve(const std::filesystem::path& out, const Saving& save, RunResult& result) {
  auto& found = std::get<SteppedResponse>(result.found);
  SampledRuns sampled_runs(scene_, prepared_, watcher_, result, out, owns_checkpoint_, [&](const std::string& warning) {
    at_.warnings.push_back(warning);
    result.warnings.push_back(warning);
    if (watcher_.warn) watcher_.warn(warning);
  });
  const LoadWords& words = load_words(test_.kind);
  LineWriter writer(out / words.file, head(words));
  for (const SteppedPoint& p : at_.points) writer.add(line(words, p));
  std::optional<LineWriter> cracks_writer;
  if (cracks_.active()) cracks_writer.emplace(out / cracks_file, crack_head(cracks_.sums()));
  const auto write_cracks = [&](const std::vector<experiments::CrackEvent>& events) {
    for (const experiments::CrackEvent& event : events)
      cracks_writer->add(crack_line(prepared_, event, cracks_.sums()));
  };
  write_cracks(at_.cracks);
  save("running");
  const auto start = Clock::now();
  const double before = at_.seconds;
  const Course course = course_of(
      [&](SteppedPoint point, const ParticleState& particles) {
        const auto events = look_for_cracks(point, particles);
        write_cracks(events);
        at_.points.push_back(point);
        writer.add(line(words, point));
      },
      [&](Checkpoint& to) {
        at_.seconds = before + seconds_since(start);
        at_.ledger = ledger_.state();
        add_to(to, at_);
        at_.ledger = {};
      });
  sampled_runs.begin_fields(test_.kind, static_cast<int>(test_.history.times.size()), stepper_->observe().time);
  const auto finish = [&] {
    found.points = at_.points;
    if (cracks_.active()) found.cracks = cracks_.found();
    found.rupture = rupture_;
    if (measures_peak()) found.peak = at_.peak;
    if (measures_peak() && cracks_.sums())
      found.fitted = quasi_static_ ? interpolate_peak(at_.stresses) : fit_peak(at_.stresses, at_.peak);
    if (found.peak) compute_standard_results(scene_, prepared_.specimen.box, at_.stresses, found);
    if (rupture_) found.steps = stepper_->observe().step;
    if (quasi_static_) found.increments = increments_found(*quasi_static_);
    if (sudden_break_) {
      found.increments->sudden_break = sudden_break_;
      found.increments->temperature_at_break_c = test_.temperature.at(sudden_break_->time_s);
    }
    if (test_.cools) found.cooling = cooling_results(found, at_.peak, test_.temperature);
    found.seconds = before + seconds_since(start);
    found.kinetic_share = kinetic_share(found.points, prepared_.specimen.box.volume());
    owns_checkpoint_ = sampled_runs.own_checkpoint();
  };
  try {
    try {
      sampled_runs.run(*stepper_, course, at_.plan.form, at_.plan.geometry);
    } catch (const quasi_static::Stopped&) {
      sampled_runs.look(*stepper_, course);
      throw RunError("interrupted in a sudden drop");  // look() throws, unless the wish to stop is taken back
    }
  } catch (const quasi_static::NoEquilibrium& error) {
    // a specimen that cracks because its temperature changes ends its test by breaking
    if (test_.temperature.empty() || !cracks_.active()) {
      finish();
      throw;
    }
    sudden_break_ = {error.last.time_s, error.last.strain, error.last.stress_pa};
    write_cracks(read_cracks(error.last.time_s));
  } catch (...) {
    finish();
    throw;
  }
  finish();
  writer.close();
  if (cracks_writer) cracks_writer->close();
  // a device keeps the states of the points until somebody needs them
  if (quasi_static_ && cracks_.sums() && contact_state_.point_cracks.empty())
    contact_state_.point_cracks = stepper_->point_cracks(prepared_.network);
  if (cracks_.sums()) {
    const double last = found.points.empty() ? 0 : found.points.back().time_s;
    write_damage(out, prepared_, contact_state_.point_cracks, sudden_break_ ? sudden_break_->time_s : last);
  }
  judge(found, result.warnings);
}

void SteppedLoad::judge(const SteppedResponse& found, std::vector<std::string>& warnings) const {
  if (found.rupture && !test_.cools && (!test_.grows || test_.reverses))
    return warnings.push_back(rupture_words(*found.rupture));
  std::vector<SteppedPoint> whole = found.points;
  if (found.rupture && !whole.empty()) whole.pop_back();  // at the last point the specimen was in two pieces
  if (sudden_break_) {
    warnings.push_back(fmt::format(
        "after t = {:.6g} s ({:.5g} degrees C, {:.4g} MPa) no equilibrium was found: the specimen breaks "
        "suddenly, and the test ends there",
        sudden_break_->time_s, test_.temperature.at(sudden_break_->time_s), sudden_break_->stress_pa / 1e6));
  }
  if (quasi_static_) {
    for (std::string& warning : increment_warnings(*quasi_static_)) warnings.push_back(std::move(warning));
  }
  if (quasi_static_ && !at_.unstepped) return;
  if (std::string large = errors_.warning(whole); !large.empty()) warnings.push_back(std::move(large));
}

std::unique_ptr<PlannedExperiment> plan_load_steps(const TransientExperiment& test, const Scene& scene,
                                                   const Preparation& prepared, const Watcher& watcher,
                                                   std::optional<Resumed> resumed, RunResult& result) {
  const InPhase planning(result.phases, &PhaseSeconds::planning);
  const auto start = Clock::now();
  Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  LoadState at;
  if (resumed) {
    at = to_load_state(std::move(resumed->checkpoint), resumed->file);
    if (at.checksum != test.checksum) {
      throw InputError(
          resumed->file.string(), 0, "file in [loading]", fmt::format("a load with the checksum {:08x}", at.checksum),
          fmt::format("the checksum {:08x}, because a run continues only with the load with which it began",
                      test.checksum));
    }
  } else {
    at.checksum = test.checksum;
    at.plan = scene.solver.method == SolverMethod::quasi_static ? make_quasi_static_plan(test, scene, prepared)
                                                                : make_load_plan(test, scene, prepared, inertia);
    const InPhase harmonic(result.phases, &PhaseSeconds::harmonic);
    at.unstepped = solve_unstepped(test, scene, prepared, watcher, result.backend, at.plan);
    at.seconds_planning = seconds_since(start);
  }
  auto steps = std::make_unique<SteppedLoad>(test, scene, prepared, watcher, std::move(inertia), std::move(at),
                                             resumed.has_value());
  steps->warn_of_many_steps();
  steps->make(result, resumed ? resumed->file : std::filesystem::path());
  steps->begin(result);
  return steps;
}

}  // namespace macadam
