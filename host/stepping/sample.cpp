// SPDX-License-Identifier: GPL-3.0-or-later
// sample.cpp  Observations at even distances of a run.
#include <fmt/format.h>

#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

void sample(Stepper& stepper, std::int64_t every, std::int64_t n, const std::function<void(const Observation&)>& f) {
  if (every < 1) throw InputError("sample: found every = " + std::to_string(every) + ", expected at least 1 step");
  f(stepper.observe());
  for (std::int64_t k = 0; k < n; ++k) {
    stepper.advance(every);
    const Observation now = stepper.observe();
    if (const std::int64_t particle = stepper.first_divergent(); particle >= 0) {
      throw DivergenceError(
          fmt::format("the time stepping diverged: particle {} moves more than its radius in a step, or "
                      "not finitely, at t = {:.6g} s (step {}); use a smaller time step",
                      particle, now.time, now.step),
          particle, now.time);
    }
    f(now);
  }
}

}  // namespace macadam
