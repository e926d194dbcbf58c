// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_materials.cpp  Reads `[materials]`: densities, the temperature and, for the rules "series" and
/// "volumetric", the laws of mastic and rock. Derives the laws of all pairs from them.
#include <fmt/format.h>

#include "host/scene/crack_keys.hpp"
#include "host/scene/law_keys.hpp"
#include "host/scene/law_range.hpp"
#include "host/scene/sections.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam::scene {
namespace {

/// Range of a density that is given as a number without a unit, in kg/m³. No solid is lighter than the lower limit, so
/// a smaller number was probably meant in g/cm³.
constexpr Rule in_kg_m3{[](double v) { return v >= 10 && v <= 30000; },
                        "10 to 30000 kg/m3; a density in another unit is text with the unit"};

/// Appends the names of the laws that a phase may have, each with an empty value. Only linear laws can be in series
/// with rock.
template <std::size_t I = 0>
void list_linear_laws(std::vector<std::string>& names, std::vector<Law>& laws) {
  if constexpr (I < std::variant_size_v<Law>) {
    using Alternative = std::variant_alternative_t<I, Law>;
    if constexpr (has_stiffness<Alternative>) {
      names.emplace_back(Alternative::name);
      laws.emplace_back(Alternative{});
    }
    list_linear_laws<I + 1>(names, laws);
  }
}

Key density_key(double& target, Need need) {
  return {"density", need, positive_into(target, density, in_kg_m3), "density of the spheres",
          "computed from [specimen.recipe] if that is given"};
}

Key expansion_key(double& target) {
  constexpr Rule rule{[](double v) { return v >= 0 && v <= 1e-3; }, "0 to 1e-3 per kelvin"};
  return {"expansion", Need::optional, into(target, expansion, rule),
          "coefficient of linear thermal expansion, for tests with temperature in [loading]"};
}

Key poisson_key(std::optional<double>& target, const char* usual) {
  return {"poisson_ratio", Need::optional, into(target, ratio, of_poisson),
          "Poisson's ratio, for rules \"series\" and \"volumetric\"", usual};
}

const char* const without_law = "the laws of [[contacts]]";

/// Refuses the law of a phase in a scene whose rule has no use for it.
void require_rule(const Section& section, ContactRule rule) {
  if (has_laws_of_phases(rule)) return;
  for (const char* key : {"law", "from", "E", "poisson_ratio"}) {
    if (section.has(key))
      section.refuse(key, "this key with rule = \"centres\" in [network]",
                     "this key only with rule = \"series\" or \"volumetric\", because with \"centres\" each pair has "
                     "its own law in [[contacts]]");
  }
}

void read_aggregate(const Section& section, Need need, ContactRule rule, Materials& materials, PhaseLaws& phases) {
  const auto law = [](const Value& value) {
    if (value.text() != laws::Elastic::name) value.refuse(value.shown(), "\"elastic\"");
  };
  const auto modulus_of_rock = [&phases](const Value& value) {
    double E = 0;
    positive_into(E, modulus, in_pascals).read(value);
    phases.rock_modulus = E;
  };
  section.read({density_key(materials.aggregate, need),
                expansion_key(materials.expansion.aggregate),
                {"law",
                 Need::optional,
                 {law, {"text", nullptr, "\"elastic\""}},
                 "law of the rock, for rules \"series\" and \"volumetric\"",
                 without_law},
                {"E",
                 Need::optional,
                 {modulus_of_rock, {"number", &modulus, in_pascals.words}},
                 "modulus of the rock",
                 "none; required with law"},
                poisson_key(materials.aggregate_poisson_ratio, "none; required for rule \"volumetric\"")});
  require_rule(section, rule);
  if (section.has("law") != section.has("E")) {
    section.refuse("E", section.has("E") ? "this key without law" : "nothing",
                   section.has("E") ? "law = \"elastic\" as well" : "a modulus, because law is \"elastic\"");
  }
  if (rule == ContactRule::volumetric && phases.rock_modulus && !materials.aggregate_poisson_ratio)
    section.refuse("poisson_ratio", "nothing", "a Poisson's ratio, because rule is \"volumetric\" in [network]");
}

void require_poisson_ratio(const Section& section, const Materials& materials, const char* why) {
  if (!materials.mastic_poisson_ratio) section.refuse("poisson_ratio", "nothing", why);
}

void read_mastic(const Section& section, Need need, ContactRule rule, const ReadingFile& reading, Materials& materials,
                 PhaseLaws& phases) {
  std::vector<std::string> names;
  std::vector<Law> empty;
  list_linear_laws(names, empty);
  std::optional<double> from_file;
  std::vector<Key> keys{
      density_key(materials.mastic, need),
      expansion_key(materials.expansion.mastic),
      {"law",
       Need::optional,
       {[](const Value&) {}, {"one of"}},
       "law of the mastic, for rules \"series\" and \"volumetric\"; it determines the other keys",
       without_law},
      {"from",
       Need::optional,
       {[&](const Value& value) {
          require_rule(section, rule);
          from_file = read_source(value, reading, phases);
        },
        {"text"}},
       "in place of law, the file that gives the law of the mastic: another scene, whose specimen is "
       "the mastic; law.toml of macadam fit; or kelvin.csv of a run",
       "none"},
      poisson_key(materials.mastic_poisson_ratio, "the value in the file of from; required with law")};
  const auto name = section.find("law");
  if (!name) {
    section.read(keys);
    require_rule(section, rule);
    if (!section.has("from")) return;
    if (!materials.mastic_poisson_ratio) materials.mastic_poisson_ratio = from_file;
    return require_poisson_ratio(section, materials, "a Poisson's ratio, because the file in from does not give it");
  }
  Law of_mastic = empty[name->choice(names)];
  ShiftKeys shift;
  RangeKeys range;
  std::visit(
      [&](auto& law) {
        for (Key& key : keys_of(law)) keys.push_back(std::move(key));
        const bool flows = laws::flows(law);
        if (flows)
          for (Key& key : shift.keys()) keys.push_back(std::move(key));
        for (Key& key : range.keys()) keys.push_back(std::move(key));
        section.read(keys);
        require_rule(section, rule);
        if (section.has("from")) section.refuse("from", "this key together with law", "only one of the two");
        phases.range = range.range(section);
        if (flows) phases.shift = shift.shift(section);
        check(law, section);
        law.alpha = 1;
      },
      of_mastic);
  require_poisson_ratio(section, materials, "a Poisson's ratio, because a law of the mastic is given");
  phases.mastic = std::move(of_mastic);
}

/// Returns a law with another ratio of shear to normal stiffness.
Law with_alpha(Law law, double alpha) {
  std::visit([alpha](auto& l) { l.alpha = alpha; }, law);
  return law;
}

}  // namespace

