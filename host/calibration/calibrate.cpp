// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate.cpp  Which parameters are free, the way to the least misfit, and whether what was found can be meant.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <numbers>

#include "host/calibration/misfit.hpp"
#include "host/calibration/statistics.hpp"
#include "host/in_quotes.hpp"
#include "host/nearest.hpp"
#include "macadam/calibration.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace calibration {
namespace {

/// Decades that a parameter without bounds may go from where it starts: beyond them nothing is meant.
constexpr double unbounded = 1e4;
/// Root mean square errors beyond which a target counts as not reached. Models miss good data by less, by far.
constexpr double worst_modulus = 0.3, worst_phase = 15;

[[noreturn]] void refuse(const std::string& what, const std::string& found, const std::string& expected) {
  throw InputError("calibration", 0, what, found, expected);
}

void check(const ModulusData& data, const CalibrationOptions& options, const Scene& scene) {
  const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
  if (data.points.empty()) throw InputError(data.source, 0, "measurements", "none", "at least one");
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const ModulusPoint& p = data.points[i];
    if (!positive(p.frequency_hz) || !positive(p.e_star_pa) || !(std::abs(p.phase_deg) < 180) ||
        (data.temperatures && !std::isfinite(p.temperature_c)) ||
        (data.deviations && !(positive(p.e_star_std) && positive(p.phase_std)))) {
      throw InputError(data.source, 0, fmt::format("measurement {}", i + 1), "a number without sense",
                       "finite ones; frequency, |E*| and standard deviations positive");
    }
  }
  if (!positive(options.e_star_deviation) || !positive(options.phase_deviation)) {
    refuse("standard deviations", fmt::format("{} and {}", options.e_star_deviation, options.phase_deviation),
           "positive numbers");
  }
  if (options.seeds < 1) refuse("seeds", fmt::format("{}", options.seeds), "at least 1");
  if (options.seeds > 1 && scene.specimen.file) {
    refuse("seeds", fmt::format("{} for a specimen from a file", options.seeds),
           "1: only generated specimens have seeds");
  }
}

/// The free parameters with their bounds. \throws InputError.
std::vector<Parameter> free_parameters(const Scene& scene, const CalibrationOptions& options, Calibration& out) {
  const std::vector<Parameter> known = parameters_of(scene);
  std::vector<std::string> names;
  for (const Parameter& p : known) names.push_back(p.name);
  if (options.free.empty()) refuse("free parameters", "none", fmt::format("one or more of {}", fmt::join(names, ", ")));
  std::vector<Parameter> free;
  for (const FreeParameter& asked : options.free) {
    const auto at = std::find(names.begin(), names.end(), asked.name);
    if (at == names.end()) {
      refuse("free parameters", in_quotes(asked.name),
             names.empty() ? "nothing: the scene has no laws"
                           : fmt::format("{} (the nearest of those that the scene has: {})", nearest(asked.name, names),
                                         fmt::join(names, ", ")));
    }
    const Parameter& p = known[static_cast<std::size_t>(at - names.begin())];
    for (const Parameter& other : free)
      if (other.name == p.name) refuse("free parameters", p.name + " twice", "each once");
    const double low = asked.low.value_or(p.value / unbounded), high = asked.high.value_or(p.value * unbounded);
    if (!(low > 0 && high > low && std::isfinite(high))) {
      refuse("bounds of " + p.name, fmt::format("{:g} and {:g}", low, high), "positive numbers, the lower one first");
    }
    if (!(p.value >= low && p.value <= high)) {
      refuse("bounds of " + p.name, fmt::format("{:g} to {:g}, without the scene's {:g}", low, high, p.value),
             "bounds that hold the value of the scene, from which the way begins");
    }
    if (asked.prior && !(*asked.prior > 0 && std::isfinite(*asked.prior) && asked.prior_deviation > 0 &&
                         std::isfinite(asked.prior_deviation))) {
      refuse("prior of " + p.name, fmt::format("{:g} with deviation {:g}", *asked.prior, asked.prior_deviation),
             "a positive value and a positive relative standard deviation");
    }
    free.push_back(p);
    out.parameters.push_back({p.name, p.unit, p.value, p.value, 0, low, high, false});
  }
  return free;
}

