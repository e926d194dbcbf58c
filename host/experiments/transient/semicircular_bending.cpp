// SPDX-License-Identifier: GPL-3.0-or-later
// semicircular_bending.cpp  Implements kind "semicircular_bending": a roller moves down at a constant rate and bends a
// half disc on two other rollers until it fails.
#include "host/experiments/transient/constant_approach.hpp"
#include "macadam/error.hpp"

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
  // a specimen that the caller has made may have another domain than the scene
  const Domain& domain = prepared.specimen.box;
  if (domain.name() != std::string(domains::HalfDisc::name) || !domain.rollers())
    throw InputError(scene.file.string(), 0, "domain of the specimen with kind \"semicircular_bending\"",
                     std::string("a ") + domain.name() + (domain.rollers() ? "" : " without rollers"),
                     "the half disc of the scene");
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<SemicircularBending>::files(const SemicircularBending& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
