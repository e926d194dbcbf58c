// SPDX-License-Identifier: GPL-3.0-or-later
// grain_surfaces.cpp  Builds a field that is positive within a grain and makes its isosurface. The surface follows the
// grey values next to mastic, and the labels at a cut from a neighbour.
#include "host/tools/ct/grains/grain_surfaces.hpp"

#include <mutex>

#include "kernels/base/parallel.hpp"
#include "host/shapes/surface/convex_hull.hpp"
#include "macadam/error.hpp"
#include "host/tools/ct/voxels/voxel_phases.hpp"

namespace macadam::ct {
namespace {

/// Returns the field of one grain, averaged over blocks of `edge` voxels: the smaller of (grey − threshold)/contrast
/// and a field that is positive where the labels do not belong to another grain. With `paper`, it depends on the labels
/// alone, as in [1].
Image<float> field_of(const Segmentation& scan, const Thresholds& thresholds, std::uint32_t id, const GrainBox& box,
                      std::int64_t edge, bool paper) {
  std::array<std::int64_t, 3> size, first;
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] = box.low[a] - margin * edge;
    size[a] = (box.high[a] + margin * edge - first[a]) / edge + 1;
  }
  const auto step = static_cast<double>(edge);
  const Vec3d spacing = step * scan.labels.spacing;
  const Vec3d origin = scan.labels.centre(first[0], first[1], first[2]) + 0.5 * (spacing - scan.labels.spacing);
  Image<float> grey(size, spacing, origin), own(size, spacing, origin);
  const auto scale = static_cast<float>(1 / scan.levels.contrast()),
             share = 1.0f / static_cast<float>(edge * edge * edge);
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        float sum = 0, mine = 0;
        for (std::int64_t c = 0; c < edge; ++c) {
          for (std::int64_t b = 0; b < edge; ++b) {
            for (std::int64_t a = 0; a < edge; ++a) {
              const std::int64_t x = first[0] + edge * i + a, y = first[1] + edge * j + b, z = first[2] + edge * k + c;
              const bool there = x >= 0 && y >= 0 && z >= 0 && x < scan.labels.size[0] && y < scan.labels.size[1] &&
                                 z < scan.labels.size[2];
              // a grain that the end of the scan or of the specimen cuts is closed there
              if (!there || scan.phases.at(x, y, z) == outside) {
                sum -= 0.5f, mine += 1;
                continue;
              }
              const std::uint32_t label = scan.labels.at(x, y, z);
              const bool foreign = label != id && scan.phases.at(x, y, z) == aggregate;
              const float above = (scan.grey.at(x, y, z) - static_cast<float>(thresholds.aggregate)) * scale;
              // A cut between labels has steps of one voxel. If nodes are voxels, even_out(own) below smooths these
              // steps. If nodes are blocks of voxels, the average over a block smooths them.
              if (paper || (foreign && edge > 1)) {
                sum += label == id ? 0.5f : -0.5f;
              } else {
                sum += std::clamp(above, -0.5f, 0.5f);
              }
              mine += !foreign;
            }
          }
        }
        grey.at(i, j, k) = sum * share;
        own.at(i, j, k) = mine * share - 0.5f;
      }
    }
  }
  if (edge == 1 && !paper) even_out(own);
  for (std::size_t n = 0; n < grey.count(); ++n) grey.voxels[n] = std::min(grey.voxels[n], own.voxels[n]);
  close_ends(grey);
  return grey;
}

/// Replaces a surface of voxels as [1], section 3.2.1, does: by the boundary of the Delaunay triangulation of its
/// points, which is their convex hull.
Surface rebuilt(const Surface& surface) {
  Surface hull{surface.name, {}, convex_hull(surface.points)};
  std::vector<std::int32_t> number(surface.points.size(), -1);
  for (auto& facet : hull.facets) {
    for (std::int32_t& corner : facet) {
      std::int32_t& n = number[static_cast<std::size_t>(corner)];
      if (n < 0) {
        n = static_cast<std::int32_t>(hull.points.size());
        hull.points.push_back(surface.points[static_cast<std::size_t>(corner)]);
      }
      corner = n;
    }
  }
  return hull;
}

}  // namespace

void even_out(Image<float>& field) {
  const std::int64_t steps[3] = {1, field.size[0], field.size[0] * field.size[1]};
  std::vector<float> from;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    from = field.voxels;
    for (std::int64_t k = 0; k < field.size[2]; ++k) {
      for (std::int64_t j = 0; j < field.size[1]; ++j) {
        for (std::int64_t i = 0; i < field.size[0]; ++i) {
          const std::int64_t at[3] = {i, j, k};
          const auto here = static_cast<std::int64_t>(field.index(i, j, k));
          const auto low = static_cast<std::size_t>(at[axis] > 0 ? here - steps[axis] : here);
          const auto high = static_cast<std::size_t>(at[axis] + 1 < field.size[axis] ? here + steps[axis] : here);
          field.voxels[static_cast<std::size_t>(here)] =
              0.25f * (from[low] + 2 * from[static_cast<std::size_t>(here)] + from[high]);
        }
      }
    }
  }
}

