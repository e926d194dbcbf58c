// SPDX-License-Identifier: GPL-3.0-or-later
// increment_words.cpp  Sums up a run by increments.
#include "host/run/increment_words.hpp"

#include <fmt/format.h>

namespace macadam {

experiments::Increments increments_found(const QuasiStaticStepper& stepper) {
  const quasi_static::CourseReport& report = stepper.report();
  experiments::Increments out;
  out.increments = report.increments, out.rejected = report.rejected, out.systems = report.passes;
  out.error = report.error, out.residual = report.residual;
  out.loose = report.loose, out.by_opening = report.by_opening;
  out.imbalance = stepper.energies().imbalance();
  out.increment_error = stepper.energies().increment_error();
  if (report.unstable)
    out.unstable = experiments::Peak{report.unstable->time_s, report.unstable->strain, report.unstable->stress_pa};
  if (report.first_drop)
    out.first_drop =
        experiments::Peak{report.first_drop->time_s, report.first_drop->strain, report.first_drop->stress_pa};
  out.drops = report.drops, out.drop_energy_j = stepper.energies().damping_j;
  return out;
}

std::vector<std::string> increment_warnings(const QuasiStaticStepper& stepper) {
  const quasi_static::CourseReport& report = stepper.report();
  const double lost_j = stepper.energies().damping_j;
  std::vector<std::string> warnings;
  if (report.unstable) {
    warnings.push_back(fmt::format(
        "after t = {:.6g} s (strain {:.6g}, {:.4g} MPa) no equilibrium was found at a larger displacement of the "
        "wall; {} increments were controlled by the opening of cracks, so that the strain may decrease in them. In a "
        "test that prescribes the strain, the stress drops suddenly at this strain",
        report.unstable->time_s, report.unstable->strain, report.unstable->stress_pa / 1e6, report.by_opening));
  }
  if (report.first_drop) {
    warnings.push_back(fmt::format(
        "sudden drops of the stress: {}, the first after t = {:.6g} s (strain {:.6g}, {:.4g} MPa), because no "
        "equilibrium was near; the cracks moved against a drag until the specimen was in equilibrium again, which took "
        "{:.3g} J. Which cracks grow in a drop may depend on the drag; method = \"explicit\" in [solver] "
        "includes inertia",
        report.drops, report.first_drop->time_s, report.first_drop->strain, report.first_drop->stress_pa / 1e6,
        lost_j));
  }
  if (report.loose > 0) {
    warnings.push_back(fmt::format(
        "up to {} particles had no stiffness, because all their contacts had separated; they were held in place",
        report.loose));
  }
  return warnings;
}

}  // namespace macadam
