// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate.cpp  Searches for the parameters of least misfit, and judges whether the result is acceptable.
//
// Each round minimises the misfit that the reduced model predicts, and then solves the networks at the minimum. (The
// reduced model consists of the equations of motion, restricted to combinations of the motions found so far.) The
// motions of the new solution are added to the reduced model. The search ends when the prediction finds nothing better
// than the last solution.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>

#include "host/tools/calibration/free_parameters.hpp"
#include "host/tools/calibration/misfit.hpp"
#include "host/tools/calibration/statistics.hpp"
#include "macadam/calibration.hpp"
#include "macadam/error.hpp"
#include "macadam/thread_limit.hpp"

namespace macadam {
namespace calibration {
namespace {

/// Root-mean-square errors of |E*| and φ [°] beyond which a target counts as not reached. Suitable models have far
/// smaller errors for good data.
constexpr double worst_modulus = 0.15, worst_phase = 8;
/// Root-mean-square error, in standard deviations, beyond which a warning says that the measurements are missed. Noise
/// alone stays below 2.
constexpr double worst_miss = 2;

/// A ratio of measured to predicted |E*| below this number, or above its inverse, suggests that the unit of the
/// measurements is wrong.
constexpr double wrong_unit = 1 / 300.0;
/// 95 % of a normal distribution lie within this number of standard deviations on either side of the mean.
constexpr double two_sided = 1.96;

/// The error of a modulus or phase that was not measured.
constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// Largest change of a parameter's logarithm in one round, and the change below which the search ends. The error of an
/// estimate is about the square of the change, so at the end it is below 1e-12.
constexpr double farthest = 2, least_move = 1e-6;
/// Decrease of the misfit per round below which the search ends, in squared standard deviations. In a round with this
/// decrease the parameters move by about 1e-3 of their standard deviations.
constexpr double least_gain = 1e-6;
constexpr int most_rounds = 40;

/// One calibration from start to end. The constructor checks the input.
class Calibrator {
 public:
  Calibrator(const Scene& scene, const ModulusData& data, const CalibrationOptions& options, const Watcher& watcher)
      : scene_(scene), data_(data), options_(options), watcher_(watcher) {
    require_valid_input(scene, data, options);
    out_.options = options;
    out_.temperatures = data.temperatures;
    out_.deviations = data.deviations;
    out_.moduli = data.moduli;
    out_.phases = data.phases;
    free_ = free_parameters(scene, options, out_.parameters);
    for (const FreeParameter& p : options.free) priors_ += p.prior ? 1 : 0;
    const std::size_t numbers = static_cast<std::size_t>(residuals_each(options.misfit)) * data.points.size() + priors_;
    if (numbers < free_.size()) {
      throw InputError(data.source, 0, "measurements",
                       fmt::format("{} numbers, priors included, for {} free parameters", numbers, free_.size()),
                       "at least one number per free parameter");
    }
  }

