// SPDX-License-Identifier: GPL-3.0-or-later
// choose_precision.cpp  Chooses the lowest precision whose estimated rounding error is a small part of the tolerance. A
// precision is chosen only if the run is within the range in which its rounding error was measured.
#include "host/experiments/cyclic/choose_precision.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/run/error_model.hpp"

namespace macadam {
namespace {

constexpr double precision_share = 0.05;  ///< the fraction of the tolerance that rounding errors may reach

}  // namespace

void choose_precision(const Scene& scene, const Preparation& prepared, Plan& plan) {
  const bool reference = scene.solver.backend == Backend::reference;
  if (scene.solver.precision || !scene.solver.tolerance || reference) {
    plan.precision = scene.solver.precision.value_or(Precision::double_);
    return;
  }
  const auto decide = [&]<class... Args>(fmt::format_string<Args...> text, Args&&... args) {
    plan.decisions.push_back(fmt::format(text, std::forward<Args>(args)...));
  };
  double single = 0, mixed = 0;
  std::string beyond_single, beyond_mixed;
  for (std::size_t i = 0; i < plan.frequencies.size(); ++i) {
    const FrequencyPlan& f = plan.frequencies[i];
    const RoundingScale scale = rounding_scale(scene, prepared, scene.cyclic().frequencies[i],
                                               f.cycles * f.loading.steps_per_period, f.density_scaling);
    single = std::max(single, single_precision_error(scale));
    mixed = std::max(mixed, mixed_precision_error(scale));
    if (beyond_single.empty()) beyond_single = beyond(scale, single_measured);
    if (beyond_mixed.empty()) beyond_mixed = beyond(scale, mixed_measured);
  }
  const double share = precision_share * *scene.solver.tolerance;
  plan.precision = single <= share && beyond_single.empty() ? Precision::single
                   : mixed <= share && beyond_mixed.empty() ? Precision::mixed
                                                            : Precision::double_;
  decide(
      "precision {}: the estimated error from rounding is {:.1e} in single and {:.1e} in mixed precision, and {:.1e} "
      "is allowed; these are estimates, not bounds: the largest errors measured so far are {:.1e} in single precision "
      "(up to {:.1e} steps) and {:.1e} in mixed precision (up to {:.1e} steps)",
      to_string(plan.precision), single, mixed, share, single_measured.largest,
      static_cast<double>(single_measured.up_to.steps), mixed_measured.largest,
      static_cast<double>(mixed_measured.up_to.steps));
  if (!beyond_single.empty())
    decide("single precision is not used, because its error was never measured for {}", beyond_single);
  if (!beyond_mixed.empty())
    decide("mixed precision is not used, because its error was never measured for {}", beyond_mixed);
}

}  // namespace macadam
