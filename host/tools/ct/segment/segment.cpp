// SPDX-License-Identifier: GPL-3.0-or-later
// segment.cpp  Segments a scan into phases and grains, step by step.
#include "host/tools/ct/voxels/correction.hpp"
#include "host/tools/ct/voxels/distance.hpp"
#include "host/tools/ct/grains/gradation.hpp"
#include "host/tools/ct/grains/grain_surfaces.hpp"
#include "host/tools/ct/grains/grains.hpp"
#include "host/tools/ct/grains/labels.hpp"
#include "host/tools/ct/grains/paper_recipe.hpp"
#include "host/tools/ct/voxels/phases.hpp"
#include "host/tools/ct/voxels/region.hpp"
#include "host/tools/ct/voxels/scan_checks.hpp"
#include "host/tools/ct/segment/segment_steps.hpp"
#include "host/tools/ct/voxels/smoothing.hpp"
#include "host/tools/ct/grains/valleys.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using namespace ct;

/// Reports a stage and its progress, if the caller wants it.
void say(const SegmentOptions& options, const char* stage, double share = 0) {
  if (options.progress) options.progress(stage, share);
}

/// \throws InputError if mastic and aggregate cannot be distinguished by their levels.
void check_levels(const Histogram& histogram, const GreyLevels& levels) {
  if (levels.contrast() < 2 * levels.deviation || !has_valley(histogram, levels)) {
    throw InputError("the scan", 0, "contrast between mastic and aggregate",
                     fmt::format("grey values {:.5g} and {:.5g} with a standard deviation of {:.3g} each",
                                 levels.mastic, levels.aggregate, levels.deviation),
                     "a valley between these grey values in the histogram, because the two phases cannot be "
                     "distinguished without it");
  }
}

}  // namespace

