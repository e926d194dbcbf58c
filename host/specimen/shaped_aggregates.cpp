// SPDX-License-Identifier: GPL-3.0-or-later
// shaped_aggregates.cpp  Prepares the templates of a shape library, draws aggregates, fills them with spheres and
// places them.
#include "host/specimen/shaped_aggregates.hpp"

#include <algorithm>
#include <memory>

#include "kernels/base/parallel.hpp"
#include "host/shapes/fill/fill.hpp"
#include "host/specimen/composition.hpp"
#include "host/specimen/packing/shape_placement.hpp"
#include "host/spheres/sphere_grid.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Returns the surfaces of the library that the recipe names.
std::vector<Surface> surfaces_of(const ShapeSpec& spec) {
  switch (spec.library) {
    case ShapeSpec::Library::aggregates:
      return shape_library();
    case ShapeSpec::Library::icosahedron:
      return {subdivided_icosahedron()};
    case ShapeSpec::Library::aggregates_and_icosahedron: {
      std::vector<Surface> all = shape_library();
      all.push_back(subdivided_icosahedron());
      return all;
    }
    case ShapeSpec::Library::folder:
      break;
  }
  return read_shape_library(spec.folder);
}

/// A template with the data for placing and filling its copies.
struct Shape {
  ShapeTemplate placed;
  ShapeFiller filler;

  Shape(const Surface& surface, SingleSphere single) : placed(shape_template(surface)), filler(placed.surface) {
    placed.sphere_size = 2 * filler.single_radius(single) / placed.d_intermediate;
  }
  const ShapeMeasure& measure() const { return filler.measure(); }
};

/// The shapes of a recipe, and the aggregates that were drawn.
struct Drawn {
  std::vector<std::shared_ptr<const Shape>> shapes;
  std::vector<ShapeTemplate> templates;
  ShapeComposition composition;

  explicit Drawn(const SpecimenSpec& spec) {
    const ShapeSpec& how = spec.shapes.value();
    const std::vector<Surface> surfaces = surfaces_of(how);
    shapes.resize(surfaces.size());
    for_each_in_parallel(surfaces.size(), [&](std::size_t k) {
      shapes[k] = std::make_shared<const Shape>(surfaces[k], how.fill.single);
    });
    for (const auto& shape : shapes) templates.push_back(shape->placed);
    composition = compose_shapes(
        spec, templates, [&](int shape, double size) { return spheres(shape, size, how.fill) < how.fill.least; });
  }

  /// Returns the number of spheres that fill a shape of this size.
  std::int64_t spheres(int shape, double size, const FillSpec& fill) const {
    const Shape& s = *shapes[static_cast<std::size_t>(shape)];
    return s.filler.spheres(size / s.measure().d_intermediate, fill);
  }
};

/// Applies the inverse of a pose.
Vec3d back(const Pose& pose, const Vec3d& point) {
  const auto& q = pose.turn;
  return Pose{{}, {q[0], -q[1], -q[2], -q[3]}, 1 / pose.scale}(point - pose.centre);
}

/// The placed shapes, without single spheres.
class PlacedShapes {
 public:
  /// `reach` is the radius of the largest sphere that will be held out of the shapes [m].
  PlacedShapes(const Box& box, std::vector<std::shared_ptr<const Shape>> shapes, std::vector<PlacedAggregate> placed,
               double reach)
      : shapes_(std::move(shapes)), placed_(std::move(placed)), grid_(box, smallest_edge(box) / 20) {
    for (std::size_t k = 0; k < placed_.size(); ++k) {
      const PlacedAggregate& a = placed_[k];
      if (!a.sphere)
        grid_.insert(static_cast<std::int32_t>(k), a.pose.centre, a.pose.scale * shape(a).measure().d_long + reach);
    }
  }

  /// Returns whether a point is in one of the shapes.
  bool hold(const Vec3d& point) const {
    const auto& near = grid_.near(grid_.cell_of(point));
    return std::any_of(near.begin(), near.end(), [&](std::int32_t k) {
      const PlacedAggregate& a = placed_[static_cast<std::size_t>(k)];
      return shape(a).filler.contains(back(a.pose, point));
    });
  }

  /// Combines all shapes near a sphere into one wall that pushes it outwards: the push is the vector sum of the depths
  /// by which the sphere reaches into each shape. `reach` is the radius of the sphere.
  WallDepth outside(const Vec3d& point, double reach) const {
    Vec3d push{};
    for (const std::int32_t k : grid_.near(grid_.cell_of(point))) {
      const PlacedAggregate& a = placed_[static_cast<std::size_t>(k)];
      const Vec3d own = back(a.pose, point);
      if (!shape(a).filler.may_reach(own, reach / a.pose.scale)) continue;
      const WallDepth above = shape(a).filler.above(own);
      const double into = reach - a.pose.scale * above.depth;
      if (into > 0) push += into * Pose{{}, a.pose.turn, 1}(above.inward);
    }
    const double into = norm(push);
    return into > 0 ? WallDepth{reach - into, (1 / into) * push} : WallDepth{2 * reach, {}};
  }

