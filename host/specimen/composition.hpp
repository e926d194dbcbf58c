// SPDX-License-Identifier: GPL-3.0-or-later
/// \file composition.hpp  From the scene's recipe to the list of spheres that must find a place.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/spheres/size_law.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Where a recipe, or a class of it, was asked for.
struct Origin {
  std::string source = "specimen";
  int line = 0;

  Origin() = default;
  explicit Origin(const SpecimenSpec& spec, int line = 0) : source(spec.source), line(line > 0 ? line : spec.line) {}

  /// `scene.toml:12: `, for the messages of errors that are no InputError.
  std::string text() const { return source + (line > 0 ? ":" + std::to_string(line) : "") + ": "; }
};

/// The spheres of one aggregate class, or of the mastic.
struct Population {
  CompositionRow row;
  std::vector<double> radius;  ///< largest first [m]
  Origin origin;
};

/// Sizes of everything solid in the specimen; no positions yet.
struct Composition {
  std::vector<Population> aggregate;  ///< in the recipe's order
  std::vector<Population> mastic;     ///< one entry, or none
};

/// One class of a recipe, aggregate or mastic, before its bodies are drawn.
struct ClassRequest {
  std::string name;
  SizeRange range;
  double form = 1;  ///< mean volume of its bodies over that of spheres of their sizes
  std::optional<std::int64_t> count;
  Origin origin;
  double volume = 0;  ///< [m³]

  double counted_volume() const { return static_cast<double>(*count) * form * range.mean_volume(); }

  /// Given, or the number that comes nearest to the class's volume with the law's mean.
  /// \throws InputError where none comes near.
  std::int64_t number(double box_volume) const;
};

/// A recipe solved for the volumes of its classes.
struct Recipe {
  std::vector<ClassRequest> aggregate;  ///< in the recipe's order
  std::optional<ClassRequest> mastic;
};

/// Solves a recipe; `form`, if given, tells ClassRequest::form of an aggregate class.
/// \throws InputError for a recipe that nobody could follow.
Recipe solve_recipe(const SpecimenSpec& spec, const std::function<double(const SizeRange&)>& form = {});

/// Refuses an aggregate whose size [m] exceeds the shortest edge of the box.
void require_fit(const Origin& origin, const std::string& size_class, double largest, const Box& box);

/// Draws every solid sphere of a recipe. Volume fractions are of the solid volume: (1 − porosity)·(box − voids), or
/// what follows from the count of mastic spheres; without mastic the solid volume is unknown and fractions are of the
/// box. Each class reaches its volume to rounding where its sieves allow, else to 0.2 % of the box. \throws InputError
/// for a recipe that nobody could follow.
Composition compose(const SpecimenSpec& spec);

/// The mastic of a recipe beside aggregates of a known volume [m³]: one entry, or none.
/// \throws InputError as compose().
std::vector<Population> compose_mastic(const SpecimenSpec& spec, double aggregate_volume);

/// The number of its spheres alone, and of voids. \throws InputError as compose().
/// @{
std::int64_t mastic_number(const SpecimenSpec& spec, double aggregate_volume);
std::int64_t void_number(const SpecimenSpec& spec);
/// @}

/// The voids of a recipe: one entry, or none.
/// \throws InputError as compose().
std::vector<Population> compose_voids(const SpecimenSpec& spec);

}  // namespace macadam
