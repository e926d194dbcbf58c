// SPDX-License-Identifier: GPL-3.0-or-later
// coarse_scan.cpp  Computes the means of blocks of voxels, one layer of blocks after the other.
#include "host/tools/ct/segment/coarse_scan.hpp"

#include "kernels/base/parallel.hpp"

namespace macadam::ct {

std::int64_t FineScan::slab() const {
  const auto [nx, ny, nz] = file.header().size;
  constexpr std::int64_t voxels = 1 << 20;
  return std::min(std::max<std::int64_t>(1, voxels / (nx * ny * block)), (nz + block - 1) / block) * block;
}

CoarseScan read_coarse(const FineScan& scan, const SegmentOptions& options) {
  const ImageHeader& header = scan.file.header();
  const std::int64_t n = scan.block, nx = header.size[0], ny = header.size[1];
  const std::array<std::int64_t, 3> size{nx / n, ny / n, header.size[2] / n};
  const Vec3d spacing = static_cast<double>(n) * scan.spacing, origin = header.origin + 0.5 * (spacing - scan.spacing);
  CoarseScan out{Image<float>(size, spacing, origin), Image<float>(size, spacing, origin)};
  const std::int64_t slab = scan.slab();
  std::vector<float> voxels(static_cast<std::size_t>(nx * ny * slab));
  const float share = 1.0f / static_cast<float>(n * n * n);
  for (std::int64_t first = 0; first < size[2] * n; first += slab) {
    if (options.progress) options.progress("reading", static_cast<double>(first) / static_cast<double>(header.size[2]));
    const std::int64_t slices = std::min(slab, size[2] * n - first);
    scan.file.read(first, slices, voxels.data());
    for_each_in_parallel(static_cast<std::size_t>(slices / n * size[1]), [&](std::size_t row) {
      const std::int64_t j = static_cast<std::int64_t>(row) % size[1], layer = static_cast<std::int64_t>(row) / size[1];
      float* mean = &out.means.at(0, j, first / n + layer);
      for (std::int64_t c = 0; c < n; ++c) {
        for (std::int64_t b = 0; b < n; ++b) {
          const float* from = &voxels[static_cast<std::size_t>(nx * (j * n + b + ny * (layer * n + c)))];
          for (std::int64_t i = 0; i < size[0]; ++i) {
            float sum = 0;
            for (std::int64_t a = 0; a < n; ++a) sum += from[i * n + a];
            mean[i] += share * sum;
            if (c == n / 2 && b == n / 2) out.middles.at(i, j, first / n + layer) = from[i * n + n / 2];
          }
        }
      }
    });
  }
  return out;
}

}  // namespace macadam::ct
