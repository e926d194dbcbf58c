// SPDX-License-Identifier: GPL-3.0-or-later
// semicircular_bending.cpp  Implements kind "semicircular_bending": a roller moves down at a constant rate and bends a
// half disc on two other rollers until it fails.
#include "host/experiments/transient/constant_approach.hpp"

namespace macadam {

using experiments::SemicircularBending;

TransientExperiment load_test(const SemicircularBending& spec) {
  return constant_approach(spec.kind, spec.times, spec.rate, spec.radius,
                           "half disc on two rollers; strain: displacement of the upper roller over the radius; "
                           "stress: load over the section at half of the height");
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<SemicircularBending>::plan(
    const SemicircularBending& spec, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
    std::optional<Resumed> resumed, RunResult& result) {
  return plan_on_rollers(load_test(spec), domains::HalfDisc::name, scene, prepared, watcher, std::move(resumed),
                         result);
}

template <>
std::vector<std::string> ExperimentOf<SemicircularBending>::files(const SemicircularBending& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
