// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_scans.hpp  Small scans for tests: grains and voids of known volume in mastic, and the blur and noise of a
/// scanner.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "macadam/ct.hpp"

namespace macadam::ct_scans {

constexpr double voxel = 1e-4;  // edge of a voxel of these scans [m]
constexpr float air = 2000, mastic = 20000, aggregate = 32000;
constexpr float contrast = aggregate - mastic;

/// Returns the depth of a point below the surface of a solid, in voxels; negative outside.
using Body = std::function<double(double x, double y, double z)>;

inline Body ball(double x, double y, double z, double radius) {
  return [=](double a, double b, double c) {
    return radius - std::sqrt((a - x) * (a - x) + (b - y) * (b - y) + (c - z) * (c - z));
  };
}

inline Body block(Vec3d low, Vec3d high) {
  return [=](double x, double y, double z) {
    return std::min({x - low.x, high.x - x, y - low.y, high.y - y, z - low.z, high.z - z});
  };
}

/// Returns a scan of grains of aggregate and voids of air in mastic, with voxels of 0.1 mm. Each surface is blurred
/// over two voxels.
inline Image<float> scan_of(std::array<std::int64_t, 3> size, const std::vector<Body>& grains,
                            const std::vector<Body>& voids = {}) {
  Image<float> scan(size, {1e-4, 1e-4, 1e-4}, {}, mastic);
  const auto share = [](double depth) { return static_cast<float>(std::clamp(0.5 + 0.5 * depth, 0.0, 1.0)); };
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const auto x = static_cast<double>(i), y = static_cast<double>(j), z = static_cast<double>(k);
        float& grey = scan.at(i, j, k);
        for (const Body& body : grains) grey = std::max(grey, mastic + contrast * share(body(x, y, z)));
        for (const Body& body : voids) grey += (air - grey) * share(body(x, y, z));
      }
    }
  }
  return scan;
}

/// Returns options that segment the whole scan and keep grains of at least `smallest_voxels` voxels in diameter.
inline SegmentOptions options_of(double smallest_voxels) {
  SegmentOptions options;
  options.region = ScanRegion::whole;
  options.smallest = smallest_voxels * voxel;
  return options;
}

/// Adds normally distributed noise; its standard deviation is `share` times the contrast of aggregate and mastic.
inline void add_noise(Image<float>& scan, double share, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, static_cast<float>(share) * contrast);
  for (float& grey : scan.voxels) grey += noise(random);
}

/// Returns a cubic scan filled with balls on a loose, randomly shifted lattice, with voids between them.
inline Image<float> many_balls(std::int64_t edge, double radius = 9) {
  std::vector<Body> grains, voids;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-1.2, 1.2);
  const double step = 2 * radius + 4;
  for (double z = step / 2; z + radius < static_cast<double>(edge); z += step) {
    for (double y = step / 2; y + radius < static_cast<double>(edge); y += step) {
      for (double x = step / 2; x + radius < static_cast<double>(edge); x += step) {
        grains.push_back(ball(x + shift(random), y + shift(random), z + shift(random), radius));
        voids.push_back(ball(x + step / 2, y + step / 2, z + step / 2, 5));
      }
    }
  }
  return scan_of({edge, edge, edge}, grains, voids);
}

}  // namespace macadam::ct_scans
