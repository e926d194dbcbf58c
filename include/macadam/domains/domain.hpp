// SPDX-License-Identifier: GPL-3.0-or-later
/// \file domain.hpp  Defines the region of a specimen: a shape in its bounding box.
#pragma once

#include <optional>
#include <string>
#include <utility>
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
  /// Returns whether the domain is its whole bounding box.
  bool is_box() const {
    return ask([](const auto& s) { return s.is_box; });
  }
  /// Returns whether z = 0 and z = size.z are flat platens, and all sections between them are equal. Tests under one
  /// stress along z need such a domain.
  bool has_uniform_section() const {
    return ask([](const auto& s) { return s.has_uniform_section; });
  }
  /// Returns the number of the prism's axis, 0 to 2; 2 for a box.
  int prism_axis() const {
    return ask([](const auto& s) { return s.prism_axis; });
  }
  /// Returns whether a wall of the bounding box, by wall_index(), is a wall of the domain.
  bool is_flat(int k) const {
    return ask([&](const auto& s) { return (s.flat_walls >> k & 1U) != 0; });
  }

  /// Returns the dimensions that describe the shape in scenes; none for a box.
  std::vector<domains::Dimension> keys() const {
    return ask([](const auto& s) { return std::vector<domains::Dimension>(s.keys.begin(), s.keys.end()); });
  }
  /// Returns the dimensions [m] from which domain_of() makes the same domain.
  std::vector<double> values() const {
    return ask([&](const auto& s) { return s.values(size); });
  }

  double volume() const {  ///< [m³]
    return ask([&](const auto& s) { return s.volume(size); });
  }
  /// Returns the area of the section perpendicular to an axis (0 to 2) through the middle of the bounding box [m²].
  double section_area(int axis = 2) const {
    return ask([&](const auto& s) { return s.section_area(size, axis); });
  }
  /// Returns the torsion constant J of the section perpendicular to z [m⁴]: the torque is G·J times the turn per
  /// length. Empty for all shapes except a cylinder, whose J is the polar moment of its section.
  std::optional<double> torsion_constant() const {
    return ask([&](const auto& s) -> std::optional<double> {
      if constexpr (requires { s.torsion_constant(Vec3d{}); }) {
        return s.torsion_constant(size);
      } else {
        return {};
      }
    });
  }
  /// Returns the extent along an axis (0 to 2) [m]; along z it is the distance of the two platens.
  double gauge_length(int axis = 2) const { return axis == 0 ? size.x : axis == 1 ? size.y : size.z; }
  /// Returns the smallest dimension; larger spheres do not fit into the domain.
  domains::SmallestDimension smallest_dimension() const {
    return ask([&](const auto& s) { return s.smallest_dimension(size); });
  }

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
  /// Returns whether a point of the bounding box is at least `inset` [m] from every side (domains::DomainShape).
  bool inside_sides(const Vec3d& p, double inset) const {
    return ask([&](const auto& s) { return s.inside_sides(size, p, inset); });
  }
  /// Gives the domain two strips of this width [m] at its bottom and top, which are the walls −z and +z. Returns
  /// whether the shape can have strips.
  bool set_strips(double width) {
    return std::visit(
        [width](auto& s) {
          if constexpr (requires { s.strip_width; }) {
            s.strip_width = width;
            return true;
          } else {
            return false;
          }
        },
        shape);
  }
  /// Gives the domain rollers on its walls −z and +z. Returns whether the shape can have rollers.
  bool set_rollers(const domains::Rollers& rollers) {
    return std::visit(
        [&rollers](auto& s) {
          if constexpr (requires { s.rollers; }) {
            s.rollers = rollers;
            return true;
          } else {
            return false;
          }
        },
        shape);
  }
  /// Returns the rollers; a null pointer if the domain has none.
  const domains::Rollers* rollers() const {
    return ask([](const auto& s) -> const domains::Rollers* {
      if constexpr (requires { s.rollers; }) {
        return s.rollers.width > 0 ? &s.rollers : nullptr;
      } else {
        return nullptr;
      }
    });
  }
  /// Returns whether a facet of a wall, by wall_index(), touches this wall. On a wall with rollers only the facets
  /// whose centroids [m] lie within a roller do so.
  bool carries(int k, const Vec3d& centroid) const {
    return ask([&](const auto& s) {
      if constexpr (requires { s.carries(k, centroid); }) {
        return s.carries(k, centroid);
      } else {
        return true;
      }
    });
  }
  /// Returns the planes that represent the sides in the tessellation; none for a box.
  std::vector<domains::SidePlane> side_planes() const {
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
  /// Returns the condition that the dimensions violate; a null pointer if they are right.
  const char* expected_size() const {
    return ask([&](const auto& s) { return s.expected_size(size); });
  }
  /// Returns kind and dimensions for messages, such as "box of 1 x 2 x 3 m".
  std::string dimensions() const {
    return ask([&](const auto& s) { return s.dimensions(size); });
  }
  /// Returns the place of the shape in its bounding box for messages, such as "whose axis is x = y = 1 m".
  std::string position() const {
    return ask([&](const auto& s) { return s.position(size); });
  }
};

/// A domain that is a box: `Box{{Lx, Ly, Lz}}`.
using Box = Domain;

/// Returns the domain with the shape of this name and these dimensions [m], in the order of the shape's `keys` (of a
/// box: its edges). \throws std::bad_optional_access for an unknown name, std::out_of_range for too few dimensions.
inline Domain domain_of(const std::string& name, const std::vector<double>& values) {
  const auto make = [&](const auto& s) -> Domain {
    auto made = s.of(values);
    return {made.size, std::move(made.shape)};
  };
  return std::visit(make, domains::shape_named(name).value());
}

/// Returns the cylinder with these dimensions [m]. Its axis is along z through x = y = diameter/2.
inline Domain cylinder_domain(double diameter, double height) {
  return {{diameter, diameter, height}, domains::Cylinder{}};
}

}  // namespace macadam
