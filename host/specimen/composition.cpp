// SPDX-License-Identifier: GPL-3.0-or-later
/// \file composition.cpp  Computes the volumes of the classes of a recipe, then draws the radii of their spheres.
#include "host/specimen/composition.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "host/spheres/size_law.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr double tolerance = 0.002;  // fraction of the box volume by which a class may miss its volume

[[noreturn]] void refuse(const Origin& origin, const std::string& what, const std::string& found,
                         const std::string& expected) {
  throw InputError(origin.source, origin.line, what, found, expected);
}

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", 1e3 * metres);
  return text;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g %%", 100 * share);
  return text;
}

void check_range(const Origin& origin, const std::string& name, double min, double max) {
  if (!(std::isfinite(min) && std::isfinite(max) && min > 0 && min <= max))
    refuse(origin, name + ": sizes", shown(min) + " to " + shown(max) + " m", "0 < smallest <= largest");
}

void check_count(const Origin& origin, const std::string& name, std::int64_t count) {
  if (count < 0 || count > most_particles)
    refuse(origin, name + ": count", std::to_string(count), "0 to " + std::to_string(most_particles));
}

/// Checks an entry of the specimen (here an aggregate class, in the two functions below the mastic and the voids), and
/// returns the sizes and the amount that it requests.
ClassRequest request_of(const AggregateClass& c, const SpecimenSpec& spec) {
  const std::string name = millimetres(c.sieve_min) + "-" + millimetres(c.sieve_max) + " mm";
  const Origin origin(spec, c.line);
  check_range(origin, "aggregate class " + name, c.sieve_min, c.sieve_max);
  if (c.volume_fraction.has_value() == c.count.has_value())
    refuse(origin, "aggregate class " + name,
           c.count ? "both volume_fraction and count" : "neither volume_fraction nor count", "exactly one of the two");
  if (c.count) check_count(origin, "aggregate class " + name, *c.count);
  if (c.volume_fraction && !(*c.volume_fraction >= 0 && *c.volume_fraction <= 1))
    refuse(origin, "aggregate class " + name + ": volume_fraction", shown(*c.volume_fraction), "0 to 1");
  return {name, {spec.size_law, c.sieve_min, c.sieve_max}, 1, c.count, origin};
}

ClassRequest request_of(const MasticSpec& m, const SpecimenSpec& spec) {
  const Origin origin(spec, m.line);
  check_range(origin, "mastic", m.radius_min, m.radius_max);
  if (m.porosity.has_value() == m.count.has_value())
    refuse(origin, "mastic", m.count ? "both porosity and count" : "neither porosity nor count",
           "exactly one of the two");
  if (m.count) check_count(origin, "mastic", *m.count);
  if (m.porosity && !(std::isfinite(*m.porosity) && *m.porosity < 1))
    refuse(origin, "mastic: porosity", shown(*m.porosity), "a number below 1");
  return {"mastic", {SizeLaw::uniform, 2 * m.radius_min, 2 * m.radius_max}, 1, m.count, origin};
}

ClassRequest request_of(const VoidSpec& v, const SpecimenSpec& spec) {
  const Origin origin(spec, v.line);
  check_range(origin, "voids", v.radius_min, v.radius_max);
  if (v.fraction.has_value() == v.count.has_value())
    refuse(origin, "voids", v.count ? "both fraction and count" : "neither fraction nor count",
           "exactly one of the two");
  if (v.count) check_count(origin, "voids", *v.count);
  if (v.fraction && !(*v.fraction >= 0 && *v.fraction < 1))
    refuse(origin, "voids: fraction", shown(*v.fraction), "0 to below 1");
  ClassRequest out{"voids", {SizeLaw::uniform, 2 * v.radius_min, 2 * v.radius_max}, 1, v.count, origin};
  out.volume = v.count ? out.counted_volume() : *v.fraction * spec.box.volume();
  return out;
}

/// Returns the volume of the box without the voids [m³].
double volume_beside_voids(const SpecimenSpec& spec) {
  return spec.box.volume() - (spec.voids ? request_of(*spec.voids, spec).volume : 0);
}

