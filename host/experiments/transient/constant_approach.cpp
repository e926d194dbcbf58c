// SPDX-License-Identifier: GPL-3.0-or-later
// constant_approach.cpp  Describes the load of a test in which the walls approach each other at a constant rate, and
// plans such a test of a specimen on rollers.
#include "host/experiments/transient/constant_approach.hpp"

#include "macadam/drives/constant_rate.hpp"
#include "macadam/error.hpp"

namespace macadam {

TransientExperiment constant_approach(const char* kind, const std::vector<double>& times, double rate, double length,
                                      const char* rows) {
  const double end = times.back(), strain_rate = -rate / length;
  TransientExperiment out;
  out.kind = kind;
  out.history = {times, {{0, end}}};
  out.load = {{"rate_m_s", rate}};
  out.grows = true;
  out.strain = strain_rate * end;
  out.rows = rows;
  out.drive = [strain_rate, end](double unit, double dt, double) {
    return std::make_shared<drives::ConstantRate>(unit * strain_rate, dt, end);
  };
  return out;
}

std::unique_ptr<PlannedExperiment> plan_on_rollers(const TransientExperiment& test, const std::string& domain,
                                                   const Scene& scene, const Preparation& prepared,
                                                   const Watcher& watcher, std::optional<Resumed> resumed,
                                                   RunResult& result) {
  // a specimen that the caller has made may have another domain than the scene
  const Domain& found = prepared.specimen.box;
  if (found.name() != domain || !found.rollers())
    throw InputError(scene.file.string(), 0, "domain of the specimen with kind \"" + test.kind + "\"",
                     std::string("a ") + found.name() + (found.rollers() ? "" : " without rollers"),
                     "the " + domain + " of the scene");
  return plan_load_test(test, scene, prepared, watcher, std::move(resumed), result);
}

}  // namespace macadam
