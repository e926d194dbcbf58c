// SPDX-License-Identifier: GPL-3.0-or-later
// void_spheres.cpp  Finds connected voids, their distance maps, and inscribed spheres.
#include "host/tools/ct/synthetic/void_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/tools/ct/voxels/distance.hpp"

namespace macadam::ct {
namespace {

using Voxel = std::array<std::int64_t, 3>;

/// Largest ratio of reach to radius at which a void becomes one sphere. The reach is the largest distance of a voxel
/// from the centroid; the radius is the radius of a sphere with the void's volume. An ellipsoid with axes of 1.4 to 1
/// has this ratio; two touching spheres have 1.6.
constexpr double nearly_round = 1.25;

double volume_of(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }
double radius_of(double volume) { return std::cbrt(volume * 3 / (4 * std::numbers::pi)); }

/// Returns the voxels of the void that contains `from`, and marks them in `met`.
std::vector<Voxel> flood(const Image<std::uint8_t>& mask, const Voxel& from, std::vector<std::uint8_t>& met) {
  std::vector<Voxel> out{from};
  met[mask.index(from[0], from[1], from[2])] = 1;
  for (std::size_t k = 0; k < out.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::int64_t way : {-1, 1}) {
        Voxel next = out[k];
        next[axis] += way;
        if (next[axis] < 0 || next[axis] >= mask.size[axis]) continue;
        const std::size_t at = mask.index(next[0], next[1], next[2]);
        if (mask.voxels[at] && !met[at]) met[at] = 1, out.push_back(next);
      }
    }
  }
  return out;
}

/// Returns the sphere of the void's volume about its centroid.
VoidSphere sphere_of(const Image<std::uint8_t>& phases, const std::vector<Voxel>& voxels, double volume) {
  Vec3d sum{};
  for (const Voxel& p : voxels) sum += phases.centre(p[0], p[1], p[2]);
  return {(1 / static_cast<double>(voxels.size())) * sum, radius_of(volume)};
}

/// Returns the distance of the farthest voxel of a void from a point [m].
double reach_of(const Image<std::uint8_t>& phases, const std::vector<Voxel>& voxels, const Vec3d& from) {
  double out = 0;
  for (const Voxel& p : voxels) out = std::max(out, norm(phases.centre(p[0], p[1], p[2]) - from));
  return out;
}

/// Whether the voxel that contains a point belongs to the mask.
bool holds(const Image<std::uint8_t>& mask, const Vec3d& point) {
  const Vec3d from = point - mask.origin;
  const auto voxel = [](double at, double edge, std::int64_t n) {
    return std::clamp(static_cast<std::int64_t>(std::lround(at / edge)), std::int64_t{0}, n - 1);
  };
  return mask.at(voxel(from.x, mask.spacing.x, mask.size[0]), voxel(from.y, mask.spacing.y, mask.size[1]),
                 voxel(from.z, mask.spacing.z, mask.size[2])) != 0;
}

/// Returns inscribed spheres of a void, from the largest down to half its radius. No sphere has its centre inside
/// another.
std::vector<VoidSphere> inscribed(const Image<float>& depth, const std::vector<Voxel>& voxels) {
  std::vector<VoidSphere> all, out;
  for (const Voxel& p : voxels) all.push_back({depth.centre(p[0], p[1], p[2]), depth.at(p[0], p[1], p[2])});
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.radius > b.radius; });
  for (const VoidSphere& s : all) {
    if (s.radius < 0.5 * all.front().radius) break;
    const bool apart = std::all_of(out.begin(), out.end(), [&](const VoidSphere& o) {
      return norm(s.centre - o.centre) > std::max(o.radius, s.radius);
    });
    if (apart) out.push_back(s);
  }
  return out;
}

}  // namespace

VoidSpheres void_spheres(const Image<std::uint8_t>& phases, double least) {
  VoidSpheres out;
  auto mask = Image<std::uint8_t>::like(phases);
  for (std::size_t v = 0; v < phases.count(); ++v)
    mask.voxels[v] = phases.voxels[v] == static_cast<std::uint8_t>(VoxelPhase::air_void);
  const Image<float> depth = distance_inside(mask);
  std::vector<std::uint8_t> met(phases.count());
  for (std::int64_t k = 0; k < phases.size[2]; ++k) {
    for (std::int64_t j = 0; j < phases.size[1]; ++j) {
      for (std::int64_t i = 0; i < phases.size[0]; ++i) {
        if (!mask.at(i, j, k) || met[phases.index(i, j, k)]) continue;
        const std::vector<Voxel> voxels = flood(mask, {i, j, k}, met);
        const double volume = static_cast<double>(voxels.size()) * phases.voxel_volume();
        if (volume < volume_of(least)) {
          out.left_out += volume;
          continue;
        }
        out.volume += volume;
        std::vector<VoidSphere> spheres{sphere_of(phases, voxels, volume)};
        // the centroid of a shell-shaped void is not inside the void
        if (!holds(mask, spheres.front().centre) ||
            reach_of(phases, voxels, spheres.front().centre) > nearly_round * spheres.front().radius)
          spheres = inscribed(depth, voxels);
        double filled = 0;
        for (const VoidSphere& s : spheres) filled += volume_of(s.radius);
        const double grown = std::cbrt(volume / filled);
        for (VoidSphere& s : spheres) s.radius *= grown;
        out.spheres.insert(out.spheres.end(), spheres.begin(), spheres.end());
      }
    }
  }
  return out;
}

}  // namespace macadam::ct
