// SPDX-License-Identifier: GPL-3.0-or-later
// plan.cpp  Chooses density scaling, time step, start, cycles, precision and geometry from the tolerance.
#include "host/experiments/cyclic/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiments/cyclic/choose_precision.hpp"
#include "host/run/error_model.hpp"
#include "host/run/step_settings.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/run/harmonic_options.hpp"
#include "host/run/phases.hpp"
#include "host/experiments/cyclic/scaling.hpp"
#include "host/experiments/cyclic/step_rules.hpp"
#include "host/experiments/cyclic/methods.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

class Planner {
 public:
  Planner(const Scene& scene, const Preparation& prepared, const Inertia& inertia, const Watcher& watcher,
          Backend backend, PhaseSeconds& phases)
      : scene_(scene),
        prepared_(prepared),
        inertia_(inertia),
        progress_(watcher.progress),
        stop_(watcher.stop),
        backend_(backend),
        phases_(phases) {}

  Plan make() {
    require_laws_to_fit();
    plan_.samples_per_cycle = scene_.cyclic().samples_per_cycle;
    choose_form_and_geometry();
    StepperOptions options;
    options.damping_kind = scene_.solver.damping_kind;
    options.damping = scene_.solver.damping;
    plan_.critical = critical_step(prepared_.network, scene_.laws, inertia_, options);
    choose_start();
    if (scene_.solver.time_step && scene_.solver.safety && (!automatic() || scene_.solver.density_scaling)) {
      decide("safety is not used, because time_step is given");
    }
    plan_frequencies();
    choose_precision(scene_, prepared_, plan_);
    return std::move(plan_);
  }

 private:
  /// Adds a sentence to the decisions, which are shown to the user.
  template <class... Args>
  void decide(fmt::format_string<Args...> text, Args&&... args) {
    plan_.decisions.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  bool automatic() const { return scene_.solver.tolerance.has_value(); }
  double tolerance() const { return *scene_.solver.tolerance; }
  /// Returns the relative residual to which harmonic solutions are computed. The error of E* is of the order of the
  /// residual squared. The relative error of the motion in a steady start is the residual times the condition number of
  /// the stiffness matrix K, which is at most about 1e5.
  double planning_residual() const {
    return automatic() ? std::clamp(1e-5 * tolerance(), HarmonicOptions{}.tolerance, 1e-8)
                       : HarmonicOptions{}.tolerance;
  }
  /// Returns β of viscous damping [1/s]; 0 with other damping.
  double viscous() const { return scene_.solver.damping_kind == Damping::viscous ? scene_.solver.damping : 0; }

  /// Refuses settings that cannot be combined with a nonlinear law or with a law without complex stiffness. \throws
  /// InputError
  void require_laws_to_fit() {
    const FactsTable facts = facts_of(scene_.laws);
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      if (!facts[pair]) continue;
      const std::string beside =
          fmt::format("with law {} of {}", facts[pair]->name, to_string(static_cast<PairType>(pair)));
      const auto refuse = [&](const char* what, const std::string& found, const char* expected) {
        throw InputError(scene_.file.string(), 0, what, found + " " + beside, expected);
      };
      if (automatic() && !facts[pair]->stiffness) {
        refuse("tolerance in [solver]", fmt::format("{}", tolerance()),
               "no tolerance, because errors are measured against a solution in the frequency domain, and this law has "
               "no complex stiffness for such a solution");
      }
      if (facts[pair]->linear) continue;
      if (scene_.network.quadrature == Quadrature::exact) {
        refuse("quadrature in [network]", "\"exact\"",
               "\"lumped\", because a law that is not linear is stepped point by point");
      }
      if (scene_.solver.form == ContactForm::condensed) {
        refuse("form in [solver]", "\"condensed\"", "\"points\", or no form, because this law is not linear");
      }
    }
  }

