// SPDX-License-Identifier: GPL-3.0-or-later
// plan.cpp  The cyclic test without stepping: its steady states.
#include "host/experiments/experiment.hpp"

namespace macadam {

template <>
std::unique_ptr<Solution> ExperimentOf<experiments::Cyclic>::plan(const experiments::Cyclic&, const Scene& scene,
                                                                  const Preparation& prepared, const Watcher& watcher,
                                                                  RunResult& result) {
  return plan_harmonic(scene, prepared, watcher, result);
}

}  // namespace macadam
