// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grain_surfaces.hpp  From labels and grey values to measured surfaces, grain by grain.
#pragma once

#include "host/ct/phases.hpp"

namespace macadam::ct {

/// The box of a grain in voxels, low to high inclusive, and what was counted in it.
struct GrainBox {
  std::array<std::int64_t, 3> low{}, high{};
  std::int64_t voxels = 0;
  double confidence = 0;  ///< Σ of its voxels', 0 to 1 each
  bool border = false;
};
std::vector<GrainBox> boxes_of(const Image<std::uint32_t>& labels, const Image<std::uint8_t>& phases,
                               const Image<std::uint8_t>& confidence);

/// Closed surfaces of all grains, measured. A grain whose surface cannot be made is left out, with a warning. `sure`:
/// by grain, what its confidence is multiplied by; empty: nothing.
std::vector<ScannedGrain> surfaces_of(const Segmentation& scan, const Thresholds& thresholds,
                                      const std::vector<GrainBox>& boxes, const SegmentOptions& options,
                                      std::vector<std::string>& warnings, const std::vector<double>& sure = {});

}  // namespace macadam::ct
