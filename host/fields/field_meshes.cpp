// SPDX-License-Identifier: GPL-3.0-or-later
// field_meshes.cpp  Makes the meshes of a specimen (vertices, lines or polygons), and the arrays on them that do not
// change during a run.
#include <numeric>

#include "host/fields/field_lists.hpp"
#include "macadam/fields.hpp"

namespace macadam {
namespace {

using Shape = FieldMesh::Shape;

void add_point(std::vector<float>& points, const Vec3d& p) {
  points.insert(points.end(), {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
}

/// Size class of each body; −1 if it is not known.
class SizeClasses {
 public:
  explicit SizeClasses(const std::vector<Aggregate>& aggregates) {
    for (const Aggregate& a : aggregates) {
      const auto body = static_cast<std::size_t>(a.body);
      if (body >= of_body_.size()) of_body_.resize(body + 1, -1);
      of_body_[body] = a.size_class;
    }
  }
  bool known() const { return !of_body_.empty(); }
  std::int32_t of(std::int32_t body) const {
    return body >= 0 && static_cast<std::size_t>(body) < of_body_.size() ? of_body_[static_cast<std::size_t>(body)]
                                                                         : -1;
  }

 private:
  std::vector<std::int32_t> of_body_;
};

/// Adds phase, body and, if it is known, size class of each particle or void in `cells`.
void add_materials(const Specimen& specimen, const std::vector<Aggregate>& aggregates,
                   const std::vector<std::int32_t>& cells, std::vector<FieldArray>& arrays) {
  const SizeClasses classes(aggregates);
  std::vector<std::int32_t> phase, body, size_class;
  for (const std::int32_t cell : cells) {
    const bool is_void = static_cast<std::size_t>(cell) >= specimen.size();
    phase.push_back(static_cast<std::int32_t>(specimen.phase_of(cell)));
    body.push_back(is_void ? -1 : specimen.body[static_cast<std::size_t>(cell)]);
    size_class.push_back(classes.of(body.back()));
  }
  arrays.push_back({"phase", "1", 1, std::move(phase)});
  arrays.push_back({"body", "1", 1, std::move(body)});
  if (classes.known()) arrays.push_back({"size_class", "1", 1, std::move(size_class)});
}

}  // namespace

FieldMesh particle_mesh(const Specimen& specimen, const std::vector<Aggregate>& aggregates) {
  FieldMesh out;
  std::vector<std::int32_t> number(specimen.size());
  std::iota(number.begin(), number.end(), 0);
  for (const Vec3d& centre : specimen.centre) add_point(out.points, centre);
  out.connectivity.assign(number.begin(), number.end());
  out.offsets = out.connectivity;
  out.offsets.push_back(static_cast<std::int64_t>(number.size()));
  out.arrays.push_back(scalars("radius", "m", specimen.radius));
  add_materials(specimen, aggregates, number, out.arrays);
  out.arrays.push_back({"particle", "1", 1, std::move(number)});
  return out;
}

FieldMesh contact_mesh(const Specimen& specimen, const ContactNetwork& network) {
  FieldMesh out;
  out.shape = Shape::lines;
  for (const Vec3d& centre : specimen.centre) add_point(out.points, centre);
  out.offsets.push_back(0);
  std::vector<std::int32_t> a, b, pair;
  std::vector<double> area, distance;
  std::vector<Vec3d> normal;
  for (const Contact& c : network.contacts) {
    out.connectivity.push_back(c.a);
    if (c.b < 0) {  // a contact at a wall ends at a point of its own, the foot of its normal on the wall
      out.connectivity.push_back(static_cast<std::int64_t>(out.point_count()));
      add_point(out.points, specimen.centre[static_cast<std::size_t>(c.a)] + c.distance * c.n);
    } else {
      out.connectivity.push_back(c.b);
    }
    out.offsets.push_back(static_cast<std::int64_t>(out.connectivity.size()));
    a.push_back(c.a), b.push_back(c.b), pair.push_back(static_cast<std::int32_t>(c.pair));
    area.push_back(c.area), distance.push_back(c.distance), normal.push_back(c.n);
  }
  out.arrays = {{"a", "1", 1, std::move(a)}, {"b", "1", 1, std::move(b)}, {"pair", "1", 1, std::move(pair)}};
  out.arrays.push_back(scalars("area", "m2", area));
  out.arrays.push_back(scalars("distance", "m", distance));
  out.arrays.push_back(vectors("normal", "1", normal));
  return out;
}

FieldMesh cell_mesh(const Specimen& specimen, const Tessellation& tessellation,
                    const std::vector<Aggregate>& aggregates) {
  FieldMesh out;
  out.shape = Shape::polygons;
  out.offsets.push_back(0);
  out.points.reserve(3 * tessellation.vertices.size());
  std::vector<std::int32_t> particle, neighbour;
  std::vector<double> area;
  const auto add = [&](const Facet& f, std::int32_t cell, std::int32_t other) {
    out.offsets.push_back(static_cast<std::int64_t>(out.connectivity.size()));
    particle.push_back(cell), neighbour.push_back(other), area.push_back(f.area);
  };
  for (const Facet& f : tessellation.facets) {
    const auto first = static_cast<std::int64_t>(out.point_count());
    for (const Vec3d& v : tessellation.polygon(f)) add_point(out.points, v);
    const auto end = static_cast<std::int64_t>(out.point_count());
    for (std::int64_t v = first; v < end; ++v) out.connectivity.push_back(v);
    add(f, f.a, f.b);
    if (f.b < 0) continue;
    for (std::int64_t v = end; v-- > first;) out.connectivity.push_back(v);
    add(f, f.b, f.a);
  }
  add_materials(specimen, aggregates, particle, out.arrays);
  out.arrays.push_back({"particle", "1", 1, std::move(particle)});
  out.arrays.push_back({"neighbour", "1", 1, std::move(neighbour)});
  out.arrays.push_back(scalars("area", "m2", area));
  return out;
}

// Facets and contacts are both in the order of (a, b), and each contact has exactly one facet.
FieldMesh crack_mesh(const Tessellation& tessellation, const ContactNetwork& network, const FactsTable& laws) {
  FieldMesh out;
  out.shape = Shape::polygons;
  out.offsets.push_back(0);
  std::vector<std::int32_t> contact, pair;
  std::vector<double> area;
  std::size_t facet = 0;
  for (std::size_t i = 0; i < network.contacts.size(); ++i) {
    const Contact& c = network.contacts[i];
    if (!has_crack(laws, c)) continue;
    while (tessellation.facets[facet].a != c.a || tessellation.facets[facet].b != c.b) ++facet;
    for (const Vec3d& v : tessellation.polygon(tessellation.facets[facet])) {
      out.connectivity.push_back(static_cast<std::int64_t>(out.point_count()));
      add_point(out.points, v);
    }
    out.offsets.push_back(static_cast<std::int64_t>(out.connectivity.size()));
    contact.push_back(static_cast<std::int32_t>(i)), pair.push_back(static_cast<std::int32_t>(c.pair));
    area.push_back(c.area);
  }
  out.arrays = {{"contact", "1", 1, std::move(contact)}, {"pair", "1", 1, std::move(pair)}};
  out.arrays.push_back(scalars("area", "m2", area));
  return out;
}

}  // namespace macadam
