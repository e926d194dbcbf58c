// SPDX-License-Identifier: GPL-3.0-or-later
// refine.cpp  Reads the file slab by slab and adds each slab to the nodes of the grains that it intersects. A
// grain's surface is made when the last slab that intersects the grain has been read.
#include "host/tools/ct/segment/refine.hpp"

#include "host/tools/ct/voxels/smoothing.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// The nodes of a grain's surface field. Each node is the mean of a cube of `edge` voxels of the file.
struct Nodes {
  std::size_t grain = 0;  ///< index in the list of grains
  GrainBox box;           ///< bounding box in blocks of the coarse grid
  std::int64_t edge = 1;
  std::array<std::int64_t, 3> first{}, size{};  ///< first voxel, and number of nodes, along each axis
  Image<float> sum;                             ///< sum of the voxels of each node; empty before the first slab and
                                                ///< after the last
  std::int64_t end() const { return first[2] + edge * size[2]; }
};

/// Returns the nodes for a grain. About `across` nodes lie along the intermediate side of the grain, and there is a
/// margin around it.
Nodes nodes_of(std::size_t grain, const GrainBox& box, const FineScan& scan) {
  Nodes nodes{grain, box, std::max<std::int64_t>(1, scan.block * box.middle_side() / across), {}, {}, {}};
  for (std::size_t a = 0; a < 3; ++a) {  // a surface may lie up to one block outside the labels
    nodes.first[a] = scan.block * (box.low[a] - 1) - margin * nodes.edge;
    nodes.size[a] = (scan.block * (box.high[a] + 2) + margin * nodes.edge - nodes.first[a]) / nodes.edge + 1;
  }
  return nodes;
}

/// Adds the voxels of slices [from, to) to the sums of a grain's nodes.
void add(Nodes& nodes, const std::vector<float>& slab, std::int64_t from, std::int64_t to, const ImageHeader& header) {
  if (nodes.sum.count() == 0) nodes.sum = Image<float>(nodes.size, {1, 1, 1});
  const auto [nx, ny, nz] = header.size;
  const std::int64_t e = nodes.edge, first = nodes.first[0];
  for (std::int64_t z = std::max(from, nodes.first[2]); z < std::min(to, nodes.end()); ++z) {
    for (std::int64_t y = std::max<std::int64_t>(0, nodes.first[1]);
         y < std::min(ny, nodes.first[1] + e * nodes.size[1]); ++y) {
      const float* row = &slab[static_cast<std::size_t>(nx * (y + ny * (z - from)))];
      float* sum = &nodes.sum.at(0, (y - nodes.first[1]) / e, (z - nodes.first[2]) / e);
      for (std::int64_t i = 0; i < nodes.size[0]; ++i) {
        const std::int64_t x = std::max<std::int64_t>(0, first + e * i), end = std::min(nx, first + e * (i + 1));
        for (std::int64_t v = x; v < end; ++v) sum[i] += row[v];
      }
    }
  }
}

/// Two fields on the coarse grid around a grain: `own` is positive except in aggregate that does not belong to the
/// grain, `inside` is positive within the specimen. The grain's surface must stay where both are positive.
struct Around {
  Image<float> own, inside;
  std::array<std::int64_t, 3> first{};
};

