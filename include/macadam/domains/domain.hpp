// SPDX-License-Identifier: GPL-3.0-or-later
/// \file domain.hpp  Defines the region of a specimen: a shape in its bounding box.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "macadam/domains/all.hpp"

namespace macadam {

/// The region that a specimen fills: a shape inscribed in an axis-aligned bounding box with one corner at the origin.
/// The axis z is the loading axis. `Domain{{Lx, Ly, Lz}}` is a box. The functions are described at
/// domains::DomainShape.
struct Domain {
 private:
  template <class F>
  auto ask(const F& f) const {
    return std::visit(f, shape);
  }

 public:
  Vec3d size{};               ///< edge lengths of the bounding box [m]
  domains::AnyShape shape{};  ///< by default the box itself

  /// Returns the shape's name in scenes.
  const char* name() const {
    return ask([](const auto& s) { return s.name; });
  }
  bool is_box() const { return std::holds_alternative<domains::Box>(shape); }

  double volume() const { return section_area() * size.z; }  ///< [m³]
  /// Returns the area of the section perpendicular to the loading axis [m²].
  double section_area() const {
    return ask([&](const auto& s) { return s.section_area(size); });
  }
  /// Returns the distance of the two platens [m].
  double gauge_length() const { return size.z; }

  /// Returns the distance of a point from the surface [m], negative inside.
  double signed_distance(const Vec3d& p) const {
    return ask([&](const auto& s) { return s.signed_distance(size, p); });
  }
  /// Returns whether a point lies inside or on the surface; false for a point that is not finite.
  bool contains(const Vec3d& p) const {
    const bool in_bounds =
        p.x >= 0 && p.x <= size.x && p.y >= 0 && p.y <= size.y && p.z >= 0 && p.z <= size.z;  // false for NaN
    return in_bounds && signed_distance(p) <= 0;
  }
  /// Returns whether a point of the bounding box is at least `inset` [m] from every curved side.
  bool inside_sides(const Vec3d& p, double inset) const {
    return ask([&](const auto& s) { return s.inside_sides(size, p, inset); });
  }
  /// Returns the planes that represent the curved sides in the tessellation; their wall has the index 0.
  std::vector<domains::Plane> side_planes() const {
    return ask([&](const auto& s) { return s.side_planes(size); });
  }
  /// Returns the area of a wall in the tessellation [m²], by wall_index(); 0 for an index without a wall.
  double wall_area(int k) const {
    return ask([&](const auto& s) { return s.wall_area(size, k); });
  }
  /// Returns the name of a wall in messages, by wall_index().
  const char* wall_name(int k) const {
    return ask([&](const auto& s) { return s.wall_name(k); });
  }
  /// Returns how far a sphere reaches beyond the surface.
  domains::Overlap overlap(const Vec3d& centre, double radius) const {
    return ask([&](const auto& s) { return s.overlap(size, centre, radius); });
  }
  /// Returns the point, moved inside if it lies beyond the surface or within about 1e-3 of the dimensions from it.
  Vec3d pulled_inside(const Vec3d& p) const {
    return ask([&](const auto& s) { return s.pulled_inside(size, p); });
  }
  /// Returns the condition that the edges of the bounding box violate; a null pointer if they are right.
  const char* expected_size() const {
    return ask([&](const auto& s) { return s.expected_size(size); });
  }
  /// Returns kind and dimensions for messages, such as "box of 1 x 2 x 3 m".
  std::string dimensions() const {
    return ask([&](const auto& s) { return s.dimensions(size); });
  }
};

/// A domain that is a box: `Box{{Lx, Ly, Lz}}`.
using Box = Domain;

/// Returns the cylinder with these dimensions [m]. Its axis is along z through x = y = diameter/2.
inline Domain cylinder_domain(double diameter, double height) {
  return {{diameter, diameter, height}, domains::Cylinder{}};
}

}  // namespace macadam
