// SPDX-License-Identifier: GPL-3.0-or-later
// phantom.cpp  Makes a phantom: generates a specimen with the surfaces of its aggregates, saws it, converts it to
// voxels, and adds the faults of a scanner. The true grains and phases are kept with the scan.
#include "macadam/phantom.hpp"

#include <fmt/format.h>

#include <limits>
#include <numbers>

#include "host/tools/ct/synthetic/grain_gaps.hpp"
#include "host/tools/ct/synthetic/scan_faults.hpp"
#include "host/tools/ct/synthetic/voxelise.hpp"
#include "kernels/base/parallel.hpp"
#include "host/shapes/library/icosahedron.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using ct::Body;
using ct::Coverage;
using ct::SawnCore;

/// Largest number of voxels of a phantom.
constexpr double most_voxels = 2e9;

/// \throws InputError if `wrong` is true.
void refuse(bool wrong, const char* what, double found, const char* expected) {
  if (wrong) throw InputError("phantom", 0, what, fmt::format("{}", found), expected);
}

/// \throws InputError for impossible values of the specification.
void check(const PhantomSpec& spec, const Domain& box) {
  if (!box.is_box())
    throw InputError("phantom", 0, "domain of the scene", box.name(), "box, because a phantom is a box");
  refuse(!(std::isfinite(spec.voxel) && spec.voxel > 0), "voxel", spec.voxel, "a positive length");
  refuse(!(spec.air >= 0 && std::isfinite(spec.air)), "air", spec.air, "a length of 0 or more");
  const double edge = std::min({box.size.x, box.size.y, box.size.z});
  refuse(!(spec.sawn >= 0 && 2 * spec.sawn < edge), "sawn", spec.sawn, "0 to below half of the shortest edge");
  refuse(!(spec.voxel <= edge - 2 * spec.sawn), "voxel", spec.voxel,
         "at most the shortest edge of the scanned specimen");
  refuse(spec.samples < 1 || spec.samples > 16, "samples", spec.samples, "1 to 16");
  if (!(spec.grey_air >= 0 && spec.grey_mastic > spec.grey_air && spec.grey_aggregate >= spec.grey_mastic &&
        spec.grey_aggregate <= 65535))
    throw InputError(
        "phantom", 0, "grey values",
        fmt::format("air {}, mastic {}, aggregate {}", spec.grey_air, spec.grey_mastic, spec.grey_aggregate),
        "0 <= air < mastic <= aggregate <= 65535");
  refuse(!(spec.blur == 0 || (spec.blur >= 0.1 && spec.blur <= 10)), "blur", spec.blur, "0, or 0.1 to 10 voxels");
  for (const auto& [name, value] :
       {std::pair{"noise", spec.noise}, {"cupping", spec.cupping}, {"rings", spec.rings}, {"drift", spec.drift}})
    refuse(!(value >= 0 && value < 1), name, value, "a fraction from 0 to below 1");
  double voxels = 1;
  for (const double side : {box.size.x, box.size.y, box.size.z})
    voxels *= (side - 2 * spec.sawn + 2 * spec.air) / spec.voxel;
  refuse(voxels > most_voxels, "number of voxels", voxels, "at most 2e9; choose larger voxels");
}

/// Returns the specimen of a file. Each aggregate must be one sphere, because a file does not contain the surfaces of
/// clusters. \throws InputError.
GeneratedSpecimen from_file(const Scene& scene) {
  GeneratedSpecimen out;
  out.specimen = read_specimen_csv(*scene.specimen.file, scene.specimen.box);
  std::vector<std::uint8_t> met;
  for (std::size_t i = 0; i < out.specimen.size(); ++i) {
    if (out.specimen.phase[i] != Phase::aggregate) continue;
    const auto body = static_cast<std::size_t>(out.specimen.body[i]);
    if (met.size() <= body) met.resize(body + 1);
    if (met[body]++)
      throw InputError(out.specimen.source, out.specimen.line_of(static_cast<std::int64_t>(i)), "spheres of a body",
                       fmt::format("a second sphere of body {}", body),
                       "one sphere per body, because the file does not hold the surface of a cluster; use a scene that "
                       "generates its specimen");
    Aggregate a;
    a.body = out.specimen.body[i];
    a.shape = "sphere";
    a.d_long = a.d_short = a.size = 2 * out.specimen.radius[i];
    a.volume = std::numbers::pi / 6 * a.size * a.size * a.size;
    a.centre = out.specimen.centre[i];
    out.aggregates.push_back(a);
  }
  return out;
}

