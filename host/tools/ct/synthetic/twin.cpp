// SPDX-License-Identifier: GPL-3.0-or-later
// twin.cpp  Makes a specimen from a scan: grains and voids become spheres at their positions, mastic is packed around
// them.
#include "macadam/twin.hpp"

#include <fmt/format.h>

#include <map>
#include <numbers>
#include <tuple>

#include "host/tools/ct/synthetic/grain_files.hpp"
#include "host/tools/ct/synthetic/void_spheres.hpp"
#include "host/network/clusters.hpp"
#include "kernels/base/parallel.hpp"
#include "host/shapes/fill/fill.hpp"
#include "host/specimen/composition.hpp"
#include "host/specimen/mastic.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t placement_stream = 2;  // same number as in generate.cpp
// Largest fraction of the voxels of a box that may be outside the specimen. Partly filled voxels at its sides may count
// as outside.
constexpr double most_outside = 0.01;

double radius_of(double volume) { return std::cbrt(volume * 3 / (4 * std::numbers::pi)); }

/// A range of voxels: first one, and one past the last, along each axis.
struct Range {
  std::array<std::int64_t, 3> begin{}, end{};
};

/// Returns the bounding range of the voxels that are not outside the specimen. \throws InputError if all voxels are
/// outside.
Range extent_of(const Image<std::uint8_t>& phases, const fs::path& folder) {
  Range out{phases.size, {0, 0, 0}};
  const auto outside = static_cast<std::uint8_t>(VoxelPhase::outside);
  for (std::int64_t k = 0; k < phases.size[2]; ++k) {
    for (std::int64_t j = 0; j < phases.size[1]; ++j) {
      for (std::int64_t i = 0; i < phases.size[0]; ++i) {
        if (phases.at(i, j, k) == outside) continue;
        const std::array<std::int64_t, 3> at{i, j, k};
        for (std::size_t a = 0; a < 3; ++a)
          out.begin[a] = std::min(out.begin[a], at[a]), out.end[a] = std::max(out.end[a], at[a] + 1);
      }
    }
  }
  if (out.end[0] == 0)
    throw InputError((folder / "phases.mha").string(), 0, "voxels of a specimen", "none", "at least one");
  return out;
}

/// Returns the range of the voxels whose centres are in a box. \throws InputError if it is empty or exceeds the image.
Range voxels_in(const std::array<Vec3d, 2>& box, const Image<std::uint8_t>& phases) {
  const Vec3d a = box[0] - phases.origin, b = box[1] - phases.origin;
  const auto first = [](double at, double edge) { return static_cast<std::int64_t>(std::ceil(at / edge - 1e-9)); };
  const Vec3d& s = phases.spacing;
  Range out{{first(a.x, s.x), first(a.y, s.y), first(a.z, s.z)}, {first(b.x, s.x), first(b.y, s.y), first(b.z, s.z)}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (out.begin[k] < 0 || out.end[k] > phases.size[k] || out.begin[k] >= out.end[k])
      throw InputError("twin", 0, "box", fmt::format("voxels {} to {} along {}", out.begin[k], out.end[k], "xyz"[k]),
                       fmt::format("at least one voxel, and only voxels of the image, which has {} along this axis",
                                   phases.size[k]));
  }
  return out;
}

template <class T>
Image<T> cropped(const Image<T>& image, const Range& r) {
  Image<T> out({r.end[0] - r.begin[0], r.end[1] - r.begin[1], r.end[2] - r.begin[2]}, image.spacing,
               image.centre(r.begin[0], r.begin[1], r.begin[2]));
  for (std::int64_t k = 0; k < out.size[2]; ++k)
    for (std::int64_t j = 0; j < out.size[1]; ++j)
      for (std::int64_t i = 0; i < out.size[0]; ++i)
        out.at(i, j, k) = image.at(r.begin[0] + i, r.begin[1] + j, r.begin[2] + k);
  return out;
}

/// The part of a grain that is within the box.
struct Part {
  double volume = 0;  ///< [m³]
  Vec3d centroid{};   ///< [m]
};

/// Returns the part of each grain, by its label.
std::map<std::uint32_t, Part> parts_of(const Image<std::uint32_t>& labels) {
  std::map<std::uint32_t, Part> out;
  for (std::int64_t k = 0; k < labels.size[2]; ++k) {
    for (std::int64_t j = 0; j < labels.size[1]; ++j) {
      for (std::int64_t i = 0; i < labels.size[0]; ++i) {
        if (labels.at(i, j, k) == 0) continue;
        Part& part = out[labels.at(i, j, k)];
        part.volume += labels.voxel_volume();
        part.centroid += labels.voxel_volume() * labels.centre(i, j, k);
      }
    }
  }
  for (auto& [id, part] : out) part.centroid = (1 / part.volume) * part.centroid;
  return out;
}