Segmentation ct::segment_steps(Image<float> scan, const SegmentOptions& options, const Refine& refine) {
  check_voxels(scan);
  check_thickness(scan);
  const double voxel = std::cbrt(scan.voxel_volume());
  if (options.smallest < 4 * voxel) {
    throw InputError("the scan", 0, "edge of a voxel", fmt::format("{:.4g} mm", 1e3 * voxel),
                     fmt::format("at most a quarter of the smallest grain, {:.4g} mm", 1e3 * options.smallest));
  }
  if (options.cuts && options.recipe == SegmentRecipe::paper)
    throw InputError("cuts", 0, "recipe", "\"paper\", which has no cuts to change", "\"own\"");
  if (const double both = options.air_voids.value_or(0) + options.aggregate.value_or(0); both >= 1)
    throw InputError("the scan", 0, "given volume fractions of air voids and aggregate",
                     fmt::format("a sum of {:g}", both), "less than 1, because the remaining volume is mastic");
  Segmentation out;
  say(options, "region");
  const Image<std::uint8_t> region =
      options.given ? take_region(scan, *options.given) : find_region(scan, options.region);
  const std::vector<bool> clipped = clipped_voxels(scan, region, out.warnings);
  if (!options.given && options.region != ScanRegion::whole) check_ends(region, out.warnings);
  if (options.recipe == SegmentRecipe::paper) {
    Segmentation paper = segment_as_paper(std::move(scan), region, options);
    paper.warnings.insert(paper.warnings.begin(), out.warnings.begin(), out.warnings.end());
    return paper;
  }
  say(options, "corrections");
  CorrectionSteps steps;
  out.corrections = correct(scan, region, options, &steps);
  check_rings(scan, region);
  say(options, "denoising");
  const GreyLevels noisy = fit_levels(histogram_of(scan, region));
  if (!(noisy.contrast() > 0)) check_levels(histogram_of(scan, region), noisy);
  if (options.denoising == Denoising::median) median(scan);
  // The more noise, the more diffusion steps. Unnecessary steps are avoided, because each step also shrinks small round
  // features.
  const int rounds = std::clamp(static_cast<int>(std::lround(40 * noisy.deviation / noisy.contrast())), 1, 8);
  if (options.denoising == Denoising::diffusion) diffuse(scan, 0.3 * noisy.contrast(), rounds);
  say(options, "phases");
  const Histogram histogram = histogram_of(scan, region);
  out.levels = fit_levels(histogram);
  check_levels(histogram, out.levels);
  double trust = trust_in_levels(scan, region, out.levels, options, out.warnings);
  const Thresholds thresholds = thresholds_of(histogram, out.levels, options, out.warnings);
  Phases phases = classify(scan, region, out.levels, thresholds);
  out.phases = std::move(phases.phase);
  out.confidence = std::move(phases.confidence);
  for (std::size_t i = 0; i < clipped.size(); ++i) {
    if (clipped[i]) out.confidence.voxels[i] = 0;
  }
  out.grey = std::move(scan);
  count_shares(out);
  if (out.mastic < 0.05 || out.aggregate < 0.005) {
    throw InputError(
        "the scan", 0, "volume fractions",
        fmt::format("mastic {:.2f} %, aggregate {:.2f} %", 100 * out.mastic, 100 * out.aggregate),
        "at least 5 % mastic and 0.5 % aggregate; a phase is missing, or has the grey value of another phase");
  }

  trust *= trust_in_axes(out.phases, out.warnings);

  say(options, "grains");
  const auto edge = std::max<std::int64_t>(1, static_cast<std::int64_t>(options.smallest / 20 / voxel));
  auto [solid, inside] = means_of_blocks(out.grey, region, {edge, edge, edge});
  const auto mastic = static_cast<float>(out.levels.mastic), scale = static_cast<float>(1 / out.levels.contrast());
  for (float& grey : solid.voxels) grey = (grey - mastic) * scale;
  // The threshold is above the middle between mastic and aggregate (0.5), because mastic in a gap thinner than a voxel
  // lowers the grey value only a little.
  for (std::size_t i = 0; i < solid.count(); ++i) inside.voxels[i] = inside.voxels[i] && solid.voxels[i] > 0.7f;
  if (std::find(inside.voxels.begin(), inside.voxels.end(), 1) == inside.voxels.end())
    throw InputError("the scan", 0, "aggregate", "none", "grains of at least a few voxels");
  const Image<float> distance = distance_inside(inside);
  const Fragments fragments = flood(distance, solid, 0.95);
  Decision decision = options.cuts ? decide(fragments, *options.cuts) : decide(fragments);
  // With `refine`, the scan consists of block means. Block means do not show gaps thinner than a block, so the cuts
  // stay where the watershed put them.
  const double depth = refine ? 0 : options.smallest / 4;
  const Image<std::uint32_t> parted = cut_along_valleys(fragments, decision.grain, solid, depth);
  out.labels = spread(out.phases, parted, edge);
  const std::vector<std::uint32_t> number = drop_small(out.labels, least_volume(options));
  measure_unassigned(out, options);
  trust *= trust_in_grains(out.labels, out.phases, out.warnings);
  const std::vector<double> certain = certainty(decision, number);
  out.cuts = std::move(decision.cuts);
  if (options.surfaces) {
    say(options, "surfaces");
    std::vector<double> sure(number.size(), trust);
    for (std::size_t n = 1; n < number.size(); ++n) sure[number[n]] = trust * certain[n];
    const std::vector<GrainBox> boxes = boxes_of(out.labels, out.phases, out.confidence);
    out.grains = surfaces_of(out, thresholds, boxes, options, out.warnings, sure);
    if (refine) refine(out, thresholds, boxes, steps);
    const double sizes = trust_in_sizes(out.grains, options.gradation, options.smallest, out.warnings);
    for (ScannedGrain& grain : out.grains) grain.confidence *= sizes;
  }
  return out;
}

Segmentation segment_scan(Image<float> scan, const SegmentOptions& options) {
  return segment_steps(std::move(scan), options, {});
}

}  // namespace macadam
