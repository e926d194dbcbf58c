// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_placement.hpp  Shaped aggregates in the box: turned and placed so that no two touch.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "macadam/shape.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// A shape of which scaled copies are placed.
struct ShapeTemplate {
  Surface surface;            ///< closed, its volume's centroid at the origin
  double volume = 0;          ///< [m³]
  double d_intermediate = 0;  ///< D^I, the size by which sieves part [m]
  double sphere_size = 1;     ///< diameter of the single sphere that may stand for a copy, over the copy's D^I
};

/// The surface about its centroid, measured.
/// \throws InputError where the surface is not closed.
ShapeTemplate shape_template(const Surface& surface);

/// One aggregate that must find a place.
struct AggregateRequest {
  int size_class = 0;   ///< in the recipe's order
  int shape = 0;        ///< number of its template
  double size = 0;      ///< its D^I [m]
  bool sphere = false;  ///< a single sphere stands for the shape
};

/// An aggregate in its place. Its surface is its template's, moved by `pose`; of a sphere the pose's centre is the
/// sphere's.
struct PlacedAggregate {
  int size_class = 0, shape = 0;
  bool sphere = false;
  Pose pose;
};

/// What must find a place: one row a class (counts and fractions reached are those asked), aggregates largest first.
struct ShapeComposition {
  std::vector<CompositionRow> row;
  std::vector<AggregateRequest> aggregate;
};

/// Volume of one aggregate [m³]: of the scaled shape, or of the sphere that stands for it.
double aggregate_volume(const ShapeTemplate& shape, double size, bool sphere);

/// Draws the aggregates of a recipe: sizes D^I by the size law, templates evenly at random. Volume fractions are of the
/// solid volume, as compose() has it. The summed volume of a class meets its own to 1e-3 of it; the nearest of many
/// draws counts where none does. `is_sphere` tells for which template and D^I a single sphere stands for the shape.
/// \throws InputError for a recipe that nobody could follow, and where a class would miss its volume by 5e-3 of it.
ShapeComposition compose_shapes(const SpecimenSpec& spec, const std::vector<ShapeTemplate>& shapes,
                                const std::function<bool(int shape, double size)>& is_sphere);

/// The search for places.
struct ShapePlacementSpec {
  PlacementMethod method = PlacementMethod::packing;
  std::int64_t attempts = 2'000'000;  ///< insertion: rotations and positions tried for one aggregate
  bool allow_short = false;           ///< insertion: return what found a place where not all did
  double gap = 0.01;                  ///< packing: least distance of two surfaces, over the smaller one's D^I
  double spacing = 0;                 ///< insertion: least distance of two aggregates [m]
  /// Insertion: the spheres of each aggregate about its origin, unturned; they are tested in place of its surface.
  std::vector<MultiSphere> spheres;
  std::uint64_t seed = 1;
  std::string origin = "aggregates: ";  ///< of the recipe: begins the messages
};

/// Aggregates in their places, largest first.
struct ShapePlacement {
  std::vector<PlacedAggregate> aggregate;
  std::vector<std::size_t> request;  ///< number of each in the composition
  std::vector<CompositionRow> row;   ///< what was asked and what found a place, one a class
};

/// Turns and places the aggregates at random inside the box; no two surfaces touch, nor holds one another, by exact
/// tests of their triangles, or of the spheres that are given. The same input gives the same bits for any number of
/// threads. \throws RunError naming the class that found no room and how much of it had, unless `spec.allow_short`.
ShapePlacement place_shapes(const Box& box, const std::vector<ShapeTemplate>& shapes,
                            const ShapeComposition& composition, const ShapePlacementSpec& spec,
                            const std::function<void(const char* stage, double share)>& progress = {});

}  // namespace macadam
