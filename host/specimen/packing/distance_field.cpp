// SPDX-License-Identifier: GPL-3.0-or-later
/// \file distance_field.cpp  Computes exact distances at the grid nodes. Along a line of nodes the sign is copied from
/// node to node as long as no surface can lie between the two nodes.
#include "host/specimen/packing/distance_field.hpp"

#include <algorithm>
#include <cmath>

#include "host/shapes/files/surface_numbers.hpp"

namespace macadam {
namespace {

/// Linear interpolation.
double mix(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

DistanceField::DistanceField(const Surface& surface, const ShapeSolid& solid, int cells) {
  const auto [low, high] = bounds_of(surface.points);
  const Vec3d size = high - low;
  edge_ = std::max({size.x, size.y, size.z}) / cells;
  error_ = std::sqrt(0.75) * edge_;
  // The grid has one more cell on each side, so that the gradient of the distance is right everywhere on the surface.
  const auto nodes = [&](double length) { return static_cast<std::int64_t>(std::ceil(length / edge_)) + 3; };
  nx_ = nodes(size.x), ny_ = nodes(size.y), nz_ = nodes(size.z);
  low_ = low - Vec3d{edge_, edge_, edge_};
  distance_.resize(static_cast<std::size_t>(nx_ * ny_ * nz_));
  auto* node = distance_.data();
  for (std::int64_t z = 0; z < nz_; ++z)
    for (std::int64_t y = 0; y < ny_; ++y) {
      bool inside = false;
      for (std::int64_t x = 0; x < nx_; ++x) {
        const Vec3d p = low_ + edge_ * Vec3d{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        const double d = solid.distance(p);
        // A node farther than one edge from the surface is on the same side as the node before it.
        if (d <= 1.001 * edge_) inside = solid.contains(p);
        *node++ = static_cast<float>(inside ? -d : d);
      }
    }
}

DistanceField::Cell DistanceField::cell_of(const Vec3d& point) const {
  const double scale = 1 / edge_;
  const auto axis = [&](double x, double low, std::int64_t n, double& share, double& beyond) {
    const double u = (x - low) * scale, in = std::clamp(u, 0.0, static_cast<double>(n - 1));
    const std::int64_t k = std::min(static_cast<std::int64_t>(in), n - 2);
    share = in - static_cast<double>(k), beyond = (u - in) * edge_;
    return k;
  };
  Cell c;
  const std::int64_t x = axis(point.x, low_.x, nx_, c.share.x, c.beyond.x);
  const std::int64_t y = axis(point.y, low_.y, ny_, c.share.y, c.beyond.y);
  const std::int64_t z = axis(point.z, low_.z, nz_, c.share.z, c.beyond.z);
  c.node = static_cast<std::size_t>((z * ny_ + y) * nx_ + x);
  return c;
}

DistanceField::Value DistanceField::value(const Vec3d& point) const {
  const Cell c = cell_of(point);
  const float* f = distance_.data() + c.node;
  const std::int64_t down = nx_, deep = nx_ * ny_;
  // Trilinear interpolation: along x on four edges, then along y on two faces, then along z.
  const double e00 = mix(f[0], f[1], c.share.x), e10 = mix(f[down], f[down + 1], c.share.x);
  const double e01 = mix(f[deep], f[deep + 1], c.share.x), e11 = mix(f[deep + down], f[deep + down + 1], c.share.x);
  const double f0 = mix(e00, e10, c.share.y), f1 = mix(e01, e11, c.share.y);
  const double d = mix(f0, f1, c.share.z);
  const double beyond2 = dot(c.beyond, c.beyond);
  // Outside the grid: let q be the nearest point of the grid's box. The box is convex and contains the shape, so the
  // directions from q to the given point and to any point of the shape enclose an angle of at least 90°. The distance
  // to the shape is therefore at least √(d² + beyond²), where d is the distance at q.
  if (beyond2 > 0) return {std::sqrt(d * d + beyond2), (1 / std::sqrt(beyond2)) * c.beyond};
  const double x0 = mix(f[1] - f[0], f[down + 1] - f[down], c.share.y);
  const double x1 = mix(f[deep + 1] - f[deep], f[deep + down + 1] - f[deep + down], c.share.y);
  const Vec3d slope{mix(x0, x1, c.share.z), mix(e10 - e00, e11 - e01, c.share.z), f1 - f0};
  const double steep = norm(slope);
  return {d, steep > 0 ? (1 / steep) * slope : Vec3d{}};
}

double DistanceField::at(const Vec3d& point) const {
  const Cell c = cell_of(point);
  const float* f = distance_.data() + c.node;
  const std::int64_t down = nx_, deep = nx_ * ny_;
  const double e00 = mix(f[0], f[1], c.share.x), e10 = mix(f[down], f[down + 1], c.share.x);
  const double e01 = mix(f[deep], f[deep + 1], c.share.x), e11 = mix(f[deep + down], f[deep + down + 1], c.share.x);
  const double d = mix(mix(e00, e10, c.share.y), mix(e01, e11, c.share.y), c.share.z);
  const double beyond2 = dot(c.beyond, c.beyond);
  return beyond2 > 0 ? std::sqrt(d * d + beyond2) : d;
}

double DistanceField::at_most(const Vec3d& point) const {
  const Vec3d beyond = cell_of(point).beyond;
  return at(point - beyond) + norm(beyond) + error_;
}

}  // namespace macadam
