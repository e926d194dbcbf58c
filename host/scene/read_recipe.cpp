// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_recipe.cpp  `[specimen.recipe]`: a mix design by mass. Types and units are checked here, all else where
/// the design's volumes are worked out.
#include <cmath>

#include <fmt/format.h>

#include "host/scene/sections.hpp"

namespace macadam::scene {
namespace {

// Where `any` number may stand, the design's own checks say what it must be, beside the sum that it spoils.
constexpr Rule share{[](double v) { return v >= 0 && v <= 1; },
                     "a share from 0 to 1, or text from \"0 %\" to \"100 %\""};

/// The entries of a row: a size and shares of the aggregate's mass, so many in all.
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
      {"gradation", Need::required, [&](const Value& v) { read_gradation(v, out.gradation); }},
      {"cut", Need::optional, into(out.cut, length, positive)},
      {"binder", Need::required, into(out.binder, ratio, any)},
      {"binder_of", Need::required,
       into<BinderOf>(out.binder_of, {{"mix", BinderOf::mix}, {"aggregate", BinderOf::aggregate}})},
      {"aggregate_density", Need::required, read_densities},
      {"filler_density", Need::optional, into(out.filler_density, density, any)},
      {"binder_density", Need::required, into(out.binder_density, density, any)},
      {"absorbed_binder", Need::optional, into(out.absorbed_binder, ratio, any)},
      {"maximum_density", Need::optional, into(out.maximum_density, density, any)},
      {"air_voids", Need::optional, into(out.air_voids, ratio, any)},
      {"bulk_density", Need::optional, into(out.bulk_density, density, any)},
      {"envelope", Need::optional, [&](const Value& v) { read_envelope(v, out.envelope); }}};
  section.read(keys);
  for (const Key& key : keys) {
    if (const auto value = section.find(key.name)) out.lines[key.name] = value->line();
  }
  return out;
}

void take_densities(const MixDesign& recipe, const Section& root, Materials& materials) {
  // Densities are given with three digits or more: half a unit of the third is this share of 1.00, less of others.
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
       fmt::format("of 1 kg of mix {:.6g} kg in {:.6g} cm3", volumes.mastic_mass,
                   1e6 * volumes.mastic_mass / volumes.mastic_density));
}

}  // namespace macadam::scene
