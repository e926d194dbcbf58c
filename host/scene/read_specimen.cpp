// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_specimen.cpp  Reads `[specimen]`: a file, or a mixture by volume or by mass. Mixtures that no generator
/// could make are refused here.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "host/scene/sections.hpp"
#include "host/spheres/size_law.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam::scene {
namespace {

/// Refuses a section that has both keys, or neither.
void require_one_of(const Section& section, const std::string& a, const std::string& b) {
  const bool both = section.has(a) && section.has(b);
  if (both || (!section.has(a) && !section.has(b))) {
    section.refuse(both ? b : a, both ? a + " and " + b : "neither " + a + " nor " + b, "exactly one of the two");
  }
}

/// Refuses a diameter [m] that is not smaller than every dimension of the domain.
void require_fit_in_box(const Section& section, const std::string& key, double diameter, const Domain& box) {
  const auto [edge, words] = box.smallest_dimension();
  if (diameter >= edge) {
    section.refuse(key, fmt::format("diameters up to {} m", diameter), fmt::format("less than {}, {} m", words, edge));
  }
}

AggregateClass read_aggregate(const Section& section, const Domain& box) {
  constexpr Rule share{[](double v) { return v > 0 && v <= 1; }, "a fraction above 0 and at most 1"};
  AggregateClass out;
  out.line = section.line();
  section.read({{"sieve", Need::required, range_into(out.sieve_min, out.sieve_max),
                 "smallest and largest diameter (D^I of shapes)"},
                {"volume_fraction", Need::optional, into(out.volume_fraction, ratio, share),
                 "fraction of the solid volume (aggregates and mastic)", "given by count"},
                {"count", Need::optional, into(out.count, 1, most_particles),
                 "number of aggregates, in place of volume_fraction", "none"}});
  require_one_of(section, "volume_fraction", "count");
  require_fit_in_box(section, "sieve", out.sieve_max, box);
  return out;
}

MasticSpec read_mastic(const Section& section, const Domain& box, bool by_mass) {
  constexpr Rule porosity{[](double v) { return v > -1 && v < 1; },
                          "a porosity between -1 and 1 (negative: the spheres overlap)"};
  MasticSpec out;
  out.line = section.line();
  section.read({{"radius", Need::required, range_into(out.radius_min, out.radius_max),
                 "smallest and largest radius of the spheres"},
                {"porosity", Need::optional, into(out.porosity, ratio, porosity),
                 "1 - sum of the solid spheres' volumes / (box - voids)", "given by count or by the recipe"},
                {"count", Need::optional, into(out.count, 1, most_particles), "number of spheres, in place of porosity",
                 "none"}});
  for (const char* key : {"porosity", "count"}) {
    if (by_mass && section.has(key))
      section.refuse(key, "this key with [specimen.recipe]",
                     "no such key, because the air voids of the recipe give the porosity");
  }
  if (!by_mass) require_one_of(section, "porosity", "count");
  require_fit_in_box(section, "radius", 2 * out.radius_max, box);
  return out;
}

VoidSpec read_voids(const Section& section, const Domain& box, bool by_mass) {
  constexpr Rule share{[](double v) { return v >= 0 && v < 1; }, "a fraction from 0 to below 1"};
  VoidSpec out;
  out.line = section.line();
  section.read(
      {{"radius", Need::required, range_into(out.radius_min, out.radius_max),
        "smallest and largest radius of the voids"},
       {"fraction", Need::optional, into(out.fraction, ratio, share), "fraction of the volume of the box",
        "given by count, or the recipe's air voids"},
       {"count", Need::optional, into(out.count, 0, most_particles), "number of voids, in place of fraction", "none"}});
  if (!by_mass || section.has("count")) require_one_of(section, "fraction", "count");
  require_fit_in_box(section, "radius", 2 * out.radius_max, box);
  return out;
}

/// Refuses mixtures that cannot be made, whichever sizes are sampled. The bounds assume the smallest aggregates for
/// volumes and the largest particles for numbers of particles.
void require_possible(const Section& section, const SpecimenSpec& spec) {
  // `counted` and `counted_most` are the least and the greatest volume of the classes given by count.
  double fractions = 0, counted = 0, counted_most = 0;
  std::int64_t count = 0;
  for (const AggregateClass& c : spec.aggregate) {
    fractions += c.volume_fraction.value_or(0);
    count += c.count.value_or(0);
    counted += static_cast<double>(c.count.value_or(0)) * sphere_volume(c.sieve_min);
    counted_most += static_cast<double>(c.count.value_or(0)) * sphere_volume(c.sieve_max);
  }
  double box = spec.box.volume();  // volume without the voids
  if (spec.voids)
    box -= spec.voids->count ? static_cast<double>(*spec.voids->count) * sphere_volume(2 * spec.voids->radius_min)
                             : *spec.voids->fraction * box;
  if (!(box > 0)) section.refuse("voids", "voids as large as the box", "smaller or fewer voids");
  if (fractions > 0 && !spec.mastic) {
    section.refuse("aggregate", "volume_fraction without [specimen.mastic]",
                   "count, because only mastic determines the solid volume");
  }
  if (spec.mastic && fractions >= 1) {
    section.refuse("aggregate", fmt::format("volume fractions with the sum {}", fractions),
                   "a sum below 1, because the mastic fills the rest of the solid volume");
  }
  // If the mastic is given by count, the mastic and the aggregates given by count together fill the fraction 1 −
  // `fractions` of the solid volume. The solid volume is therefore their volume divided by this fraction. The smallest
  // radii of the bodies are used, so `solid` is a lower bound.
  double solid = counted;
  double number = static_cast<double>(count);
  if (spec.mastic && spec.mastic->porosity) {
    solid = (1 - *spec.mastic->porosity) * box;
    const double rest = solid * (1 - fractions) - counted_most;
    number += std::max(0.0, rest) / sphere_volume(2 * spec.mastic->radius_max);
  } else if (spec.mastic) {
    const double mastic = static_cast<double>(*spec.mastic->count) * sphere_volume(2 * spec.mastic->radius_min);
    solid = (counted + mastic) / (1 - fractions);
    number += static_cast<double>(*spec.mastic->count);
  }
  if (solid >= 2 * box) {
    section.refuse(
        spec.mastic ? "mastic" : "aggregate", fmt::format("spheres with a total volume of at least {:.4g} m3", solid),
        fmt::format("less than twice the volume of the box, {:.4g} m3, so that the porosity is above -1", box));
  }
  for (const AggregateClass& c : spec.aggregate) {
    number += c.volume_fraction.value_or(0) * solid / sphere_volume(c.sieve_max);
  }
  const double aggregates = counted + fractions * solid;
  if (aggregates >= box) {
    section.refuse("aggregate", fmt::format("a total volume of aggregates of at least {:.4g} m3", aggregates),
                   fmt::format("less than the volume of the box, {:.4g} m3, because aggregates do not overlap", box));
  }
  if (spec.mastic && aggregates >= solid) {
    section.refuse("aggregate", fmt::format("a total volume of aggregates of at least {:.4g} m3", aggregates),
                   fmt::format("less than the solid volume at this porosity, {:.4g} m3", solid));
  }
  if (!(number <= static_cast<double>(most_particles))) {
    section.refuse(spec.mastic ? "mastic" : "aggregate", fmt::format("sizes that need {:.3g} particles", number),
                   fmt::format("at most {} particles", most_particles));
  }
}

/// Takes aggregate classes and porosity from the recipe. `section` is `[specimen]`.
void follow_recipe(const Section& section, const MixDesign& recipe, SpecimenSpec& spec) {
  if (section.has("aggregate"))
    section.refuse("aggregate", "classes of aggregate with [specimen.recipe]", "only one of the two");
  if (!spec.mastic)
    section.refuse("recipe", "[specimen.recipe] without [specimen.mastic]", "[specimen.mastic] with its radius");
  follow(recipe, spec);
  const auto [edge, words] = spec.box.smallest_dimension();
  for (const AggregateClass& c : spec.aggregate) {
    if (c.sieve_max >= edge)
      throw InputError(spec.source, c.line, "[specimen.recipe] gradation",
                       fmt::format("aggregate of {:.6g} to {:.6g} mm", 1e3 * c.sieve_min, 1e3 * c.sieve_max),
                       fmt::format("sizes below {}, {:.6g} mm", words, 1e3 * edge));
  }
}

}  // namespace

