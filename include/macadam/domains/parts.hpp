// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parts.hpp  Defines what a shape of a domain answers, and the types of its answers.
#pragma once

#include <concepts>
#include <string>
#include <vector>

#include "macadam/numeric.hpp"

namespace macadam::domains {

/// A plane n·x = offset. Points with a positive height lie on the side to which the normal points.
struct Plane {
  Vec3d normal{};     ///< unit vector
  double offset = 0;  ///< [m]
  double height(const Vec3d& p) const { return dot(p, normal) - offset; }
};

/// How far a sphere reaches beyond the surface of a domain.
struct Overlap {
  Vec3d push{};     ///< sum over the walls of depth times inward normal [m]
  Vec3d squares{};  ///< squared depths, summed over the walls along each axis [m²]; the energy of the overlap is
                    ///< proportional to their sum
};

/// A shape inscribed in a bounding box, whose edge lengths are `size` [m] and whose one corner is the origin. Loads act
/// along z on the two flat platens z = 0 and z = size.z. The functions of a shape are:
/// - `name`: its name in scenes;
/// - `section_area(size)`: area of the section perpendicular to z [m²], the same at every z;
/// - `signed_distance(size, p)`: distance of a point from the surface [m], negative inside;
/// - `inside_sides(size, p, inset)`: whether a point of the bounding box is at least `inset` [m] from every curved
///   side;
/// - `side_planes(size)`: planes that represent the curved sides in the tessellation, with outward normals, one after
///   the other around the axis; none for a shape with flat walls. Their prism has exactly the area section_area();
/// - `wall_area(size, k)`: area of the wall with the index k (wall_index()) in the tessellation [m²]; 0: no such wall;
/// - `wall_name(k)`: name of this wall in messages;
/// - `overlap(size, centre, radius)` of a sphere with the walls;
/// - `pulled_inside(size, p)`: the point, moved inside if it lies beyond the surface or too near it;
/// - `expected_size(size)`: condition that the edges of the bounding box violate; a null pointer if they are right;
/// - `dimensions(size)`: kind and dimensions, for messages, such as "box of 1 x 2 x 3 m".
template <class S>
concept DomainShape = requires(const S& s, const Vec3d& v, int k, double length) {
  { S::name } -> std::convertible_to<const char*>;
  { s.section_area(v) } -> std::same_as<double>;
  { s.signed_distance(v, v) } -> std::same_as<double>;
  { s.inside_sides(v, v, length) } -> std::same_as<bool>;
  { s.side_planes(v) } -> std::same_as<std::vector<Plane>>;
  { s.wall_area(v, k) } -> std::same_as<double>;
  { s.wall_name(k) } -> std::convertible_to<const char*>;
  { s.overlap(v, v, length) } -> std::same_as<Overlap>;
  { s.pulled_inside(v, v) } -> std::same_as<Vec3d>;
  { s.expected_size(v) } -> std::convertible_to<const char*>;
  { s.dimensions(v) } -> std::same_as<std::string>;
};

}  // namespace macadam::domains
