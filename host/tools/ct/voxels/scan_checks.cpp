// SPDX-License-Identifier: GPL-3.0-or-later
// scan_checks.cpp  Checks a scan for clipped voxels, missing ends, rings, implausible grey levels and wrong axes.
#include "host/tools/ct/voxels/scan_checks.hpp"

#include "host/tools/ct/voxels/correction.hpp"
#include "macadam/error.hpp"
#include "host/tools/ct/voxels/voxel_phases.hpp"

namespace macadam::ct {
namespace {

/// Returns the median grey value around the specimen; nothing if the surroundings are less than a hundredth of the
/// scan.
std::optional<double> level_around(const Image<float>& scan, const Image<std::uint8_t>& region) {
  std::vector<float> around;
  const std::size_t step = scan.count() / 1'000'000 + 1;
  for (std::size_t i = 0; i < scan.count(); i += step) {
    if (!region.voxels[i]) around.push_back(scan.voxels[i]);
  }
  if (around.size() * step < scan.count() / 100) return std::nullopt;
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end());
  return *middle;
}

}  // namespace

void check_voxels(const Image<float>& scan) {
  if (scan.count() == 0) throw InputError("the scan", 0, "voxels", "none", "an image");
  for (std::size_t i = 0; i < scan.count(); ++i) {
    if (!std::isfinite(scan.voxels[i]))
      throw InputError("the scan", 0, fmt::format("voxel {}", i), fmt::format("{}", scan.voxels[i]), "a finite number");
  }
  const auto [low, high] = std::minmax_element(scan.voxels.begin(), scan.voxels.end());
  if (!(*high > *low))
    throw InputError("the scan", 0, "grey values", fmt::format("{} everywhere", *low), "phases of different grey");
}

std::vector<bool> clipped_voxels(const Image<float>& scan, const Image<std::uint8_t>& region,
                                 std::vector<std::string>& warnings) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < scan.count(); ++i) {
    if (!region.voxels[i]) continue;
    ++inside;
    low = std::min(low, scan.voxels[i]), high = std::max(high, scan.voxels[i]);
  }
  std::vector<bool> clipped;
  for (const auto& [end, name] : {std::pair{low, "least"}, {high, "largest"}}) {
    std::size_t there = 0;
    for (std::size_t i = 0; i < scan.count(); ++i) there += region.voxels[i] && scan.voxels[i] == end;
    const double share = static_cast<double>(there) / static_cast<double>(inside);
    if (!(share > 0.01)) continue;
    warnings.push_back(
        fmt::format("{:.1f} % of the specimen's voxels have the {} grey value {}: the scan is clipped there, and "
                    "surfaces next to such voxels may be in the wrong place",
                    100 * share, name, end));
    clipped.resize(scan.count());
    for (std::size_t i = 0; i < scan.count(); ++i) {
      if (region.voxels[i] && scan.voxels[i] == end) clipped[i] = true;
    }
  }
  return clipped;
}

void check_ends(const Image<std::uint8_t>& region, std::vector<std::string>& warnings) {
  bool there[3][2] = {};
  const auto [nx, ny, nz] = region.size;
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        if (!region.at(i, j, k)) continue;
        const std::int64_t at[3] = {i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          there[a][0] = there[a][0] || at[a] == 0;
          there[a][1] = there[a][1] || at[a] + 1 == region.size[a];
        }
      }
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (there[a][0] == there[a][1]) continue;
    warnings.push_back(
        fmt::format("along {} the specimen ends in air at one end, but at its {} end it reaches the edge of the scan: "
                    "a part of the scan may be missing",
                    "xyz"[a], there[a][0] ? "lower" : "upper"));
  }
}

void check_rings(const Image<float>& scan, const Image<std::uint8_t>& region) {
  // In a scan without rings, this fraction of the variance of the grey values is a few per cent. A ring of a few
  // voxels' width crosses many grains, so the mean grey values of all rings are nearly equal.
  constexpr double most = 0.15;
  if (const double share = ring_share(scan, region); share > most) {
    throw InputError(
        "the scan", 0, "rings",
        fmt::format("ring artefacts that cause {:.0f} % of the variance of the grey values", 100 * share),
        fmt::format("rings that cause at most {:.0f} %, because stronger rings hide the specimen", 100 * most));
  }
}

double trust_in_levels(const Image<float>& scan, const Image<std::uint8_t>& region, const GreyLevels& levels,
                       const SegmentOptions& options, std::vector<std::string>& warnings) {
  if (levels.has_air || options.air_voids == 0.0) return 1;
  if (options.air_voids) {
    throw InputError(
        "the scan", 0, "grey levels",
        fmt::format("two grey levels, {:.5g} and {:.5g}", levels.mastic, levels.aggregate),
        fmt::format(
            "three grey levels, because the given air voids are {:.3g} % of the specimen. If these voids have "
            "no grey level of their own in the histogram, give --air-voids 0, and the voids are taken for mastic",
            100 * *options.air_voids));
  }
  // if the region is given by coordinates, more of the specimen may lie around it
  const std::optional<double> around = options.given ? std::nullopt : level_around(scan, region);
  if (around && std::abs(*around - levels.mastic) < 0.25 * levels.contrast()) {
    throw InputError(
        "the scan", 0, "grey levels",
        fmt::format(
            "two grey levels, {:.5g} and {:.5g}, of which the lower is the level of the air around the specimen",
            levels.mastic, levels.aggregate),
        "a grey level each of air, mastic and aggregate; a phase is missing, or has the grey value of another phase "
        "(if the grains lie in air without mastic, give --air-voids 0, and the air is taken for mastic)");
  }
  warnings.push_back("the scan has two grey levels: they were taken for mastic and aggregate, without air voids");
  if (around) return 1;  // the air around the specimen has another level, so neither phase is air
  warnings.push_back(
      "the scan does not show which two phases its two grey levels are, so the confidence of every grain is at most "
      "one half; give --air-voids 0 if the specimen has no air voids");
  return doubtful;
}

