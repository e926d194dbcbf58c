// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scan_checks.hpp  Checks whether a scan and its segmentation are plausible. A check throws if nothing can
/// be determined. A check warns and lowers the confidence if a person should look at the scan.
#pragma once

#include "host/tools/ct/voxels/grey_levels.hpp"

namespace macadam::ct {

/// Factor for the confidence of all grains if there is a doubt about the whole scan.
constexpr double doubtful = 0.5;

/// \throws InputError if a scan has no voxels, a voxel that is not a finite number, or one grey value everywhere.
void check_voxels(const Image<float>& scan);

/// \throws InputError if a scan has fewer than four voxels along an axis, for example a single slice.
void check_thickness(const Image<float>& scan);

/// Sets Segmentation::in_no_grain, the fraction of the aggregate's volume that is in no grain, from phases and labels.
/// Warns above a tenth.
void measure_unassigned(Segmentation& out, const SegmentOptions& options);

/// Finds voxels of the specimen that are clipped: they have the smallest or the largest grey value, and more than 1 %
/// of the specimen's voxels share that value. Returns one flag per voxel, or an empty vector if there are none. Warns
/// if there are some.
std::vector<bool> clipped_voxels(const Image<float>& scan, const Image<std::uint8_t>& region,
                                 std::vector<std::string>& warnings);

/// Warns if the specimen ends in air at one end of an axis, but touches the end of the scan at the other.
void check_ends(const Image<std::uint8_t>& region, std::vector<std::string>& warnings);

/// \throws InputError if rings explain more than 15 % of the variance of the grey values (see ring_share()).
void check_rings(const Image<float>& scan, const Image<std::uint8_t>& region);

/// Checks that the levels belong to the phases. Returns 1, or `doubtful` with a warning if the scan has two levels that
/// may be any two phases. \throws InputError if they cannot be mastic and aggregate.
double trust_in_levels(const Image<float>& scan, const Image<std::uint8_t>& region, const GreyLevels& levels,
                       const SegmentOptions& options, std::vector<std::string>& warnings);

/// Checks that the aggregate has similar chord lengths along all axes. Returns 1, or `doubtful` with a warning. Grains
/// lie in all directions, more or less; if the height of the voxels is wrong, all grains look flat or tall.
double trust_in_axes(const Image<std::uint8_t>& phases, std::vector<std::string>& warnings);

/// Checks that the aggregate was separated into grains. Returns 1, or `doubtful` with a warning if one grain fills at
/// least half of the specimen.
double trust_in_grains(const Image<std::uint32_t>& labels, const Image<std::uint8_t>& phases,
                       std::vector<std::string>& warnings);

}  // namespace macadam::ct