 private:
  static double smallest_edge(const Box& box) { return std::min({box.size.x, box.size.y, box.size.z}); }
  const Shape& shape(const PlacedAggregate& a) const { return *shapes_[static_cast<std::size_t>(a.shape)]; }

  std::vector<std::shared_ptr<const Shape>> shapes_;
  std::vector<PlacedAggregate> placed_;
  SphereGrid grid_;
};

Aggregate described(const PlacedAggregate& placed, const Shape& shape, std::int32_t body) {
  Aggregate out;
  out.body = body;
  out.size_class = placed.size_class;
  out.centre = placed.pose.centre;
  out.size = placed.pose.scale * shape.measure().d_intermediate;
  out.volume = aggregate_volume(shape.placed, out.size, placed.sphere);
  out.shape = placed.sphere ? "sphere" : shape.placed.surface.name;
  const double sphere = out.size * shape.placed.sphere_size;
  out.d_long = placed.sphere ? sphere : placed.pose.scale * shape.measure().d_long;
  out.d_short = placed.sphere ? sphere : placed.pose.scale * shape.measure().d_short;
  if (!placed.sphere) {
    out.axis_long = Pose{{}, placed.pose.turn, 1}(shape.measure().axis_long);
    out.surface = placed.shape;
    out.pose = placed.pose;
  }
  return out;
}

}  // namespace

double ShapedAggregates::volume() const {
  double sum = 0;
  for (const Aggregate& a : aggregate) sum += a.volume;
  return sum;
}
double ShapedAggregates::smallest_radius() const {
  double out = INFINITY;
  for (const MultiSphere& s : spheres) out = std::min(out, *std::min_element(s.radius.begin(), s.radius.end()));
  return out;
}

ShapeCensus count_shapes(const SpecimenSpec& spec) {
  const Drawn drawn(spec);
  ShapeCensus out;
  out.templates = std::ssize(drawn.templates);
  for (const AggregateRequest& r : drawn.composition.aggregate) {
    ++out.aggregates;
    out.spheres += r.sphere ? 1 : drawn.spheres(r.shape, r.size, spec.shapes->fill);
    out.volume += aggregate_volume(drawn.templates[static_cast<std::size_t>(r.shape)], r.size, r.sphere);
  }
  return out;
}

ShapedAggregates make_shaped_aggregates(const SpecimenSpec& spec,
                                        const std::function<void(const char* stage, double share)>& progress) {
  const ShapeSpec& how = spec.shapes.value();
  const Drawn drawn(spec);
  const auto& shapes = drawn.shapes;
  const ShapeComposition& composition = drawn.composition;
  ShapePlacementSpec search;
  search.method = how.placement;
  search.attempts = spec.attempts;
  search.allow_short = how.allow_short;
  search.gap = how.gap;
  search.spacing = spec.spacing;
  search.seed = spec.seed;
  search.origin = Origin(spec).text();
  const auto filled = [&](std::size_t k) {
    const AggregateRequest& r = composition.aggregate[k];
    const Shape& shape = *shapes[static_cast<std::size_t>(r.shape)];
    if (r.sphere) return MultiSphere{{Vec3d{}}, {r.size * shape.placed.sphere_size / 2}};
    FillSpec fill = how.fill;
    fill.seed = spec.seed * 1'000'003 + k;
    return shape.filler.fill(r.size / shape.placed.d_intermediate, fill);
  };
  std::vector<MultiSphere> spheres(composition.aggregate.size());
  if (progress) progress("filling aggregates", 0);
  for_each_in_parallel(spheres.size(), [&](std::size_t k) { spheres[k] = filled(k); });
  if (how.test == PlacementTest::spheres) search.spheres = spheres;
  ShapePlacement placed = place_shapes(spec.box, drawn.templates, composition, search, progress);

  ShapedAggregates out;
  out.row = std::move(placed.row);
  const std::size_t n = placed.aggregate.size();
  out.spheres.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const PlacedAggregate& a = placed.aggregate[k];
    out.aggregate.push_back(described(a, *shapes[static_cast<std::size_t>(a.shape)], static_cast<std::int32_t>(k)));
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Pose& pose = placed.aggregate[k].pose;
    out.spheres[k] = std::move(spheres[placed.request[k]]);
    // The radius must be exactly half of the diameter in the description of the aggregate, without another rounding.
    if (placed.aggregate[k].sphere) out.spheres[k].radius = {out.aggregate[k].d_long / 2};
    for (Vec3d& c : out.spheres[k].centre) c = Pose{pose.centre, pose.turn, 1}(c);
    out.aggregate[k].spheres = static_cast<std::int64_t>(out.spheres[k].size());
  }
  for (const auto& shape : shapes) out.surfaces.push_back(shape->placed.surface);
  const auto all = std::make_shared<const PlacedShapes>(spec.box, shapes, std::move(placed.aggregate),
                                                        spec.mastic ? spec.mastic->radius_max : 0);
  out.inside = [all](const Vec3d& point) { return all->hold(point); };
  if (how.hold_out > 0) {
    out.outside.depth = [all](const Vec3d& point, double reach) { return all->outside(point, reach); };
    out.outside.stiffness = how.hold_out;
  }
  return out;
}

}  // namespace macadam
