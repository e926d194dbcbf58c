// SPDX-License-Identifier: GPL-3.0-or-later
// read_domain.cpp  Reads the keys of `[specimen]` that give its domain: kind and dimensions. Each shape
// gives the keys of its dimensions (domains/all.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/scene/sections.hpp"

namespace macadam::scene {
namespace {

/// Refuses a domain whose dimensions do not go together. `value`: the last dimension.
void require_possible(const Value& value, const Domain& domain) {
  if (const char* expected = domain.expected_size()) value.refuse("a " + domain.dimensions(), expected);
  if (!(domain.volume() > 0 && std::isfinite(domain.volume())))
    value.refuse(fmt::format("a volume of {} m3", domain.volume()), "a volume within the range of double precision");
}

Reader box_into(Domain& box) {
  const auto read = [&box](const Value& value) {
    const std::vector<double> edges = value.numbers(length, positive);
    if (edges.size() != 3) value.refuse(fmt::format("{} entries", edges.size()), "three, [x, y, z]");
    box = domain_of(domains::Box::name, edges);
    require_possible(value, box);
  };
  return {read, {"list of three numbers", &length, positive.words}};
}

/// Returns words in a row: "a, b or c" with last = " or ". `quote`: text before and after each word.
std::string listed(const std::vector<std::string>& words, const char* last, const char* quote = "") {
  std::string out;
  for (std::size_t k = 0; k < words.size(); ++k)
    out += (k == 0 ? "" : k + 1 < words.size() ? ", " : last) + std::string(quote) + words[k] + quote;
  return out;
}

/// Returns the name of a key as words: "base_width" becomes "base width".
std::string words_of(std::string key) {
  std::ranges::replace(key, '_', ' ');
  return key;
}

/// A key that gives a dimension of one or several shapes.
struct DimensionKey {
  std::string key;
  std::vector<std::string> shapes, texts;  ///< names of the shapes, and descriptions, one for each shape
};

/// Returns all keys of dimensions, in the order of the shapes. The keys of one shape keep their order.
std::vector<DimensionKey> dimension_keys() {
  std::vector<DimensionKey> out;
  const auto names = domains::shape_names();
  const auto keys = domains::shape_keys();
  for (std::size_t s = 0; s < names.size(); ++s) {
    for (const domains::Dimension& d : keys[s]) {
      auto place = std::ranges::find(out, d.key, &DimensionKey::key);
      if (place == out.end()) place = out.insert(out.end(), DimensionKey{d.key, {}, {}});
      place->shapes.push_back(names[s]), place->texts.emplace_back(d.text);
    }
  }
  return out;
}

/// Returns the keys of the dimensions of a shape, in its order.
std::vector<std::string> keys_of_shape(const std::string& name) {
  const auto names = domains::shape_names();
  const auto keys = domains::shape_keys();
  const auto index = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  std::vector<std::string> out;
  for (const domains::Dimension& d : keys[index]) out.emplace_back(d.key);
  return out;
}

/// Returns the name of the domain of `[specimen]` before its other keys are read, because the domain decides which keys
/// give the dimensions. Refuses the keys of another domain.
std::string name_of_domain(const Section& section) {
  const std::vector<std::string> names = domains::shape_names();
  std::string name = names.front();
  if (section.has("domain")) name = names[section.find("domain")->choice(names)];
  const bool is_box = name == domains::Box::name;
  const std::string with = "this key with domain = \"" + name + "\"", dimensions = listed(keys_of_shape(name), " and ");
  if (!is_box && section.has("box")) section.refuse("box", with, dimensions);
  for (const DimensionKey& d : dimension_keys()) {
    if (!section.has(d.key) || std::ranges::count(d.shapes, name) > 0) continue;
    const std::string owners = "domain = " + listed(d.shapes, " or ", "\"");
    if (is_box) section.refuse(d.key, "this key without " + owners, "box, or " + owners + " as well");
    section.refuse(d.key, with, dimensions);
  }
  return name;
}

}  // namespace

std::vector<Key> keys_of_domain(const Section& section, std::map<std::string, double>& dimensions, Domain& domain) {
  const std::string name = name_of_domain(section);
  const std::vector<std::string> of_shape = keys_of_shape(name);
  const auto no_more = [](const Value&) {};
  std::vector<Key> out{{"domain",
                        Need::optional,
                        {no_more, {"one of", nullptr, "", R"("box")", domains::shape_names()}},
                        "shape of the specimen; it determines which keys give the dimensions"},
                       {"box", of_shape.empty() ? Need::required : Need::optional, box_into(domain),
                        "edge lengths x, y, z; one corner is the origin, z is vertical"}};
  for (const DimensionKey& d : dimension_keys()) {
    // The domain is made when its last dimension has been read.
    const auto read = [&domain, &dimensions, name, of_shape, key = d.key](const Value& value) {
      dimensions[key] = value.number(length, positive);
      std::vector<double> values;
      for (const std::string& one : of_shape)
        if (dimensions.contains(one)) values.push_back(dimensions[one]);
      if (values.size() < of_shape.size()) return;
      domain = domain_of(name, values);
      require_possible(value, domain);
    };
    const bool is_needed = std::ranges::count(of_shape, d.key) > 0;
    out.push_back({d.key,
                   is_needed ? Need::required : Need::optional,
                   {read, {"number", &length, positive.words}},
                   words_of(d.key) + " " + fmt::format("{}", fmt::join(d.texts, "; ")),
                   "only for " + listed(d.shapes, " or ")});
  }
  return out;
}

}  // namespace macadam::scene
