// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rock_fractions.hpp  Computes the volume fraction of rock in each voxel of a specimen.
#pragma once

#include <numeric>
#include <string>

#include "bench/continuum/grid.hpp"

namespace continuum {

/// Volume fraction of rock in each voxel; the rest is mastic.
struct RockFractions {
  Size size;
  std::vector<float> fraction;
  double mean() const { return std::accumulate(fraction.begin(), fraction.end(), 0.0) / double(fraction.size()); }
};

/// Return the volume fractions of rock for balls, for the cells of a specimen file, and for two layers normal to an
/// axis. Voxels that a surface may cut are sampled at 6 × 6 × 6 points. `box`: edges [m]; `voxel`: edge [m]. \throws
/// std::runtime_error for files that cannot be read, and for boxes whose edges are not multiples of the voxel to 1e-6.
/// @{
RockFractions of_balls(const std::string& file, const std::vector<double>& box, double voxel);
RockFractions of_cells(const std::string& file, const std::vector<double>& box, double voxel);
RockFractions of_layers(int axis, const std::vector<double>& box, double voxel);
/// @}

}  // namespace continuum
