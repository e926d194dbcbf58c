// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scan_checks.hpp  What makes a scan, or what was found in it, doubtful: errors where nothing can be told,
/// warnings and less confidence where a person has to look.
#pragma once

#include "host/ct/grey_levels.hpp"

namespace macadam::ct {

/// By how much a doubt about the whole scan lowers the confidence of all its grains.
constexpr double doubtful = 0.5;

/// \throws InputError where a scan has no voxels, a voxel that is no number, or one grey value everywhere.
void check_voxels(const Image<float>& scan);

/// \throws InputError where a scan has fewer than four voxels along an axis: one slice, say.
void check_thickness(const Image<float>& scan);

/// Measures which part of the aggregate's volume is in no grain (Segmentation::in_no_grain), from phases and labels.
/// Warns above a tenth.
void measure_unassigned(Segmentation& out, const SegmentOptions& options);

/// The specimen's voxels of the least or the largest grey value, by number, where they are more than 1 %: what those
/// would have been is not known. Empty where there are none. Warns.
std::vector<bool> clipped_voxels(const Image<float>& scan, const Image<std::uint8_t>& region,
                                 std::vector<std::string>& warnings);

/// Warns where the specimen ends in air at one end of an axis, and with the scan at the other.
void check_ends(const Image<std::uint8_t>& region, std::vector<std::string>& warnings);

/// \throws InputError where grey values follow the distance from the axis more than the specimen.
void check_rings(const Image<float>& scan, const Image<std::uint8_t>& region);

/// Whether the levels are those of the phases: 1, or `doubtful`, with a warning, where two levels may be any two
/// phases. \throws InputError where they are not.
double trust_in_levels(const Image<float>& scan, const Image<std::uint8_t>& region, const GreyLevels& levels,
                       const SegmentOptions& options, std::vector<std::string>& warnings);

/// Whether grains are as long along each axis as along the others: 1, or `doubtful`, with a warning. They lie in all
/// directions, more or less: a voxel that is not as high as it was said to be makes all of them flat or tall.
double trust_in_axes(const Image<std::uint8_t>& phases, std::vector<std::string>& warnings);

/// Whether aggregate came apart into grains: 1, or `doubtful`, with a warning, where one of them is most of the
/// specimen.
double trust_in_grains(const Image<std::uint32_t>& labels, const Image<std::uint8_t>& phases,
                       std::vector<std::string>& warnings);

}  // namespace macadam::ct
