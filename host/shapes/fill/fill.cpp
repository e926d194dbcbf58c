// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fill.cpp  Draws sphere radii, places the spheres at random below the surface, and relaxes them against each
/// other and the surface.
#include "host/shapes/fill/fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/spheres/random_stream.hpp"
#include "host/spheres/relaxation.hpp"
#include "host/spheres/size_law.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr std::uint64_t radius_stream = 0, position_stream = 1;
constexpr int attempts = 200;  // random points per sphere
// Largest number of relaxations. Before each further relaxation, the spheres without a cell get new positions.
constexpr int most_rounds = 10;
// More spheres are reported as an input error. Even all aggregates of a specimen together have fewer.
constexpr double most_spheres = 1e5;
constexpr double least_porosity = -0.5;  // below this value, spheres would overlap too much to have cells

void require(bool good, const std::string& name, const char* what, double found, const char* expected) {
  if (!good) throw InputError(name, 0, std::string("fill: ") + what, shown(found), expected);
}

void check(const std::string& name, double scale, const FillSpec& spec) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  require(positive(scale), name, "scale", scale, "a finite positive number");
  require(positive(spec.radius_min), name, "radius_min [m]", spec.radius_min, "a finite positive number");
  require(std::isfinite(spec.radius_max) && spec.radius_max >= spec.radius_min, name, "radius_max [m]", spec.radius_max,
          ("a finite number of at least radius_min, " + shown(spec.radius_min)).c_str());
  require(spec.porosity >= least_porosity && spec.porosity < 1, name, "porosity", spec.porosity,
          "a number of at least -0.5 and below 1");
  require(spec.least >= 1, name, "least", static_cast<double>(spec.least), "at least 1");
}

SizeRange diameters(const FillSpec& spec) { return {SizeLaw::uniform, 2 * spec.radius_min, 2 * spec.radius_max}; }

}  // namespace

Specimen in_box(const MultiSphere& cluster, const Vec3d& low, const Vec3d& high) {
  const std::size_t n = cluster.size();
  Specimen s{{high - low}, {}, cluster.radius, std::vector(n, Phase::mastic), std::vector<std::int32_t>(n, -1)};
  for (const Vec3d& c : cluster.centre) s.centre.push_back(c - low);
  return s;
}

ShapeFiller::ShapeFiller(const Surface& surface)
    : name_(surface.name), measure_(measure_shape(surface)), distance_(surface) {}

std::int64_t ShapeFiller::spheres(double scale, const FillSpec& spec) const {
  check(name_, scale, spec);
  const double volume = (1 - spec.porosity) * measure_.volume * scale * scale * scale;
  const double number = volume / diameters(spec).mean_volume();
  require(number <= most_spheres, name_, "number of spheres that the radii and the porosity need", std::round(number),
          "at most 100000");
  return std::llround(number);
}

double ShapeFiller::single_radius(SingleSphere rule) const {
  switch (rule) {
    case SingleSphere::intermediate:
      return measure_.d_intermediate / 2;
    case SingleSphere::circumscribed:
      return measure_.radius_bounding;
    case SingleSphere::volume:
      return std::cbrt(measure_.volume * 3 / (4 * std::numbers::pi));
  }
  throw InputError(name_, 0, "fill: single", std::to_string(static_cast<int>(rule)), "a rule of SingleSphere");
}

bool ShapeFiller::may_reach(const Vec3d& p, double reach) const {
  const Vec3d low = distance_.low(), high = distance_.high(), way = p - measure_.centre_bounding;
  const double far = measure_.radius_bounding + reach;
  return dot(way, way) <= far * far && p.x >= low.x - reach && p.x <= high.x + reach && p.y >= low.y - reach &&
         p.y <= high.y + reach && p.z >= low.z - reach && p.z <= high.z + reach;
}

WallDepth ShapeFiller::above(const Vec3d& point) const {
  const WallDepth below = distance_.below(point, std::numeric_limits<double>::infinity());
  return {-below.depth, -below.inward};
}

/// Returns a random point at least one radius below the surface. If no attempt finds one, returns the deepest point
/// tried.
Vec3d ShapeFiller::position(double radius, RandomStream& random) const {
  const Vec3d low = distance_.low(), high = distance_.high();
  Vec3d best = measure_.centroid;
  double deepest = -norm(high - low);
  for (int k = 0; k < attempts && deepest < radius; ++k) {
    const double x = random.uniform(low.x, high.x), y = random.uniform(low.y, high.y);
    const Vec3d p{x, y, random.uniform(low.z, high.z)};
    if (const double depth = distance_.below(p, radius).depth; depth > deepest) deepest = depth, best = p;
  }
  return best;
}

MultiSphere ShapeFiller::fill(double scale, const FillSpec& spec) const {
  const std::int64_t count = spheres(scale, spec);
  if (count < spec.least) return {{scale * measure_.centroid}, {scale * single_radius(spec.single)}};

  // From here on, all lengths refer to the shape at scale 1, because the distances from the surface were computed at
  // this scale.
  RandomStream radii(spec.seed, radius_stream), positions(spec.seed, position_stream);
  const double volume = (1 - spec.porosity) * measure_.volume * scale * scale * scale;
  const std::vector<double> diameter = draw_diameters(diameters(spec), count, volume, radii);
  MultiSphere cluster;
  for (double d : diameter) {
    cluster.radius.push_back(d / (2 * scale));
    cluster.centre.push_back(position(cluster.radius.back(), positions));
  }
  const double r = cluster.radius.front();  // largest radius; with this margin no sphere is near a side of the box
  const Vec3d low = distance_.low() - Vec3d{r, r, r}, high = distance_.high() + Vec3d{r, r, r};
  Specimen boxed = in_box(cluster, low, high);
  const Enclosure wall{[&](const Vec3d& point, double reach) { return distance_.below(low + point, reach); }};
  std::vector<std::int32_t> hidden;
  for (int round = 0; round == 0 || !hidden.empty(); ++round) {
    if (round == most_rounds)
      throw RunError(name_ + ": " + std::to_string(hidden.size()) + " of " + std::to_string(count) +
                     " spheres have no Laguerre cell, the first is sphere " + std::to_string(hidden.front()) +
                     "; choose radii that differ less, or a higher porosity");
    for (std::int32_t i : hidden) boxed.centre[i] = position(boxed.radius[i], positions) - low;
    relax(
        boxed, false, [](double) {}, wall);
    hidden = particles_without_cell(boxed);
  }
  for (std::size_t i = 0; i < boxed.size(); ++i) {
    cluster.centre[i] = scale * (low + boxed.centre[i]);
    cluster.radius[i] = diameter[i] / 2;
  }
  return cluster;
}

MultiSphere fill_shape(const Surface& surface, const FillSpec& spec) { return ShapeFiller(surface).fill(1, spec); }

}  // namespace macadam
