// SPDX-License-Identifier: GPL-3.0-or-later
// phases.cpp  Computes the thresholds, and the Markov random field that removes the effect of noise on the phases.
#include "host/tools/ct/voxels/phases.hpp"

#include "kernels/base/parallel.hpp"
#include "host/tools/ct/voxels/voxel_phases.hpp"

namespace macadam::ct {
namespace {

/// Returns the grey value below which the fraction `share` of a histogram lies.
double quantile(const Histogram& h, double share) {
  double left = share * static_cast<double>(h.total());
  for (std::size_t b = 0; b < h.counts.size(); ++b) {
    const auto count = static_cast<double>(h.counts[b]);
    if (left <= count) return h.low + h.width * (static_cast<double>(b) + (count > 0 ? left / count : 0));
    left -= count;
  }
  return h.low + h.width * static_cast<double>(h.counts.size());
}

/// Returns `wanted`, limited to the range from a quarter to three quarters of the way from `low` to `high`. Warns if
/// `wanted` is outside this range.
double within(double wanted, double low, double high, const char* what, std::vector<std::string>& warnings) {
  const double from = low + 0.25 * (high - low), to = low + 0.75 * (high - low);
  if (wanted >= from && wanted <= to) return wanted;
  warnings.push_back(
      fmt::format("the given volume fraction of {} does not agree with the grey values; the chosen thresholds only "
                  "come close to this fraction",
                  what));
  return std::clamp(wanted, from, to);
}

}  // namespace

Thresholds thresholds_of(const Histogram& histogram, const GreyLevels& levels, const SegmentOptions& options,
                         std::vector<std::string>& warnings) {
  Thresholds t{0.5 * (levels.air + levels.mastic), 0.5 * (levels.mastic + levels.aggregate)};
  if (!levels.has_air) t.air = -std::numeric_limits<double>::infinity();
  if (options.air_voids && levels.has_air)
    t.air = within(quantile(histogram, *options.air_voids), levels.air, levels.mastic, "air voids", warnings);
  if (options.aggregate)
    t.aggregate =
        within(quantile(histogram, 1 - *options.aggregate), levels.mastic, levels.aggregate, "aggregate", warnings);
  return t;
}

Phases classify(const Image<float>& grey, const Image<std::uint8_t>& region, const GreyLevels& levels,
                const Thresholds& thresholds) {
  const auto [nx, ny, nz] = grey.size;
  const auto slices = static_cast<std::size_t>(nz);
  Phases out{Image<std::uint8_t>::like(grey, outside), Image<std::uint8_t>::like(grey)};
  const auto across = [&](std::size_t i) {
    return !region.voxels[i]                       ? outside
           : grey.voxels[i] < thresholds.air       ? air
           : grey.voxels[i] < thresholds.aggregate ? mastic
                                                   : aggregate;
  };
  for_each_in_parallel(slices, [&](std::size_t k) {
    for (std::size_t i = k * out.phase.count() / slices; i < (k + 1) * out.phase.count() / slices; ++i)
      out.phase.voxels[i] = across(i);
  });
  // The weight of the neighbours is small: a larger one would remove small voids, because their surfaces are curved.
  // The energies of two phases differ by (grey − threshold)·contrast/σ², with contrast²/σ² = 10; σ covers noise and
  // blur. Six neighbours of one phase then outweigh a grey value difference of up to about a fifth of the contrast.
  const double gap = levels.has_air ? levels.mastic - levels.air : 1;
  const auto energy = [&](float value) {
    const double x_air = 10 * (value - thresholds.air) / gap,
                 x_aggregate = 10 * (value - thresholds.aggregate) / levels.contrast();
    return std::array<double, 3>{levels.has_air ? x_air : 1e9, 0, -x_aggregate};
  };
  constexpr double neighbour = 0.3;
  const auto offset_y = nx, offset_z = nx * ny;
  constexpr int rounds = 3;
  for (int half = 0; half < 2 * rounds; ++half) {
    // voxels are updated like the fields of a chessboard: all neighbours of a voxel have the other colour, so the
    // result does not depend on the order within a colour
    for_each_in_parallel(slices, [&, nx = nx, ny = ny, nz = nz](std::size_t slice) {
      const auto k = static_cast<std::int64_t>(slice);
      for (std::int64_t j = 0; j < ny; ++j) {
        for (std::int64_t i = (j + k + half) % 2; i < nx; i += 2) {
          const std::size_t at = out.phase.index(i, j, k);
          std::uint8_t& phase = out.phase.voxels[at];
          if (phase == outside) continue;
          const std::uint8_t* p = &phase;
          int same[3] = {};
          const auto see = [&](bool there, std::int64_t step) {
            if (there && p[step] != outside) ++same[p[step]];
          };
          see(i > 0, -1), see(i + 1 < nx, 1), see(j > 0, -offset_y), see(j + 1 < ny, offset_y), see(k > 0, -offset_z),
              see(k + 1 < nz, offset_z);
          std::array<double, 3> e = energy(grey.voxels[at]);
          for (std::size_t c = 0; c < 3; ++c) e[c] -= neighbour * same[c];
          phase = static_cast<std::uint8_t>(std::min_element(e.begin(), e.end()) - e.begin());
          if (half < 2 * rounds - 2) continue;
          const double best = e[phase];
          double others = 0;
          for (std::size_t c = 0; c < 3; ++c)
            if (c != phase) others += std::exp(std::max(-50.0, best - e[c]));
          out.confidence.voxels[at] = static_cast<std::uint8_t>(255 * (1 - others) / (1 + others) * (others < 1));
        }
      }
    });
  }
  return out;
}

}  // namespace macadam::ct
