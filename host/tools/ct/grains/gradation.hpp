// SPDX-License-Identifier: GPL-3.0-or-later
/// \file gradation.hpp  Compares the grains' gradation with the laboratory's.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Returns the fraction of a laboratory's gradation below `size` [m], interpolated linearly over the logarithm of the
/// size between its sieves. Below the smallest sieve the fraction is proportional to the size. With `from` [m], returns
/// the fraction of the part that is larger than `from`.
double passing_at(const std::vector<SievePassing>& gradation, double size, double from = 0);

/// Returns a table of the fraction of the grains' volume that passes each sieve, by D^I and by the square mesh. If a
/// laboratory's gradation is given, the table also has this gradation: in full, and for sizes above half of `smallest`
/// [m], because a scan does not show smaller grains.
std::string gradation_csv(const std::vector<ScannedGrain>& grains, const std::vector<SievePassing>& laboratory = {},
                          double smallest = 0);

/// Compares the sizes of the grains with the laboratory's sieve curve. Returns 1 if they agree, otherwise `doubtful`
/// with a warning. An image contains no lengths, so only this check can find that the given edge length of a voxel is
/// wrong.
double trust_in_sizes(const std::vector<ScannedGrain>& grains, const std::vector<SievePassing>& laboratory,
                      double smallest, std::vector<std::string>& warnings);

}  // namespace macadam::ct
