// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic_options.cpp  Makes the options of the frequency domain from `[solver]`.
#include "host/run/harmonic_options.hpp"

#include <cmath>

namespace macadam {

HarmonicOptions harmonic_options(const Scene& scene, Backend backend, const std::function<bool()>& stop,
                                 double residual) {
  HarmonicOptions out;
  out.tolerance = residual;
  out.linear = scene.solver.linear;
  out.backend = backend == Backend::cuda ? Backend::cuda : Backend::cpu;
  if (out.backend == Backend::cuda) out.devices = scene.solver.devices;
  out.stop = stop;
  return out;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

double density_scaling_of(const SolverSpec& solver, std::size_t frequency) {
  if (!solver.density_scaling) return 1;
  return (*solver.density_scaling)[solver.density_scaling->size() == 1 ? 0 : frequency];
}

}  // namespace macadam
