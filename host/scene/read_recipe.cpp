// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_recipe.cpp  Reads `[specimen.recipe]`: a mix design by mass. Types and units are checked here; everything
/// else is checked where the volumes of the design are computed (host/recipe/).
#include <cmath>

#include <fmt/format.h>

#include "host/scene/sections.hpp"

namespace macadam::scene {
namespace {

// Values with the rule `any` are checked later, when the volumes of the design are computed. The error message of that
// check shows the calculation to which the wrong value belongs.
constexpr Rule share{[](double v) { return v >= 0 && v <= 1; },
                     "a fraction from 0 to 1, or text from \"0 %\" to \"100 %\""};

/// Returns the entries of a row: a size, then fractions of the aggregate's mass. \throws InputError if the row does not
/// have `count` entries.
std::vector<Value> row_of(const Value& row, std::size_t count, const std::string& expected) {
  std::vector<Value> out = row.entries(expected);
  if (out.size() != count) row.refuse(fmt::format("{} entries", out.size()), expected);
  return out;
}

void read_gradation(const Value& value, std::vector<SievePassing>& out) {
  for (const Value& entry : value.entries("a list of [sieve, passing], coarsest first")) {
    const auto row = row_of(entry, 2, "[sieve, passing], such as [\"12.5 mm\", \"83.7 %\"]");
    out.push_back({row[0].number(length, positive), row[1].number(ratio, share), entry.line()});
  }
}

void read_envelope(const Value& value, std::vector<EnvelopePoint>& out) {
  for (const Value& entry : value.entries("a list of [sieve, least passing, most passing]")) {
    const auto row = row_of(entry, 3, "[sieve, least passing, most passing], such as [\"2 mm\", \"20 %\", \"40 %\"]");
    out.push_back(
        {row[0].number(length, positive), row[1].number(ratio, share), row[2].number(ratio, share), entry.line()});
  }
}

}  // namespace

MixDesign read_recipe(const Section& section) {
  MixDesign out;
  out.source = section.file(), out.line = section.line();
  const auto read_densities = [&](const Value& value) {
    out.aggregate_density =
        value.is_array() ? value.numbers(density, any) : std::vector<double>{value.number(density, any)};
  };
  const std::vector<Key> keys = {
      {"gradation",
       Need::required,
       {[&](const Value& v) { read_gradation(v, out.gradation); }, {"list of [sieve, fraction]", &length}},
       "fraction of the aggregate's mass that passes each sieve, coarsest first; 100 % pass the coarsest sieve"},
      {"cut", Need::optional, into(out.cut, length, positive),
       "sieve of the curve: aggregate retained on this sieve becomes particles; finer aggregate and the binder are "
       "mastic"},
      {"binder", Need::required, into(out.binder, ratio, any), "binder content by mass, absorbed binder included"},
      {"binder_of", Need::required,
       into<BinderOf>(out.binder_of, {{"mix", BinderOf::mix}, {"aggregate", BinderOf::aggregate}}),
       "whether the binder content is a fraction of the mass of the mix or of the aggregate"},
      {"aggregate_density",
       Need::required,
       {read_densities, {"number or list of numbers", &density}},
       "particle density including pores: one number, or one per interval between two sieves, coarsest first"},
      {"filler_density", Need::optional, into(out.filler_density, density, any),
       "density of the aggregate that passes the finest sieve", "the last value of aggregate_density"},
      {"binder_density", Need::required, into(out.binder_density, density, any), "density of the binder"},
      {"absorbed_binder", Need::optional, into(out.absorbed_binder, ratio, any),
       "binder in the pores of the aggregate, as a fraction of the aggregate's mass", "0"},
      {"maximum_density", Need::optional, into(out.maximum_density, density, any),
       "measured maximum density; if it is given, absorbed_binder is computed from it", "none"},
      {"air_voids", Need::optional, into(out.air_voids, ratio, any), "air voids as a fraction of the bulk volume",
       "computed from bulk_density"},
      {"bulk_density", Need::optional, into(out.bulk_density, density, any),
       "measured bulk density; if it is given, air_voids are computed from it", "none"},
      {"envelope",
       Need::optional,
       {[&](const Value& v) { read_envelope(v, out.envelope); }, {"list of [sieve, least, most]", &length}},
       "limits of a specification for the gradation, which are drawn and compared; exceeding them is not an error",
       "none"}};
  section.read(keys);
  for (const Key& key : keys) {
    if (const auto value = section.find(key.name)) out.lines[key.name] = value->line();
  }
  return out;
}

void take_densities(const MixDesign& recipe, const Section& root, Materials& materials) {
  // Largest relative difference between a density in the scene and the density that follows from the recipe. Densities
  // are given with at least three digits, so half a unit of the last digit is at most this fraction of the density
  // (0.005 of 1.00).
  constexpr double rounding = 5e-3;
  const MixVolumes volumes = volumes_of(recipe);
  const auto take = [&](const std::string& phase, double& given, double derived, const std::string& sum) {
    if (given > 0 && std::abs(given / derived - 1) > rounding)
      root.find("materials")
          ->section()
          .find(phase)
          ->section()
          .refuse(
              "density", fmt::format("{} kg/m3", given),
              fmt::format("{:.6g} kg/m3, which follows from [specimen.recipe] ({}), or no density here", derived, sum));
    given = derived;
  };
  if (!volumes.classes.empty())
    take("aggregate", materials.aggregate, volumes.aggregate_density,
         fmt::format("its aggregate above the cut, with {:.4g} % of absorbed binder", 100 * volumes.absorbed_binder));
  take("mastic", materials.mastic, volumes.mastic_density,
       fmt::format("1 kg of the mix has {:.6g} kg of mastic in {:.6g} cm3", volumes.mastic_mass,
                   1e6 * volumes.mastic_mass / volumes.mastic_density));
}

}  // namespace macadam::scene