  Calibration calibrate() {
    const auto start = Clock::now();
    Specimens specimens(scene_, data_, options_.seeds, watcher_);
    out_.seeds = specimens.seeds();
    out_.solver = specimens.solver();
    const auto prepared = Clock::now();
    out_.seconds_preparing = seconds(prepared - start);
    try {
      finish(find(specimens));
    } catch (const InterruptedError&) {
      throw InterruptedError("interrupted while calibrating; no file was written, and the folder is unchanged");
    }
    out_.seconds_solving = seconds(Clock::now() - prepared);
    return std::move(out_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

  /// Returns the scene's laws with the free parameters exp(theta).
  LawTable laws_at_theta(const std::vector<double>& theta) const {
    LawTable laws = scene_.laws;
    for (std::size_t i = 0; i < free_.size(); ++i)
      multiply(laws, free_[i], std::exp(theta[i] - std::log(free_[i].value)));
    return laws;
  }

  /// A prediction with its residuals and their derivatives. The residuals of the measurements come first, the residuals
  /// of the priors last.
  struct State {
    std::vector<double> theta;  ///< logarithms of the free parameters
    std::vector<Predicted> predicted;
    std::vector<double> residuals, jacobian;
    double misfit = 0;  ///< sum of squares, priors included
  };

  /// Returns the state for predictions at `theta`.
  State state_of(const std::vector<double>& theta, std::vector<Predicted> predicted) const {
    State out{theta, std::move(predicted), {}, {}, 0};
    add_residuals(data_, options_, out.predicted, out.residuals, out.jacobian);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const FreeParameter& p = options_.free[i];
      if (!p.prior) continue;
      out.residuals.push_back((theta[i] - std::log(*p.prior)) / p.prior_deviation);
      for (std::size_t k = 0; k < free_.size(); ++k) out.jacobian.push_back(k == i ? 1 / p.prior_deviation : 0);
    }
    for (const double r : out.residuals) out.misfit += r * r;
    return out;
  }

  /// Returns the state from solutions of the networks at `theta`.
  State solved(Specimens& specimens, const std::vector<double>& theta) {
    ++out_.solutions;
    return state_of(theta, specimens.solve(laws_at_theta(theta), free_));
  }

  /// Returns the state of least misfit according to the estimates. The search starts at θ and changes no parameter by
  /// more than a factor of e², beyond which the estimates are poor.
  State least_by_estimate(const Specimens& specimens, std::vector<double> theta) const {
    std::vector<ParameterBounds> bounds;
    for (std::size_t i = 0; i < theta.size(); ++i) {
      bounds.push_back({std::max(std::log(out_.parameters[i].low), theta[i] - farthest),
                        std::min(std::log(out_.parameters[i].high), theta[i] + farthest)});
    }
    std::exception_ptr interrupted;
    const Residuals residuals = [&](const std::vector<double>& at, std::vector<double>& r, std::vector<double>& j) {
      if (interrupted) return false;
      try {
        const State state = state_of(at, specimens.estimate(laws_at_theta(at), free_));
        r = state.residuals, j = state.jacobian;
        const auto finite = [](double v) { return std::isfinite(v); };
        return std::all_of(r.begin(), r.end(), finite) && std::all_of(j.begin(), j.end(), finite);
      } catch (const InterruptedError&) {  // an exception must not pass through Ceres
        interrupted = std::current_exception();
      } catch (const RunError&) {}  // no solution at this point: Ceres tries a shorter step
      return false;
    };
    const std::size_t count = static_cast<std::size_t>(residuals_each(options_.misfit)) * data_.points.size() + priors_;
    minimise(residuals, count, bounds, theta);
    if (interrupted) std::rethrow_exception(interrupted);
    return state_of(theta, specimens.estimate(laws_at_theta(theta), free_));
  }

  /// Solves at `theta`. If no solution is found, halves the distance to `good` and tries again, up to five times.
  State solved_near(Specimens& specimens, std::vector<double> theta, const State& good) {
    constexpr int halvings = 5;
    for (int i = 0;; ++i) {
      try {
        return solved(specimens, theta);
      } catch (const InterruptedError&) { throw; } catch (const RunError&) {
        if (i == halvings) throw;
      }
      for (std::size_t k = 0; k < theta.size(); ++k) theta[k] = (theta[k] + good.theta[k]) / 2;
    }
  }

  /// Returns the state of least misfit. The estimates and their derivatives are exact at the best solution so far; the
  /// search ends when the estimates predict no better state.
  State find(Specimens& specimens) {
    std::vector<double> theta;
    for (const CalibratedParameter& p : out_.parameters)
      theta.push_back(std::clamp(std::log(p.start), std::log(p.low), std::log(p.high)));
    State best = solved(specimens, theta);
    for (int round = 0; round < most_rounds; ++round) {
      State next = least_by_estimate(specimens, best.theta);
      double moved = 0;
      for (std::size_t i = 0; i < theta.size(); ++i) moved = std::max(moved, std::abs(next.theta[i] - best.theta[i]));
      if (moved < least_move) return next;
      // with exact measurements the misfit goes to zero; the search then continues until the parameters are exact as
      // well
      if (best.misfit > least_gain && best.misfit - next.misfit < least_gain) return best;
      State there = solved_near(specimens, next.theta, best);
      if (there.misfit < best.misfit) best = std::move(there);
    }
    out_.warnings.push_back(fmt::format(
        "the search for the smallest misfit did not end within {} solutions: these are the best values so far",
        out_.solutions));
    return best;
  }

  /// Fills in the results for the final state.
  void finish(const State& last) {
    out_.laws = laws_at_theta(last.theta);
    const std::size_t n = free_.size(), measured = last.residuals.size() - priors_;
    for (std::size_t i = 0; i < measured; ++i) out_.misfit += last.residuals[i] * last.residuals[i];
    for (std::size_t i = 0; i < n; ++i) {
      CalibratedParameter& p = out_.parameters[i];
      p.value = std::exp(last.theta[i]);
      const double near = 1e-6 * std::log(p.high / p.low);
      p.at_bound = last.theta[i] < std::log(p.low) + near || last.theta[i] > std::log(p.high) - near;
    }
    compare(last.predicted);
    const auto split = last.jacobian.begin() + static_cast<std::ptrdiff_t>(measured * n);
    add_statistics(out_, {last.jacobian.begin(), split}, {split, last.jacobian.end()});
    judge();
    warn();
  }

  /// Fills in measured and predicted values of each measurement, and the errors.
  void compare(const std::vector<Predicted>& predicted) {
    const std::vector<std::optional<double>> temperatures = temperatures_of(scene_, data_);
    FitErrors& e = out_.errors;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      const ModulusPoint& m = data_.points[i];
      CalibratedPoint p{m,
                        temperatures[i],
                        std::abs(predicted[i].modulus),
                        std::arg(predicted[i].modulus) * 180 / std::numbers::pi,
                        predicted[i].e_star_scatter,
                        predicted[i].phase_scatter_deg};
      // NaN stands for the error of a value that was not measured
      const double modulus = data_.moduli ? p.e_star_pa / m.e_star_pa - 1 : not_measured;
      const double phase = data_.phases ? p.phase_deg - m.phase_deg : not_measured;
      e.e_star_rms += modulus * modulus, e.phase_rms_deg += phase * phase;
      // std::max keeps its first argument if that is NaN
      e.e_star_largest = std::max(std::abs(modulus), e.e_star_largest);
      e.phase_largest_deg = std::max(std::abs(phase), e.phase_largest_deg);
      out_.points.push_back(p);
    }
    e.e_star_rms = std::sqrt(e.e_star_rms / static_cast<double>(predicted.size()));
    e.phase_rms_deg = std::sqrt(e.phase_rms_deg / static_cast<double>(predicted.size()));
  }