  void choose_form_and_geometry() {
    plan_.form = form_of(scene_);
    plan_.geometry = cyclic_geometry(scene_);
    const double strain = scene_.cyclic().strain_amplitude, error = fixed_geometry_error(strain);
    const bool fixed = plan_.geometry == Geometry::fixed;
    if (automatic()) {
      // The contact points turn with the frame of the contact, so the forms condensed and points differ by the square
      // of the strain.
      decide("contact form {}: |E*| with the other form (condensed or points) would differ only by {}",
             to_string(plan_.form),
             fixed ? "rounding" : fmt::format("about {:.0e}, the square of the strain", strain * strain));
      decide("geometry {}: at a strain of {:g}, keeping the initial geometry changes |E*| by at most about {:.1e}",
             to_string(plan_.geometry), strain, error);
    }
    if (fixed) plan_.geometry_error = error;
    nonlinear_ = nonlinear_effect(scene_, plan_.geometry);
  }

  /// Makes the harmonic solver. If that is not possible, `no_harmonic_` says why.
  void make_harmonic() {
    if (prepared_.loose_particles > 0) {
      no_harmonic_ = fmt::format("{} particles have no path of contacts to the bottom wall, to the top wall or to both",
                                 prepared_.loose_particles);
      return;
    }
    if (const auto without = first_without_stiffness(scene_.laws)) {
      no_harmonic_ = fmt::format("law {} of {} has no complex stiffness", without->law, to_string(without->pair));
      return;
    }
    if (progress_) progress_("harmonic: preconditioner", 0);
    const InPhase in(phases_, &PhaseSeconds::preconditioner);
    try {
      harmonic_.emplace(prepared_.specimen, prepared_.network, scene_.laws, inertia_,
                        harmonic_options(scene_, backend_, stop_, planning_residual()),
                        geometric_mean(scene_.cyclic().frequencies));
    } catch (const RunError& error) { no_harmonic_ = error.what(); }
  }

  void choose_start() {
    const bool asked = scene_.cyclic().start == Start::steady;
    start_ = asked_start(scene_);
    if (!plans_with_solutions(scene_)) return;
    make_harmonic();
    if (!harmonic_) decide("there is no harmonic solution to start from or to compare with: {}", no_harmonic_);
    const bool local = scene_.solver.damping_kind == Damping::local;
    if (local) decide("local damping is not linear, so predicted errors do not contain its effect");
    if (is_strain_large(scene_, plan_.geometry)) {
      decide(
          "the response is not linear at this strain: the harmonic solution, which keeps the initial geometry, differs "
          "from the stepped result by up to {:.1e}",
          nonlinear_);
    }
    start_ = harmonic_ ? cyclic_start(scene_, plan_.geometry) : Start::rest;
    if (start_ == Start::steady) {
      decide(
          "the run starts in the steady state of the harmonic solution, so that the first cycle is already periodic");
    } else {
      decide("the run starts from rest{}", asked ? ", although the scene asks for a steady start" : "");
    }
  }

  /// Solves harmonic problems (loads) side by side. A problem without a solution has an empty result and is reported
  /// among the decisions.
  std::vector<std::optional<HarmonicResult>> solutions(const std::vector<HarmonicLoad>& loads) {
    std::vector<std::optional<HarmonicResult>> out(loads.size());
    if (!harmonic_) return out;
    if (progress_) progress_("harmonic: " + std::to_string(loads.size()) + " solutions", 0);
    const InPhase in(phases_, &PhaseSeconds::harmonic);
    try {
      std::vector<HarmonicResult> all = harmonic_->solve(loads);
      std::move(all.begin(), all.end(), out.begin());
    } catch (const InterruptedError&) { throw; } catch (const RunError&) {
      for (std::size_t i = 0; i < loads.size(); ++i)
        out[i] = solution(loads[i]);  // one by one, so that the other problems are solved even if one has no solution
    }
    for (const auto& r : out) {
      if (r && !r->why_factors.empty())
        decide("{} Hz: solved with the direct solver, because the iterative solver cannot be used: {}", r->frequency_hz,
               r->why_factors);
    }
    return out;
  }

