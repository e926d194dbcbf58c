// SPDX-License-Identifier: GPL-3.0-or-later
/// \file parts.hpp  Defines what a shape of a domain answers, and the types of its answers.
#pragma once

#include <charconv>
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

/// A plane of a domain's surface in the tessellation, with its outward normal.
struct SidePlane : Plane {
  int wall = 0;         ///< index of the wall to which the plane belongs (wall_index())
  bool on_box = false;  ///< whether the plane is the wall of the bounding box with the same index
};

/// How far a sphere reaches beyond the surface of a domain.
struct Overlap {
  Vec3d push{};     ///< sum over the walls of depth times inward normal [m]
  Vec3d squares{};  ///< squared depths, summed over the walls along each axis [m²]; the energy of the overlap is
                    ///< proportional to their sum
};

/// A dimension of a shape, which a scene gives by one key.
struct Dimension {
  const char* key;   ///< name of the key
  const char* text;  ///< words that follow the name of the key in its description
};

/// The smallest dimension of a domain. A sphere of this diameter or larger does not fit into the domain.
struct SmallestDimension {
  double length;      ///< [m]
  const char* words;  ///< for messages, such as "the smallest edge of the box"
};

/// A shape and the edges of its bounding box [m].
template <class S>
struct Sized {
  Vec3d size;
  S shape;
};

/// Returns the shortest text from which the number can be read again.
inline std::string shortest_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// A shape inscribed in a bounding box, whose edge lengths are `size` [m] and whose one corner is the origin. Every
/// shape is a prism or a circular cylinder (a prism whose profile has curved sides). Its two ends are walls of the
/// bounding box. The members of a shape are:
/// - `name`: its name in scenes;
/// - `keys`: its dimensions, each with the key that gives it in scenes; empty for a box, whose key `box` is a list;
/// - `of(values)`: the shape and its bounding box with these dimensions [m], in the order of `keys`;
/// - `values(size)`: these dimensions [m];
/// - `is_box`: whether the shape is the whole bounding box;
/// - `has_uniform_section`: whether z = 0 and z = size.z are flat platens, and all sections between them are equal;
/// - `prism_axis`: number of the axis of the prism, 0 to 2;
/// - `flat_walls`: bit k is set if the wall k of the bounding box (wall_index()) is a wall of the shape. The numbers of
///   the walls −z and +z belong only to walls that can be loaded;
/// - `volume(size)` [m³];
/// - `section_area(size, axis)`: area of the section perpendicular to an axis through the middle of the box [m²];
/// - `smallest_dimension(size)`;
/// - `signed_distance(size, p)`: distance of a point from the surface [m], negative inside;
/// - `inside_sides(size, p, inset)`: whether a point of the bounding box is at least `inset` [m] from every side. A
///   side is a wall that is not an end of the prism; for a box the function returns true;
/// - `side_planes(size)`: planes that represent the sides in the tessellation, one after the other, counter-clockwise
///   about the prism's axis; none for a box. The polygon that they enclose has exactly the area of the section
///   perpendicular to the prism's axis;
/// - `wall_area(size, k)`: area of the wall with the index k in the tessellation [m²]; 0: no such wall;
/// - `wall_name(k)`: name of this wall in messages;
/// - `overlap(size, centre, radius)` of a sphere with the walls;
/// - `pulled_inside(size, p)`: the point, moved inside if it lies beyond the surface or too near it;
/// - `expected_size(size)`: condition that the dimensions violate; a null pointer if they are right;
/// - `dimensions(size)`: kind and dimensions, for messages, such as "box of 1 x 2 x 3 m";
/// - `position(size)`: place of the shape in its box, for messages, such as "whose axis is x = y = 1 m".
template <class S>
concept DomainShape = requires(const S& s, const Vec3d& v, int k, double length, const std::vector<double>& values) {
  { S::name } -> std::convertible_to<const char*>;
  { S::keys.size() } -> std::convertible_to<std::size_t>;
  { S::of(values) } -> std::same_as<Sized<S>>;
  { s.values(v) } -> std::same_as<std::vector<double>>;
  { S::is_box } -> std::convertible_to<bool>;
  { S::has_uniform_section } -> std::convertible_to<bool>;
  { S::prism_axis } -> std::convertible_to<int>;
  { S::flat_walls } -> std::convertible_to<unsigned>;
  { s.volume(v) } -> std::same_as<double>;
  { s.section_area(v, k) } -> std::same_as<double>;
  { s.smallest_dimension(v) } -> std::same_as<SmallestDimension>;
  { s.signed_distance(v, v) } -> std::same_as<double>;
  { s.inside_sides(v, v, length) } -> std::same_as<bool>;
  { s.side_planes(v) } -> std::same_as<std::vector<SidePlane>>;
  { s.wall_area(v, k) } -> std::same_as<double>;
  { s.wall_name(k) } -> std::convertible_to<const char*>;
  { s.overlap(v, v, length) } -> std::same_as<Overlap>;
  { s.pulled_inside(v, v) } -> std::same_as<Vec3d>;
  { s.expected_size(v) } -> std::convertible_to<const char*>;
  { s.dimensions(v) } -> std::same_as<std::string>;
  { s.position(v) } -> std::same_as<std::string>;
};

}  // namespace macadam::domains
