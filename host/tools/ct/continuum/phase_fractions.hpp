// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phase_fractions.hpp  Defines the volume fractions of rock and voids in each voxel of a specimen.
#pragma once

#include <vector>

#include "host/tools/ct/continuum/grid.hpp"

namespace macadam::continuum {

/// Volume fractions of rock and of voids in each voxel; the remainder is mastic.
struct PhaseFractions {
  Size size;
  std::vector<float> rock, voids;  ///< [voxel]; `voids` includes the volume outside the specimen
  double area = 0;                 ///< mean cross-section of the specimen, in faces of voxels

  /// Returns the fraction of a phase in the volume of the specimen.
  double mean_rock() const;
  double mean_voids() const;
  /// Returns whether a voxel holds more than one phase. If none does, all mixing rules give the same moduli.
  bool has_mixed_voxels() const;
};

}  // namespace macadam::continuum
