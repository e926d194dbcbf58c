// SPDX-License-Identifier: GPL-3.0-or-later
// constant_approach.cpp  Describes the load of a test in which the walls approach each other at a constant rate.
#include "host/experiments/transient/constant_approach.hpp"

#include "macadam/drives/constant_rate.hpp"

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

}  // namespace macadam
