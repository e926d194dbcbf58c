// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_body.cpp  Runs exact tests after faster approximate ones, and finds contacts from samples of one body in
/// the distance field of the other.
#include "host/specimen/packing/shape_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace macadam {
namespace {

// Number of cells of the distance field of a shape along the longest edge of the shape's bounding box.
constexpr int field_cells = 40;
// Tolerance of the samples divided by the intermediate diameter D^I; small compared with the gaps that packing keeps.
constexpr double sample_tolerance = 0.003;

double farthest_point(const Surface& s) {
  double most = 0;
  for (const Vec3d& p : s.points) most = std::max(most, norm(p));
  return most;
}

/// Transforms points from the frame of one body into the frame of another body.
struct Transfer {
  Rotation turn;  // includes the scale
  Vec3d shift;

  Transfer(const ShapeBody& from, const ShapeBody& to) {
    const double k = from.scale / to.scale;
    const auto row = [&](const Vec3d& axis) { return k * from.rotation.back(axis); };
    const Rotation& r = to.rotation;
    turn.x = row({r.x.x, r.y.x, r.z.x}), turn.y = row({r.x.y, r.y.y, r.z.y}), turn.z = row({r.x.z, r.y.z, r.z.z});
    shift = to.to_own(from.centre);
  }
  Vec3d operator()(const Vec3d& p) const { return turn(p) + shift; }
};

/// Sums over the samples of a contact, weighted by their depths.
struct Manifold {
  double deepest = 0, sum = 0, clear = std::numeric_limits<double>::infinity();
  Vec3d moment{}, push{};

  void add(double depth, const Vec3d& point, const Vec3d& direction) {
    deepest = std::max(deepest, depth);
    sum += depth, moment += depth * point, push += depth * direction;
  }
  ShapeContact contact() const {
    const double length = norm(push);
    if (!(length > 0)) return {0, std::max(0.0, clear), {}, {}};
    return {deepest, 0, (1 / sum) * moment, (1 / length) * push};
  }
};

/// Adds the samples of `a` that are closer to `b` than `gap`, according to the distance field of `b`. The normal pushes
/// `a` away from `b` if `sign` is 1, and `b` away from `a` if it is −1.
void add_samples(Manifold& m, const ShapeBody& a, const ShapeBody& b, double gap, double sign) {
  const Transfer transfer(a, b);
  const DistanceField& field = b.geometry->field;
  const double reach = gap / b.scale, ratio = a.scale / b.scale;
  Manifold own;
  a.geometry->samples.visit(
      [&](const Vec3d& centre, double radius) {
        const double beyond = field.at(transfer(centre)) - ratio * radius - reach;
        if (beyond >= 0) own.clear = std::min(own.clear, beyond);
        return beyond < 0;
      },
      [&](const Vec3d& point) {
        const Vec3d p = transfer(point);
        const DistanceField::Value v = field.value(p);
        if (v.distance < reach)
          own.add(reach - v.distance, p, v.outward);
        else
          own.clear = std::min(own.clear, v.distance - reach);
      });
  m.clear = std::min(m.clear, b.scale * own.clear);
  if (!(own.sum > 0)) return;
  const double k = b.scale;
  m.deepest = std::max(m.deepest, k * own.deepest);
  m.sum += k * own.sum;
  m.moment += (k * own.sum) * b.to_space((1 / own.sum) * own.moment);
  m.push += (sign * k) * b.rotation(own.push);
}

/// Returns whether a sphere touches or overlaps a shape.
bool sphere_touches(const ShapeBody& sphere, const ShapeBody& body) {
  const double r = sphere.sphere_radius();
  if (body.distance_at_least(sphere.centre) > r) return false;
  const Vec3d own = body.to_own(sphere.centre);
  return body.geometry->solid.contains(own) || body.scale * body.geometry->solid.distance(own) <= r;
}

/// Returns whether the field of `b` proves that a sample of `a` is inside `b`. Samples are ignored if their distance
/// from the surface is below the error of the field.
bool sample_inside(const ShapeBody& a, const ShapeBody& b) {
  const Transfer transfer(a, b);
  const DistanceField& field = b.geometry->field;
  const double ratio = a.scale / b.scale, sure = -field.error();
  bool inside = false;
  a.geometry->samples.visit(
      [&](const Vec3d& centre, double radius) { return !inside && field.at(transfer(centre)) - ratio * radius < sure; },
      [&](const Vec3d& point) { inside = inside || field.at(transfer(point)) < sure; });
  return inside;
}

/// Returns whether the surface of `a` intersects the surface of `b`, or a point of `a` is inside `b`.
bool surface_enters(const ShapeBody& a, const ShapeBody& b) {
  const Transfer transfer(a, b);
  const ShapeGeometry &ga = *a.geometry, &gb = *b.geometry;
  const double ratio = a.scale / b.scale;
  const std::vector<Vec3d>& points = ga.shape.surface.points;
  std::vector<Vec3d> moved(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) moved[i] = transfer(points[i]);
  for (std::size_t f = 0; f < ga.facet_reach.size(); ++f) {
    const auto& v = ga.shape.surface.facets[f];
    const Vec3d& p = moved[v[0]];
    const double reach = ratio * ga.facet_reach[f], ball = (gb.radius + reach) * (1 + 1e-9);
    if (dot(p, p) > ball * ball || gb.field.at_least(p) > reach) continue;
    if (gb.solid.touches(p, moved[v[1]], moved[v[2]])) return true;
  }
  // If the surfaces do not intersect, all points of `a` are on the same side of `b`.
  return gb.field.at_least(moved.front()) <= 0 && gb.solid.contains(moved.front());
}

/// Returns whether `a` contains `b`. The surfaces must not intersect.
bool holds(const ShapeBody& a, const ShapeBody& b) {
  const Vec3d p = a.to_own(b.to_space(b.geometry->shape.surface.points.front()));
  return a.geometry->field.at_least(p) <= 0 && a.geometry->solid.contains(p);
}

/// Does what nearer() does for two bodies, at least one of which has a cluster.
bool spheres_nearer(const ShapeBody& a, const ShapeBody& b, double spacing) {
  if (a.sphere) return b.cluster->touches(b.to_cluster(a.centre), a.sphere_radius() + spacing);
  if (b.sphere) return spheres_nearer(b, a, spacing);
  const ShapeBody& few = a.cluster->spheres().size() < b.cluster->spheres().size() ? a : b;
  const ShapeBody& many = &few == &a ? b : a;
  const MultiSphere& s = few.cluster->spheres();
  for (std::size_t i = 0; i < s.size(); ++i)
    if (many.cluster->touches(many.to_cluster(few.centre + few.rotation(s.centre[i])), s.radius[i] + spacing))
      return true;
  return false;
}

}  // namespace

