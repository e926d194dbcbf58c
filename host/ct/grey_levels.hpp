// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grey_levels.hpp  The grey values of the phases, from histograms: mixtures of normal distributions and of what
/// lies between them where a voxel holds two phases.
#pragma once

#include <cstdint>
#include <vector>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Counts of grey values in equal bins.
struct Histogram {
  double low = 0, width = 1;  ///< lower end of the first bin, width of each
  std::vector<std::int64_t> counts;
  double centre(std::size_t bin) const { return low + width * (static_cast<double>(bin) + 0.5); }
  std::size_t bin(double grey) const {
    const double at = (grey - low) / width;
    return at <= 0 ? 0 : std::min(counts.size() - 1, static_cast<std::size_t>(at));
  }
  void add(double grey) { ++counts[bin(grey)]; }
  std::int64_t total() const;
};

/// Bins for the grey values of an image's region, without the rarest 1e-4 at both ends.
Histogram bins_of(const Image<float>& image, const Image<std::uint8_t>& region, std::size_t bins);

/// The same bins, filled.
Histogram histogram_of(const Image<float>& image, const Image<std::uint8_t>& region, std::size_t bins = 512);

/// The grey value that parts a histogram's range [from, to) of bins into two classes with the least variance within
/// them (Otsu).
double otsu(const Histogram& histogram, std::size_t from, std::size_t to);

/// The levels of air, mastic and aggregate. \throws InputError naming what is missing: contrast, a phase.
GreyLevels fit_levels(const Histogram& histogram);

/// By how much a part of the scan is brighter than the whole: levels are air + (1 + brighter)·(level − air) there, or,
/// where a scan has no air, level + brighter·contrast. One number, because a part may hold little of one phase; the
/// shares of the phases are free, so that composition does not matter.
struct PartLevel {
  double brighter = 0;
  double weight = 0;  ///< grey values that it rests on, 0: too few
};
PartLevel level_of_part(const Histogram& histogram, const GreyLevels& whole);

/// Whether a histogram has a valley between mastic and aggregate. Without one nothing tells them from each other.
bool has_valley(const Histogram& histogram, const GreyLevels& levels);

}  // namespace macadam::ct