void close_ends(Image<float>& field) {
  const auto& size = field.size;
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        if (i == 0 || j == 0 || k == 0 || i + 1 == size[0] || j + 1 == size[1] || k + 1 == size[2])
          field.at(i, j, k) = std::min(field.at(i, j, k), -0.5f);
      }
    }
  }
}

Simplified fit_surface(const Surface& fine, const SegmentOptions& options, double error) {
  const int most = std::max(800, options.facets);
  Simplified out;
  for (const int facets : {options.facets, most, 2 * most}) {
    out = simplified(fine, facets, std::max(facets, most), error);
    if (check_surface(out.surface).good()) return out;
  }
  // repair_surface() may wrap the grain in a new surface, which is better than losing the grain
  out.surface = repair_surface(out.surface, nullptr, {}, true);
  return out;
}

std::vector<GrainBox> boxes_of(const Image<std::uint32_t>& labels, const Image<std::uint8_t>& phases,
                               const Image<std::uint8_t>& confidence) {
  const std::uint32_t most = *std::max_element(labels.voxels.begin(), labels.voxels.end());
  std::vector<GrainBox> boxes(most + 1);
  const auto [nx, ny, nz] = labels.size;
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        const std::size_t at = labels.index(i, j, k);
        if (labels.voxels[at] == 0) continue;
        GrainBox& box = boxes[labels.voxels[at]];
        const std::array here{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          box.low[a] = box.voxels == 0 ? here[a] : std::min(box.low[a], here[a]);
          box.high[a] = box.voxels == 0 ? here[a] : std::max(box.high[a], here[a]);
          box.border = box.border || here[a] == 0 || here[a] + 1 == labels.size[a];
        }
        ++box.voxels;
        box.confidence += confidence.voxels[at] / 255.0;
        // at the specimen's end a voxel that is partly air may look like mastic, so voxels up to two steps away are
        // checked
        for (std::size_t a = 0; a < 3 && !box.border; ++a) {
          for (const std::int64_t step : {-2, -1, 1, 2}) {
            std::array<std::int64_t, 3> there = here;
            there[a] += step;
            if (there[a] < 0 || there[a] >= labels.size[a]) continue;
            box.border = box.border || phases.at(there[0], there[1], there[2]) == outside;
          }
        }
      }
    }
  }
  return boxes;
}

std::vector<ScannedGrain> surfaces_of(const Segmentation& scan, const Thresholds& thresholds,
                                      const std::vector<GrainBox>& boxes, const SegmentOptions& options,
                                      std::vector<std::string>& warnings, const std::vector<double>& sure) {
  const double voxel = std::cbrt(scan.labels.voxel_volume());
  std::vector<ScannedGrain> grains(boxes.size());
  std::vector<std::string> faults(boxes.size());
  std::size_t done = 0;
  std::mutex mutex;
  for_each_in_parallel(boxes.size(), [&](std::size_t id) {
    const GrainBox& box = boxes[id];
    if (box.voxels == 0) return;
    const std::int64_t edge = std::max<std::int64_t>(1, box.middle_side() / across);
    const bool paper = options.recipe == SegmentRecipe::paper;
    try {
      const Surface fine = isosurface(field_of(scan, thresholds, static_cast<std::uint32_t>(id), box, edge, paper));
      if (fine.facets.empty()) throw RunError("the grey values around the grain enclose no volume");
      ScannedGrain grain;
      // largest error: half the node spacing of the field from which the surface is made
      Simplified fewer = fit_surface(fine, options, 0.5 * voxel * static_cast<double>(edge));
      grain.surface = paper ? rebuilt(fewer.surface) : std::move(fewer.surface);
      grain.surface.name = fmt::format("grain_{:04}", id);
      grain.surface_error = fewer.error;
      grain.measure = measure_shape(grain.surface);
      grain.sieve = square_sieve(grain.surface);
      grain.id = static_cast<std::uint32_t>(id);
      grain.border = box.border;
      grain.confidence = box.confidence / static_cast<double>(box.voxels) * (sure.empty() ? 1 : sure.at(id));
      grains[id] = std::move(grain);
    } catch (const Error& error) { faults[id] = fmt::format("grain {} has no surface: {}", id, error.what()); }
    const std::lock_guard lock(mutex);
    ++done;
    if (options.progress) options.progress("surfaces", static_cast<double>(done) / static_cast<double>(boxes.size()));
  });
  for (const std::string& fault : faults) {
    if (!fault.empty()) warnings.push_back(fault);
  }
  std::erase_if(grains, [](const ScannedGrain& g) { return g.id == 0; });
  return grains;
}

}  // namespace macadam::ct