ShapeGeometry::ShapeGeometry(const ShapeTemplate& shape)
    : shape(shape),
      solid(shape.surface),
      field(shape.surface, solid, field_cells),
      samples(shape.surface, sample_tolerance * shape.d_intermediate),
      radius(farthest_point(shape.surface)),
      inner(std::max(0.0, -field.at_most({}))) {
  for (const auto& f : shape.surface.facets) {
    const Vec3d& p = shape.surface.points[f[0]];
    facet_reach.push_back(std::max(norm(shape.surface.points[f[1]] - p), norm(shape.surface.points[f[2]] - p)));
  }
}

double ShapeBody::distance_at_least(const Vec3d& space) const {
  return sphere ? norm(space - centre) - sphere_radius() : scale * geometry->field.at_least(to_own(space));
}

double ShapeBody::distance_at_most(const Vec3d& space) const {
  if (sphere) return norm(space - centre) - sphere_radius();
  return cluster ? cluster->distance_at_most(to_cluster(space)) : scale * geometry->field.at_most(to_own(space));
}

bool nearer(const ShapeBody& a, const ShapeBody& b, double spacing) {
  const double apart = norm(a.centre - b.centre);
  if (apart > a.radius() + b.radius() + spacing) return false;
  if (a.sphere && b.sphere) return true;
  if (a.cluster || b.cluster) return spheres_nearer(a, b, spacing);
  return overlap(a, b) || (spacing > 0 && contact(a, b, spacing).depth > 0);
}

bool overlap(const ShapeBody& a, const ShapeBody& b) {
  const Vec3d d = a.centre - b.centre;
  const double apart = norm(d);
  if (apart > a.radius() + b.radius()) return false;
  if (apart <= a.inner_radius() + b.inner_radius()) return true;
  if (a.sphere && b.sphere) return false;  // tested in the line above: the inner radius of a sphere is its radius
  if (a.sphere) return sphere_touches(a, b);
  if (b.sphere) return sphere_touches(b, a);
  // If the other surface comes closer to a body's centre than the radius of the inner ball, the bodies overlap.
  if (b.distance_at_most(a.centre) < a.inner_radius() || a.distance_at_most(b.centre) < b.inner_radius()) return true;
  return sample_inside(a, b) || sample_inside(b, a) || surface_enters(a, b) || holds(a, b);
}

