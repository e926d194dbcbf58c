// SPDX-License-Identifier: GPL-3.0-or-later
/// \file overlay.hpp  Pictures in which a person sees at a glance whether a segmentation can be right.
#pragma once

#include <filesystem>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Writes the three middle planes of the scan side by side (xy, xz, yz), the corrected grey values with the grains'
/// colours over them, and a scale below: a PNG, of at least 1200 pixels' width where a voxel then has at most eight.
/// Voxels whose edges differ are drawn with these edges. \throws RunError.
void write_overlay(const std::filesystem::path& file, const Segmentation& segmentation);

/// The grains seen obliquely from above, each in its colour of the planes, shaded by their surfaces: a PNG. \throws
/// RunError.
void write_view(const std::filesystem::path& file, const Segmentation& segmentation);

}  // namespace macadam::ct