Reader range_into(double& low, double& high) {
  const auto read = [&low, &high](const Value& value) {
    const std::vector<double> range = value.numbers(length, positive);
    if (range.size() != 2) value.refuse(fmt::format("{} entries", range.size()), "two, [min, max]");
    if (range[0] > range[1]) value.refuse(fmt::format("[{}, {}] m", range[0], range[1]), "min not above max");
    low = range[0], high = range[1];
  };
  return {read, {"list of two numbers", &length, positive.words}};
}

SpecimenSpec read_specimen(const Section& section, const std::filesystem::path& folder,
                           std::optional<MixDesign>& recipe, std::vector<Notch>& notches) {
  SpecimenSpec spec;
  spec.source = section.file(), spec.line = section.line();
  const auto existing = [&](const Value& value, const char* what) {
    const std::filesystem::path file = (folder / value.text()).lexically_normal();
    std::error_code error;
    if (value.text() != given_particles && !std::filesystem::is_regular_file(file, error)) {
      value.refuse("no file " + file.string(), std::string(what) + "; paths are relative to the scene's folder");
    }
    return file;
  };
  const auto read_file = [&](const Value& value) { spec.file = existing(value, "a specimen file"); };
  const auto read_aggregate_file = [&](const Value& value) {
    spec.aggregate_file = existing(value, "a file of aggregates");
  };
  const auto read_classes = [&](const Value& value) {
    for (const Section& entry : value.sections()) spec.aggregate.push_back(read_aggregate(entry, spec.box));
  };
  const auto read_the_mastic = [&](const Value& v) {
    spec.mastic = read_mastic(v.section(), spec.box, section.has("recipe"));
  };
  std::map<std::string, double> dimensions;
  std::vector<Key> keys = keys_of_domain(section, dimensions, spec.box);
  const std::vector<Key> others{
      {"file",
       Need::optional,
       {read_file, {"text"}},
       "CSV file of an existing specimen, with the columns id,x,y,z,radius,phase,body; the path is relative to the "
       "scene's folder",
       "the specimen is generated"},
      {"aggregate_file",
       Need::optional,
       {read_aggregate_file, {"text"}},
       "for a specimen from a file with rule \"series\" or \"volumetric\": CSV file of the true surfaces of the "
       "aggregates, with the columns body,shape,size,x,y,z and qw,qx,qy,qz",
       "surfaces of the spheres"},
      {"seed", Need::optional, into(spec.seed, 0),
       "seed of the generator: another seed gives another specimen of the same mixture"},
      {"size_law", Need::optional,
       into<SizeLaw>(spec.size_law, {{"log_uniform", SizeLaw::log_uniform},
                                     {"uniform", SizeLaw::uniform},
                                     {"volume_uniform", SizeLaw::volume_uniform}}),
       "distribution of the diameters between two sieves"},
      {"spacing", Need::optional, into(spec.spacing, length, non_negative),
       "smallest distance between an aggregate and the aggregates inserted before it"},
      {"fix_aggregates", Need::optional, into(spec.fix_aggregates),
       "whether aggregates are fixed while the mastic relaxes"},
      {"attempts", Need::optional, into(spec.attempts, 1),
       "number of positions tried for one aggregate before the generator gives up"},
      {"aggregate", Need::optional, sections_by(read_classes), "a class of aggregates, between two sieves", "none"},
      {"shapes", Need::optional, section_by([&](const Value& v) { spec.shapes = read_shapes(v.section(), folder); }),
       "aggregates of real shape, filled with spheres", "an aggregate is a sphere"},
      {"recipe", Need::optional, section_by([&](const Value& v) { recipe = read_recipe(v.section()); }),
       "a mix design by mass, in place of [[specimen.aggregate]] and of the mastic's content", "none"},
      {"mastic", Need::optional, section_by(read_the_mastic), "the mastic: spheres that fill the remaining volume",
       "none"},
      {"voids", Need::optional,
       section_by([&](const Value& v) { spec.voids = read_voids(v.section(), spec.box, section.has("recipe")); }),
       "air voids with cells of their own", "none"},
      {"notch", Need::optional, sections_by([&](const Value& v) {
         for (const Section& entry : v.sections()) notches.push_back(read_notch(entry, spec.box));
       }),
       "a thin cut that no contact crosses", "none"}};
  keys.insert(keys.end(), others.begin(), others.end());
  section.read(keys);
  if (spec.file) {
    for (const char* key : {"recipe", "aggregate", "shapes", "mastic", "voids", "seed", "size_law", "spacing",
                            "fix_aggregates", "attempts"}) {
      if (section.has(key))
        section.refuse(key, "this key of the generator together with the key file", "only one of the two");
    }
  } else if (spec.aggregate_file) {
    section.refuse(
        "aggregate_file", "this key without file",
        "the key file as well, because a generated specimen already contains the surfaces of its aggregates");
  } else if (spec.aggregate.empty() && !spec.mastic && !recipe) {
    section.refuse("file", "neither this key nor a section of particles",
                   "a specimen file, [[specimen.aggregate]], [specimen.mastic] or [specimen.recipe]");
  } else {
    if (recipe) follow_recipe(section, *recipe, spec);
    require_possible(section, spec);
    if (spec.shapes && spec.aggregate.empty())
      section.refuse("shapes", "shapes without aggregates",
                     "[[specimen.aggregate]], whose sieves give the sizes D^I of the shapes");
    if (spec.shapes && spec.shapes->placement == PlacementMethod::packing && spec.spacing > 0)
      section.refuse("spacing", "a spacing with placement = \"packing\"",
                     "gap in [specimen.shapes], or placement = \"insertion\" there");
    if (spec.shapes && !spec.fix_aggregates)
      section.refuse("fix_aggregates", "false with shapes",
                     "true, because otherwise the spheres of one shape would move apart");
    if (spec.voids && !spec.fix_aggregates)
      section.refuse("fix_aggregates", "false with voids",
                     "true, because otherwise the voids would move with the aggregates");
  }
  return spec;
}

}  // namespace macadam::scene