/// Returns what remains of the specimen if a layer of thickness `off` is cut off each side: the spheres and voids whose
/// centres remain.
Specimen sawn(const Specimen& whole, double off) {
  Specimen out;
  const Vec3d corner{off, off, off};
  out.box.size = whole.box.size - 2.0 * corner;
  out.source = whole.source;
  const auto inside = [&](const Vec3d& p) {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= out.box.size.x && p.y <= out.box.size.y && p.z <= out.box.size.z;
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Vec3d p = whole.centre[i] - corner;
    if (!inside(p)) continue;
    out.centre.push_back(p);
    out.radius.push_back(whole.radius[i]);
    out.phase.push_back(whole.phase[i]);
    out.body.push_back(whole.body[i]);
  }
  for (const VoidSphere& v : whole.voids)
    if (inside(v.centre - corner)) out.voids.push_back({v.centre - corner, v.radius});
  return out;
}

/// Returns the aggregates in the frame of the sawn specimen, with all values that do not depend on voxels.
std::vector<PhantomGrain> grains_of(const GeneratedSpecimen& made, const PhantomSpec& spec) {
  std::vector<ShapeMeasure> measure(made.surfaces.size());
  std::vector<double> sieve(made.surfaces.size());
  for_each_in_parallel(measure.size(), [&](std::size_t k) {
    measure[k] = measure_shape(made.surfaces[k]);
    sieve[k] = square_sieve(made.surfaces[k]);
  });
  Surface unit = geodesic_sphere(3);
  // a sphere's polyhedron gets the volume of the sphere
  const double grown = std::cbrt(4 * std::numbers::pi / 3 / measure_shape(unit).volume);
  const Vec3d corner{spec.sawn, spec.sawn, spec.sawn};
  std::vector<PhantomGrain> out;
  for (const Aggregate& a : made.aggregates) {
    PhantomGrain g;
    g.body = a.body;
    g.shape = a.shape;
    g.volume = a.volume;
    g.centre = a.centre - corner;
    g.d_long = a.d_long, g.d_short = a.d_short;
    if (a.surface < 0) {
      g.sphere_radius = a.d_long / 2;
      g.d_intermediate = g.sieve = a.d_long;
      g.area = std::numbers::pi * a.d_long * a.d_long;
      g.surface = unit;
      for (Vec3d& p : g.surface.points) p = g.centre + (g.sphere_radius * grown) * p;
    } else {
      const auto number = static_cast<std::size_t>(a.surface);
      g.d_intermediate = a.size;
      g.area = a.pose.scale * a.pose.scale * measure[number].area;
      g.sieve = a.pose.scale * sieve[number];
      g.axis_long = a.axis_long;
      g.surface = made.surfaces[number];
      for (Vec3d& p : g.surface.points) p = a.pose(p) - corner;
    }
    out.push_back(std::move(g));
  }
  return out;
}

/// Whether the sides of the core cut a grain.
bool cut_by(const SawnCore& core, const PhantomGrain& g) {
  // the polyhedron of a sphere has the volume of the sphere, so its points lie slightly outside the sphere
  const double margin = 1e-3 * g.sphere_radius;
  return std::any_of(g.surface.points.begin(), g.surface.points.end(), [&](const Vec3d& p) {
    return p.z < core.low.z - margin || p.z > core.high.z + margin || !core.holds(p.x, p.y);
  });
}

/// For each voxel, the fractions that aggregate, voids and the specimen fill.
struct Shares {
  Image<float> aggregate, voids, specimen;
};

/// Adds the filled fractions of a body.
void add(const Coverage& c, Image<float>& to) {
  for (std::int64_t k = c.begin[2]; k < c.end[2]; ++k)
    for (std::int64_t j = c.begin[1]; j < c.end[1]; ++j)
      for (std::int64_t i = c.begin[0]; i < c.end[0]; ++i) to.at(i, j, k) += c.share[c.index(i, j, k)];
}

/// Labels the voxels of which the grain fills more than any grain before it.
void label(const Coverage& c, std::uint32_t id, Image<float>& largest, Image<std::uint32_t>& labels) {
  for (std::int64_t k = c.begin[2]; k < c.end[2]; ++k) {
    for (std::int64_t j = c.begin[1]; j < c.end[1]; ++j) {
      for (std::int64_t i = c.begin[0]; i < c.end[0]; ++i) {
        const float here = c.share[c.index(i, j, k)];
        if (!(here > largest.at(i, j, k))) continue;
        largest.at(i, j, k) = here;
        labels.at(i, j, k) = id;
      }
    }
  }
}

/// Numbers the grains of which some volume remains, and finds their voxels.
void voxelise(const SawnCore& core, const PhantomSpec& spec, Phantom& out, Image<float>& share,
              const std::function<void(const char* stage, double share)>& report) {
  constexpr std::size_t at_once = 32;  // number of grains whose voxels are in memory at the same time
  auto largest = Image<float>::like(share);
  std::vector<PhantomGrain> kept;
  const std::size_t n = out.grains.size();
  for (std::size_t first = 0; first < n; first += at_once) {
    report("grains into voxels", static_cast<double>(first) / static_cast<double>(n));
    std::vector<Coverage> part(std::min(at_once, n - first));
    for_each_in_parallel(part.size(), [&](std::size_t k) {
      const PhantomGrain& g = out.grains[first + k];
      const Body body{g.sphere_radius > 0 ? nullptr : &g.surface, g.centre, g.sphere_radius};
      part[k] = cover(body, core, share, spec.samples);
    });
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (!(part[k].volume > 0)) continue;
      PhantomGrain& grain = kept.emplace_back(std::move(out.grains[first + k]));
      grain.id = static_cast<std::uint32_t>(kept.size());
      grain.border = cut_by(core, grain);
      if (grain.border) grain.volume = part[k].volume, grain.centre = part[k].centroid;
      add(part[k], share);
      label(part[k], grain.id, largest, out.labels);
    }
  }
  out.grains = std::move(kept);
}

