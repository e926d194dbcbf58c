// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_shapes.cpp  Reads `[specimen.shapes]`: aggregates of real shape, filled with spheres.
#include <map>

#include "host/scene/sections.hpp"

namespace macadam::scene {

std::optional<ShapeSpec::Library> shipped_library(const std::string& name) {
  static const std::map<std::string, ShapeSpec::Library> shipped{
      {"aggregates", ShapeSpec::Library::aggregates},
      {"icosahedron", ShapeSpec::Library::icosahedron},
      {"aggregates and icosahedron", ShapeSpec::Library::aggregates_and_icosahedron}};
  const auto found = shipped.find(name);
  return found == shipped.end() ? std::nullopt : std::optional(found->second);
}

ShapeSpec read_shapes(const Section& section, const std::filesystem::path& folder) {
  constexpr Rule porosity{[](double v) { return v >= -0.5 && v < 1; },
                          "a porosity from -0.5 to below 1 (negative: the spheres overlap)"};
  constexpr Rule gap{[](double v) { return v > 0 && v < 0.5; }, "a fraction above 0 and below 0.5"};
  constexpr Rule hold_out{[](double v) { return v >= 0 && v <= 10; }, "a number from 0 to 10"};
  ShapeSpec out;
  const auto read_library = [&](const Value& value) {
    const std::string name = value.text();
    if (const auto shipped = shipped_library(name)) {
      out.library = *shipped;
      return;
    }
    out.library = ShapeSpec::Library::folder;
    out.folder = (folder / name).lexically_normal();
    std::error_code error;
    if (!std::filesystem::is_directory(out.folder, error)) {
      value.refuse("no folder " + out.folder.string(),
                   "\"aggregates\", \"icosahedron\", \"aggregates and icosahedron\", or a folder of surfaces; its path "
                   "is relative to the scene's folder");
    }
  };
  section.read(
      {{"library",
        Need::optional,
        {read_library, {"text", nullptr, "", "\"aggregates\""}},
        "\"aggregates\" (82 shapes), \"icosahedron\", \"aggregates and icosahedron\", or a folder of closed surfaces"},
       {"radius", Need::required, range_into(out.fill.radius_min, out.fill.radius_max),
        "smallest and largest radius of the spheres inside an aggregate"},
       {"porosity", Need::optional, into(out.fill.porosity, ratio, porosity),
        "porosity inside an aggregate: 1 - sum of the spheres' volumes / volume of the shape"},
       {"least", Need::optional, into(out.fill.least, 1, 1000),
        "least number of spheres; an aggregate too small for this number is a single sphere"},
       {"single", Need::optional,
        into<SingleSphere>(out.fill.single, {{"intermediate", SingleSphere::intermediate},
                                             {"circumscribed", SingleSphere::circumscribed},
                                             {"volume", SingleSphere::volume}}),
        "radius of the single sphere: half of D^I, radius of the circumscribed sphere, or radius of the sphere of "
        "equal volume"},
       {"placement", Need::optional,
        into<PlacementMethod>(out.placement,
                              {{"packing", PlacementMethod::packing}, {"insertion", PlacementMethod::insertion}}),
        "packing: all aggregates grow together while overlaps push them apart; insertion: one aggregate after the "
        "other at a random position"},
       {"allow_short", Need::optional, into(out.allow_short),
        "insertion: whether aggregates that find no space are left out"},
       {"test", Need::optional,
        into<PlacementTest>(out.test, {{"surfaces", PlacementTest::surfaces}, {"spheres", PlacementTest::spheres}}),
        "insertion: what is tested for overlap, the surfaces of the shapes or the spheres that fill them"},
       {"hold_out", Need::optional, into(out.hold_out, ratio, hold_out),
        "stiffness of the surfaces against mastic during relaxation, divided by the stiffness of a mastic pair"},
       {"gap", Need::optional, into(out.gap, ratio, gap),
        "packing: required distance between two surfaces, divided by the smaller D^I"}});
  if (out.placement == PlacementMethod::packing && out.allow_short)
    section.refuse("allow_short", "true with placement = \"packing\"", "placement = \"insertion\"");
  if (out.placement == PlacementMethod::packing && out.test == PlacementTest::spheres)
    section.refuse("test", "\"spheres\" with placement = \"packing\"", "placement = \"insertion\"");
  if (out.placement == PlacementMethod::insertion && section.has("gap"))
    section.refuse("gap", "a gap with placement = \"insertion\"", "placement = \"packing\"");
  return out;
}

}  // namespace macadam::scene