/// The box, and the part of the scan within it.
struct Cut {
  Image<std::uint8_t> phases;
  Image<std::uint32_t> labels;
  /// Lower corner of the box in the scan's coordinates [m].
  Vec3d corner{};
  Box box;
};

/// Reads the scan of a folder and cuts out the box. \throws InputError if more than 1 % of its voxels are outside the
/// specimen.
Cut cut_out(const fs::path& folder, const TwinSpec& spec) {
  Cut out;
  out.phases = read_image<std::uint8_t>(folder / "phases.mha");
  out.labels = read_image<std::uint32_t>(folder / "labels.mha");
  if (out.labels.size != out.phases.size)
    throw InputError((folder / "labels.mha").string(), 0, "voxels", fmt::format("{}", out.labels.count()),
                     fmt::format("{}, as in phases.mha", out.phases.count()));
  const Range range = spec.box ? voxels_in(*spec.box, out.phases) : extent_of(out.phases, folder);
  out.phases = cropped(out.phases, range);
  out.labels = cropped(out.labels, range);
  const Vec3d& s = out.phases.spacing;
  const auto& n = out.phases.size;
  out.corner = spec.box ? (*spec.box)[0] : out.phases.origin - 0.5 * s;
  out.box.size = spec.box ? (*spec.box)[1] - (*spec.box)[0]
                          : Vec3d{s.x * static_cast<double>(n[0]), s.y * static_cast<double>(n[1]),
                                  s.z * static_cast<double>(n[2])};
  const auto outside =
      std::count(out.phases.voxels.begin(), out.phases.voxels.end(), static_cast<std::uint8_t>(VoxelPhase::outside));
  const double share = static_cast<double>(outside) / static_cast<double>(out.phases.count());
  if (share > most_outside)
    throw InputError((folder / "phases.mha").string(), 0, "voxels of the box outside of the specimen",
                     fmt::format("{:.2g} %", 100 * share), "less than 1 %, so that the box lies within the specimen");
  return out;
}

/// Returns the spheres of a grain in the frame of the box. The spheres fill the grain's surface; spheres whose centres
/// are outside the box or closer to its sides than a tenth of their radius are left out. A grain without a surface
/// file, or in a scene without shapes, becomes one sphere of its volume in the box.
MultiSphere spheres_of(std::uint32_t id, const Part& part, const Cut& cut, const fs::path& folder,
                       const SpecimenSpec& how, std::uint64_t seed) {
  fs::path file = folder / ct::whole_grains / ct::surface_file(id);
  if (!fs::exists(file)) file = folder / ct::cut_grains / ct::surface_file(id);
  if (!how.shapes || !fs::exists(file)) return {{part.centroid - cut.corner}, {radius_of(part.volume)}};
  FillSpec fill = how.shapes->fill;
  fill.seed = seed * 1'000'003 + id;
  const MultiSphere whole = ShapeFiller(read_surface(file)).fill(1, fill);
  if (whole.size() == 1) return {{part.centroid - cut.corner}, {radius_of(part.volume)}};
  MultiSphere out;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Vec3d p = whole.centre[i] - cut.corner, q = cut.box.size - p;
    if (std::min({p.x, p.y, p.z, q.x, q.y, q.z}) < 0.1 * whole.radius[i]) continue;
    out.centre.push_back(p), out.radius.push_back(whole.radius[i]);
  }
  return out;
}

/// Returns a function that returns whether a point is in a voxel of a grain or a void; mastic may not be placed there.
std::function<bool(const Vec3d&)> taken_in(const Cut& cut) {
  return [&cut](const Vec3d& point) {
    const Vec3d& s = cut.labels.spacing;
    const auto at = [](double x, double edge, std::int64_t n) {
      return std::clamp(static_cast<std::int64_t>(x / edge), std::int64_t{0}, n - 1);
    };
    const std::size_t voxel =
        cut.labels.index(at(point.x, s.x, cut.labels.size[0]), at(point.y, s.y, cut.labels.size[1]),
                         at(point.z, s.z, cut.labels.size[2]));
    return cut.labels.voxels[voxel] != 0 || cut.phases.voxels[voxel] == static_cast<std::uint8_t>(VoxelPhase::air_void);
  };
}

/// Removes particles that no path of contacts joins to both the bottom and the top wall, such as mastic enclosed by
/// voids. These particles carry no load, and their motion would be undetermined. Their space goes to the voids and
/// cells around them. Returns the numbers of removed particles of mastic and of other phases.
std::array<std::int64_t, 2> remove_hanging(Specimen& s, const NetworkSpec& spec) {
  std::array<std::int64_t, 2> out{};
  // repeats, because a cell that grows into the freed space may lose another contact
  for (int round = 0; round < 5; ++round) {
    std::vector<bool> gone(s.size());
    bool any = false;
    const std::vector<Cluster> clusters = find_clusters(build_network(s, tessellate(s), spec), s.size());
    if (std::none_of(clusters.begin(), clusters.end(), [](const Cluster& c) { return c.spans(); })) break;
    for (const Cluster& cluster : clusters) {
      if (cluster.spans()) continue;
      for (const std::int32_t p : cluster.particles) {
        gone[static_cast<std::size_t>(p)] = any = true;
        ++out[s.phase[static_cast<std::size_t>(p)] != Phase::mastic];
      }
    }
    if (!any) break;
    const auto keep = [&gone](auto& list) {
      std::size_t to = 0;
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (!gone[i]) list[to++] = list[i];
      }
      list.resize(to);
    };
    keep(s.centre), keep(s.radius), keep(s.phase), keep(s.body);
  }
  return out;
}

}  // namespace

