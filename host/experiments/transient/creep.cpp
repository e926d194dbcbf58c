// SPDX-License-Identifier: GPL-3.0-or-later
// creep.cpp  Implements kind "creep": the strain under a constant stress, and after the stress has been removed.
#include <algorithm>
#include <cmath>

#include "host/experiments/transient/transient_experiment.hpp"
#include "macadam/drives/ramp.hpp"

namespace macadam {

using experiments::Creep;
using experiments::ResponsePoint;

namespace {

/// Returns the fraction of the held stress that acts at time t.
double loaded(const LoadTimes& when, double t) {
  const auto grown = [&](double since) { return since < 0 ? 0 : when.ramp > 0 ? std::min(1.0, since / when.ramp) : 1; };
  return grown(t) - (when.release ? grown(t - *when.release) : 0);
}

}  // namespace

TransientExperiment load_test(const Creep& spec) {
  TransientExperiment out;
  out.kind = spec.kind;
  out.history = {spec.times, {{0, spec.ramp}}};
  if (spec.release) out.history.ramps.push_back({*spec.release, spec.ramp});
  out.poisson_ratio = spec.poisson_ratio;
  out.temperature = spec.temperature;
  out.load = {{"stress_pa", spec.stress}, {"ramp_s", spec.ramp}, {"release_s", spec.release}};
  out.by_stress = true;
  out.when = {spec.ramp, spec.release};
  out.held_stress = spec.stress;
  out.platen_mass = spec.platen_mass;
  out.unstepped = [spec](const Spectrum& spectrum, double t, const LoadTimes& when) -> ResponsePoint {
    const CreepSeries& series = spectrum.creep;
    double strain = series.after_ramp(t, when.ramp);
    if (when.release) strain -= series.after_ramp(t - *when.release, when.ramp);
    return {t, spec.stress * strain, spec.stress * loaded(when, t) + 0.0, series.compliance(t)};
  };
  out.drive = [spec](double unit, double dt, double ramp) {
    const std::int64_t rise = std::llround(ramp / dt);
    const std::int64_t hold = spec.release ? std::llround(*spec.release / dt) - rise : drives::Ramp::forever;
    return std::make_shared<drives::Ramp>(unit * spec.stress, dt, rise, hold);
  };
  return out;
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Creep>::plan(const Creep& spec, const Scene& scene,
                                                             const Preparation& prepared, const Watcher& watcher,
                                                             std::optional<Resumed> resumed, RunResult& result) {
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

template <>
std::vector<std::string> ExperimentOf<Creep>::files(const Creep& spec, const Scene& scene) {
  return load_files(spec.kind, scene);
}

}  // namespace macadam