  /// Checks that the prediction is near the targets, and that parameters without bounds stayed within their search
  /// range. \throws RunError if not, or adds a warning if the options ask for the nearest values.
  void judge() {
    const FitErrors& e = out_.errors;
    std::vector<std::string> ends;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const CalibratedParameter& p = out_.parameters[i];
      const FreeParameter& asked = options_.free[i];
      const bool lower = p.value * p.value < p.low * p.high;
      if (p.at_bound && !(lower ? asked.low : asked.high))
        ends.push_back(fmt::format("the search moved {} to {:.3g}, four decades from its value in the scene, {:.3g}",
                                   p.name, p.value, p.start));
    }
    const bool modulus = options_.misfit != Misfit::phase && e.e_star_rms > worst_modulus;
    const bool phase = options_.misfit != Misfit::modulus && e.phase_rms_deg > worst_phase;
    if (ends.empty() && !modulus && !phase) return;
    const double ratio =
        // 1 if moduli were not measured
        data_.moduli ? out_.points.front().measured.e_star_pa / out_.points.front().e_star_pa : 1;
    std::string what = fmt::format(
        "{}{}{}", data_.moduli ? fmt::format("|E*| is missed by {:.3g} % (rms)", 100 * e.e_star_rms) : "",
        data_.moduli && data_.phases ? ", " : "",
        data_.phases ? fmt::format("phase{} by {:.3g} degrees", data_.moduli ? "" : " is missed", e.phase_rms_deg)
                     : "");
    for (const std::string& end : ends) what += "; " + end;
    if (ratio < wrong_unit || ratio > 1 / wrong_unit)
      what +=
          fmt::format("; the measured modulus is {:.1e} times the prediction: is the measured modulus in Pa?", ratio);
    const std::string first =
        modulus || phase ? "the targets are not reached by any values of the free parameters"
                         : "the targets do not determine the free parameters, so the misfit decreases without limit";
    if (!options_.nearest) {
      throw RunError(fmt::format("{}: {}: {}; bounds of a parameter, a prior, or other free parameters may help",
                                 data_.source, first, what));
    }
    out_.warnings.push_back(first + ": " + what);
  }

