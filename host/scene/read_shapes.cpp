// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_shapes.cpp  Reads `[specimen.shapes]`: aggregates of real shape, filled with spheres.
#include <map>

#include "host/scene/sections.hpp"

namespace macadam::scene {

ShapeSpec read_shapes(const Section& section, const std::filesystem::path& folder) {
  constexpr Rule porosity{[](double v) { return v >= -0.5 && v < 1; }, "a porosity from -0.5 to below 1"};
  constexpr Rule gap{[](double v) { return v > 0 && v < 0.5; }, "a share above 0 and below 0.5"};
  constexpr Rule hold_out{[](double v) { return v >= 0 && v <= 10; }, "a stiffness ratio from 0 to 10"};
  ShapeSpec out;
  const auto read_library = [&](const Value& value) {
    const std::string name = value.text();
    const std::map<std::string, ShapeSpec::Library> shipped{
        {"aggregates", ShapeSpec::Library::aggregates},
        {"icosahedron", ShapeSpec::Library::icosahedron},
        {"aggregates and icosahedron", ShapeSpec::Library::aggregates_and_icosahedron}};
    if (const auto found = shipped.find(name); found != shipped.end()) {
      out.library = found->second;
      return;
    }
    out.library = ShapeSpec::Library::folder;
    out.folder = (folder / name).lexically_normal();
    std::error_code error;
    if (!std::filesystem::is_directory(out.folder, error)) {
      value.refuse(
          "no folder " + out.folder.string(),
          "\"aggregates\", \"icosahedron\", \"aggregates and icosahedron\", or a folder of surfaces relative to "
          "the scene's");
    }
  };
  section.read(
      {{"library",
        Need::optional,
        {read_library, {"text", nullptr, "", "\"aggregates\""}},
        "\"aggregates\" (82 shapes), \"icosahedron\", \"aggregates and icosahedron\", or a folder of closed surfaces"},
       {"radius", Need::required, range_into(out.fill.radius_min, out.fill.radius_max),
        "radii of the spheres inside an aggregate, [min, max]"},
       {"porosity", Need::optional, into(out.fill.porosity, ratio, porosity),
        "porosity inside an aggregate: 1 - sum of the spheres' volumes / volume of the shape"},
       {"least", Need::optional, into(out.fill.least, 1, 1000),
        "minimum number of filling spheres; an aggregate that needs fewer is one sphere"},
       {"single", Need::optional,
        into<SingleSphere>(out.fill.single, {{"intermediate", SingleSphere::intermediate},
                                             {"circumscribed", SingleSphere::circumscribed},
                                             {"volume", SingleSphere::volume}}),
        "radius of a single sphere: D^I/2, of the smallest enclosing sphere, or of the sphere of equal volume"},
       {"placement", Need::optional,
        into<PlacementMethod>(out.placement,
                              {{"packing", PlacementMethod::packing}, {"insertion", PlacementMethod::insertion}}),
        "places all aggregates at once and grows them, or places them one by one at random"},
       {"allow_short", Need::optional, into(out.allow_short),
        "insertion: leave out aggregates for which no position is found"},
       {"test", Need::optional,
        into<PlacementTest>(out.test, {{"surfaces", PlacementTest::surfaces}, {"spheres", PlacementTest::spheres}}),
        "insertion: the parts of two aggregates that must not touch: surfaces of the shapes, or filling spheres"},
       {"hold_out", Need::optional, into(out.hold_out, ratio, hold_out),
        "stiffness of the surfaces against mastic while it relaxes, divided by the stiffness of a mastic pair"},
       {"gap", Need::optional, into(out.gap, ratio, gap),
        "packing: required distance of two surfaces, divided by the smaller D^I"}});
  if (out.placement == PlacementMethod::packing && out.allow_short)
    section.refuse("allow_short", "true with placement = \"packing\"", "placement = \"insertion\"");
  if (out.placement == PlacementMethod::packing && out.test == PlacementTest::spheres)
    section.refuse("test", "\"spheres\" with placement = \"packing\"", "placement = \"insertion\"");
  if (out.placement == PlacementMethod::insertion && section.has("gap"))
    section.refuse("gap", "a gap with placement = \"insertion\"", "placement = \"packing\"");
  return out;
}

}  // namespace macadam::scene
