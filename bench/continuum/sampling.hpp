// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sampling.hpp  Computes the fractions of rock and voids in voxels from bodies, Laguerre cells and layers.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/tools/ct/continuum/phase_fractions.hpp"

namespace macadam::continuum {

using Point = std::array<double, 3>;  ///< [m]

/// Returns mastic without rock and voids. `box`: edges [m]; `voxel`: edge [m]. \throws std::runtime_error for edges of
/// the box that are not multiples of the voxel to 1e-6.
PhaseFractions mastic_in(const Point& box, double voxel);

/// A body of rock or a void, as the parts of vertical lines that lie in it.
struct Body {
  Point low, high;  ///< corners of a box around it [m]
  /// Returns the sorted heights [m] at which the vertical line through (x, y) enters and leaves the body, in turn.
  std::function<std::vector<double>(double x, double y)> crossings;
};

/// Sets the fractions of bodies of rock and of voids. Each voxel has 8 × 8 vertical lines, along which lengths are
/// exact. Volume in several bodies counts once; volume in a void is void.
void place_bodies(PhaseFractions& to, double voxel, const std::vector<Body>& rock, const std::vector<Body>& voids);

/// Returns the bodies of a file of balls: columns x,y,z,radius [m]. \throws std::runtime_error naming the line.
std::vector<Body> read_balls(const std::string& file);

/// Returns the bodies of a file of aggregates: columns body,shape,size,x,y,z,qw,qx,qy,qz in any order; other columns
/// are ignored. A shape is the name of a file in the folder `library`, without its ending. It is centred at the
/// centroid of its volume, scaled so that its intermediate dimension is `size` [m], rotated by the quaternion, and
/// moved to x,y,z [m]. The shape `sphere` has the diameter `size` and needs no quaternion. \throws std::runtime_error
/// naming the line.
std::vector<Body> read_aggregates(const std::string& file, const std::string& library);

/// Returns the fractions of the Laguerre cells of a specimen file: each cell has the phase of its sphere. Cut voxels
/// are sampled at 6 × 6 × 6 points. \throws std::runtime_error as mastic_in(), and for files that cannot be read.
PhaseFractions of_cells(const std::string& file, const Point& box, double voxel);

/// Returns a layer of mastic and a layer of rock, both normal to an axis; the rock has the larger coordinates.
PhaseFractions of_layers(int axis, const Point& box, double voxel);

}  // namespace macadam::continuum