/// One calibration from start to end.
class Calibrator {
 public:
  Calibrator(const Scene& scene, const ModulusData& data, const CalibrationOptions& options, const Watcher& watcher)
      : scene_(scene), data_(data), options_(options), watcher_(watcher) {
    check(data, options, scene);
    out_.options = options;
    out_.temperatures = data.temperatures;
    out_.deviations = data.deviations;
    free_ = free_parameters(scene, options, out_);
    for (const FreeParameter& p : options.free) priors_ += p.prior ? 1 : 0;
    const std::size_t told = static_cast<std::size_t>(residuals_each(options.misfit)) * data.points.size() + priors_;
    if (told < free_.size()) {
      throw InputError(data.source, 0, "measurements",
                       fmt::format("{} numbers, priors included, for {} free parameters", told, free_.size()),
                       "as many or more");
    }
  }

  Calibration calibrate() {
    const auto start = Clock::now();
    Specimens specimens(scene_, data_, options_.seeds, watcher_);
    out_.seeds = specimens.seeds();
    out_.solver = specimens.solver();
    const auto prepared = Clock::now();
    out_.seconds_preparing = seconds(prepared - start);
    find(specimens);
    finish(specimens);
    out_.seconds_solving = seconds(Clock::now() - prepared);
    return std::move(out_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

  LawTable laws_at_theta(const std::vector<double>& theta) const {
    LawTable laws = scene_.laws;
    for (std::size_t i = 0; i < free_.size(); ++i)
      multiply(laws, free_[i], std::exp(theta[i] - std::log(free_[i].value)));
    return laws;
  }

  /// Residuals of the measurements, then of the priors.
  void evaluate(Specimens& specimens, const std::vector<double>& theta, std::vector<double>& residuals,
                std::vector<double>& jacobian) {
    ++out_.evaluations;
    predicted_ = specimens.at(laws_at_theta(theta), free_);
    residuals.clear(), jacobian.clear();
    add_residuals(data_, options_, predicted_, residuals, jacobian);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const FreeParameter& p = options_.free[i];
      if (!p.prior) continue;
      residuals.push_back((theta[i] - std::log(*p.prior)) / p.prior_deviation);
      for (std::size_t k = 0; k < free_.size(); ++k) jacobian.push_back(k == i ? 1 / p.prior_deviation : 0);
    }
  }

  void find(Specimens& specimens) {
    std::vector<Bounds> bounds;
    theta_.clear();
    for (const CalibratedParameter& p : out_.parameters) {
      bounds.push_back({std::log(p.low), std::log(p.high)});
      theta_.push_back(std::clamp(std::log(p.start), bounds.back().low, bounds.back().high));
    }
    std::exception_ptr failure, stopped;
    bool any = false;
    const Residuals residuals = [&](const std::vector<double>& theta, std::vector<double>& r, std::vector<double>& j) {
      if (stopped) return false;
      try {
        evaluate(specimens, theta, r, j);
        any = true;
        const auto finite = [](double v) { return std::isfinite(v); };
        return std::all_of(r.begin(), r.end(), finite) && std::all_of(j.begin(), j.end(), finite);
      } catch (const InterruptedError&) { stopped = std::current_exception(); } catch (const InputError&) {
        stopped = std::current_exception();
      } catch (const RunError&) {  // laws of a trial that have no solution: a shorter step is tried
        failure = std::current_exception();
      }
      return false;
    };
    const std::size_t count = static_cast<std::size_t>(residuals_each(options_.misfit)) * data_.points.size() + priors_;
    const bool usable = minimise(residuals, count, bounds, theta_);
    if (stopped) {
      try {
        std::rethrow_exception(stopped);
      } catch (const InterruptedError&) {
        throw InterruptedError("interrupted while calibrating; nothing was written, what the folder held is as it was");
      }
    }
    if (!any && failure) std::rethrow_exception(failure);
    if (!usable)
      throw RunError("calibration: no way to a least misfit was found: no finite one near the scene's values");
  }

  void finish(Specimens& specimens) {
    std::vector<double> residuals, jacobian;
    evaluate(specimens, theta_, residuals, jacobian);
    out_.laws = laws_at_theta(theta_);
    const std::size_t n = free_.size(), measured = residuals.size() - priors_;
    for (std::size_t i = 0; i < measured; ++i) out_.misfit += residuals[i] * residuals[i];
    out_.degrees_of_freedom = static_cast<double>(residuals.size()) - static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
      CalibratedParameter& p = out_.parameters[i];
      p.value = std::exp(theta_[i]);
      const double near = 1e-6 * std::log(p.high / p.low);
      p.at_bound = theta_[i] < std::log(p.low) + near || theta_[i] > std::log(p.high) - near;
    }
    compare();
    const auto split = jacobian.begin() + static_cast<std::ptrdiff_t>(measured * n);
    add_statistics(out_, {jacobian.begin(), split}, {split, jacobian.end()});
    judge();
    warn();
  }