double trust_in_axes(const Image<std::uint8_t>& phases, std::vector<std::string>& warnings) {
  const std::int64_t steps[3] = {1, phases.size[0], phases.size[0] * phases.size[1]};
  const double edges[3] = {phases.spacing.x, phases.spacing.y, phases.spacing.z};
  double voxels = 0, ends[3] = {};
  for (std::int64_t k = 0; k < phases.size[2]; ++k) {
    for (std::int64_t j = 0; j < phases.size[1]; ++j) {
      for (std::int64_t i = 0; i < phases.size[0]; ++i) {
        const std::uint8_t* here = &phases.at(i, j, k);
        if (*here != aggregate) continue;
        ++voxels;
        const std::int64_t at[3] = {i, j, k};
        for (std::size_t a = 0; a < 3; ++a) ends[a] += at[a] + 1 == phases.size[a] || here[steps[a]] != aggregate;
      }
    }
  }
  double chord[3];
  for (std::size_t a = 0; a < 3; ++a) chord[a] = ends[a] > 0 ? edges[a] * voxels / ends[a] : 0;
  const auto [shortest, longest] = std::minmax_element(chord, chord + 3);
  // Compaction turns flat grains horizontal: chord lengths in a core may differ by a quarter. A voxel height that is
  // wrong by a factor of two gives a ratio of 2.
  if (!(*longest > 1.5 * *shortest)) return 1;
  warnings.push_back(
      fmt::format("the mean chords through the aggregate differ: they are {:.3g}, {:.3g} and {:.3g} mm along x, y and "
                  "z. The edges of a voxel, {:.4g}, {:.4g} and {:.4g} mm, may be wrong: please check them",
                  1e3 * chord[0], 1e3 * chord[1], 1e3 * chord[2], 1e3 * edges[0], 1e3 * edges[1], 1e3 * edges[2]));
  return doubtful;
}

double trust_in_grains(const Image<std::uint32_t>& labels, const Image<std::uint8_t>& phases,
                       std::vector<std::string>& warnings) {
  std::vector<double> voxels(1);
  double specimen = 0;
  for (std::size_t i = 0; i < labels.count(); ++i) {
    specimen += phases.voxels[i] != static_cast<std::uint8_t>(VoxelPhase::outside);
    if (labels.voxels[i] >= voxels.size()) voxels.resize(labels.voxels[i] + 1);
    ++voxels[labels.voxels[i]];
  }
  voxels[0] = 0;  // label 0 is not a grain
  const double fraction = *std::max_element(voxels.begin(), voxels.end()) / specimen;
  if (fraction < 0.5) return 1;
  warnings.push_back(fmt::format(
      "one grain is {:.0f} % of the specimen: the phase called aggregate is another phase, or several phases",
      100 * fraction));
  return doubtful;
}

void check_thickness(const Image<float>& scan) {
  constexpr std::int64_t least = 4;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t n = scan.size[axis];
    if (n >= least) continue;
    throw InputError("the scan", 0, axis == 2 ? "slices" : fmt::format("voxels along {}", "xy"[axis]),
                     std::to_string(n),
                     fmt::format("at least {}, because grains are found in a volume, not in a picture", least));
  }
}

void measure_unassigned(Segmentation& out, const SegmentOptions& options) {
  std::size_t all = 0, in_none = 0;
  for (std::size_t i = 0; i < out.phases.count(); ++i) {
    if (out.phases.voxels[i] != aggregate) continue;
    ++all;
    in_none += out.labels.voxels[i] == 0;
  }
  out.in_no_grain = all > 0 ? static_cast<double>(in_none) / static_cast<double>(all) : 0;
  // some aggregate is always smaller than a scan can resolve
  constexpr double many = 0.1;
  if (!(out.in_no_grain > many)) return;
  const double finest = 4 * std::cbrt(out.phases.voxel_volume());
  out.warnings.push_back(fmt::format(
      "{:.0f} % of the aggregate's volume is in no grain: pieces below half of --smallest, {:.3g} mm, are left "
      "out of the grains and of gradation.csv. {}",
      100 * out.in_no_grain, 500 * options.smallest,
      options.smallest > 1.01 * finest
          ? fmt::format("These voxels allow a --smallest of {:.3g} mm and more", 1e3 * finest)
          : "Smaller grains need smaller voxels"));
}

}  // namespace macadam::ct
