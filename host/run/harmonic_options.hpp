// SPDX-License-Identifier: GPL-3.0-or-later
/// \file harmonic_options.hpp  Makes the options with which any experiment solves linear systems in the frequency
/// domain.
#pragma once

#include <functional>
#include <vector>

#include "macadam/harmonic.hpp"
#include "macadam/scene.hpp"

namespace macadam {

/// Returns the options for a scene's linear systems. With backend reference the systems are solved on the CPU.
HarmonicOptions harmonic_options(const Scene& scene, Backend backend, const std::function<bool()>& stop,
                                 double residual = HarmonicOptions{}.tolerance);

/// Returns the geometric mean. A preconditioner that is made for the mean of several frequencies serves all of them
/// best; for a relaxation spectrum the mean is the middle of its range.
double geometric_mean(const std::vector<double>& values);

/// Returns the density scaling that the scene gives for a frequency; 1 if it gives none.
double density_scaling_of(const SolverSpec& solver, std::size_t frequency);

}  // namespace macadam