/// Computes the fields `own` and `inside` around grain `id` and smooths both.
Around around(const Segmentation& out, std::uint32_t id, const GrainBox& box) {
  constexpr std::int64_t ring = 3;
  Around a;
  std::array<std::int64_t, 3> size;
  for (std::size_t c = 0; c < 3; ++c) a.first[c] = box.low[c] - ring, size[c] = box.high[c] - box.low[c] + 1 + 2 * ring;
  a.own = Image<float>(size, {1, 1, 1}, {}, 0.5f), a.inside = Image<float>(size, {1, 1, 1}, {}, -0.5f);
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const std::array<std::int64_t, 3> place{a.first[0] + i, a.first[1] + j, a.first[2] + k};
        auto near = place;  // the nearest place inside the scan
        for (std::size_t c = 0; c < 3; ++c) near[c] = std::clamp<std::int64_t>(place[c], 0, out.labels.size[c] - 1);
        const auto phase = static_cast<VoxelPhase>(out.phases.at(near[0], near[1], near[2]));
        // `inside` stays positive beyond the end of the scan, because the grey values already end the grain exactly
        // there. Labels are continued beyond the end, so a cut between two grains continues too.
        if (phase != VoxelPhase::outside || near != place) a.inside.at(i, j, k) = 0.5f;
        if (phase == VoxelPhase::aggregate && out.labels.at(near[0], near[1], near[2]) != id) a.own.at(i, j, k) = -0.5f;
      }
    }
  }
  even_out(a.own), even_out(a.inside);
  return a;
}

/// Returns the trilinear interpolation of a field at (i, j, k).
float between(const Image<float>& field, double i, double j, double k) {
  std::int64_t low[3];
  double share[3];
  const double at[3] = {i, j, k};
  for (std::size_t a = 0; a < 3; ++a) {
    const double in = std::clamp(at[a], 0.0, static_cast<double>(field.size[a] - 1));
    low[a] = std::min(static_cast<std::int64_t>(in), field.size[a] - 2);
    share[a] = in - static_cast<double>(low[a]);
  }
  double sum = 0;
  for (std::int64_t c = 0; c < 8; ++c) {
    const std::int64_t x = c & 1, y = c >> 1 & 1, z = c >> 2;
    sum += (x ? share[0] : 1 - share[0]) * (y ? share[1] : 1 - share[1]) * (z ? share[2] : 1 - share[2]) *
           field.at(low[0] + x, low[1] + y, low[2] + z);
  }
  return static_cast<float>(sum);
}

/// Makes the new surface of a grain from the sums of its nodes.
struct Refiner {
  const FineScan& scan;
  const Segmentation& out;
  const Thresholds& thresholds;
  const CorrectionSteps& steps;
  double noise;
  const SegmentOptions& options;

  /// Returns the field whose zero level is the grain's surface, from the sums of its nodes. Clears the sums.
  Image<float> field_of(Nodes& nodes) const {
    const auto e = static_cast<double>(nodes.edge);
    const ImageHeader& header = scan.file.header();
    Image<float> field = std::move(nodes.sum);
    nodes.sum = {};
    field.spacing = e * scan.spacing;
    const auto middle = [&](std::size_t axis, std::int64_t node) {  // middle of a node [voxels]
      return static_cast<double>(nodes.first[axis] + nodes.edge * node) + 0.5 * (e - 1);
    };
    field.origin = header.origin +
                   Vec3d{scan.spacing.x * middle(0, 0), scan.spacing.y * middle(1, 0), scan.spacing.z * middle(2, 0)};
    // number of voxels of the scan in a node along an axis
    const auto voxels = [&](std::size_t axis, std::int64_t node) {
      const std::int64_t low = nodes.first[axis] + nodes.edge * node;
      return std::max<std::int64_t>(0, std::min(header.size[axis], low + nodes.edge) - std::max<std::int64_t>(0, low));
    };
    const Around near = around(out, out.grains[nodes.grain].id, nodes.box);
    Image<float> most = Image<float>::like(field);
    for (std::int64_t k = 0; k < field.size[2]; ++k) {
      for (std::int64_t j = 0; j < field.size[1]; ++j) {
        for (std::int64_t i = 0; i < field.size[0]; ++i) {
          const double x = scan.in_blocks(middle(0, i)), y = scan.in_blocks(middle(1, j)),
                       z = scan.in_blocks(middle(2, k));
          const std::int64_t count = voxels(0, i) * voxels(1, j) * voxels(2, k);
          float& value = field.at(i, j, k);
          double grey = count > 0 ? value / static_cast<double>(count) : out.levels.mastic;
          if (count > 0)
            for (const CorrectionStep& step : steps) grey = step.of(grey, x, y, z);
          value = static_cast<float>((grey - thresholds.aggregate) / out.levels.contrast());
          const double a = x - static_cast<double>(near.first[0]), b = y - static_cast<double>(near.first[1]),
                       c = z - static_cast<double>(near.first[2]);
          most.at(i, j, k) = std::min(between(near.own, a, b, c), between(near.inside, a, b, c));
        }
      }
    }
    // The more noise, the more diffusion steps, as in segment_scan(), where each node is a single voxel.
    const int rounds = std::clamp(static_cast<int>(std::lround(40 * noise / std::pow(e, 1.5))), 0, 8);
    if (options.denoising != Denoising::none) diffuse(field, 0.3, rounds);
    for (std::size_t n = 0; n < field.count(); ++n)
      field.voxels[n] = std::min(std::clamp(field.voxels[n], -0.5f, 0.5f), most.voxels[n]);
    close_ends(field);
    return field;
  }