Materials read_mastic_alone(const Section& section, const ReadingFile& reading, PhaseLaws& phases) {
  Materials out;
  read_mastic(section, Need::optional, ContactRule::series, reading, out, phases);
  return out;
}

Materials read_materials(const Section& section, Need need, ContactRule rule, const ReadingFile& reading,
                         PhaseLaws& phases) {
  Materials materials;
  section.read({{"aggregate", Need::optional,
                 section_by([&](const Value& v) { read_aggregate(v.section(), need, rule, materials, phases); }),
                 "material of the aggregates", "none"},
                {"mastic", Need::optional,
                 section_by([&](const Value& v) { read_mastic(v.section(), need, rule, reading, materials, phases); }),
                 "material of the mastic", "none"},
                {"temperature", Need::optional, into(materials.temperature, temperature, celsius),
                 "temperature of the whole specimen; laws that have a shift change with it",
                 "the laws' reference temperatures"}});
  materials.rock_modulus = phases.rock_modulus;
  return materials;
}

void set_laws_of_phases(Scene& scene, const PhaseLaws& phases, const PairCracks& cracks, const Section& root) {
  if (scene.network.rule == ContactRule::centres) return;
  const auto require = [&](bool needed, bool given, const char* phase, const char* example) {
    if (needed && !given)
      root.refuse("materials",
                  std::string("no law of the ") + phase + ", which rule = \"" + to_string(scene.network.rule) +
                      "\" in [network] needs",
                  std::string("[materials.") + phase + "] with " + example);
  };
  const bool file = scene.specimen.file.has_value(), mastic = phases.mastic.has_value(),
             rock = phases.rock_modulus.has_value();
  require(scene.specimen.mastic.has_value() || (file && !rock), mastic, "mastic",
          "law = \"generalised_kelvin\" or \"elastic\" and poisson_ratio, or with the key from");
  require(!scene.specimen.aggregate.empty(), rock, "aggregate", "law = \"elastic\" and E");
  scene.mastic_source = phases.source;
  // Frictionless platens, as in [1]. The platens that turn a cylinder are glued to it.
  const double alpha_of_platens = std::holds_alternative<experiments::Torsion>(scene.experiment) ? 1 : 0;
  const auto set = [&](PairType pair, const Law& law, const laws::Shift& shift) {
    const auto& crack = cracks[static_cast<std::size_t>(pair)];
    scene.laws[static_cast<std::size_t>(pair)] = crack ? with_crack(law, *crack) : law;
    if (pair != PairType::inner && pair != PairType::aw) scene.ranges[static_cast<std::size_t>(pair)] = phases.range;
    scene.shifts[static_cast<std::size_t>(pair)] = shift;
  };
  if (mastic) {
    const double nu = *scene.materials.mastic_poisson_ratio;
    set(PairType::mm, *phases.mastic, phases.shift);
    set(PairType::mw, with_alpha(*phases.mastic, alpha_of_platens), phases.shift);
    if (rock) {
      set(PairType::ma, *phases.mastic, phases.shift);
      // A film between two aggregates is held at its faces: λ + 2μ resists its opening and μ its slip.
      set(PairType::aa, with_alpha(*phases.mastic, (1 - 2 * nu) / (2 * (1 - nu))), phases.shift);
    }
  }
  if (rock) {
    const laws::Elastic law{*phases.rock_modulus, 1};
    set(PairType::inner, law, laws::NoShift{});
    set(PairType::aw, with_alpha(law, alpha_of_platens), laws::NoShift{});
  }
}

}  // namespace macadam::scene
