// SPDX-License-Identifier: GPL-3.0-or-later
// step_load.cpp  Takes the time steps of a test with a load on the top wall, from one point of the result to the
// next.
#include "host/experiments/transient/step_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/experiments/transient/load_rules.hpp"
#include "host/experiments/transient/load_state.hpp"
#include "host/experiments/transient/quasi_static_plan.hpp"
#include "host/experiments/transient/stepped_columns.hpp"
#include "host/run/sampled_run.hpp"
#include "host/run/cracks.hpp"
#include "host/run/damaged_contacts.hpp"
#include "host/run/step_settings.hpp"
#include "host/run/skips.hpp"
#include "host/files/result_files.hpp"
#include "host/network/free_sides.hpp"
#include "host/run/phases.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

namespace {

/// If a run has more steps than this or is predicted to take more seconds than this, the user is warned.
constexpr std::int64_t many_steps = 100'000'000;
constexpr double many_seconds = 3600;
/// Number of steps, evenly spaced over a run, at which a strength test reads the stress, and at which a test with
/// cracks adds up the work of the walls.
constexpr std::int64_t peak_samples = 10'000;

/// Returns the mean density of the specimen's box, including the density scaling [kg/m³].
double heavy_density(const LoadPlan& plan, const Inertia& inertia, const Box& box) {
  double mass = 0;
  for (const double m : inertia.mass) mass += m;
  return plan.density_scaling * mass / box.volume();
}

double kinetic_energy(const ParticleState& p, const Inertia& inertia) {
  double out = 0;
  for (std::size_t i = 0; i < p.velocity.size(); ++i) {
    out += 0.5 * (inertia.mass[i] * dot(p.velocity[i], p.velocity[i]) + inertia.inertia[i] * dot(p.spin[i], p.spin[i]));
  }
  return out;
}

/// A stepped test of a load, from its planning to its results.
class SteppedLoad : public PlannedExperiment {
 public:
  SteppedLoad(const TransientExperiment& test, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
              Inertia inertia, LoadState at, bool resumed)
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

  /// Makes the stepper. The stepper is made before any file is changed, so that all files stay as they were if the
  /// stepper refuses the scene.
  void make(RunResult& result, const std::filesystem::path& checkpoint) {
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
    if (state.empty() && starts_in_motion(test_, facts_of(scene_.laws))) set_in_motion();
  }

