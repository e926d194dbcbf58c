// SPDX-License-Identifier: GPL-3.0-or-later
// labels.cpp  Transfers labels from the grid on which grains were separated to the grid of the scan.
#include "host/tools/ct/grains/labels.hpp"

#include "kernels/base/parallel.hpp"
#include "host/tools/ct/voxels/voxel_phases.hpp"

namespace macadam::ct {
Image<std::uint32_t> spread(const Image<std::uint8_t>& phases, const Image<std::uint32_t>& coarse, std::int64_t edge) {
  Image<std::uint32_t> labels = Image<std::uint32_t>::like(phases);
  const auto [nx, ny, nz] = labels.size;
  for_each_in_parallel(static_cast<std::size_t>(nz), [&, nx = nx, ny = ny](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    if (k / edge >= coarse.size[2]) return;
    for (std::int64_t j = 0; j < ny && j / edge < coarse.size[1]; ++j) {
      for (std::int64_t i = 0; i < nx && i / edge < coarse.size[0]; ++i) {
        const std::size_t at = labels.index(i, j, k);
        if (phases.voxels[at] == aggregate) labels.voxels[at] = coarse.at(i / edge, j / edge, k / edge);
      }
    }
  });
  std::vector<std::size_t> front, next;
  const auto around = [&, nx = nx, ny = ny, nz = nz](std::size_t at, auto&& see) {
    const auto n = static_cast<std::int64_t>(at);
    const std::int64_t i = n % nx, j = n / nx % ny, k = n / (nx * ny);
    if (i > 0) see(at - 1);
    if (i + 1 < nx) see(at + 1);
    if (j > 0) see(at - static_cast<std::size_t>(nx));
    if (j + 1 < ny) see(at + static_cast<std::size_t>(nx));
    if (k > 0) see(at - static_cast<std::size_t>(nx * ny));
    if (k + 1 < nz) see(at + static_cast<std::size_t>(nx * ny));
  };
  const auto open = [&](std::size_t at) { return labels.voxels[at] == 0 && phases.voxels[at] == aggregate; };
  for (std::size_t at = 0; at < labels.count(); ++at) {
    if (labels.voxels[at] == 0) continue;
    bool edge_voxel = false;
    around(at, [&](std::size_t near) { edge_voxel = edge_voxel || open(near); });
    if (edge_voxel) front.push_back(at);
  }
  while (!front.empty()) {
    next.clear();
    for (const std::size_t at : front) {
      around(at, [&](std::size_t near) {
        if (!open(near)) return;
        labels.voxels[near] = labels.voxels[at];
        next.push_back(near);
      });
    }
    std::swap(front, next);
  }
  return labels;
}

std::vector<std::uint32_t> drop_small(Image<std::uint32_t>& labels, double least) {
  std::vector<std::int64_t> voxels;
  for (const std::uint32_t label : labels.voxels) {
    if (label >= voxels.size()) voxels.resize(label + 1);
    ++voxels[label];
  }
  std::vector<std::uint32_t> number(voxels.size());
  std::uint32_t next = 1;
  for (std::size_t n = 1; n < voxels.size(); ++n) {
    if (static_cast<double>(voxels[n]) * labels.voxel_volume() >= least) number[n] = next++;
  }
  for (std::uint32_t& label : labels.voxels) label = number[label];
  return number;
}

void count_shares(Segmentation& out) {
  std::array<std::int64_t, 256> count{};
  double confidence = 0;
  for (std::size_t i = 0; i < out.phases.count(); ++i) {
    ++count[out.phases.voxels[i]];
    if (out.phases.voxels[i] != outside) confidence += out.confidence.voxels[i] / 255.0;
  }
  const auto all = static_cast<double>(static_cast<std::int64_t>(out.phases.count()) - count[outside]);
  out.air_voids = static_cast<double>(count[air]) / all;
  out.aggregate = static_cast<double>(count[aggregate]) / all;
  out.mastic = 1 - out.air_voids - out.aggregate;
  out.confidence_mean = confidence / all;
}

double least_volume(const SegmentOptions& options) {
  return std::numbers::pi / 6 * std::pow(0.5 * options.smallest, 3);
}

}  // namespace macadam::ct
