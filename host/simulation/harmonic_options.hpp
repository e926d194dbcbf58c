// SPDX-License-Identifier: GPL-3.0-or-later
/// \file harmonic_options.hpp  How the linear systems of any test are solved.
#pragma once

#include <functional>
#include <vector>

#include "macadam/harmonic.hpp"
#include "macadam/scene.hpp"

namespace macadam {

/// How a scene's linear systems are solved; beside backend reference, on the CPU.
HarmonicOptions harmonic_options(const Scene& scene, Backend backend, const std::function<bool()>& stop,
                                 double residual = HarmonicOptions{}.tolerance);

/// The frequency at which factors serve all of these best: halfway for a relaxation spectrum.
double geometric_mean(const std::vector<double>& values);

/// Density scaling that the scene gives for a frequency; 1 where it gives none.
double density_scaling_of(const SolverSpec& solver, std::size_t frequency);

}  // namespace macadam