/// Returns the volume of aggregates and mastic [m³], to which volume fractions refer. Without mastic this volume is
/// unknown; the function then returns the volume of the box without the voids.
double solid_volume(const SpecimenSpec& spec, const std::vector<ClassRequest>& aggregate,
                    const std::optional<ClassRequest>& mastic) {
  if (!mastic) return volume_beside_voids(spec);
  if (spec.mastic->porosity) return (1 - *spec.mastic->porosity) * volume_beside_voids(spec);
  double counted = mastic->counted_volume(), fractions = 0;
  for (std::size_t k = 0; k < aggregate.size(); ++k) {
    if (aggregate[k].count)
      counted += aggregate[k].counted_volume();
    else
      fractions += *spec.aggregate[k].volume_fraction;
  }
  if (!(fractions < 1)) refuse(Origin(spec), "aggregate: sum of the volume fractions", shown(fractions), "less than 1");
  return counted / (1 - fractions);
}

/// Draws the radii of one class.
Population draw(const ClassRequest& r, double box_volume, RandomStream random) {
  const std::int64_t n = r.number(box_volume);
  Population p{{r.name, n, n, r.volume / box_volume, 0}, draw_diameters(r.range, n, r.volume, random), r.origin};
  for (double& size : p.radius) {
    p.row.fraction += sphere_volume(size) / box_volume;
    size /= 2;
  }
  return p;
}

}  // namespace

std::int64_t ClassRequest::number(double box_volume) const {
  if (count) return *count;
  const double smallest = form * sphere_volume(range.min), largest = form * sphere_volume(range.max);
  const double most = std::floor(volume / smallest * (1 + 1e-12));
  const double least = std::ceil(volume / largest * (1 - 1e-12));
  const double mean = std::round(volume / (form * range.mean_volume()));
  if (!(mean <= static_cast<double>(most_particles)))
    refuse(origin, name + ": number of spheres that the volume needs", shown(mean),
           "at most " + std::to_string(most_particles));
  if (least <= most) return static_cast<std::int64_t>(std::clamp(mean, least, most));
  // No number of spheres with diameters between the sieve sizes has exactly this volume. `most` spheres have less
  // volume, even if all have the largest diameter. `least` spheres have more, even if all have the smallest diameter.
  const double below = volume - most * largest;
  const double above = least * smallest - volume;
  if (std::min(below, above) > tolerance * box_volume)
    refuse(origin, name + ": volume", percent(volume / box_volume) + " of the box",
           "the volume of a whole number of spheres between the two sieves, such as " +
               percent(most * largest / box_volume) + " (" + shown(most) + " spheres) or " +
               percent(least * smallest / box_volume) + " (" + shown(least) +
               " spheres); wider sieves or a larger box allow more volumes");
  return static_cast<std::int64_t>(below <= above ? most : least);
}

Recipe solve_recipe(const SpecimenSpec& spec, const std::function<double(const SizeRange&)>& form) {
  const Vec3d l = spec.box.size;
  for (double edge : {l.x, l.y, l.z})
    if (!(std::isfinite(edge) && edge > 0)) refuse(Origin(spec), "box: edge", shown(edge), "a finite positive length");
  if (spec.attempts < 1) refuse(Origin(spec), "attempts", std::to_string(spec.attempts), "at least 1");

  Recipe recipe;
  for (const AggregateClass& c : spec.aggregate) {
    recipe.aggregate.push_back(request_of(c, spec));
    if (form) recipe.aggregate.back().form = form(recipe.aggregate.back().range);
  }
  if (spec.mastic) recipe.mastic = request_of(*spec.mastic, spec);

  const double solid = solid_volume(spec, recipe.aggregate, recipe.mastic), box = spec.box.volume();
  double of_aggregates = 0;
  for (std::size_t k = 0; k < recipe.aggregate.size(); ++k) {
    ClassRequest& r = recipe.aggregate[k];
    r.volume = r.count ? r.counted_volume() : *spec.aggregate[k].volume_fraction * solid;
    of_aggregates += r.volume;
  }
  if (of_aggregates > volume_beside_voids(spec))
    refuse(Origin(spec), "aggregate: volume", percent(of_aggregates / box) + " of the box",
           "less than the box without the voids, because aggregates and voids do not overlap");
  if (recipe.mastic) {
    recipe.mastic->volume = recipe.mastic->count ? recipe.mastic->counted_volume() : solid - of_aggregates;
    if (!(recipe.mastic->volume >= 0))
      refuse(Origin(spec), "aggregate: volume", percent(of_aggregates / box) + " of the box",
             "at most the solid volume that the porosity leaves, " + percent(solid / box) + " of the box");
  }
  return recipe;
}