/// Sets the phase of each voxel to the phase that fills most of it, and its grey value to the mean of the phases
/// weighted by their fractions. Sets the volume fractions.
void settle(const PhantomSpec& spec, const Shares& shares, Phantom& out, Image<float>& grey) {
  const auto n = static_cast<std::int64_t>(grey.count());
  double specimen = 0, aggregate = 0, voids = 0;
  for (std::int64_t at = 0; at < n; ++at) {
    const auto v = static_cast<std::size_t>(at);
    const double s = std::min(1.0F, shares.specimen.voxels[v]);
    const double a = std::min<double>(s, shares.aggregate.voxels[v]),
                 air = std::min<double>(s - a, shares.voids.voxels[v]);
    specimen += s, aggregate += a, voids += air;
    grey.voxels[v] =
        static_cast<float>(spec.grey_air * (1 - s + air) + spec.grey_mastic * (s - a - air) + spec.grey_aggregate * a);
    VoxelPhase phase = VoxelPhase::mastic;
    if (s < 0.5) {
      phase = VoxelPhase::outside;
    } else if (a >= 0.5 * s) {
      phase = VoxelPhase::aggregate;
    } else if (air >= 0.5 * s) {
      phase = VoxelPhase::air_void;
    }
    out.phases.voxels[v] = static_cast<std::uint8_t>(phase);
    if (phase != VoxelPhase::aggregate) out.labels.voxels[v] = 0;
  }
  out.aggregate = aggregate / specimen, out.voids = voids / specimen;
  out.mastic = 1 - out.aggregate - out.voids;
}

}  // namespace

// Steps: generate the specimen; compute the fractions of aggregate, voids and specimen in each voxel; compute phases
// and grey values from these fractions; add the faults of a scanner; find the gaps between grains.
Phantom make_phantom(const Scene& scene, const PhantomSpec& spec,
                     const std::function<void(const std::string& stage, double share)>& progress) {
  check(spec, scene.specimen.box);
  const auto report = [&](const char* stage, double share) {
    if (progress) progress(stage, share);
  };
  const GeneratedSpecimen made = scene.specimen.file ? from_file(scene) : generate_specimen(scene.specimen, report);
  Phantom out;
  out.specimen = sawn(made.specimen, spec.sawn);
  out.grains = grains_of(made, spec);

  const Vec3d size = out.specimen.box.size;
  const SawnCore core{{0, 0, 0}, size, spec.shape == CoreShape::cylinder};
  const double around = std::ceil(spec.air / spec.voxel), first = (0.5 - around) * spec.voxel;
  const auto voxels = [&](double edge) {
    return static_cast<std::int64_t>(std::ceil(edge / spec.voxel * (1 - 1e-12)) + 2 * around);
  };
  Image<float> grey({voxels(size.x), voxels(size.y), voxels(size.z)}, {spec.voxel, spec.voxel, spec.voxel},
                    {first, first, first});
  Shares shares{Image<float>::like(grey), Image<float>::like(grey), Image<float>::like(grey)};
  out.labels = Image<std::uint32_t>::like(grey);
  out.phases = Image<std::uint8_t>::like(grey);
  voxelise(core, spec, out, shares.aggregate, report);
  for (const VoidSphere& v : made.specimen.voids) {
    const Vec3d corner{spec.sawn, spec.sawn, spec.sawn};
    add(cover({nullptr, v.centre - corner, v.radius}, core, grey, spec.samples), shares.voids);
  }
  add(cover({}, core, grey, spec.samples), shares.specimen);
  settle(spec, shares, out, grey);
  shares = {};
  report("faults of the scan", 0);
  const double radius = core.cylinder ? std::min(size.x, size.y) / 2 : std::hypot(size.x, size.y) / 2;
  ct::add_faults(grey, spec, radius);
  out.scan = Image<std::uint16_t>::like(grey);
  for (std::size_t v = 0; v < grey.count(); ++v)
    out.scan.voxels[v] = static_cast<std::uint16_t>(std::clamp(std::round(grey.voxels[v]), 0.0F, 65535.0F));
  report("gaps between grains", 0);
  out.gaps = ct::grain_gaps(out.grains, 3 * spec.voxel);
  return out;
}

}  // namespace macadam
