// SPDX-License-Identifier: GPL-3.0-or-later
// plan.cpp  Density scaling, time step, start, cycles, precision and geometry from the error that is asked for.
#include "host/simulation/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/simulation/error_model.hpp"
#include "host/simulation/solution.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Shares of the tolerance: inertia is predicted by a solution and so may take most of it; the rest are estimates.
constexpr double inertia_share = 0.9, precision_share = 0.05, geometry_share = 0.02;

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

class Planner {
 public:
  Planner(const Scene& scene, const Preparation& prepared, const Inertia& inertia, const Progress& progress)
      : scene_(scene), prepared_(prepared), inertia_(inertia), progress_(progress) {}

  Plan make() {
    choose_form_and_geometry();
    StepperOptions options;
    options.damping_kind = scene_.solver.damping_kind;
    options.damping = scene_.solver.damping;
    plan_.critical = critical_step(prepared_.network, scene_.laws, inertia_, options);
    choose_start();
    for (std::size_t i = 0; i < scene_.loading.frequencies.size(); ++i) plan_frequency(i);
    choose_precision();
    return std::move(plan_);
  }

 private:
  template <class... Args>
  void decide(fmt::format_string<Args...> text, Args&&... args) {
    plan_.decisions.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  bool automatic() const { return scene_.solver.tolerance.has_value(); }
  double tolerance() const { return *scene_.solver.tolerance; }

  void choose_form_and_geometry() {
    plan_.form = scene_.solver.form.value_or(ContactForm::condensed);
    if (scene_.solver.geometry || !automatic()) {
      plan_.geometry = scene_.solver.geometry.value_or(Geometry::updated);
      return;
    }
    const double error = fixed_geometry_error(scene_.loading.strain_amplitude);
    plan_.geometry = error <= geometry_share * tolerance() ? Geometry::fixed : Geometry::updated;
    decide("geometry {}: with fixed normals and arms a strain of {:g} costs about {:.1e}", to_string(plan_.geometry),
           scene_.loading.strain_amplitude, error);
  }

  /// Whether there is a harmonic solution to start from and to compare with; if not, why.
  std::optional<std::string> why_not_linear() const {
    if (scene_.solver.damping_kind == Damping::local) return "local damping is not linear";
    if (prepared_.loose_particles > 0) {
      return fmt::format("{} particles are not joined to both walls, which makes the stiffness singular",
                         prepared_.loose_particles);
    }
    if (prepared_.specimen.size() > largest_harmonic) {
      return fmt::format("{} particles are more than the {} whose stiffness is factored unasked",
                         prepared_.specimen.size(), largest_harmonic);
    }
    return std::nullopt;
  }

  void choose_start() {
    const bool asked = scene_.loading.start.has_value();
    start_ = scene_.loading.start.value_or(automatic() && scene_.loading.ramp_cycles.value_or(0) == 0 ? Start::steady
                                                                                                      : Start::rest);
    if (!automatic() && start_ == Start::rest) return;
    if (const auto why = why_not_linear()) {
      if (start_ == Start::steady) {
        start_ = Start::rest;
        ramp_ = 1;
        decide("start from rest with a ramp of one cycle{}: {}", asked ? ", not steady as asked" : "", *why);
      }
      return;
    }
    if (progress_) progress_("harmonic: factoring", 0);
    harmonic_.emplace(prepared_.specimen, prepared_.network, scene_.laws, inertia_, HarmonicOptions{},
                      geometric_mean(scene_.loading.frequencies));
    if (start_ == Start::steady) {
      decide("steady start from the harmonic solution{}", asked ? "" : ": one cycle is enough");
    }
  }

  void plan_frequency(std::size_t i) {
    const double frequency = scene_.loading.frequencies[i];
    if (progress_ && harmonic_) progress_(fmt::format("harmonic: {} Hz", frequency), 0);
    FrequencyPlan f;
    if (harmonic_) f.known = harmonic_->solve(frequency, 1, viscous()).top;
    HarmonicResult scaled;
    if (scene_.solver.density_scaling || !automatic()) {
      f.density_scaling = density_scaling_of(scene_.solver, i);
      if (harmonic_) scaled = harmonic_->solve(frequency, f.density_scaling, viscous());
    } else if (harmonic_) {
      scaled = choose_scaling(frequency, f);
    } else {
      const double bound = inertia_bound(scene_, prepared_, frequency);
      f.density_scaling = std::max(1.0, inertia_share * tolerance() / bound);
      decide(
          "{} Hz: density scaling {:.4g}, whose inertia costs less than {:.1e} by the specimen's height and the "
          "slowest wave",
          frequency, f.density_scaling, f.density_scaling * bound);
    }
    choose_cycles(f);
    f.start = start_;
    f.loading = make_loading(f, frequency);
    if (harmonic_) {
      f.predicted = inertia_error(scaled.top, *f.known);
      if (start_ == Start::steady) f.motion = std::move(scaled.motion);
    }
    plan_.frequencies.push_back(std::move(f));
  }

  double viscous() const { return scene_.solver.damping_kind == Damping::viscous ? scene_.solver.damping : 0; }

  /// The scaling whose inertia costs `inertia_share` of the tolerance, and its solution. Inertia grows as the scaling
  /// while it is small, so that one or two corrections do.
  HarmonicResult choose_scaling(double frequency, FrequencyPlan& f) {
    const double wanted = inertia_share * tolerance();
    double scaling =
        std::max(1.0, wanted / (bound_over_error_ ? *bound_over_error_ * inertia_bound(scene_, prepared_, frequency)
                                                  : inertia_bound(scene_, prepared_, frequency)));
    for (int attempt = 0;; ++attempt) {
      HarmonicResult solved = harmonic_->solve(frequency, scaling, viscous());
      const double error = largest(inertia_error(solved.top, *f.known));
      const bool fits = error <= 1.05 * wanted && (error >= 0.8 * wanted || scaling == 1);
      if (scaling == 1 || fits || attempt == 4) {
        f.density_scaling = scaling;
        decide("{} Hz: density scaling {:.4g}, whose inertia costs {:.1e} by the harmonic solver", frequency, scaling,
               error);
        if (scaling > 1) { bound_over_error_ = error / (scaling * inertia_bound(scene_, prepared_, frequency)); }
        return solved;
      }
      scaling = std::max(1.0, scaling * wanted / error);
    }
  }

  void choose_cycles(FrequencyPlan& f) {
    const LoadingSpec& loading = scene_.loading;
    int standard = start_ == Start::steady ? 1 : 5;
    if (automatic() && start_ == Start::rest) standard = cycles_from_rest(tolerance());
    f.cycles = loading.cycles.value_or(
        std::max(standard, static_cast<int>(std::ceil(ramp())) + loading.fit_cycles.value_or(1)));
    f.fit_cycles = std::min(f.cycles, loading.fitted(f.cycles));
    if (ramp() > f.cycles - f.fit_cycles) ramp_ = f.cycles - f.fit_cycles;
  }
  double ramp() const { return scene_.loading.ramp_cycles.value_or(ramp_); }

  /// A whole number of samples a period, a whole number of steps a sample.
  loadings::Cyclic make_loading(const FrequencyPlan& f, double frequency) const {
    const LoadingSpec& spec = scene_.loading;
    const double safety = scene_.solver.safety.value_or(automatic() ? 0.95 : 0.8);
    const double step = scene_.solver.time_step.value_or(safety * plan_.critical.dt * std::sqrt(f.density_scaling));
    const double wanted = 1 / (frequency * step * spec.samples_per_cycle);
    if (!(wanted < 1e12)) {
      throw RunError(fmt::format("the time step of {} s would take {} steps a cycle at {} Hz; raise density_scaling",
                                 step, wanted * spec.samples_per_cycle, frequency));
    }
    loadings::Cyclic loading;
    loading.amplitude = spec.strain_amplitude * prepared_.specimen.box.size.z;
    loading.frequency = frequency;
    loading.steps_per_period = std::max<std::int64_t>(1, std::llround(std::ceil(wanted))) * spec.samples_per_cycle;
    if (f.start == Start::rest) {
      loading.ramp_steps = std::llround(ramp() * static_cast<double>(loading.steps_per_period));
    }
    return loading;
  }

  void choose_precision() {
    const bool reference = scene_.solver.backend == Backend::reference;
    if (scene_.solver.precision || !automatic() || reference) {
      plan_.precision = scene_.solver.precision.value_or(Precision::double_);
      return;
    }
    double error = 0;
    for (const FrequencyPlan& f : plan_.frequencies) {
      error = std::max(error, single_precision_error(f.cycles * f.loading.steps_per_period));
    }
    plan_.precision = error <= precision_share * tolerance() ? Precision::single : Precision::mixed;
    decide("precision {}: single would drift by about {:.1e}", to_string(plan_.precision), error);
  }

  const Scene& scene_;
  const Preparation& prepared_;
  const Inertia& inertia_;
  const Progress& progress_;
  Plan plan_;
  std::optional<Harmonic> harmonic_;
  std::optional<double> bound_over_error_;
  Start start_ = Start::rest;
  double ramp_ = 0;
};

}  // namespace

Plan make_plan(const Scene& scene, const Preparation& prepared, const Inertia& inertia, const Progress& progress) {
  return Planner(scene, prepared, inertia, progress).make();
}

}  // namespace macadam