Extent extent(const ShapeBody& body) {
  if (body.sphere) {
    const double r = body.sphere_radius();
    return {{-r, -r, -r}, {r, r, r}};
  }
  Extent e;
  if (body.cluster) {
    const MultiSphere& s = body.cluster->spheres();
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3d q = body.rotation(s.centre[i]), r = s.radius[i] * Vec3d{1, 1, 1};
      e.low = {std::min(e.low.x, q.x - r.x), std::min(e.low.y, q.y - r.y), std::min(e.low.z, q.z - r.z)};
      e.high = {std::max(e.high.x, q.x + r.x), std::max(e.high.y, q.y + r.y), std::max(e.high.z, q.z + r.z)};
    }
    return e;
  }
  for (const Vec3d& p : body.geometry->shape.surface.points) {
    const Vec3d q = body.scale * body.rotation(p);
    e.low = {std::min(e.low.x, q.x), std::min(e.low.y, q.y), std::min(e.low.z, q.z)};
    e.high = {std::max(e.high.x, q.x), std::max(e.high.y, q.y), std::max(e.high.z, q.z)};
  }
  return e;
}

ShapeContact contact(const ShapeBody& a, const ShapeBody& b, double gap) {
  const Vec3d d = a.centre - b.centre;
  const double apart2 = dot(d, d), near = a.radius() + b.radius() + gap;
  if (apart2 >= near * near) return {0, std::sqrt(apart2) - near, {}, {}};
  Manifold m;
  if (a.sphere && b.sphere) {
    const double apart = std::sqrt(apart2);
    m.add(near - apart, b.centre + (b.sphere_radius() / apart) * d, d);
  } else if (a.sphere || b.sphere) {
    const ShapeBody &s = a.sphere ? a : b, &body = a.sphere ? b : a;
    const Vec3d own = body.to_own(s.centre);
    // The centre of a sphere is usually too far from the surface for the field to be accurate, so the distance is
    // computed exactly. If the centre is inside the body, the field is used.
    DistanceField::Value v = body.geometry->field.value(own);
    if (v.distance > 0) {
      const Vec3d way = own - body.geometry->solid.nearest(own);
      v.distance = norm(way);
      if (v.distance > 0) v.outward = (1 / v.distance) * way;
    }
    const double depth = gap + s.sphere_radius() - body.scale * v.distance;
    const Vec3d out = body.rotation(v.outward);
    if (depth > 0)
      m.add(depth, s.centre - s.sphere_radius() * out, (a.sphere ? 1 : -1) * out);
    else
      m.clear = -depth;
  } else {
    const double clear =
        std::max(b.distance_at_least(a.centre) - a.radius() - gap, a.distance_at_least(b.centre) - b.radius() - gap);
    if (clear > 0) return {0, clear, {}, {}};
    add_samples(m, a, b, gap, 1);
    add_samples(m, b, a, gap, -1);
  }
  return m.contact();
}

ShapeContact wall_contact(const ShapeBody& body, const Domain& domain, double gap) {
  const double reach = body.radius() + gap;
  const Vec3d c = body.centre, l = domain.size;
  constexpr double Vec3d::*axes[]{&Vec3d::x, &Vec3d::y, &Vec3d::z};
  double Vec3d::*const along = axes[domain.prism_axis()];
  Vec3d inwards{};
  inwards.*along = 1;
  const double near = -domain.signed_distance(c);
  if (near >= reach) return {0, near - reach, {}, {}};
  Manifold m;
  const auto add = [&](const Vec3d& p, double radius) {
    const auto wall = [&](double x, double length, const Vec3d& inward) {
      const double low = gap + radius - x, high = gap + radius - (length - x);
      if (low > 0) m.add(low, p, inward);
      if (high > 0) m.add(high, p, -inward);
    };
    if (domain.is_box()) {
      wall(p.x, l.x, {1, 0, 0}), wall(p.y, l.y, {0, 1, 0});
    } else {
      Vec3d side = domain.overlap(p, gap + radius).push;
      side.*along = 0;  // the ends of the prism follow
      if (const double depth = norm(side); depth > 0) m.add(depth, p, (1 / depth) * side);
    }
    wall(p.*along, l.*along, inwards);
  };
  if (body.sphere) {
    add(c, body.sphere_radius());
  } else {
    for (const Vec3d& p : body.geometry->shape.surface.points) add(body.to_space(p), 0);
  }
  return m.contact();
}

}  // namespace macadam
