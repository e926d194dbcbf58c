// SPDX-License-Identifier: GPL-3.0-or-later
/// \file connection.hpp  Finds the voxels that connect both platens through faces of voxels with material.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/tools/ct/continuum/grid.hpp"

namespace macadam::continuum {

/// Which voxels are connected with the platens.
struct Connection {
  enum : unsigned char { solid = 1, bottom = 2, top = 4 };
  std::vector<unsigned char> marks;  ///< [voxel]; `solid`: has material; `bottom`, `top`: connected with this platen
  std::size_t count = 0;             ///< voxels with material
  std::size_t of_bottom = 0, of_top = 0, of_both = 0;  ///< voxels connected with a platen, and with both
  int highest = 0;                                     ///< layers from the bottom that `of_bottom` reaches
  int lowest = 0;                                      ///< layers from the bottom below `of_top`

  bool spans(std::size_t voxel) const { return marks[voxel] == (solid | bottom | top); }
  /// Describes which part of the material is connected with which platen. `edge`: edge of a voxel [m].
  std::string words(double edge) const;
};

/// Returns the connections of voxels. `marks`: Connection::solid for voxels with material, else 0.
Connection find_connection(const Size& size, std::vector<unsigned char> marks);

}  // namespace macadam::continuum
