// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_placement.hpp  Places shaped aggregates in the box, with random rotations, such that no two touch.
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
  Surface surface;            ///< closed; the centroid of its volume is at the origin
  double volume = 0;          ///< [m³]
  double d_intermediate = 0;  ///< D^I, which sieves measure [m]
  double sphere_size = 1;     ///< diameter of the single sphere that may represent a copy, divided by the copy's D^I
};

/// Moves the surface to its centroid and measures it. \throws InputError if the surface is not closed.
ShapeTemplate shape_template(const Surface& surface);

/// An aggregate to be placed.
struct AggregateRequest {
  int size_class = 0;   ///< index in the recipe's list of classes
  int shape = 0;        ///< index of its template
  double size = 0;      ///< D^I of the aggregate [m]
  bool sphere = false;  ///< whether a single sphere represents the shape
};

/// A placed aggregate. Its surface is the surface of its template, moved by `pose`. For a single sphere the pose gives
/// the centre.
struct PlacedAggregate {
  int size_class = 0, shape = 0;
  bool sphere = false;
  Pose pose;
};

/// The aggregates to be placed, largest first, and one row per class. The reached counts and fractions in a row are
/// computed from these aggregates.
struct ShapeComposition {
  std::vector<CompositionRow> row;
  std::vector<AggregateRequest> aggregate;
};

/// Returns the volume of one aggregate [m³]: the volume of the scaled shape, or of the sphere that represents it.
double aggregate_volume(const ShapeTemplate& shape, double size, bool sphere);

/// Draws the aggregates of a recipe: sizes D^I by the size law, templates with equal probability. Volume fractions
/// refer to the solid volume, as in compose(). The drawn volume of a class differs from the requested one by at most
/// 0.1 %; if none of 200 samples is that close, the closest one is used. `is_sphere` returns, for a template and a D^I,
/// whether a single sphere represents the aggregate. \throws InputError for a contradictory or impossible recipe, and
/// if the volume of a class would be wrong by more than 0.5 %.
ShapeComposition compose_shapes(const SpecimenSpec& spec, const std::vector<ShapeTemplate>& shapes,
                                const std::function<bool(int shape, double size)>& is_sphere);

/// Settings of the search for places.
struct ShapePlacementSpec {
  PlacementMethod method = PlacementMethod::packing;
  std::int64_t attempts = 2'000'000;  ///< insertion: number of rotations and positions tried for one aggregate
  bool allow_short = false;           ///< insertion: whether to return the placed aggregates if not all were placed
  double gap = 0.01;                  ///< packing: least distance of two surfaces, relative to the smaller one's D^I
  double spacing = 0;                 ///< insertion: least distance of two aggregates [m]
  /// Insertion: the spheres of each aggregate relative to its centre, before rotation; if given, they are tested in
  /// place of its surface.
  std::vector<MultiSphere> spheres;
  std::uint64_t seed = 1;
  std::string origin = "aggregates: ";  ///< begins the messages; names the recipe
};

/// The placed aggregates, largest first.
struct ShapePlacement {
  std::vector<PlacedAggregate> aggregate;
  std::vector<std::size_t> request;  ///< for each placed aggregate, its index in ShapeComposition::aggregate
  std::vector<CompositionRow> row;   ///< requested and placed amounts, one row per class
};

/// Places the aggregates at random positions and rotations inside the box, such that no two surfaces touch and none
/// contains another. Exact tests of the triangles, or of the spheres if these are given, ensure both conditions. The
/// same input gives the same bits for any number of threads. \throws RunError naming the class that did not fit, and
/// how much of it was placed, unless `spec.allow_short`.
ShapePlacement place_shapes(const Domain& box, const std::vector<ShapeTemplate>& shapes,
                            const ShapeComposition& composition, const ShapePlacementSpec& spec,
                            const std::function<void(const char* stage, double share)>& progress = {});

}  // namespace macadam
