// SPDX-License-Identifier: GPL-3.0-or-later
// relaxation.cpp  Implements kind "relaxation": the stress under a constant strain.
#include <algorithm>
#include <cmath>

#include "host/experiments/transient/transient_experiment.hpp"
#include "macadam/drives/ramp.hpp"

namespace macadam {

using experiments::Relaxation;
using experiments::ResponsePoint;

TransientExperiment load_test(const Relaxation& spec) {
  TransientExperiment out;
  out.kind = spec.kind;
  out.history = {spec.times, {{0, spec.ramp}}};
  out.poisson_ratio = spec.poisson_ratio;
  out.temperature = spec.temperature;
  out.load = {{"strain", spec.strain}, {"ramp_s", spec.ramp}};
  out.when.ramp = spec.ramp;
  out.strain = spec.strain;
  out.unstepped = [spec](const Spectrum& spectrum, double t, const LoadTimes& when) -> ResponsePoint {
    const PronySeries& series = spectrum.relaxation;
    const double grown = when.ramp > 0 ? std::min(1.0, t / when.ramp) : 1;
    return {t, spec.strain * grown, spec.strain * series.after_ramp(t, when.ramp), series.modulus(t)};
  };
  out.drive = [spec](double unit, double dt, double ramp) {
    return std::make_shared<drives::Ramp>(unit * spec.strain, dt, std::llround(ramp / dt));
  };
  return out;
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Relaxation>::plan(const Relaxation& spec, const Scene& scene,
                                                                  const Preparation& prepared, const Watcher& watcher,
                                                                  std::optional<Resumed> resumed, RunResult& result) {
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<Relaxation>::files(const Relaxation& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
