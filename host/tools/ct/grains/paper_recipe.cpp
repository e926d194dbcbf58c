// SPDX-License-Identifier: GPL-3.0-or-later
// paper_recipe.cpp  Implements the recipe of [1]: equalises slices and rings, applies Otsu's global threshold, erodes,
// computes the watershed, and makes surfaces of the voxels.
#include "host/tools/ct/grains/paper_recipe.hpp"

#include "host/tools/ct/voxels/distance.hpp"
#include "host/tools/ct/grains/fragments.hpp"
#include "host/tools/ct/grains/grain_surfaces.hpp"
#include "host/tools/ct/grains/labels.hpp"
#include "host/tools/ct/voxels/scan_checks.hpp"
#include "host/tools/ct/voxels/smoothing.hpp"
#include "macadam/error.hpp"
#include "host/tools/ct/voxels/voxel_phases.hpp"

namespace macadam::ct {
namespace {

/// Shifts the grey values of every part so that all parts have the same mean: the mean of part `to`, or of the whole
/// scan if `to` is empty. `part(at)` returns the part of a voxel.
template <class Part>
void shift_to(Image<float>& scan, const Image<std::uint8_t>& region, std::size_t parts, std::optional<std::size_t> to,
              Part&& part) {
  std::vector<double> sum(parts), count(parts);
  double all = 0, voxels = 0;
  for (std::size_t at = 0; at < scan.count(); ++at) {
    if (!region.voxels[at]) continue;
    sum[part(at)] += scan.voxels[at], ++count[part(at)];
    all += scan.voxels[at], ++voxels;
  }
  const double mean = to && count[*to] > 0 ? sum[*to] / count[*to] : all / voxels;
  for (std::size_t at = 0; at < scan.count(); ++at) {
    const std::size_t p = part(at);
    if (region.voxels[at]) scan.voxels[at] += static_cast<float>(mean - sum[p] / count[p]);
  }
}

/// Fills holes: adds the outside voxels that no path from the end of the image reaches.
void fill_holes(Image<std::uint8_t>& mask) {
  Image<std::uint8_t> seen = mask;
  std::vector<std::size_t> open;
  const auto [nx, ny, nz] = mask.size;
  const auto visit = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const std::size_t at = mask.index(i, j, k);
    if (!seen.voxels[at]) seen.voxels[at] = 1, open.push_back(at);
  };
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        if (i == 0 || j == 0 || k == 0 || i + 1 == nx || j + 1 == ny || k + 1 == nz) visit(i, j, k);
      }
    }
  }
  while (!open.empty()) {
    const auto at = static_cast<std::int64_t>(open.back());
    open.pop_back();
    const std::int64_t i = at % nx, j = at / nx % ny, k = at / (nx * ny);
    if (i > 0) visit(i - 1, j, k);
    if (i + 1 < nx) visit(i + 1, j, k);
    if (j > 0) visit(i, j - 1, k);
    if (j + 1 < ny) visit(i, j + 1, k);
    if (k > 0) visit(i, j, k - 1);
    if (k + 1 < nz) visit(i, j, k + 1);
  }
  for (std::size_t at = 0; at < mask.count(); ++at) mask.voxels[at] = mask.voxels[at] || !seen.voxels[at];
}

}  // namespace

void equalise(Image<float>& scan, const Image<std::uint8_t>& region) {
  const auto [nx, ny, nz] = scan.size;
  const auto slice = static_cast<std::size_t>(nx * ny);
  shift_to(scan, region, static_cast<std::size_t>(nz), {}, [&](std::size_t at) { return at / slice; });
  constexpr double zones = 20;
  std::vector<std::size_t> zone(slice);
  const double half = 0.5 * std::hypot(static_cast<double>(nx), static_cast<double>(ny));
  for (std::size_t c = 0; c < slice; ++c) {
    const auto i = static_cast<std::int64_t>(c) % nx, j = static_cast<std::int64_t>(c) / nx;
    const double r = std::hypot(static_cast<double>(i) - 0.5 * static_cast<double>(nx - 1),
                                static_cast<double>(j) - 0.5 * static_cast<double>(ny - 1));
    zone[c] = static_cast<std::size_t>(std::min(zones - 1, zones * r / half));
  }
  shift_to(scan, region, static_cast<std::size_t>(zones), std::size_t{0},
           [&](std::size_t at) { return zone[at % slice]; });
}

Segmentation segment_as_paper(Image<float> scan, const Image<std::uint8_t>& region, const SegmentOptions& options) {
  const auto say = [&](const char* stage) {
    if (options.progress) options.progress(stage, 0);
  };
  Segmentation out;
  say("corrections");
  equalise(scan, region);
  check_rings(scan, region);
  say("phases");
  const Histogram raw = histogram_of(scan, region);
  const GreyLevels levels = fit_levels(raw);
  const double air_below =
      levels.has_air ? 0.5 * (levels.air + levels.mastic) : -std::numeric_limits<double>::infinity();
  out.phases = Image<std::uint8_t>::like(scan, outside);
  for (std::size_t at = 0; at < scan.count(); ++at) {
    if (region.voxels[at]) out.phases.voxels[at] = scan.voxels[at] < air_below ? air : mastic;
  }
  say("denoising");
  median(scan);
  const Histogram h = histogram_of(scan, region);
  const double threshold = otsu(h, h.bin(air_below), h.counts.size());
  Image<std::uint8_t> mask = Image<std::uint8_t>::like(scan);
  for (std::size_t at = 0; at < scan.count(); ++at) {
    if (out.phases.voxels[at] == mastic && scan.voxels[at] >= threshold)
      out.phases.voxels[at] = aggregate, mask.voxels[at] = 1;
  }
  if (std::find(mask.voxels.begin(), mask.voxels.end(), 1) == mask.voxels.end())
    throw InputError("the scan", 0, "aggregate", "none", "grey values above Otsu's threshold");
  say("grains");
  fill_holes(mask);
  for (std::size_t at = 0; at < scan.count(); ++at) {
    if (mask.voxels[at]) out.phases.voxels[at] = aggregate;
  }
  Image<float> distance = distance_inside(mask);
  const double voxel = std::cbrt(scan.voxel_volume());
  // erosion by one voxel
  for (std::size_t at = 0; at < scan.count(); ++at) mask.voxels[at] = distance.voxels[at] > voxel;
  distance = distance_inside(mask);
  const Fragments fragments = flood(distance, scan, 1);
  out.labels = spread(out.phases, fragments.labels, 1);  // dilation
  drop_small(out.labels, least_volume(options));
  out.confidence = Image<std::uint8_t>::like(scan, 255);
  out.levels = levels;
  out.grey = std::move(scan);
  count_shares(out);
  measure_unassigned(out, options);
  if (options.surfaces) {
    say("surfaces");
    out.grains = surfaces_of(out, {air_below, threshold}, boxes_of(out.labels, out.phases, out.confidence), options,
                             out.warnings);
  }
  return out;
}

}  // namespace macadam::ct
