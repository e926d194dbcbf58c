// SPDX-License-Identifier: GPL-3.0-or-later
/// \file overlay.hpp  Writes pictures in which a person can check a segmentation.
#pragma once

#include <filesystem>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Writes a PNG with the three middle planes of the scan side by side (xy, xz, yz): the corrected grey values, tinted
/// with the colours of the grains' size classes, and a scale bar below. Neighbouring grains differ in shade, and a dark
/// line separates grains that touch. The picture is at least 1200 pixels wide, unless a voxel would need more than
/// eight pixels. Voxels with different edges are drawn in proportion. \throws RunError.
void write_overlay(const std::filesystem::path& file, const Segmentation& segmentation);

/// Writes a PNG of the grains seen obliquely from above, each in its colour of the planes, with shaded surfaces.
/// \throws RunError.
void write_view(const std::filesystem::path& file, const Segmentation& segmentation);

}  // namespace macadam::ct
