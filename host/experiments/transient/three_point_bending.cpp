// SPDX-License-Identifier: GPL-3.0-or-later
// three_point_bending.cpp  Implements kind "three_point_bending": a roller moves down at a constant rate and bends a
// beam on two other rollers until it fails.
#include "host/experiments/transient/constant_approach.hpp"

namespace macadam {

using experiments::ThreePointBending;

TransientExperiment load_test(const ThreePointBending& spec) {
  return constant_approach(
      spec.kind, spec.times, spec.rate, spec.height,
      "beam on two rollers; strain: displacement of the upper roller over the height; stress: load "
      "over the horizontal section");
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<ThreePointBending>::plan(
    const ThreePointBending& spec, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
    std::optional<Resumed> resumed, RunResult& result) {
  return plan_on_rollers(load_test(spec), domains::Beam::name, scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<ThreePointBending>::files(const ThreePointBending& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
