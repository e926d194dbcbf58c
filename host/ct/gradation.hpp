// SPDX-License-Identifier: GPL-3.0-or-later
/// \file gradation.hpp  The grains' gradation, and the laboratory's beside it.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Reads `sieve_m,passing` (shares) or `sieve_mm,passing_percent`, in any order of the sieves. \throws InputError
/// naming file and line.
std::vector<SievePassing> read_gradation(const std::filesystem::path& file);

/// Share of a laboratory's gradation below a size [m], straight between its sieves over the logarithm of the size; or
/// of what of it is above `from` [m].
double passing_at(const std::vector<SievePassing>& gradation, double size, double from = 0);

/// Share passing of all grains' volume, by D^I and by the square sieve; beside them the laboratory's, whole and of what
/// a scan can show, which is above half of `smallest` [m].
std::string gradation_csv(const std::vector<ScannedGrain>& grains, const std::vector<SievePassing>& laboratory = {},
                          double smallest = 0);

/// Whether the grains are as large as the laboratory's: 1, or `doubtful`, with a warning. An image knows no lengths: a
/// wrong edge of its voxels shows here alone.
double trust_in_sizes(const std::vector<ScannedGrain>& grains, const std::vector<SievePassing>& laboratory,
                      double smallest, std::vector<std::string>& warnings);

}  // namespace macadam::ct