  /// Returns the grain with its new surface; nothing if the surface cannot be made.
  std::optional<ScannedGrain> refined(Nodes& nodes) const {
    try {
      const Image<float> field = field_of(nodes);
      const Surface fine = isosurface(field);
      if (fine.facets.empty()) return {};
      ScannedGrain grain = out.grains[nodes.grain];
      Simplified fewer = fit_surface(fine, options, 0.5 * std::cbrt(field.voxel_volume()));
      fewer.surface.name = grain.surface.name;
      grain.surface = std::move(fewer.surface);
      grain.surface_error = fewer.error;
      grain.measure = measure_shape(grain.surface);
      grain.sieve = square_sieve(grain.surface);
      return grain;
    } catch (const Error&) { return {}; }
  }
};

}  // namespace

std::size_t refine_surfaces(const FineScan& scan, Segmentation& out, const Thresholds& thresholds,
                            const std::vector<GrainBox>& boxes, const CorrectionSteps& steps, double noise,
                            const SegmentOptions& options) {
  const Refiner refiner{scan, out, thresholds, steps, noise, options};
  std::vector<Nodes> waiting;
  for (std::size_t g = 0; g < out.grains.size(); ++g) {
    const GrainBox& box = boxes[out.grains[g].id];
    if (box.middle_side() < across) waiting.push_back(nodes_of(g, box, scan));
  }
  const std::size_t all = waiting.size();
  const ImageHeader& header = scan.file.header();
  const std::int64_t slab = scan.slab(), slices = header.size[2];
  std::vector<float> voxels(static_cast<std::size_t>(header.size[0] * header.size[1] * slab));
  std::size_t made = 0;
  for (std::int64_t from = 0; from < slices && !waiting.empty(); from += slab) {
    if (options.progress)
      options.progress("refining", static_cast<double>(all - waiting.size()) / static_cast<double>(all));
    const std::int64_t to = std::min(slices, from + slab);
    std::vector<Nodes*> here, done;
    for (Nodes& nodes : waiting) {
      if (nodes.first[2] < to && nodes.end() > from) here.push_back(&nodes);
      if (nodes.end() <= to || to == slices) done.push_back(&nodes);
    }
    if (here.empty()) continue;
    scan.file.read(from, to - from, voxels.data());
    for_each_in_parallel(here.size(), [&](std::size_t n) { add(*here[n], voxels, from, to, header); });
    std::vector<std::optional<ScannedGrain>> grains(done.size());
    for_each_in_parallel(done.size(), [&](std::size_t n) { grains[n] = refiner.refined(*done[n]); });
    for (std::size_t n = 0; n < done.size(); ++n) {
      if (!grains[n]) continue;
      out.grains[done[n]->grain] = std::move(*grains[n]);
      ++made;
    }
    std::erase_if(waiting, [&](const Nodes& nodes) { return nodes.end() <= to || to == slices; });
  }
  return made;
}

}  // namespace macadam::ct
