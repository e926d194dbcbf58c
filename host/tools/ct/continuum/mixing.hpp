// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mixing.hpp  Mixes the constants of the phases in voxels that a surface cuts.
#pragma once

#include <cmath>
#include <numbers>

#include "host/tools/ct/continuum/phase_fractions.hpp"

namespace macadam::continuum {

/// A phase: a modulus [Pa] with a phase angle [degrees], and Poisson's ratio.
struct Material {
  double modulus = 0, phase = 0, poisson = 0;
  Complex young() const { return std::polar(modulus, phase * std::numbers::pi / 180); }
  Complex mu() const { return young() / (2 * (1 + poisson)); }
  Complex bulk() const { return young() / (3 * (1 - 2 * poisson)); }
};

/// Voxels with less material than this are empty: a smaller modulus changes no result and slows the solver down.
constexpr double least_material = 1e-3;

/// How a voxel with several phases is mixed. `stiff`: bulk and shear modulus are averages of the phases. `soft`: their
/// inverses are averages over rock and mastic; a void fraction v multiplies the result by (1 − v)/(1 + v), because
/// the average with the infinite inverse of a void would remove every voxel that a void touches.
enum class Mixing { stiff, soft };

/// Returns the grid of a specimen, with moduli divided by the mastic's modulus. Columns without material are added at
/// the sides until coarser grids fit, and pieces that do not connect both platens are removed.
///
/// \throws InputError if no material connects the platens.
Grid<double> grid_of(const PhaseFractions& of, const Material& mastic, const Material& rock, Mixing mixing);

}  // namespace macadam::continuum
