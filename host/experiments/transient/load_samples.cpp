// SPDX-License-Identifier: GPL-3.0-or-later
// load_samples.cpp  Takes the samples of a stepped test of a load: points of the result, the largest stress, cracks and
// energies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/experiments/transient/load_judgement.hpp"
#include "host/experiments/transient/stepped_load.hpp"

namespace macadam {

using experiments::SteppedPoint;

namespace {

/// If the steps are predicted to take more seconds than this, the user is warned.
constexpr double many_seconds = 3600;
/// Number of steps, evenly spaced over a run, at which a strength test reads the stress, and at which a test with
/// cracks adds up the work of the walls.
constexpr std::int64_t peak_samples = 10'000;

double kinetic_energy(const ParticleState& p, const Inertia& inertia) {
  double out = 0;
  for (std::size_t i = 0; i < p.velocity.size(); ++i) {
    out += 0.5 * (inertia.mass[i] * dot(p.velocity[i], p.velocity[i]) + inertia.inertia[i] * dot(p.spin[i], p.spin[i]));
  }
  return out;
}

}  // namespace

void SteppedLoad::follow_peak(const Observation& now) {
  const Box& box = prepared_.specimen.box;
  const double strain = now.top_displacement() / gauge_length(box), stress = -now.top_force() / section_area(box);
  const double sign = test_.cools ? 1.0 : std::copysign(1.0, strain);
  if (sign * stress > sign * at_.peak.stress_pa) at_.peak = {now.time, strain, stress};
  // a resumed run may observe a step again
  if (measures_peak() && cracks_.sums() && (at_.stresses.empty() || at_.stresses.back().strain != strain))
    at_.stresses.push_back({strain, stress});
}

std::vector<experiments::CrackEvent> SteppedLoad::read_cracks(double time) {
  const auto survey = quasi_static_ && cracks_.sums() ? quasi_static_->survey_cracks() : std::nullopt;
  if (quasi_static_ && !survey) {  // its energies need no states of contacts
    contact_state_.point_breaks = stepper_->point_breaks(prepared_.network);
    contact_state_.point_cracks = stepper_->point_cracks(prepared_.network);
  } else if (!survey) {
    read_contact_state(scene_, *stepper_, prepared_.network, contact_state_);
  }
  auto events = survey ? cracks_.look(*survey, time) : cracks_.look(contact_state_, time);
  at_.cracks.insert(at_.cracks.end(), events.begin(), events.end());
  return events;
}

std::vector<experiments::CrackEvent> SteppedLoad::look_for_cracks(SteppedPoint& point, const ParticleState& particles) {
  if (!cracks_.active()) return {};
  auto events = read_cracks(point.time_s);
  point.broken_points = cracks_.found().points();
  const Observation now = stepper_->observe();
  if (cracks_.sums()) {
    point.cracks = *cracks_.found().sums;
    point.energies = quasi_static_ ? experiments::Energies(quasi_static_->energies())
                                   : ledger_.sample(now, contact_state_, particles, point.cracks);
  }
  if ((test_.cools || drive_->value(now.step) > 0) && !cracks_.joins_walls()) {
    const SteppedPoint before = at_.points.empty() ? SteppedPoint{} : at_.points.back();
    rupture_ = {point.time_s, point.strain, before.time_s, before.strain};
  }
  return events;
}

Course SteppedLoad::course_of(const std::function<void(SteppedPoint, const ParticleState&)>& add, Content content) {
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
    if (k == 0) return;
    const ParticleState particles = stepper_->particles();
    add(point(now, particles), particles);
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
    return fmt::format("{}, t = {:.4g} s of {:g}, {:.0f} steps/s", test_.kind, static_cast<double>(step) * at_.plan.dt,
                       test_.history.times.back(), steps_a_second);
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

SteppedPoint SteppedLoad::point(const Observation& now, const ParticleState& particles) const {
  const double area = section_area(prepared_.specimen),
               load = drive_->value(now.step) / area + 0.0;  // + 0.0 turns −0 into 0
  SteppedPoint out{};
  out.time_s = now.time;
  out.strain = now.top_displacement() / gauge_length(prepared_.specimen);
  out.top_pa = -now.top_force() / area;  // in tension the particles pull the top wall down: negative force
  out.bottom_pa = now.wall_force[wall_index(wall_z_lo)].z / area;
  const double none = std::numeric_limits<double>::quiet_NaN();
  out.kinetic_j = at_.plan.density_scaling * kinetic_energy(particles, inertia_);
  out.poisson_ratio = sides_ && out.strain != 0
                          ? sides_->contraction(motions_of(particles, sides_->particles())) / now.top_displacement()
                          : none;
  if (!test_.temperature.empty()) out.temperature_c = test_.temperature.at(now.time);
  if (test_.by_stress) {
    out.stress_pa = load;
    const bool released = test_.when.release && now.time > *test_.when.release + 0.5 * at_.plan.dt;
    out.ratio = released || load == 0 ? none : out.strain / load;
  } else {
    out.stress_pa = out.top_pa;
    out.ratio = out.strain == 0 ? none : out.stress_pa / out.strain;
  }
  out.error = quasi_static_ && !at_.unstepped ? quasi_static_->report().error : errors_.of(out, at_.points);
  return out;
}

}  // namespace macadam
