// SPDX-License-Identifier: GPL-3.0-or-later
// load_plan.cpp  Chooses ramp, damping, platen mass and time step of a stepped test, from the slowest wave of the
// specimen and the times of the result's points.
#include "host/experiments/transient/load_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiments/transient/load_rules.hpp"
#include "host/run/step_settings.hpp"
#include "host/run/harmonic_options.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

class LoadPlanner {
 public:
  LoadPlanner(const TransientExperiment& test, const Scene& scene, const Preparation& prepared, const Inertia& inertia)
      : test_(test), scene_(scene), prepared_(prepared), inertia_(inertia) {}

  LoadPlan make() {
    refuse_others();
    plan_.form = form_of(scene_);
    plan_.geometry = scene_.solver.geometry.value_or(Geometry::updated);
    plan_.precision = scene_.solver.precision.value_or(Precision::double_);
    plan_.density_scaling = density_scaling_of(scene_.solver, 0);
    const double slowest = period_of_slowest_wave();
    choose_ramp(slowest);
    choose_damping(slowest);
    if (test_.by_stress) choose_platen();
    choose_step();
    return std::move(plan_);
  }

 private:
  /// Adds a sentence to the decisions.
  template <class... Args>
  void decide(fmt::format_string<Args...> text, Args&&... args) {
    plan_.decisions.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void refuse_others() const {
    if (!scene_.solver.tolerance) return;
    throw InputError(
        scene_.file.string(), 0, "tolerance in [solver]",
        fmt::format("{:g} with method \"explicit\" of kind \"{}\"", *scene_.solver.tolerance, test_.kind),
        "no tolerance, because a tolerance does not choose the settings of this test; give density_scaling, or "
        "method \"harmonic\"");
  }

  double period_of_slowest_wave() const {
    const Box& box = prepared_.specimen.box;
    double mass = 0;
    for (const double m : inertia_.mass) mass += m;
    const double modulus = affine_modulus(prepared_.network, facts_of(scene_.laws), box.volume());
    return slowest_period(test_, gauge_length(box), modulus, plan_.density_scaling * mass / box.volume());
  }

  void choose_ramp(double slowest) {
    plan_.ramp = ramp_of(test_, slowest);
    if (test_.grows || test_.when.ramp > 0) return;
    decide(
        "the load grows over {:.3g} s, the period of the specimen's slowest wave, because the scene asks for an "
        "instantaneous load",
        slowest);
    if (test_.when.release && *test_.when.release < slowest) {
      throw InputError(scene_.file.string(), 0, "release in [loading]", fmt::format("{} s", *test_.when.release),
                       fmt::format("the end of the ramp, {:.3g} s, or later", slowest));
    }
  }

  void choose_damping(double slowest) {
    damping_ = damping_of(test_, scene_.solver, facts_of(scene_.laws), plan_.ramp, slowest);
    plan_.damping_kind = damping_.kind;
    plan_.damping = damping_.value;
    if (starts_in_motion(test_, facts_of(scene_.laws))) {
      decide("the particles start with the velocities of the strain rate, so that the start causes no waves{}",
             scene_.solver.damping_given           ? ""
             : plan_.damping_kind == Damping::none ? "; no damping"
                                                   : fmt::format("; local damping {}, because sliding faces excite "
                                                                 "vibrations in compression",
                                                                 plan_.damping));
    }
    if (!damping_.chosen) return;
    decide("viscous damping of {:.3g} 1/s: {}", plan_.damping,
           damping_.critical
               ? "this is critical damping of the slowest wave, but waves have not died out at the first times of the "
                 "table"
               : fmt::format("waves that a change of load causes die out within {:.3g} s", damping_.pause));
  }

  /// Chooses the lightest platen that does not shorten the time step, unless the scene gives the mass of the platen.
  void choose_platen() {
    plan_.platen_mass = test_.platen_mass.value_or(0);
    if (plan_.platen_mass > 0) return;
    Inertia heavy = inertia_;  // particles so heavy that the wall alone limits the time step
    for (auto* list : {&heavy.mass, &heavy.inertia}) std::fill(list->begin(), list->end(), 1e60);
    StepperOptions options;
    const double particles = critical_step(prepared_.network, scene_.laws, inertia_, options).dt;
    options.boundary.load(wall_z_hi, 2, nullptr, 1);  // 1 kg
    const double wall = critical_step(prepared_.network, scene_.laws, heavy, options).dt;
    constexpr double no_shorter = 1.001;
    plan_.platen_mass = no_shorter * std::pow(particles / wall, 2);
    if (!(wall < 1e20)) throw RunError("the top wall touches no particle, so nothing carries the stress");
    decide("the loaded top wall has a mass of {:.3g} kg, the smallest mass that does not shorten the time step",
           plan_.platen_mass);
  }

  void choose_step() {
    StepperOptions options;
    options.damping_kind = plan_.damping_kind;
    options.damping = plan_.damping;
    if (test_.by_stress) options.boundary.load(wall_z_hi, 2, nullptr, plan_.platen_mass);
    plan_.critical = critical_step(prepared_.network, scene_.laws, inertia_, options);
    const double stable = plan_.critical.dt * std::sqrt(plan_.density_scaling);
    plan_.dt = load_step(test_, scene_.solver, plan_.critical.dt, plan_.density_scaling, plan_.ramp, damping_);
    const double end = test_.history.times.back();
    decide("density scaling {:.4g}: {} time steps of {:.3g} s until t = {:g} s", plan_.density_scaling,
           plan_.step_at(end), plan_.dt, end);
    if (plan_.dt > stable)
      decide("the given time step is {:.2f} times the largest time step that is certainly stable", plan_.dt / stable);
  }

  const TransientExperiment& test_;
  const Scene& scene_;
  const Preparation& prepared_;
  const Inertia& inertia_;
  LoadPlan plan_;
  LoadDamping damping_;
};

}  // namespace

double affine_modulus(const ContactNetwork& network, const FactsTable& laws, double volume) {
  double sum = 0;
  for (const Contact& c : network.contacts) {
    const LawFacts& law = laws[static_cast<std::size_t>(c.pair)].value();
    const double normal = c.n.z * c.n.z;
    const double weak_n = 1 + c.series * law.instantaneous, weak_s = 1 + c.series * law.alpha * law.instantaneous;
    // A uniform strain opens the contact by strain·distance; the stiffness is that of area over length
    sum += law.instantaneous * c.area * c.distance * (c.distance / c.length) * normal *
           (normal / weak_n + law.alpha * (1 - normal) / weak_s);
  }
  return sum / volume;
}

std::int64_t LoadPlan::step_at(double time) const { return std::max<std::int64_t>(1, std::llround(time / dt)); }

LoadPlan make_load_plan(const TransientExperiment& test, const Scene& scene, const Preparation& prepared,
                        const Inertia& inertia) {
  return LoadPlanner(test, scene, prepared, inertia).make();
}

Boundary boundary_of(const TransientExperiment& test, const LoadPlan& plan, const Box& box) {
  Boundary out;
  if (test.by_stress) {
    out.load(wall_z_hi, 2, test.drive(section_area(box), plan.dt, plan.ramp), plan.platen_mass);
  } else {
    out.move(wall_z_hi, 2, test.drive(gauge_length(box), plan.dt, plan.ramp));
  }
  return out;
}

}  // namespace macadam
