// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grey_levels.hpp  Finds the grey values of the phases from histograms. A histogram is modelled as a mixture: a
/// normal distribution for each phase, and a distribution for voxels that hold two neighbouring phases in part.
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

/// Returns empty bins for the grey values in an image's region. The range leaves out the lowest and the highest 1e-4 of
/// the values; these count in the first and last bin. \throws InputError for an empty region or a constant grey value.
Histogram bins_of(const Image<float>& image, const Image<std::uint8_t>& region, std::size_t bins);

/// Returns the histogram of the grey values in the region, with the bins of bins_of().
Histogram histogram_of(const Image<float>& image, const Image<std::uint8_t>& region, std::size_t bins = 512);

/// Returns the threshold that splits bins [from, to) into two classes with the smallest variance within the classes
/// (Otsu).
double otsu(const Histogram& histogram, std::size_t from, std::size_t to);

/// Returns the grey levels of air, mastic and aggregate. `has_air` is false if the histogram shows two phases only.
GreyLevels fit_levels(const Histogram& histogram);

/// Difference in brightness between a part of the scan and the whole scan. A level of the whole scan becomes air + (1 +
/// brighter)·(level − air) in the part, or level + brighter·contrast if the scan has no air. The difference is a single
/// number because a part may hold little of one phase. The fractions of the phases are fitted too, so the composition
/// of the part does not affect the result.
struct PartLevel {
  double brighter = 0;
  double weight = 0;  ///< number of voxels on which the value is based; 0: too few
};
/// Fits the brightness of a part of the scan, given its histogram and the levels of the whole scan.
PartLevel level_of_part(const Histogram& histogram, const GreyLevels& whole);

/// Whether a histogram has a valley between mastic and aggregate. Without one the two cannot be distinguished.
bool has_valley(const Histogram& histogram, const GreyLevels& levels);

}  // namespace macadam::ct
