// SPDX-License-Identifier: GPL-3.0-or-later
// choose_chain.cpp  Fits chains of every length. The fit of a chain starts from several points: its usual starting
// values, and the fitted smaller chains that are special cases of it.
#include "host/tools/fit/choose_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "host/tools/fit/criterion.hpp"
#include "host/tools/fit/shift_start.hpp"
#include "macadam/error.hpp"

namespace macadam::fitting {
namespace {

/// Chains by (number of units, whether there is a dashpot).
using Chains = std::map<std::pair<int, bool>, Chain>;

/// Fits chains of increasing length, with and without a dashpot.
class ChainSeries {
 public:
  ChainSeries(const Problem& problem, const FitOptions& options, bool deviations)
      : problem_(problem),
        options_(options),
        deviations_(deviations),
        shift_(start_shift(problem.unknowns, problem.targets, problem.temperatures)) {}

  /// Fits all chains up to the length at which the criterion has risen twice in a row. `known` holds chains that were
  /// fitted with simpler shift laws and converted to the shift law of this series. A chain also starts from the known
  /// chains of the same length, and the series continues while a longer known chain has a smaller criterion.
  Chains fit(const std::vector<Chains>& known) {
    const int longest = options_.units.value_or(options_.most_units);
    for (int units = 0; units <= longest; ++units)
      for (const bool flow : {false, true}) fit_one(units, flow, known);
    return std::move(chains_);
  }

  /// Returns the criterion of a fitted chain; less is better.
  double criterion_of(const Chain& chain) const {
    return criterion(options_.criterion, chain.minimum.misfit, 2 * problem_.targets.size(), chain.unknowns.count(),
                     deviations_);
  }

  /// Returns why a chain could not be fitted; empty if all could.
  const std::string& failure() const { return failure_; }

 private:
  /// Progress of one series: the smallest criterion so far, and how many chains in a row have not improved it.
  struct Course {
    double best = std::numeric_limits<double>::infinity();
    int worse = 0;
  };

  /// Returns whether a known chain of at least `units` units, converted to the shift law of this series, has a smaller
  /// criterion than `best`.
  bool is_longer_one_better(int units, bool flow, const std::vector<Chains>& known, double best) const {
    for (const Chains& chains : known) {
      for (const auto& [of, chain] : chains)
        if (of.first >= units && of.second == flow && criterion_of(chain) < best) return true;
    }
    return false;
  }

  /// Fits one chain, unless its series has ended or the measurements are too few.
  void fit_one(int units, bool flow, const std::vector<Chains>& known) {
    Course& course = courses_[flow];
    if (!options_.units && course.worse >= 2 && !is_longer_one_better(units, flow, known, course.best)) return;
    Unknowns u = problem_.unknowns;
    u.units = units;
    u.flow = flow;
    if (!enough(2 * problem_.targets.size(), u.count(), options_.criterion)) return;
    std::vector<const Chain*> starts;
    const auto add = [&](const Chains& chains, int of_units, bool of_flow) {
      if (const auto found = chains.find({of_units, of_flow}); found != chains.end()) starts.push_back(&found->second);
    };
    add(chains_, units - 1, flow);
    // a chain with a dashpot is close to a chain with one more unit, whose retardation time is long
    add(chains_, flow ? units : units - 1, !flow);
    for (const Chains& chains : known) add(chains, units, flow);
    const auto limits = joined(chain_limits(u, problem_.targets, shift_), shift_limits(u, problem_.temperatures));
    Chain chain{u, {}};
    try {
      chain.minimum = fit_chain(u, problem_.targets, limits, shift_, starts);
    } catch (const RunError& error) {  // the other chains are fitted nevertheless
      failure_ = error.what();
      return;
    }
    const double value = criterion_of(chain);
    course.worse = value < course.best ? 0 : course.worse + 1;
    course.best = std::min(course.best, value);
    chains_.emplace(std::pair{units, flow}, std::move(chain));
  }

  const Problem& problem_;
  const FitOptions& options_;
  bool deviations_;
  std::vector<double> shift_;
  std::map<bool, Course> courses_;
  std::string failure_;
  Chains chains_;
};

/// Converts chains to the shift law of `problem`, which must contain their shift law.
Chains converted(Chains chains, const Problem& problem) {
  for (auto& [of, chain] : chains) {
    Minimum& minimum = chain.minimum;
    minimum.theta = convert_shift(chain.unknowns, minimum.theta, problem.unknowns.shift, problem.temperatures);
    chain.unknowns.shift = problem.unknowns.shift;
    minimum.misfit = misfit_at(chain.unknowns, problem.targets, minimum.theta);
  }
  return chains;
}

/// Fits chains with every shift law that the problem's shift law contains. The fits with a law also start from the
/// chains of all laws before it. Returns the chains converted to the problem's shift law.
std::vector<Chains> fit_contained_laws(const Problem& problem, const FitOptions& options, bool deviations) {
  std::vector<Chains> fitted;
  const auto converted_to = [&](const Problem& larger) {
    std::vector<Chains> out;
    for (const Chains& chains : fitted) out.push_back(converted(chains, larger));
    return out;
  };
  for (const ShiftKind kind : contained_shift_laws(problem)) {
    Problem law = problem;
    law.unknowns.shift = kind;
    Chains chains = ChainSeries(law, options, deviations).fit(converted_to(law));
    fitted.push_back(std::move(chains));
  }
  return converted_to(problem);
}

}  // namespace

Chain choose_chain(const Problem& problem, const ModulusData& data, Fit& fit) {
  const FitOptions& options = fit.options;
  ChainSeries series(problem, options, data.deviations);
  const Chains all = series.fit(fit_contained_laws(problem, options, data.deviations));
  std::vector<const Chain*> asked;
  for (const bool flow : {true, false}) {
    if (options.flow.value_or(flow) != flow) continue;
    for (const auto& [of, chain] : all) {
      if (of.second != flow || options.units.value_or(of.first) != of.first) continue;
      asked.push_back(&chain);
      fit.candidates.push_back({of.first, flow, static_cast<int>(chain.unknowns.count()), chain.minimum.misfit,
                                series.criterion_of(chain), chain.minimum.determined});
    }
  }
  if (asked.empty() && !series.failure().empty()) throw RunError(series.failure());
  if (asked.empty()) {
    throw InputError(data.source, 0, "measurements", fmt::format("{}", data.points.size()),
                     options.units
                         ? fmt::format("more measurements for {} Kelvin units and their shift", *options.units)
                         : "more, because these measurements do not determine even a chain without Kelvin units");
  }
  for (std::size_t i = 1; i < asked.size(); ++i) {
    const FitCandidate &at = fit.candidates[i], &taken = fit.candidates[fit.chosen];
    const bool better = at.determined == taken.determined ? at.criterion < taken.criterion : at.determined;
    if (better) fit.chosen = i;
  }
  if (!options.units && asked.size() > 1 && fit.candidates[fit.chosen].units == options.most_units) {
    fit.warnings.push_back(
        fmt::format("the criterion {} would choose more than {} Kelvin units; --most-units allows more",
                    to_string(options.criterion), options.most_units));
  }
  return *asked[fit.chosen];
}

}  // namespace macadam::fitting
