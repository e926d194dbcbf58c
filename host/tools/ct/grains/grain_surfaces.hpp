// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grain_surfaces.hpp  Makes a measured surface for each grain from labels and grey values.
#pragma once

#include "host/tools/ct/grains/isosurface.hpp"
#include "host/tools/ct/voxels/phases.hpp"

namespace macadam::ct {

inline constexpr std::int64_t margin = 2;   ///< extra nodes around a grain's box
inline constexpr std::int64_t across = 32;  ///< nodes along a grain's intermediate side; a grain with fewer voxels
                                            ///< there has one node per voxel

/// Bounding box of a grain in voxels, from low to high inclusive, and sums over its voxels.
struct GrainBox {
  std::array<std::int64_t, 3> low{}, high{};
  std::int64_t voxels = 0;
  double confidence = 0;  ///< sum of its voxels' confidence, 0 to 1 each
  /// whether the end of the scan or of the specimen cuts the grain
  bool border = false;
  /// Returns the intermediate side of the box [voxels].
  std::int64_t middle_side() const {
    std::array<std::int64_t, 3> sides;
    for (std::size_t a = 0; a < 3; ++a) sides[a] = high[a] - low[a] + 1;
    std::sort(sides.begin(), sides.end());
    return sides[1];
  }
};
/// Returns the box of each grain, by its number in the labels.
std::vector<GrainBox> boxes_of(const Image<std::uint32_t>& labels, const Image<std::uint8_t>& phases,
                               const Image<std::uint8_t>& confidence);

/// Returns the closed, measured surfaces of all grains. A grain whose surface cannot be made is left out, with a
/// warning. `sure` holds for each grain a factor for its confidence; if it is empty, the factor is 1.
std::vector<ScannedGrain> surfaces_of(const Segmentation& scan, const Thresholds& thresholds,
                                      const std::vector<GrainBox>& boxes, const SegmentOptions& options,
                                      std::vector<std::string>& warnings, const std::vector<double>& sure = {});

/// Replaces each value by the mean of three neighbours along each axis, with weights 1, 2, 1. This smooths the voxel
/// steps of faces between labels.
void even_out(Image<float>& field);

/// Makes the values at the ends of a field negative, so that its isosurface is closed.
void close_ends(Image<float>& field);

/// Returns the grain's surface with few facets. The surface gets more facets if it would intersect itself or be farther
/// than `error` [m] from the fine surface. If it still intersects itself, it is repaired.
Simplified fit_surface(const Surface& fine, const SegmentOptions& options, double error);

}  // namespace macadam::ct
