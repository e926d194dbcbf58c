// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_contacts.cpp  Reads `[[contacts]]`: one law for each pair type.
#include <fmt/format.h>

#include "host/scene/crack_keys.hpp"
#include "host/scene/law_keys.hpp"
#include "host/scene/law_range.hpp"
#include "host/scene/sections.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam::scene {
namespace {

/// Appends the name and an empty value of every kind of law that a scene can name.
template <std::size_t I = 0>
void list_laws(std::vector<std::string>& names, std::vector<Law>& laws) {
  if constexpr (I < std::variant_size_v<Law>) {
    using Alternative = std::variant_alternative_t<I, Law>;
    if constexpr (named_law<Alternative>) {
      names.emplace_back(Alternative::name);
      laws.emplace_back(Alternative{});
    }
    list_laws<I + 1>(names, laws);
  }
}

/// Returns an empty law of the kind that the section names.
Law law_named_in(const Section& section) {
  std::vector<std::string> names;
  std::vector<Law> laws;
  list_laws(names, laws);
  const auto name = section.find("law");
  if (!name) section.refuse("law", "nothing", fmt::format("law = \"{}\"", fmt::join(names, "\" or \"")));
  return laws[name->choice(names)];
}

std::vector<std::string> pair_names() {
  std::vector<std::string> out;
  for (int i = 0; i < pair_types; ++i) out.emplace_back(to_string(static_cast<PairType>(i)));
  return out;
}

/// Stores the limits of one pair. \throws InputError if limits are given for a pair with a wall.
void set_limits(const Section& section, std::size_t pair, const FacetLimits& limits, NetworkSpec& network) {
  if (pair < network.of_pair.size()) {
    network.of_pair[pair] = limits;
  } else if (limits.gap_max || limits.area_min) {
    section.refuse(limits.gap_max ? "gap_max" : "area_min", "this key for a pair with a wall",
                   "this key only for pairs of two particles, because every facet on a wall is a contact");
  }
}

}  // namespace

/// Returns the keys that decide which facets between two particles become contacts.
std::vector<Key> keys_of(FacetLimits& limits) {
  // For a distance d of the centres, the gap d − R_a − R_b in units of the mean radius is d/mean − 2.
  constexpr Rule gap{[](double v) { return v > -2; }, "a gap above -2 mean radii (at -2 the centres coincide)"};
  return {
      {"gap_max", Need::optional, into(limits.gap_max, ratio, gap),
       "largest gap between two particles in contact, in units of their mean radius", "every facet is a contact"},
      {"area_min", Need::optional, into(limits.area_min, ratio, non_negative),
       "smallest area of a facet that is a contact, as a fraction of the mean facet area", "every facet is a contact"}};
}

LawTable read_contacts(const std::vector<Section>& sections, ShiftLaws& shifts, LawRanges& ranges, Deltas& deltas,
                       NetworkSpec& network, TemperatureTables& tables) {
  const std::vector<std::string> pairs = pair_names();
  LawTable table;
  for (const Section& section : sections) {
    std::size_t pair = 0;
    double delta = 1;
    ShiftKeys shift;
    RangeKeys range;
    FacetLimits limits;
    std::optional<laws::Crack> crack;
    Law read_law = law_named_in(section);
    std::visit(
        [&]<class L>(L& law) {
          std::vector<Key> keys{
              {"pair",
               Need::required,
               {[&](const Value& v) { pair = v.choice(pairs); }, {"one of", nullptr, "", "", pairs}},
               "the two materials: M mastic, A aggregate, W wall; inner: spheres of one aggregate"},
              {"law",
               Need::required,
               {[](const Value&) {}, {"one of"}},
               "the contact law; it determines the other keys"},
              {"alpha", Need::optional, into(law.alpha, ratio, non_negative), "ratio of shear to normal stiffness"},
              {"delta", Need::optional, into(delta, ratio, positive),
               "factor on all moduli and viscosities of the pair, not on strengths"}};
          for (Key& key : keys_of(law)) keys.push_back(std::move(key));
          for (Key& key : keys_of(limits)) keys.push_back(std::move(key));
          if constexpr (can_have_crack<L>) keys.push_back(crack_key(crack, tables));
          const bool flows = laws::flows(law);
          if (flows)
            for (Key& key : shift.keys()) keys.push_back(std::move(key));
          for (Key& key : range.keys()) keys.push_back(std::move(key));
          section.read(keys);
          if (flows) shifts[pair] = shift.shift(section);
          ranges[pair] = range.range(section);
          check(law, section);
          laws::each_value(law, [delta](const std::string&, double& value, ValueKind kind, ValueNeed) {
            if (kind != ValueKind::strength) value *= delta;
          });
          if (!laws::usable(law)) {
            section.refuse("delta", fmt::format("{}, which makes a coefficient of the law 0 or infinite", delta),
                           "a factor that keeps all coefficients of the law within the range of double precision");
          }
        },
        read_law);
    if (table[pair]) section.refuse("pair", fmt::format("\"{}\" again", pairs[pair]), "each pair once");
    if (crack) require_particles(section, static_cast<PairType>(pair));
    table[pair] = crack ? with_crack(std::move(read_law), *crack) : std::move(read_law);
    deltas[pair] = delta;
    set_limits(section, pair, limits, network);
  }
  return table;
}

void read_limits_of_pairs(const std::vector<Section>& sections, ContactRule rule, NetworkSpec& network,
                          PairCracks& cracks, TemperatureTables& tables) {
  const std::string name = to_string(rule);
  const std::vector<std::string> pairs = pair_names();
  std::vector<bool> seen(pairs.size());
  for (const Section& section : sections) {
    for (const char* key : {"law", "alpha", "delta"}) {
      if (section.has(key))
        section.refuse(
            key, "this key of a pair with rule = \"" + name + "\" in [network]",
            "only pair, crack, gap_max and area_min: with this rule the laws of all pairs follow from the laws in "
            "[materials.mastic] and [materials.aggregate]");
    }
    if (section.has("crack") && rule == ContactRule::volumetric)
      section.refuse("crack", "this key with rule = \"" + name + "\" in [network]",
                     "rule = \"series\" or \"centres\", because increments do not compute the pressures of cells");
    std::size_t pair = 0;
    FacetLimits limits;
    std::vector<Key> keys{{"pair", Need::required, {[&](const Value& v) { pair = v.choice(pairs); }}}};
    for (Key& key : keys_of(limits)) keys.push_back(std::move(key));
    std::optional<laws::Crack> crack;
    keys.push_back(crack_key(crack, tables));
    section.read(keys);
    if (crack) require_particles(section, static_cast<PairType>(pair));
    cracks[pair] = crack;
    if (seen[pair]) section.refuse("pair", fmt::format("\"{}\" again", pairs[pair]), "each pair once");
    seen[pair] = true;
    set_limits(section, pair, limits, network);
  }
}

}  // namespace macadam::scene