  /// Fills in the results that are known before the first step.
  void begin(RunResult& result) {
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

  /// Warns of a run with very many steps.
  void warn_of_many_steps() const {
    if (is_quasi_static()) return;
    const std::int64_t steps = at_.plan.step_at(test_.history.times.back());
    if (steps > many_steps && watcher_.warn) {
      watcher_.warn(fmt::format("the run takes {} time steps of {:.3g} s until t = {:g} s; {}", steps, at_.plan.dt,
                                test_.history.times.back(), fewer_steps()));
    }
  }

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override {
    auto& found = std::get<SteppedResponse>(result.found);
    SampledRuns sampled_runs(scene_, prepared_, watcher_, result, out, owns_checkpoint_,
                             [&](const std::string& warning) {
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
        [&](SteppedPoint point) {
          const auto events = look_for_cracks(point);
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
      if (rupture_) found.steps = stepper_->observe().step;
      if (quasi_static_) found.increments = increments_found();
      found.seconds = before + seconds_since(start);
      found.kinetic_share = kinetic_share(found);
      owns_checkpoint_ = sampled_runs.own_checkpoint();
    };
    try {
      sampled_runs.run(*stepper_, course, at_.plan.form, at_.plan.geometry);
    } catch (...) {
      finish();
      throw;
    }
    finish();
    writer.close();
    if (cracks_writer) cracks_writer->close();
    // a device keeps the states of the points until somebody needs them
    if (quasi_static_ && cracks_.sums() && end_cracks_.empty() && !found.points.empty())
      end_cracks_ = stepper_->point_cracks(prepared_.network);
    if (cracks_.sums())
      write_damage(out, prepared_, end_cracks_, found.points.empty() ? 0 : found.points.back().time_s);
    judge(found, result.warnings);
  }

  bool owns_checkpoint() const override { return owns_checkpoint_; }

 private:
  /// Gives the particles the velocities of a uniform strain rate: zero at the bottom wall, and the velocity of the top
  /// wall at the top.
  void set_in_motion() {
    const std::vector<Vec3d>& centre = prepared_.specimen.centre;
    std::vector<Vec3d> velocity(centre.size()), spin(centre.size());
    const double rate = drive_->rate(0) / prepared_.specimen.box.size.z;
    for (std::size_t i = 0; i < centre.size(); ++i) velocity[i].z = rate * centre[i].z;
    stepper_->set_velocities(velocity, spin);
    ledger_.start(stepper_->particles());
  }
  bool is_quasi_static() const { return scene_.solver.method == SolverMethod::quasi_static; }
  void make_quasi_static(const Boundary& boundary, const std::vector<StateArray>& state, Backend backend) {
    quasi_static::CourseOptions options = course_options(test_, at_.plan, scene_, prepared_);
    options.solver.backend = backend;
    if (backend == Backend::cuda) options.solver.devices = scene_.solver.devices;
    auto made = std::make_unique<QuasiStaticStepper>(prepared_.specimen, prepared_.network, scene_.laws, boundary,
                                                     std::move(options));
    if (!state.empty()) made->set_state(state);
    quasi_static_ = made.get();
    if (measures_peak()) made->after_each([this](const Observation& now) { follow_peak(now); });
    stepper_ = std::move(made);
  }
  experiments::Increments increments_found() const {
    const quasi_static::CourseReport& report = quasi_static_->report();
    experiments::Increments out;
    out.increments = report.increments, out.rejected = report.rejected, out.systems = report.passes;
    out.error = report.error;
    out.loose = report.loose, out.by_opening = report.by_opening;
    out.imbalance = quasi_static_->energies().imbalance();
    out.increment_error = quasi_static_->energies().increment_error();
    if (report.unstable)
      out.unstable = experiments::Peak{report.unstable->time_s, report.unstable->strain, report.unstable->stress_pa};
    return out;
  }

  std::string head(const LoadWords& words) const {
    const std::string ratio =
        words.ratio ? fmt::format("{}: ratio of the strain and stress in its row; ", words.ratio) : "";
    return fmt::format("# {}, stepped in time; {}{}\n{},{}", modulus_words(scene_.network.lateral_walls), ratio,
                       errors_.meaning(), csv_head(words), columns().head());
  }
  std::string line(const LoadWords& words, const SteppedPoint& p) const {
    return fmt::format("{},{}", csv_line(words, p), columns().line(p));
  }
  SteppedColumns columns() const {
    return {test_.by_stress, cracks_.active(), cracks_.sums(), at_.plan.damping_kind != Damping::none,
            sides_.has_value()};
  }

  /// Returns whether the largest stress is recorded: only in a strength test, in which the strain grows and contact
  /// points can break.
  bool measures_peak() const { return cracks_.active() && test_.grows && !test_.by_stress && !test_.reverses; }
  /// Keeps the largest stress so far, with its time and strain.
  void follow_peak(const Observation& now) {
    const Box& box = prepared_.specimen.box;
    const double strain = now.top_displacement() / gauge_length(box), stress = -now.top_force() / section_area(box);
    const double sign = std::copysign(1.0, strain);
    if (sign * stress > sign * at_.peak.stress_pa) at_.peak = {now.time, strain, stress};
    // a resumed run may observe a step again
    if (cracks_.sums() && (at_.stresses.empty() || at_.stresses.back().strain != strain))
      at_.stresses.push_back({strain, stress});
  }

  /// Counts the contact points that are broken at a sample, sums the energies, and returns the events since the last
  /// sample. Under tension the test ends when no path of intact contacts joins the walls. In compression broken points
  /// still bear load, so the test goes on.
  std::vector<experiments::CrackEvent> look_for_cracks(SteppedPoint& point) {
    if (!cracks_.active()) return {};
    ContactState state;
    const auto survey = quasi_static_ && cracks_.sums() ? quasi_static_->survey_cracks() : std::nullopt;
    if (quasi_static_ && !survey) {  // its energies need no states of contacts
      state.point_breaks = stepper_->point_breaks(prepared_.network);
      state.point_cracks = stepper_->point_cracks(prepared_.network);
    } else if (!survey) {
      state = read_contact_state(scene_, *stepper_, prepared_.network);
    }
    auto events = survey ? cracks_.look(*survey, point.time_s) : cracks_.look(state, point.time_s);
    at_.cracks = cracks_.found().events;
    point.broken_points = cracks_.found().points();
    const Observation now = stepper_->observe();
    if (cracks_.sums()) {
      point.cracks = *cracks_.found().sums;
      point.energies = quasi_static_ ? experiments::Energies(quasi_static_->energies())
                                     : ledger_.sample(now, state, stepper_->particles(), point.cracks);
      end_cracks_ = std::move(state.point_cracks);
    }
    if (drive_->value(now.step) > 0 && !cracks_.joins_walls()) {
      const SteppedPoint before = at_.points.empty() ? SteppedPoint{} : at_.points.back();
      rupture_ = {point.time_s, point.strain, before.time_s, before.strain};
    }
    return events;
  }

  /// Returns the course of the run: its samples, and the functions that are called at them. Sample 0 is the initial
  /// state, which is drawn in the field files. The other samples are the points of the result.
  Course course_of(const std::function<void(SteppedPoint)>& add, Content content) {
    const std::vector<double>& times = test_.history.times;
    Course course;
    course.name = test_.kind;
    course.dt = at_.plan.dt;
    course.first = stepper_->observe().step == 0 ? 0 : static_cast<std::int64_t>(at_.points.size()) + 1;
    course.last = static_cast<std::int64_t>(times.size());
    course.step_of = [this, &times](std::int64_t k) {
      return k == 0 ? 0 : at_.plan.step_at(times[static_cast<std::size_t>(k - 1)]);
    };
    course.taken = [](std::int64_t k) { return k > 0; };
    course.take = [this, add](std::int64_t k, const Observation& now) {
      if (k > 0) add(point(now));
    };
    course.uses_stepper = [](std::int64_t) { return true; };  // point() computes the kinetic energy from it
    if (!quasi_static_ && (measures_peak() || cracks_.sums())) {
      course.between = [this](const Observation& now) {
        if (measures_peak()) follow_peak(now);
        if (cracks_.sums()) ledger_.observe(now);
      };
      course.between_every = std::max<std::int64_t>(1, at_.plan.step_at(times.back()) / peak_samples);
    }
    course.ended = [this] { return rupture_.has_value(); };
    course.shown = [this](std::int64_t step, double steps_a_second) {
      return fmt::format("{}, t = {:.4g} s of {:g}, {:.0f} steps/s", test_.kind,
                         static_cast<double>(step) * at_.plan.dt, test_.history.times.back(), steps_a_second);
    };
    course.content = std::move(content);
    course.report_remaining = [this](double seconds) {
      // increments have very different lengths, so the first ones say nothing about the time of the others
      if (!quasi_static_ && seconds > many_seconds && watcher_.warn) {
        watcher_.warn(fmt::format("the time steps will take about {:.1f} h more; {}", seconds / 3600, fewer_steps()));
      }
    };
    return course;
  }

  /// Returns the point at the stepper's present step.
  SteppedPoint point(const Observation& now) const {
    const double area = section_area(prepared_.specimen),
                 load = drive_->value(now.step) / area + 0.0;  // + 0.0 turns −0 into 0
    SteppedPoint out{};
    out.time_s = now.time;
    out.strain = now.top_displacement() / gauge_length(prepared_.specimen);
    out.top_pa = -now.top_force() / area;  // in tension the particles pull the top wall down: negative force
    out.bottom_pa = now.wall_force[wall_index(wall_z_lo)].z / area;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const ParticleState particles = stepper_->particles();
    out.kinetic_j = at_.plan.density_scaling * kinetic_energy(particles, inertia_);
    out.poisson_ratio = sides_ && out.strain != 0
                            ? sides_->contraction(motions_of(particles, sides_->particles())) / now.top_displacement()
                            : none;
    if (test_.by_stress) {
      out.stress_pa = load;
      out.ratio = test_.when.release && now.time > *test_.when.release + 0.5 * at_.plan.dt ? none : out.strain / load;
    } else {
      out.stress_pa = out.top_pa;
      out.ratio = out.strain == 0 ? none : out.stress_pa / out.strain;
    }
    out.error = quasi_static_ && !at_.unstepped ? quasi_static_->report().error : errors_.of(out, at_.points);
    return out;
  }

  /// Returns the largest kinetic energy divided by the work of the load; 0 if the load does no work.
  double kinetic_share(const SteppedResponse& found) const {
    double kinetic = 0, strain = 0, stress = 0;
    for (const SteppedPoint& p : found.points) {
      kinetic = std::max(kinetic, p.kinetic_j);
      strain = std::max(strain, std::abs(p.strain));
      stress = std::max(stress, std::abs(p.stress_pa));
    }
    const double work = 0.5 * strain * stress * prepared_.specimen.box.volume();
    return work > 0 ? kinetic / work : 0;
  }

  /// Returns a text that advises how to get fewer steps.
  static std::string fewer_steps() {
    return "a larger density_scaling reduces their number, and method = \"harmonic\" needs none if all laws are linear";
  }

  /// Adds a warning if the error of a row is large. A specimen in two pieces has no equilibrium, so its rupture is
  /// reported instead of an error. In a strength test the rupture is a result and causes no warning.
  void judge(const SteppedResponse& found, std::vector<std::string>& warnings) const {
    if (found.rupture && (!test_.grows || test_.reverses)) return warnings.push_back(rupture_words(*found.rupture));
    std::vector<SteppedPoint> whole = found.points;
    if (found.rupture && !whole.empty()) whole.pop_back();  // at the last point the specimen was in two pieces
    if (quasi_static_) judge_increments(warnings);
    if (quasi_static_ && !at_.unstepped) return;
    if (std::string large = errors_.warning(whole); !large.empty()) warnings.push_back(std::move(large));
  }

  void judge_increments(std::vector<std::string>& warnings) const {
    const quasi_static::CourseReport& report = quasi_static_->report();
    if (report.unstable) {
      warnings.push_back(fmt::format(
          "after t = {:.6g} s (strain {:.6g}, {:.4g} MPa) no equilibrium was found at a larger displacement of the "
          "wall; {} increments were controlled by the opening of cracks, so that the strain may decrease in them. In a "
          "test that prescribes the strain, the stress drops suddenly at this strain",
          report.unstable->time_s, report.unstable->strain, report.unstable->stress_pa / 1e6, report.by_opening));
    }
    if (report.loose > 0) {
      warnings.push_back(fmt::format(
          "up to {} particles had no stiffness, because all their contacts had separated; they were held in place",
          report.loose));
    }
  }

  const TransientExperiment test_;
  const Scene& scene_;
  const Preparation& prepared_;
  const Watcher& watcher_;
  Inertia inertia_;
  LoadState at_;
  LoadErrors errors_;
  std::shared_ptr<const Drive> drive_;
  std::unique_ptr<Stepper> stepper_;
  const QuasiStaticStepper* quasi_static_ = nullptr;  ///< `stepper_`, if the method is quasi-static
  std::optional<FreeSides> sides_;                    ///< empty if a side is held or has no cell
  CrackWatch cracks_;
  EnergyLedger ledger_;
  std::vector<laws::PointCrack> end_cracks_;  // of the contact points, at the last point of the result
  std::optional<experiments::Rupture> rupture_ = {};
  bool owns_checkpoint_;
};

}  // namespace

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