  /// Adds warnings about parameters at bounds, undetermined combinations, a large misfit, and parts of the scene that
  /// have no effect.
  void warn() {
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const CalibratedParameter& p = out_.parameters[i];
      if (p.at_bound)
        out_.warnings.push_back(fmt::format(
            "{} lies at its bound {:.4g}; the standard deviations of the other parameters are valid for this value",
            p.name, p.value));
    }
    const std::string alone = priors_ > 0 ? " without the priors" : "";
    for (const Combination& c : out_.combinations) {
      out_.warnings.push_back(std::isfinite(c.deviation)
                                  ? fmt::format("the measurements{} hardly determine {}: its 95 % interval extends by "
                                                "a factor of {:.2g} to either side",
                                                alone, name_of(out_, c), std::exp(two_sided * c.deviation))
                                  : fmt::format("the measurements{} do not determine {}", alone, name_of(out_, c)));
    }
    const double missed = std::sqrt(out_.misfit / static_cast<double>(out_.points.size()) /
                                    residuals_each(options_.misfit));  // in standard deviations (rms)
    if (missed > worst_miss) {
      out_.warnings.push_back(fmt::format(
          "the prediction misses the measurements by {:.3g} times their standard deviation (rms): the scene "
          "with these free parameters does not describe the measurements",
          missed));
    }
    const auto shifts = [](const laws::Shift& shift) { return !std::holds_alternative<laws::NoShift>(shift); };
    if (data_.temperatures && std::none_of(scene_.shifts.begin(), scene_.shifts.end(), shifts))
      out_.warnings.push_back(
          "no law of the scene changes with temperature: the temperatures of the measurements have no effect");
    if (scene_.solver.method == SolverMethod::explicit_ && scene_.solver.damping_kind == Damping::local) {
      out_.warnings.push_back("local damping of the scene has no effect in the frequency domain");
    }
  }

  const Scene& scene_;
  const ModulusData& data_;
  const CalibrationOptions& options_;
  const Watcher& watcher_;
  Calibration out_;
  std::vector<Parameter> free_;
  std::size_t priors_ = 0;
};

}  // namespace
}  // namespace calibration

Calibration calibrate(const Scene& scene, const ModulusData& data, const CalibrationOptions& options,
                      const Watcher& watcher) {
  const ThreadLimit threads(scene.solver.threads);
  Scene with_laws = scene;
  const std::vector<std::string> warnings = compute_mastic_law(with_laws, watcher);
  if (watcher.warn) std::for_each(warnings.begin(), warnings.end(), watcher.warn);
  return calibration::Calibrator(with_laws, data, options, watcher).calibrate();
}

}  // namespace macadam
