// SPDX-License-Identifier: GPL-3.0-or-later
// read_domain.cpp  Reads the keys of `[specimen]` that give its domain: kind and dimensions.
#include <fmt/format.h>

#include <cmath>

#include "host/scene/sections.hpp"

namespace macadam::scene {
namespace {

Reader box_into(Domain& box) {
  const auto read = [&box](const Value& value) {
    const std::vector<double> edges = value.numbers(length, positive);
    if (edges.size() != 3) value.refuse(fmt::format("{} entries", edges.size()), "three, [x, y, z]");
    box.size = {edges[0], edges[1], edges[2]};
    if (!(box.volume() > 0 && std::isfinite(box.volume()))) {
      value.refuse(fmt::format("a volume of {} m3", box.volume()), "a volume within the range of double precision");
    }
  };
  return {read, {"list of three numbers", &length, positive.words}};
}

/// Returns the name of the domain of `[specimen]` before its other keys are read, because the domain decides which keys
/// give the dimensions. Refuses the keys of another domain.
std::string domain_of(const Section& section) {
  const std::vector<std::string> names = domains::shape_names();
  std::string name = names.front();
  if (section.has("domain")) name = names[section.find("domain")->choice(names)];
  if (name == domains::Cylinder::name && section.has("box"))
    section.refuse("box", "this key with domain = \"cylinder\"", "diameter and height");
  for (const char* key : {"diameter", "height"})
    if (name == domains::Box::name && section.has(key))
      section.refuse(key, "this key without domain = \"cylinder\"", "box, or domain = \"cylinder\" as well");
  return name;
}

}  // namespace

std::vector<Key> keys_of_domain(const Section& section, double& diameter, double& height, Domain& domain) {
  const bool cylinder = domain_of(section) == domains::Cylinder::name;
  const Need box = cylinder ? Need::optional : Need::required, round = cylinder ? Need::required : Need::optional;
  const auto set_cylinder = [&](const Value& value) {
    domain = cylinder_domain(diameter, height);
    if (!(domain.volume() > 0 && std::isfinite(domain.volume())))
      value.refuse(fmt::format("a volume of {} m3", domain.volume()), "a volume within the range of double precision");
  };
  const auto read_height = [&, set_cylinder](const Value& value) {
    height = value.number(length, positive);
    set_cylinder(value);
  };
  const auto no_more = [](const Value&) {};
  return {
      {"domain",
       Need::optional,
       {no_more, {"one of", nullptr, "", R"("box")", domains::shape_names()}},
       "shape of the specimen; it determines which keys give the dimensions"},
      {"box", box, box_into(domain), "edge lengths x, y, z; one corner is the origin, z is vertical"},
      {"diameter",
       round,
       {[&](const Value& value) { diameter = value.number(length, positive); }, {"number", &length, positive.words}},
       "diameter of a cylinder, whose vertical axis passes through x = y = diameter/2",
       "only for a cylinder"},
      {"height",
       round,
       {read_height, {"number", &length, positive.words}},
       "height of a cylinder",
       "only for a cylinder"}};
}

}  // namespace macadam::scene
