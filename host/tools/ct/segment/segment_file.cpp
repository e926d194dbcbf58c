// SPDX-License-Identifier: GPL-3.0-or-later
// segment_file.cpp  Segments a scan in a file: entirely in memory if it fits, otherwise on two levels (blocks, then
// finer surfaces from the file).
#include "host/tools/ct/segment/coarse_scan.hpp"
#include "host/tools/ct/segment/refine.hpp"
#include "host/tools/ct/segment/segment_steps.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using namespace ct;

constexpr double scan_bytes = 12;    ///< peak memory per voxel of the scan [bytes]
constexpr double parted_bytes = 14;  ///< peak memory per voxel of the grid on which grains are separated [bytes]
constexpr double block_bytes = 32;   ///< peak memory per block [bytes]: somewhat more than the sum of both values above
                                     ///< and 4 bytes for the voxel in its middle
constexpr double fixed_bytes = 1e8;  ///< memory of the program and its libraries [bytes]

double gigabytes(double bytes) { return 1e-9 * bytes; }

double voxels_of(const ImageHeader& header) {
  return static_cast<double>(header.size[0]) * static_cast<double>(header.size[1]) *
         static_cast<double>(header.size[2]);
}

/// Returns the memory needed to segment the scan entirely in memory [bytes].
double bytes_whole(const FineScan& scan, const SegmentOptions& options) {
  const double voxel = std::cbrt(scan.spacing.x * scan.spacing.y * scan.spacing.z);
  const double parted = std::max(1.0, std::floor(options.smallest / 20 / voxel));
  return fixed_bytes + voxels_of(scan.file.header()) * (scan_bytes + parted_bytes / std::pow(parted, 3));
}

/// Returns the memory needed to segment the scan in blocks of edge `block` [bytes].
double bytes_in_blocks(FineScan scan, std::int64_t block) {
  scan.block = block;
  const ImageHeader& header = scan.file.header();
  const auto edge = static_cast<double>(block);
  const double slab = static_cast<double>(header.size[0] * header.size[1] * scan.slab());
  const double held = scan.file.apart() ? 0 : voxels_of(header) * header.bits / 8;
  return fixed_bytes + voxels_of(header) / (edge * edge * edge) * block_bytes + slab * (4 + header.bits / 8.0) + held;
}

/// Returns the edge of the blocks [voxels]: a twentieth of the smallest grain or, if blocks of this size do not fit in
/// memory, up to a tenth. \throws InputError if none fits.
std::int64_t block_of(const FineScan& scan, const std::string& file, const SegmentOptions& options, double memory) {
  const double voxel = std::cbrt(scan.spacing.x * scan.spacing.y * scan.spacing.z);
  const auto least = std::max<std::int64_t>(2, static_cast<std::int64_t>(options.smallest / 20 / voxel));
  const auto most = std::max<std::int64_t>(2, static_cast<std::int64_t>(options.smallest / 10 / voxel));
  for (std::int64_t block = least; block <= most; ++block)
    if (bytes_in_blocks(scan, block) <= memory) return block;
  std::string found = fmt::format("{:.3g} GB", gigabytes(memory));
  if (!scan.file.apart())
    found += ", and this file cannot be read in parts (raw MetaImage, HDF5 and folders of TIFF files can)";
  throw InputError(
      file, 0, "memory", found,
      fmt::format(
          "at least {:.3g} GB, with means over blocks of {} voxels along each edge (a tenth of the smallest grain)",
          gigabytes(bytes_in_blocks(scan, most)), most));
}