void require_fit(const Origin& origin, const std::string& size_class, double largest, const Domain& box) {
  const auto [edge, words] = box.smallest_dimension();
  if (largest > edge)
    refuse(origin, "aggregate class " + size_class + ": largest diameter", millimetres(largest) + " mm",
           std::string("at most ") + words + ", " + millimetres(edge) + " mm");
}

Composition compose(const SpecimenSpec& spec) {
  const Recipe recipe = solve_recipe(spec);
  const double box = spec.box.volume();
  Composition result;
  double total = 0;
  for (std::size_t k = 0; k < recipe.aggregate.size(); ++k) {
    result.aggregate.push_back(draw(recipe.aggregate[k], box, RandomStream(spec.seed, 100 + k)));
    const Population& p = result.aggregate.back();
    total += static_cast<double>(p.row.count);
    if (!p.radius.empty()) require_fit(p.origin, p.row.name, 2 * p.radius.front(), spec.box);
  }
  if (recipe.mastic) {
    result.mastic.push_back(draw(*recipe.mastic, box, RandomStream(spec.seed, 1)));
    total += static_cast<double>(result.mastic.back().row.count);
  }
  if (!(total >= 1 && total <= static_cast<double>(most_particles)))
    refuse(Origin(spec), "particles", shown(total), "1 to " + std::to_string(most_particles));
  return result;
}

namespace {

/// Returns a recipe that has only the mastic of `spec`, without aggregates and voids. If `spec` gives a porosity, the
/// new recipe has a larger one, with which the mastic keeps its volume. `aggregate_volume` is the volume of the
/// aggregates [m³].
SpecimenSpec mastic_alone(const SpecimenSpec& spec, double aggregate_volume) {
  SpecimenSpec rest;
  rest.box = spec.box;
  rest.seed = spec.seed;
  rest.source = spec.source, rest.line = spec.line;
  rest.mastic = spec.mastic;
  if (rest.mastic->porosity) {
    const double solid = (1 - *spec.mastic->porosity) * volume_beside_voids(spec), mastic = solid - aggregate_volume;
    if (!(mastic > 0))
      refuse(
          Origin(spec), "aggregate: volume", percent(aggregate_volume / spec.box.volume()) + " of the box",
          "at most the solid volume that the porosity leaves, " + percent(solid / spec.box.volume()) + " of the box");
    rest.mastic->porosity = 1 - mastic / spec.box.volume();
  }
  return rest;
}

}  // namespace

std::vector<Population> compose_mastic(const SpecimenSpec& spec, double aggregate_volume) {
  if (!spec.mastic) return {};
  return compose(mastic_alone(spec, aggregate_volume)).mastic;
}

std::int64_t mastic_number(const SpecimenSpec& spec, double aggregate_volume) {
  return solve_recipe(mastic_alone(spec, aggregate_volume)).mastic->number(spec.box.volume());
}

std::int64_t void_number(const SpecimenSpec& spec) {
  return spec.voids ? request_of(*spec.voids, spec).number(spec.box.volume()) : 0;
}

std::vector<Population> compose_voids(const SpecimenSpec& spec) {
  if (!spec.voids) return {};
  const ClassRequest request = request_of(*spec.voids, spec);
  std::vector<Population> out{draw(request, spec.box.volume(), RandomStream(spec.seed, 3))};
  if (!out.back().radius.empty()) require_fit(request.origin, "voids", 2 * out.back().radius.front(), spec.box);
  return out;
}

}  // namespace macadam