// Steps: cut out the box; fill each grain with spheres; replace the voids by spheres; pack mastic into the remaining
// space; remove particles that are not connected to both walls. Voids are placed as aggregates first, so that mastic
// avoids them, and become voids at the end.
Twin make_twin(const fs::path& folder, const Scene& scene, const TwinSpec& spec,
               const std::function<void(const std::string& stage, double share)>& progress) {
  const auto report = [&](const char* stage, double share) {
    if (progress) progress(stage, share);
  };
  SpecimenSpec how = scene.specimen;
  if (!how.box.is_box())
    throw InputError(how.source, how.line, "domain", how.box.name(), "box, because a twin is a box cut out of a scan");
  if (!how.mastic)
    throw InputError(how.source, how.line, "[specimen.mastic]", "none",
                     "this section, which gives the radius of the mastic particles of the twin");
  if (spec.porosity) how.mastic->porosity = spec.porosity, how.mastic->count.reset();
  if (!how.mastic->porosity)
    throw InputError(how.source, how.mastic->line, "[specimen.mastic]", "a count",
                     "a porosity, in this section or in --porosity");

  report("reading the scan", 0);
  const Cut cut = cut_out(folder, spec);
  Twin out;
  out.corner = cut.corner;
  out.specimen.box = how.box = cut.box;
  out.specimen.source = "twin of " + folder.string();
  const double box = cut.box.volume();

  const std::map<std::uint32_t, Part> parts = parts_of(cut.labels);
  const std::vector<std::pair<std::uint32_t, Part>> grain(parts.begin(), parts.end());
  std::vector<MultiSphere> spheres(grain.size());
  report("filling grains", 0);
  for_each_in_parallel(grain.size(), [&](std::size_t k) {
    spheres[k] = spheres_of(grain[k].first, grain[k].second, cut, folder, how, spec.seed);
  });
  const Vec3d& edge = cut.phases.spacing;
  const double least = spec.least_void > 0 ? spec.least_void : 2 * std::max({edge.x, edge.y, edge.z});
  const ct::VoidSpheres voids = ct::void_spheres(cut.phases, least);

  double smallest = std::min({cut.box.size.x, cut.box.size.y, cut.box.size.z}), largest_void = 0;
  for (const MultiSphere& s : spheres)
    for (const double r : s.radius) smallest = std::min(smallest, r);
  for (const VoidSphere& v : voids.spheres) largest_void = std::max(largest_void, v.radius);
  Placement placement(out.specimen, smallest, how.attempts, RandomStream(spec.seed, placement_stream), Origin(how),
                      taken_in(cut), largest_void);
  for (std::size_t k = 0; k < grain.size(); ++k) {
    out.aggregate += grain[k].second.volume / box;
    ++(spheres[k].size() == 0 ? out.lost : out.grains);
    if (spheres[k].size() > 1) ++out.clusters;
    for (std::size_t i = 0; i < spheres[k].size(); ++i)
      placement.add_aggregate(spheres[k].centre[i], spheres[k].radius[i], static_cast<std::int32_t>(grain[k].first));
  }
  const std::size_t first_void = out.specimen.size();
  std::int32_t body = grain.empty() ? 1 : static_cast<std::int32_t>(grain.back().first) + 1;
  for (const VoidSphere& v : voids.spheres) placement.add_aggregate(v.centre - cut.corner, v.radius, body++);
  const std::size_t end_of_voids = out.specimen.size();
  out.voids = voids.volume / box, out.voids_left_out = voids.left_out / box;

  how.voids.reset();
  how.seed = spec.seed;
  how.mastic->porosity = 1 - (1 - *how.mastic->porosity) * (1 - out.voids);
  for (const Population& p : compose_mastic(how, out.aggregate * box)) {
    out.mastic += p.row.fraction;
    placement.place_mastic(p);
  }
  settle_mastic(out.specimen, placement, true, Origin(how), {}, report);
  part_voids(first_void, end_of_voids, out.specimen);
  report("removal of unconnected particles", 0);
  std::tie(out.enclosed_mastic, out.enclosed_aggregate) = std::tuple_cat(remove_hanging(out.specimen, scene.network));
  validate(out.specimen, out.specimen.source);
  return out;
}

}  // namespace macadam