/// Returns the noise of the voxels as a fraction of the contrast, and warns if the scan is clipped.
double noise_of(const Image<float>& middles, Segmentation& out, const CorrectionSteps& steps) {
  const float high = *std::max_element(middles.voxels.begin(), middles.voxels.end());
  const double clipped = static_cast<double>(std::count(middles.voxels.begin(), middles.voxels.end(), high)) /
                         static_cast<double>(middles.count());
  if (clipped > 0.01) {
    out.warnings.push_back(fmt::format(
        "{:.1f} % of the voxels have the largest grey value {}: the scan is clipped there", 100 * clipped, high));
  }
  Image<float> corrected = middles;
  Image<std::uint8_t> region = Image<std::uint8_t>::like(middles);
  for (std::int64_t k = 0; k < middles.size[2]; ++k) {
    for (std::int64_t j = 0; j < middles.size[1]; ++j) {
      for (std::int64_t i = 0; i < middles.size[0]; ++i) {
        const std::size_t at = middles.index(i, j, k);
        region.voxels[at] = out.phases.voxels[at] != static_cast<std::uint8_t>(VoxelPhase::outside);
        if (!region.voxels[at]) continue;
        double grey = middles.voxels[at];
        for (const CorrectionStep& step : steps)
          grey = step.of(grey, static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        corrected.voxels[at] = static_cast<float>(grey);
      }
    }
  }
  return fit_levels(histogram_of(corrected, region)).deviation / out.levels.contrast();
}

/// Returns the edges of a voxel: those that the user gives, otherwise those in the file. Adds a warning if both are
/// known and differ by more than 1 %. \throws InputError if neither is known.
Vec3d spacing_of(const ScanFile& file, const ImageHeader& header, std::vector<std::string>& warnings) {
  const Vec3d own = header.spacing, given = file.spacing;
  if (!(given.x > 0)) {
    std::string notes;
    for (const std::string& note : header.notes) notes += (notes.empty() ? " (" : "; ") + note;
    if (!(own.x > 0))
      throw InputError(file.path.string(), 0, "edge of a voxel",
                       "none in the file" + notes + (notes.empty() ? "" : ")"),
                       "the edge in --voxel, such as \"25 um\"");
    return own;
  }
  const double ratios[3] = {own.x / given.x, own.y / given.y, own.z / given.z};
  if (own.x > 0 && std::ranges::any_of(ratios, [](double ratio) { return !(std::abs(ratio - 1) <= 0.01); })) {
    warnings.push_back(
        fmt::format("the file says that a voxel is {:.6g} x {:.6g} x {:.6g} mm; --voxel takes precedence: {:.6g} x "
                    "{:.6g} x {:.6g} mm",
                    1e3 * own.x, 1e3 * own.y, 1e3 * own.z, 1e3 * given.x, 1e3 * given.y, 1e3 * given.z));
  }
  return given;
}

/// Does the work of segment_file() for an open file.
Segmentation segment_open(ImageSlices& image, const Vec3d& spacing, const ScanFile& file, const SegmentOptions& options,
                          double memory) {
  FineScan fine{image, spacing};
  const std::string name = file.path.string();
  const double whole = bytes_whole(fine, options);
  if (whole <= memory) {
    Image<float> scan = read_image<float>(file.path, file.dataset);
    scan.spacing = fine.spacing;
    return segment_scan(std::move(scan), options);
  }
  if (options.recipe == SegmentRecipe::paper) {
    throw InputError(
        name, 0, "memory", fmt::format("{:.3g} GB", gigabytes(memory)),
        fmt::format("at least {:.3g} GB, because with the recipe \"paper\" the whole scan must fit in memory",
                    gigabytes(whole)));
  }
  fine.block = block_of(fine, name, options, memory);
  CoarseScan coarse = read_coarse(fine, options);
  std::size_t refined = 0;
  const auto refine = [&](Segmentation& out, const Thresholds& thresholds, const std::vector<GrainBox>& boxes,
                          const CorrectionSteps& steps) {
    const double noise = noise_of(coarse.middles, out, steps);
    coarse.middles = {};
    refined = refine_surfaces(fine, out, thresholds, boxes, steps, noise, options);
  };
  Segmentation out = segment_steps(std::move(coarse.means), options, refine);
  out.block = fine.block, out.refined = refined;
  return out;
}

}  // namespace

Segmentation segment_file(const ScanFile& file, const SegmentOptions& options, double memory) {
  const std::unique_ptr<ImageSlices> image = open_image(file.path, file.dataset);
  std::vector<std::string> warnings = image->header().notes;
  const Vec3d spacing = spacing_of(file, image->header(), warnings);
  Segmentation out = segment_open(*image, spacing, file, options, memory);
  out.warnings.insert(out.warnings.begin(), warnings.begin(), warnings.end());
  return out;
}

}  // namespace macadam
