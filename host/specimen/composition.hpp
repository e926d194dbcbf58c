// SPDX-License-Identifier: GPL-3.0-or-later
/// \file composition.hpp  Computes, from the recipe of a scene, the radii of the spheres that must be placed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/spheres/size_law.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// File and line of a recipe, or of one of its classes.
struct Origin {
  std::string source = "specimen";
  int line = 0;

  Origin() = default;
  explicit Origin(const SpecimenSpec& spec, int line = 0) : source(spec.source), line(line > 0 ? line : spec.line) {}

  /// Returns `scene.toml:12: `, which begins messages of errors other than InputError.
  std::string text() const { return source + (line > 0 ? ":" + std::to_string(line) : "") + ": "; }
};

/// The spheres of one aggregate class, of the mastic or of the voids.
struct Population {
  CompositionRow row;
  std::vector<double> radius;  ///< [m], largest first
  Origin origin;
};

/// Sizes of all aggregates and mastic spheres of a specimen, without positions.
struct Composition {
  std::vector<Population> aggregate;  ///< in the order of the recipe
  std::vector<Population> mastic;     ///< one entry, or none without mastic
};

/// The request of a recipe for one class (aggregate, mastic or voids), before sizes are drawn.
struct ClassRequest {
  std::string name;
  SizeRange range;
  double form = 1;  ///< mean volume of the bodies, relative to spheres of the same sizes
  std::optional<std::int64_t> count;
  Origin origin;
  double volume = 0;  ///< [m³]

  /// Returns the expected volume of `count` bodies [m³].
  double counted_volume() const { return static_cast<double>(*count) * form * range.mean_volume(); }

  /// Returns the given count. Without a count, considers the numbers of bodies that can have `volume` with sizes within
  /// `range`, and returns the one whose expected volume is closest to `volume`. \throws InputError if every number
  /// misses the volume by more than 0.2 % of the box.
  std::int64_t number(double box_volume) const;
};

/// A recipe with the volumes of its classes.
struct Recipe {
  std::vector<ClassRequest> aggregate;  ///< in the order of the recipe
  std::optional<ClassRequest> mastic;
};

/// Computes the volumes of the classes of a recipe. `form`, if given, returns ClassRequest::form for an aggregate
/// class.
/// \throws InputError for a contradictory or impossible recipe.
Recipe solve_recipe(const SpecimenSpec& spec, const std::function<double(const SizeRange&)>& form = {});

/// Checks that the largest aggregate of a class fits in the box. \throws InputError if its size `largest` [m] exceeds
/// the shortest edge of the box.
void require_fit(const Origin& origin, const std::string& size_class, double largest, const Domain& box);

/// Draws the radii of all aggregates and mastic spheres of a recipe. Volume fractions refer to the solid volume: (1 −
/// porosity)·(box − voids), or the value that follows from the count of mastic spheres. Without mastic the solid volume
/// is unknown, and fractions refer to the box. The drawn volume of a class equals the requested one up to rounding if
/// its sieve sizes allow this; otherwise they differ by at most 0.2 % of the box volume. \throws InputError for a
/// contradictory or impossible recipe.
Composition compose(const SpecimenSpec& spec);

/// Draws the mastic of a recipe whose aggregates have a known volume [m³]. Returns one entry, or none if the recipe has
/// no mastic. \throws InputError as compose().
std::vector<Population> compose_mastic(const SpecimenSpec& spec, double aggregate_volume);

/// Returns only the number of mastic spheres, or of voids. \throws InputError as compose().
/// @{
std::int64_t mastic_number(const SpecimenSpec& spec, double aggregate_volume);
std::int64_t void_number(const SpecimenSpec& spec);
/// @}

/// Draws the voids of a recipe. Returns one entry, or none if the recipe has no voids. \throws InputError as compose().
std::vector<Population> compose_voids(const SpecimenSpec& spec);

}  // namespace macadam
