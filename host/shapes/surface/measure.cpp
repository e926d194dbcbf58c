// SPDX-License-Identifier: GPL-3.0-or-later
// measure.cpp  Measures shapes: volume, area and centroid from the facets; chords and bounding sphere from the points;
// sieve classes.
#include <CGAL/Cartesian.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/shapes/surface/chords.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "macadam/error.hpp"
#include "macadam/shape.hpp"

namespace macadam {
namespace {

void measure_body(const Surface& surface, ShapeMeasure& m) {
  const Vec3d origin = middle_of(surface.points);
  double volume = 0, area = 0;
  Vec3d moment{};
  for (const auto& f : surface.facets) {
    const Vec3d a = surface.points[f[0]] - origin, b = surface.points[f[1]] - origin, c = surface.points[f[2]] - origin;
    const double six_volumes = dot(a, cross(b, c));  // six times the signed volume of the tetrahedron over the facet
    volume += six_volumes / 6;
    moment += (six_volumes / 24) * (a + b + c);
    area += norm(cross(b - a, c - a)) / 2;
  }
  m.volume = volume;
  m.area = area;
  m.centroid = origin + (1 / volume) * moment;
  m.sphericity_true = std::cbrt(std::numbers::pi * 36 * volume * volume) / area;
}

void measure_bounding_sphere(const Surface& surface, ShapeMeasure& m) {
  using Kernel = CGAL::Cartesian<double>;
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double, CGAL::Tag_true>;
  const Vec3d origin = middle_of(surface.points);
  const double unit = m.d_long;  // scaled to length 1, as the algorithm has absolute tolerances
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& p : surface.points) {
    points.emplace_back((p.x - origin.x) / unit, (p.y - origin.y) / unit, (p.z - origin.z) / unit);
  }
  CGAL::Min_sphere_of_spheres_d<Traits> sphere(points.begin(), points.end());
  auto c = sphere.center_cartesian_begin();
  m.centre_bounding = origin + unit * Vec3d{c[0], c[1], c[2]};
  for (const Vec3d& p : surface.points) m.radius_bounding = std::max(m.radius_bounding, norm(p - m.centre_bounding));
}

}  // namespace

ShapeMeasure measure_shape(const Surface& surface) {
  if (const SurfaceVerdict verdict = check_surface(surface); !verdict.good()) {
    throw InputError(surface.name, 0, "surface", verdict.text(),
                     "closed, of one piece, oriented outwards, without self-intersections");
  }
  ShapeMeasure m;
  m.points = static_cast<std::int64_t>(surface.points.size());
  m.facets = static_cast<std::int64_t>(surface.facets.size());
  const Chords chords = measure_chords(surface);
  std::tie(m.d_long, m.d_intermediate, m.d_short) = std::tuple_cat(chords.length);
  std::tie(m.axis_long, m.axis_intermediate, m.axis_short) = std::tuple_cat(chords.axis);
  measure_body(surface, m);
  measure_bounding_sphere(surface, m);
  return m;
}

double ShapeMeasure::sphericity_working() const {
  const double p = flatness(), q = elongation();
  return 12.8 * std::cbrt(p * p * q) / (1 + p * (1 + q) + 6 * std::sqrt(1 + p * p * (1 + q * q)));
}

double ShapeMeasure::flakiness() const {
  const double upper = sieve_class(d_intermediate)[1];
  return std::isfinite(upper) ? d_short / upper : std::numeric_limits<double>::quiet_NaN();
}

const std::vector<double>& standard_sieves() {
  static const std::vector<double> sieves{0, 0.5e-3, 1e-3, 2e-3, 4e-3, 6.3e-3, 10e-3, 12.5e-3, 16e-3, 20e-3};
  return sieves;
}

std::array<double, 2> sieve_class(double d_intermediate) {
  if (!(d_intermediate >= 0)) {
    throw InputError("sieve class", 0, "D^I", fmt::format("{} m", d_intermediate), "a size of 0 or more");
  }
  const std::vector<double>& sieves = standard_sieves();
  const auto upper = std::upper_bound(sieves.begin(), sieves.end(), d_intermediate);
  return {*std::prev(upper), upper == sieves.end() ? std::numeric_limits<double>::infinity() : *upper};
}

}  // namespace macadam