  /// Solves one harmonic problem. If it has no solution, reports this among the decisions and returns nothing.
  std::optional<HarmonicResult> solution(const HarmonicLoad& load) {
    try {
      return harmonic_->solve(std::vector{load}).front();
    } catch (const InterruptedError&) { throw; } catch (const RunError& error) {
      decide("{} Hz, density scaling {:.4g}: no harmonic solution: {}", load.frequency_hz, load.density_scaling,
             error.what());
      return {};
    }
  }

  /// Plans all frequencies at once: solves them at true mass, chooses their density scaling, and solves them again with
  /// the inertia of the scaled mass.
  void plan_frequencies() {
    const std::vector<double>& frequencies = scene_.cyclic().frequencies;
    std::vector<HarmonicLoad> loads;
    // without viscous damping, because this damping is not a property of the specimen
    for (const double f : frequencies) loads.push_back({f, 1, 0});
    const auto known = solutions(loads);
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      loads[i].density_scaling = scaling_of(i, known[i]);
      loads[i].viscous_damping = viscous();
      if (known[i]) loads[i].near = &known[i]->motion;
    }
    auto scaled = solutions(loads);
    correct(loads, known, scaled);
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      FrequencyPlan f;
      if (known[i]) f.known = known[i]->top;
      f.density_scaling = loads[i].density_scaling;
      finish(std::move(f), frequencies[i], std::move(scaled[i]));
    }
  }

  /// Returns the density scaling of frequency i: the one in the scene, or the largest one that the tolerance allows.
  /// The error of a scaling is computed from the derivative of E* or, without a harmonic solution, estimated.
  double scaling_of(std::size_t i, const std::optional<HarmonicResult>& known) const {
    if (const auto given = given_scaling(scene_, i, plan_.critical.dt)) return *given;
    const double frequency = scene_.cyclic().frequencies[i];
    if (known) return largest_scaling(*known, viscous(), aimed_part * inertia_part * tolerance());
    return std::max(1.0, estimate_part * tolerance() / inertia_estimate(scene_, prepared_, frequency));
  }

  /// Corrects the density scaling of frequencies whose error is too large, and solves these frequencies again. The
  /// correction is needed if the tolerance is large or a resonance is near, because the error then does not grow in
  /// proportion to the scaling.
  void correct(std::vector<HarmonicLoad>& loads, const std::vector<std::optional<HarmonicResult>>& known,
               std::vector<std::optional<HarmonicResult>>& scaled) {
    if (!automatic() || scene_.solver.density_scaling || scene_.solver.time_step) return;
    const double wanted = inertia_part * tolerance();
    for (int attempt = 0; attempt < 6; ++attempt) {
      std::vector<std::size_t> missed;
      std::vector<HarmonicLoad> again;
      for (std::size_t i = 0; i < loads.size(); ++i) {
        if (!known[i] || loads[i].density_scaling <= 1) continue;
        const double error = scaled[i] ? largest(difference(scaled[i]->top, known[i]->top)) : 10 * wanted;
        if (error <= wanted) continue;
        loads[i].density_scaling = 1 + (loads[i].density_scaling - 1) * std::clamp(0.9 * wanted / error, 1e-3, 0.9);
        missed.push_back(i);
        again.push_back(loads[i]);
      }
      if (missed.empty()) return;
      auto found = solutions(again);
      for (std::size_t k = 0; k < missed.size(); ++k) scaled[missed[k]] = std::move(found[k]);
    }
  }

  /// Completes the plan of a frequency with its start, cycles, loading and predicted error.
  void finish(FrequencyPlan f, double frequency, std::optional<HarmonicResult> scaled) {
    f.start = scaled ? start_ : Start::rest;
    const CycleCount count = count_cycles(scene_, f.start);
    const double ramp = count.ramp;
    f.cycles = count.cycles, f.fit_cycles = count.fitted;
    f.loading = make_loading(f, frequency, ramp);
    if (scaled && f.known) f.predicted = difference(scaled->top, *f.known);
    // at such strains the difference from the linear harmonic solution is not the error of the run
    if (automatic() && nonlinear_ > tolerance()) f.known.reset(), f.predicted.reset();
    if (f.start == Start::steady) f.motion = std::move(scaled->motion);
    say(f, frequency, ramp);
    plan_.frequencies.push_back(std::move(f));
  }

  /// Adds sentences about the settings of a frequency to the decisions.
  void say(const FrequencyPlan& f, double frequency, double ramp) {
    if (automatic()) {
      std::string error;
      if (f.predicted) {
        error = fmt::format("predicted error of |E*| {:+.1e}, of phi {:+.1e} rad", f.predicted->e_star,
                            f.predicted->phase_rad);
      } else {
        error = fmt::format(
            "estimated error from inertia {:.1e}, computed from the height of the specimen and the speed of its "
            "slowest wave",
            f.density_scaling * inertia_estimate(scene_, prepared_, frequency));
      }
      if (f.predicted && largest(*f.predicted) + plan_.geometry_error > tolerance())
        error += ", which is more than the tolerance";
      decide("{} Hz: with density scaling {:.4g} the time step is {:.3g} s, so {} cycle{} {} {} steps{}; {}", frequency,
             f.density_scaling, f.loading.dt(), f.cycles, f.cycles == 1 ? "" : "s", f.cycles == 1 ? "takes" : "take",
             f.loading.steps_per_period, f.cycles == 1 ? "" : " each", error);
    }
    if (f.start == Start::rest && usual_ramp(scene_) > 0) {
      decide("{} Hz: {}", frequency,
             ramp > 0 ? fmt::format("the load grows over {:g} cycle{}, so that the start causes fewer waves", ramp,
                                    ramp == 1 ? "" : "s")
                      : "without a ramp, waves from the start remain and change |E*| by 1e-5 to 1e-3 at random");
    }
    const double share = f.loading.dt() / (plan_.critical.dt * std::sqrt(f.density_scaling));
    if (share > 1)
      decide("{} Hz: the given time step is {:.2f} times the largest time step that is certainly stable", frequency,
             share);
  }

  /// Returns a loading with a whole number of samples per period and a whole number of steps per sample.
  drives::Cyclic make_loading(const FrequencyPlan& f, double frequency, double ramp) const {
    const experiments::Cyclic& spec = scene_.cyclic();
    const double step = longest_cyclic_step(scene_.solver, plan_.critical.dt, f.density_scaling);
    require_possible(1 / (frequency * step), step, fmt::format("per cycle at {} Hz", frequency));
    drives::Cyclic loading;
    loading.amplitude = spec.strain_amplitude * gauge_length(prepared_.specimen);
    loading.frequency = frequency;
    loading.steps_per_period = std::llround(steps_per_period(frequency, step, spec.samples_per_cycle));
    loading.ramp_steps = std::llround(ramp * static_cast<double>(loading.steps_per_period));
    return loading;
  }

  const Scene& scene_;
  const Preparation& prepared_;
  const Inertia& inertia_;
  const Progress& progress_;
  const std::function<bool()>& stop_;
  Backend backend_;
  PhaseSeconds& phases_;
  Plan plan_;
  std::optional<Harmonic> harmonic_;
  std::string no_harmonic_;
  Start start_ = Start::rest;
  double nonlinear_ = 0;  ///< effect of the strain on |E*| that the harmonic solution does not contain
};

}  // namespace

Plan make_plan(const Scene& scene, const Preparation& prepared, const Inertia& inertia, const Watcher& watcher,
               Backend backend, PhaseSeconds& phases) {
  return Planner(scene, prepared, inertia, watcher, backend, phases).make();
}

}  // namespace macadam
