// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grain_surfaces.hpp  From labels and grey values to measured surfaces, grain by grain.
#pragma once

#include "host/ct/isosurface.hpp"
#include "host/ct/phases.hpp"

namespace macadam::ct {

inline constexpr std::int64_t margin = 2;   ///< nodes around a grain
inline constexpr std::int64_t across = 32;  ///< nodes through a grain's middle side, or one a voxel where it has fewer

/// The box of a grain in voxels, low to high inclusive, and what was counted in it.
struct GrainBox {
  std::array<std::int64_t, 3> low{}, high{};
  std::int64_t voxels = 0;
  double confidence = 0;  ///< Σ of its voxels', 0 to 1 each
  bool border = false;
  std::int64_t middle_side() const {
    std::array<std::int64_t, 3> sides;
    for (std::size_t a = 0; a < 3; ++a) sides[a] = high[a] - low[a] + 1;
    std::sort(sides.begin(), sides.end());
    return sides[1];
  }
};
std::vector<GrainBox> boxes_of(const Image<std::uint32_t>& labels, const Image<std::uint8_t>& phases,
                               const Image<std::uint8_t>& confidence);

/// Closed surfaces of all grains, measured. A grain whose surface cannot be made is left out, with a warning. `sure`:
/// by grain, what its confidence is multiplied by; empty: nothing.
std::vector<ScannedGrain> surfaces_of(const Segmentation& scan, const Thresholds& thresholds,
                                      const std::vector<GrainBox>& boxes, const SegmentOptions& options,
                                      std::vector<std::string>& warnings, const std::vector<double>& sure = {});

/// Averages of three neighbours along each axis, weights 1, 2, 1: a face between labels loses its steps.
void even_out(Image<float>& field);

/// Nothing positive at the ends of a field: its surface is closed whatever lies there.
void close_ends(Image<float>& field);

/// The grain's surface of few facets, of more where the few cut each other or are farther away than `error` [m], mended
/// where those do as well.
Simplified fit_surface(const Surface& fine, const SegmentOptions& options, double error);

}  // namespace macadam::ct
