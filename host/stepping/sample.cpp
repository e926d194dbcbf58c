// SPDX-License-Identifier: GPL-3.0-or-later
// sample.cpp  Samples one run at even intervals and checks in each sample that it has not diverged.
#include <fmt/format.h>

#include <cmath>

#include "host/stepping/divergence.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

void require_convergence(const Sample& sample, const std::string& of) {
  const auto& [now, particle] = sample;
  if (particle < 0 && std::isfinite(now.top_force()) && std::isfinite(now.top_displacement())) return;
  const std::string what =
      particle >= 0
          ? fmt::format("particle {} moves more than its radius in one step, or its motion is not finite", particle)
          : "force or motion of the top wall is not finite";
  const std::string where = of.empty() ? fmt::format("step {}", now.step) : fmt::format("{}, step {}", of, now.step);
  throw DivergenceError(fmt::format("the time stepping diverged: {}, at t = {:.6g} s ({}); use a smaller "
                                    "time_step or safety",
                                    what, now.time, where),
                        particle, now.time);
}

void sample(Stepper& stepper, std::int64_t every, std::int64_t n, const std::function<void(const Observation&)>& f) {
  if (every < 1) throw InputError("sample: found every = " + std::to_string(every) + ", expected at least 1 step");
  f(stepper.observe());
  for (std::int64_t k = 0; k < n; ++k) {
    const Sample here = stepper.advance_sampled(every, 1).front();
    require_convergence(here, "");
    f(here.now);
  }
}

}  // namespace macadam
