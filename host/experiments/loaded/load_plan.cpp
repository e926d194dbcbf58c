// SPDX-License-Identifier: GPL-3.0-or-later
// load_plan.cpp  Ramp, damping, platen and step from the slowest wave of the specimen and the times that are asked for.
#include "host/experiments/loaded/load_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/experiments/stepped/settings.hpp"
#include "host/simulation/harmonic_options.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// What waves may be of the stress where they are looked at.
constexpr double largest_wave = 2e-5;

/// The modulus that the network has at once if all of it strains alike [Pa]: no less than its true one.
double affine_modulus(const ContactNetwork& network, const FactsTable& laws, double volume) {
  double sum = 0;
  for (const Contact& c : network.contacts) {
    const LawFacts& law = laws[static_cast<std::size_t>(c.pair)].value();
    const double normal = c.n.z * c.n.z;
    sum += law.instantaneous * c.area * c.distance * normal * (normal + law.alpha * (1 - normal));
  }
  return sum / volume;
}

class LoadPlanner {
 public:
  LoadPlanner(const LoadTest& test, const Scene& scene, const Preparation& prepared, const Inertia& inertia)
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
  template <class... Args>
  void decide(fmt::format_string<Args...> text, Args&&... args) {
    plan_.decisions.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void refuse_others() const {
    if (!scene_.solver.tolerance) return;
    throw InputError(
        scene_.file.string(), 0, "tolerance in [solver]",
        fmt::format("{:g} beside method \"explicit\" of kind \"{}\"", *scene_.solver.tolerance, test_.kind),
        "none: it has no part in the choice of settings; give density_scaling, or method \"harmonic\"");
  }

  /// Held at both ends, or loaded at one.
  double period_of_slowest_wave() const {
    const Box& box = prepared_.specimen.box;
    double mass = 0;
    for (const double m : inertia_.mass) mass += m;
    const double modulus = affine_modulus(prepared_.network, facts_of(scene_.laws), box.volume());
    const double speed = std::sqrt(modulus / (plan_.density_scaling * mass / box.volume()));
    return (test_.by_stress ? 4 : 2) * box.size.z / speed;
  }

  void choose_ramp(double slowest) {
    plan_.ramp = test_.grows ? test_.history.times.back() : test_.ramp;
    if (plan_.ramp > 0) return;
    plan_.ramp = slowest;
    decide("a load that is put on at once grows over {:.3g} s, the period of the specimen's slowest wave", slowest);
    if (test_.release && *test_.release < slowest) {
      throw InputError(scene_.file.string(), 0, "release in [loading]", fmt::format("{} s", *test_.release),
                       fmt::format("the end of the ramp, {:.3g} s, or later", slowest));
    }
  }

  /// The shortest time from a change of the load's rate to a point.
  double shortest_rest() const {
    std::vector<double> changes{0};
    if (!test_.grows) changes.push_back(plan_.ramp);
    if (test_.release) changes.insert(changes.end(), {*test_.release, *test_.release + plan_.ramp});
    double out = std::numeric_limits<double>::infinity();
    for (const double t : test_.history.times) {
      double rest = t;
      for (const double change : changes) {
        if (t > change * (1 + 1e-9)) rest = std::min(rest, t - change);
      }
      out = std::min(out, rest);
    }
    return out;
  }

  /// Weak damping leaves waves, strong damping drags at motions that are no waves: as much as the points need. A ramp
  /// makes waves of a share of the stress at its end that is the time of a wave through the specimen over the ramp's.
  /// Viscous damping takes e^(−β·t/2) of them.
  void choose_damping(double slowest) {
    plan_.damping_kind = scene_.solver.damping_kind;
    plan_.damping = scene_.solver.damping;
    if (scene_.solver.damping_given) return;
    const double rest = shortest_rest(), grown = std::min(plan_.ramp, test_.history.times.front());
    const double waves = std::min(1.0, 0.5 * slowest / grown);
    const double critical = 4 * std::numbers::pi / slowest;
    const double enough = 2 * std::max(1.0, std::log(waves / largest_wave)) / rest;
    plan_.damping_kind = Damping::viscous;
    plan_.damping = std::min(critical, enough);
    decide("viscous damping of {:.3g} 1/s: {}", plan_.damping,
           enough < critical ? fmt::format("waves of a change of load have died out {:.3g} s later", rest)
                             : "critical for the slowest wave; the first points come before waves have died out");
  }

  /// As heavy as a wall may be light without a shorter step, where the scene does not say.
  void choose_platen() {
    plan_.platen_mass = test_.platen_mass.value_or(0);
    if (plan_.platen_mass > 0) return;
    Inertia heavy = inertia_;  // so that the wall alone sets the step
    for (auto* list : {&heavy.mass, &heavy.inertia}) std::fill(list->begin(), list->end(), 1e60);
    StepperOptions options;
    const double particles = critical_step(prepared_.network, scene_.laws, inertia_, options).dt;
    options.boundary.load(wall_z_hi, 2, nullptr, 1);  // 1 kg
    const double wall = critical_step(prepared_.network, scene_.laws, heavy, options).dt;
    constexpr double no_shorter = 1.001;
    plan_.platen_mass = no_shorter * std::pow(particles / wall, 2);
    if (!(wall < 1e20)) throw RunError("the top wall touches no particle: nothing carries the stress");
    decide("a platen of {:.3g} kg: the lightest that does not shorten the step", plan_.platen_mass);
  }

  void choose_step() {
    const SolverSpec& solver = scene_.solver;
    StepperOptions options;
    options.damping_kind = plan_.damping_kind;
    options.damping = plan_.damping;
    if (test_.by_stress) options.boundary.load(wall_z_hi, 2, nullptr, plan_.platen_mass);
    plan_.critical = critical_step(prepared_.network, scene_.laws, inertia_, options);
    const double stable = plan_.critical.dt * std::sqrt(plan_.density_scaling);
    constexpr double usual_safety = 0.8;
    double step = solver.time_step.value_or(solver.safety.value_or(usual_safety) * stable);
    const bool viscous = plan_.damping_kind == Damping::viscous;
    if (viscous && !solver.time_step) step = std::min(step, 1 / plan_.damping);  // follow the decay
    const double end = test_.history.times.back();
    require_possible(end / step, step, fmt::format("until {:g} s", end));
    require_possible(plan_.ramp / step, step, fmt::format("in the ramp of {:g} s", plan_.ramp));
    plan_.dt = plan_.ramp / std::ceil(plan_.ramp / step);  // a whole number of steps
    decide("density scaling {:.4g}: {} steps of {:.3g} s until {:g} s", plan_.density_scaling, plan_.step_at(end),
           plan_.dt, end);
    if (plan_.dt > stable) decide("the given step is {:.2f} of the largest that is surely stable", plan_.dt / stable);
  }

  const LoadTest& test_;
  const Scene& scene_;
  const Preparation& prepared_;
  const Inertia& inertia_;
  LoadPlan plan_;
};

}  // namespace

std::int64_t LoadPlan::step_at(double time) const { return std::max<std::int64_t>(1, std::llround(time / dt)); }

LoadPlan make_load_plan(const LoadTest& test, const Scene& scene, const Preparation& prepared, const Inertia& inertia) {
  return LoadPlanner(test, scene, prepared, inertia).make();
}

Boundary boundary_of(const LoadTest& test, const LoadPlan& plan, const Box& box) {
  Boundary out;
  if (test.by_stress) {
    out.load(wall_z_hi, 2, test.drive(box.size.x * box.size.y, plan.dt, plan.ramp), plan.platen_mass);
  } else {
    out.move(wall_z_hi, 2, test.drive(box.size.z, plan.dt, plan.ramp));
  }
  return out;
}

}  // namespace macadam
