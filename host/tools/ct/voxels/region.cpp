// SPDX-License-Identifier: GPL-3.0-or-later
// region.cpp  Finds the specimen's outline from the columns and slices that contain material.
#include "host/tools/ct/voxels/region.hpp"

#include "host/tools/ct/voxels/grey_levels.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// The outline of the specimen: columns of voxels, and a range of slices.
struct Outline {
  std::vector<std::uint8_t> columns;  ///< one per column of voxels; 1: within the specimen
  std::int64_t bottom = 0, top = 0;   ///< slices [bottom, top)
};

/// Sets the ends of the specimen: the longest sequence of slices that each contain at least half as much material as
/// the fullest slice.
void find_ends(const std::vector<double>& share, Outline& outline) {
  const double half = 0.5 * *std::max_element(share.begin(), share.end());
  const auto n = static_cast<std::int64_t>(share.size());
  for (std::int64_t from = 0; from < n; ++from) {
    std::int64_t to = from;
    while (to < n && share[static_cast<std::size_t>(to)] >= half) ++to;
    if (to - from > outline.top - outline.bottom) outline.bottom = from, outline.top = to;
    from = std::max(from, to);
  }
}

/// Fills gaps: a column belongs to the specimen if it lies between the first and the last column with material, both
/// along x and along y, because air between them is inside the specimen.
void close_gaps(std::vector<std::uint8_t>& columns, std::int64_t nx, std::int64_t ny) {
  std::vector<std::uint8_t> along_x(columns.size()), along_y(columns.size());
  const auto fill = [&](std::int64_t first, std::int64_t step, std::int64_t n, std::vector<std::uint8_t>& out) {
    std::int64_t low = 0, high = n - 1;
    while (low < n && !columns[static_cast<std::size_t>(first + step * low)]) ++low;
    while (high > low && !columns[static_cast<std::size_t>(first + step * high)]) --high;
    for (std::int64_t i = low; i <= high && low < n; ++i) out[static_cast<std::size_t>(first + step * i)] = 1;
  };
  for (std::int64_t j = 0; j < ny; ++j) fill(j * nx, 1, nx, along_x);
  for (std::int64_t i = 0; i < nx; ++i) fill(i, nx, ny, along_y);
  for (std::size_t c = 0; c < columns.size(); ++c) columns[c] = along_x[c] && along_y[c];
}

}  // namespace

Image<std::uint8_t> find_region(const Image<float>& scan, ScanRegion kind) {
  Image<std::uint8_t> region = Image<std::uint8_t>::like(scan, 1);
  const Histogram h = histogram_of(scan, region);
  if (kind == ScanRegion::whole) return region;
  const auto [nx, ny, nz] = scan.size;
  const double air = otsu(h, 0, h.counts.size());
  Outline outline;
  outline.columns.resize(static_cast<std::size_t>(nx * ny));
  std::vector<double> in_slice(static_cast<std::size_t>(nz));
  std::vector<std::int64_t> in_column(outline.columns.size());
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t c = 0; c < nx * ny; ++c) {
      if (scan.voxels[static_cast<std::size_t>(c + nx * ny * k)] > air)
        ++in_column[static_cast<std::size_t>(c)], ++in_slice[static_cast<std::size_t>(k)];
    }
  }
  // Voxels brighter than Otsu's threshold are material. A column belongs to the specimen if its number of material
  // voxels is more than 0.15 times the number in the fullest column. Columns of the specimen reach this number despite
  // voids and dark mastic; columns of the surroundings do not.
  find_ends(in_slice, outline);
  const double fullest = static_cast<double>(*std::max_element(in_column.begin(), in_column.end()));
  if (fullest <= 0) throw InputError("the scan", 0, "specimen", "none", "a region brighter than its surroundings");
  std::size_t inside = 0;
  for (std::size_t c = 0; c < in_column.size(); ++c)
    outline.columns[c] = static_cast<double>(in_column[c]) > 0.15 * fullest;
  close_gaps(outline.columns, nx, ny);
  double x = 0, y = 0;
  std::int64_t low_x = nx, high_x = -1, low_y = ny, high_y = -1;
  for (std::int64_t j = 0; j < ny; ++j) {
    for (std::int64_t i = 0; i < nx; ++i) {
      if (!outline.columns[static_cast<std::size_t>(i + nx * j)]) continue;
      ++inside, x += static_cast<double>(i), y += static_cast<double>(j);
      low_x = std::min(low_x, i), high_x = std::max(high_x, i), low_y = std::min(low_y, j),
      high_y = std::max(high_y, j);
    }
  }
  const auto n = static_cast<double>(inside);
  x /= n, y /= n;
  const double filled = n / static_cast<double>((high_x - low_x + 1) * (high_y - low_y + 1));
  if (kind == ScanRegion::found) {
    // a circle fills π/4 = 0.785 of its bounding box
    kind = filled > 0.95                     ? ScanRegion::prism
           : std::abs(filled - 0.785) < 0.03 ? ScanRegion::cylinder
                                             : ScanRegion::found;
    if (filled > 0.95 && n > 0.97 * static_cast<double>(nx * ny)) kind = ScanRegion::whole;
  }
  const double radius2 = n / std::numbers::pi;
  for_each_in_parallel(static_cast<std::size_t>(nz), [&, nx = nx, ny = ny](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    const bool between = k >= outline.bottom && k < outline.top;
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        bool in = outline.columns[static_cast<std::size_t>(i + nx * j)] != 0;
        const double dx = static_cast<double>(i) - x, dy = static_cast<double>(j) - y;
        if (kind == ScanRegion::cylinder) in = dx * dx + dy * dy <= radius2;
        if (kind == ScanRegion::prism) in = i >= low_x && i <= high_x && j >= low_y && j <= high_y;
        if (kind == ScanRegion::whole) in = true;
        region.at(i, j, k) = in && between;
      }
    }
  });
  return region;
}

Image<std::uint8_t> take_region(const Image<float>& scan, const GivenRegion& given) {
  Image<std::uint8_t> region = Image<std::uint8_t>::like(scan);
  const Vec3d axis = 0.5 * (given.low + given.high);
  const double radius = 0.5 * (given.high.x - given.low.x);
  for_each_in_parallel(static_cast<std::size_t>(scan.size[2]), [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < scan.size[1]; ++j) {
      for (std::int64_t i = 0; i < scan.size[0]; ++i) {
        const Vec3d p = scan.centre(i, j, k);
        const bool between = p.z >= given.low.z && p.z <= given.high.z;
        region.at(i, j, k) = between && (given.cylinder ? std::hypot(p.x - axis.x, p.y - axis.y) <= radius
                                                        : p.x >= given.low.x && p.x <= given.high.x &&
                                                              p.y >= given.low.y && p.y <= given.high.y);
      }
    }
  });
  if (std::find(region.voxels.begin(), region.voxels.end(), 1) == region.voxels.end()) {
    const Vec3d end = scan.centre(scan.size[0] - 1, scan.size[1] - 1, scan.size[2] - 1);
    throw InputError(
        "the scan", 0, "voxels within the region", "none",
        fmt::format("at least one; the scan reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) mm",
                    1e3 * scan.origin.x, 1e3 * scan.origin.y, 1e3 * scan.origin.z, 1e3 * end.x, 1e3 * end.y,
                    1e3 * end.z));
  }
  return region;
}

}  // namespace macadam::ct