  /// Measured against predicted.
  void compare() {
    const std::vector<std::optional<double>> temperatures = temperatures_of(scene_, data_);
    FitErrors& e = out_.errors;
    for (std::size_t i = 0; i < predicted_.size(); ++i) {
      const ModulusPoint& m = data_.points[i];
      CalibratedPoint p{m,
                        temperatures[i],
                        std::abs(predicted_[i].modulus),
                        std::arg(predicted_[i].modulus) * 180 / std::numbers::pi,
                        predicted_[i].e_star_scatter,
                        predicted_[i].phase_scatter_deg};
      const double modulus = p.e_star_pa / m.e_star_pa - 1, phase = p.phase_deg - m.phase_deg;
      e.e_star_rms += modulus * modulus, e.phase_rms_deg += phase * phase;
      e.e_star_largest = std::max(e.e_star_largest, std::abs(modulus));
      e.phase_largest_deg = std::max(e.phase_largest_deg, std::abs(phase));
      out_.points.push_back(p);
    }
    e.e_star_rms = std::sqrt(e.e_star_rms / static_cast<double>(predicted_.size()));
    e.phase_rms_deg = std::sqrt(e.phase_rms_deg / static_cast<double>(predicted_.size()));
  }

  /// What was found must be near the targets, and nearest for another reason than that the way ended there.
  void judge() {
    const FitErrors& e = out_.errors;
    std::vector<std::string> ends;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const CalibratedParameter& p = out_.parameters[i];
      const FreeParameter& asked = options_.free[i];
      const bool lower = p.value * p.value < p.low * p.high;
      if (p.at_bound && !(lower ? asked.low : asked.high))
        ends.push_back(fmt::format("{} ran to {:.3g}, four decades from the scene's {:.3g}", p.name, p.value, p.start));
    }
    const bool modulus = options_.misfit != Misfit::phase && e.e_star_rms > worst_modulus;
    const bool phase = options_.misfit != Misfit::modulus && e.phase_rms_deg > worst_phase;
    if (ends.empty() && !modulus && !phase) return;
    std::string what =
        fmt::format("|E*| is missed by {:.3g} % (rms), phase by {:.3g} degrees", 100 * e.e_star_rms, e.phase_rms_deg);
    for (const std::string& end : ends) what += "; " + end;
    if (!options_.nearest) {
      throw RunError(data_.source + ": the targets are not reached by any values of the free parameters: " + what +
                     "; bounds that stop a parameter, or other free parameters, may mend it");
    }
    out_.warnings.push_back("the targets are not reached: " + what);
  }

  void warn() {
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const CalibratedParameter& p = out_.parameters[i];
      if (p.at_bound)
        out_.warnings.push_back(fmt::format("{} lies at a bound, {:.4g}: its deviation means little", p.name, p.value));
    }
    for (const Combination& c : out_.combinations) {
      out_.warnings.push_back(fmt::format("the measurements {} {}",
                                          std::isfinite(c.deviation) ? "hardly determine" : "say nothing of",
                                          words(out_, c)));
    }
    if (!out_.deviations && out_.degrees_of_freedom <= 0) {
      out_.warnings.push_back(
          "as many parameters as numbers measured: deviations are those that were assumed, " +
          fmt::format("{:.3g} % and {:.3g} degrees", 100 * options_.e_star_deviation, options_.phase_deviation));
    }
    if (scene_.solver.method == SolverMethod::explicit_ && scene_.solver.damping_kind == Damping::local) {
      out_.warnings.push_back("local damping of the scene has no part in the frequency domain");
    }
  }

  const Scene& scene_;
  const ModulusData& data_;
  const CalibrationOptions& options_;
  const Watcher& watcher_;
  Calibration out_;
  std::vector<Parameter> free_;
  std::size_t priors_ = 0;
  std::vector<double> theta_;  ///< logarithms of the free parameters
  std::vector<Predicted> predicted_;
};

}  // namespace
}  // namespace calibration

Calibration calibrate(const Scene& scene, const ModulusData& data, const CalibrationOptions& options,
                      const Watcher& watcher) {
  return calibration::Calibrator(scene, data, options, watcher).calibrate();
}

}  // namespace macadam
