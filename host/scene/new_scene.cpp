// SPDX-License-Identifier: GPL-3.0-or-later
// new_scene.cpp  Defines the values of a new scene.
#include "host/scene/new_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/scene/scene_part.hpp"
#include "macadam/error.hpp"

namespace macadam::scene {
namespace {

/// Keys that are not offered beside the box of a generated specimen.
const std::vector<std::string> not_with_box = {"domain", "diameter", "height", "file", "aggregate_file"};
const std::vector<Given> box = {{"box", R"(["20 mm", "20 mm", "30 mm"])"}, {"seed", "1"}};

std::vector<Part> specimen_by_volume(bool shapes) {
  std::vector<Part> out{{"[specimen]", box, "", true, not_with_box}};
  if (shapes)
    out.push_back({"[specimen.shapes]",
                   {{"library", R"("aggregates")"}, {"radius", R"(["0.75 mm", "1 mm"])"}, {"porosity", "0.12"}},
                   "Without this section every aggregate is one sphere."});
  out.push_back({"[[specimen.aggregate]]",
                 {{"sieve", R"(["4.75 mm", "9.5 mm"])"}, {"volume_fraction", "0.24"}},
                 "Classes of aggregates, one [[specimen.aggregate]] between every two sieves. The mastic (binder, "
                 "filler, fine sand) fills the remaining solid volume.",
                 true,
                 {"count"}});
  out.push_back(
      {"[[specimen.aggregate]]", {{"sieve", R"(["2 mm", "4.75 mm"])"}, {"volume_fraction", "0.19"}}, "", false});
  out.push_back({"[specimen.mastic]",
                 {{"radius", R"(["0.75 mm", "1 mm"])"}, {"porosity", "0.05"}},
                 "Smaller spheres mean more spheres and a longer run.",
                 true,
                 {"count"}});
  return out;
}

std::vector<Part> specimen_by_mass() {
  return {{"[specimen]", {{"box", R"(["30 mm", "30 mm", "40 mm"])"}, {"seed", "1"}}, "", true, not_with_box},
          {"[specimen.recipe]",
           {{"gradation",
             R"([["19 mm", "100 %"], ["12.5 mm", "83.7 %"], ["9.5 mm", "71.2 %"], ["4.75 mm", "47.8 %"],
             ["2 mm", "32.5 %"], ["0.425 mm", "16.9 %"], ["0.18 mm", "9.4 %"], ["0.075 mm", "5.3 %"]])"},
            {"cut", R"("2 mm")"},
            {"binder", R"("5.2 %")"},
            {"binder_of", R"("mix")"},
            {"aggregate_density", R"("2.63 g/cm3")"},
            {"binder_density", R"("1.03 g/cm3")"},
            {"air_voids", R"("5 %")"}},
           "The mix design from the laboratory's sheet. Densities and volumes of the specimen are computed from this "
           "design."},
          {"[specimen.mastic]", {{"radius", R"(["0.75 mm", "1 mm"])"}}, "", true, {"porosity", "count"}}};
}

std::vector<Part> specimen_of(NewKind kind) {
  if (kind == NewKind::recipe) return specimen_by_mass();
  if (kind != NewKind::file && kind != NewKind::packing) return specimen_by_volume(kind == NewKind::shapes);
  return {{"[specimen]",
           {{"file", R"("specimen.csv")"}, {"box", R"(["20 mm", "20 mm", "30 mm"])"}},
           "macadam specimen writes such files.",
           false}};
}

Given chain(const char* key, const char* value) { return {key, value}; }

/// Returns the contact laws. `cracks`: whether contacts between particles have cracks. `shift`: whether viscosities
/// depend on the temperature. `glued`: whether the walls have shear stiffness.
std::vector<Part> contacts_of(NewKind kind, bool cracks, bool shift, bool glued) {
  const std::string kelvin = R"("generalised_kelvin")", elastic = R"("elastic")";
  std::vector<Part> out{
      {"[[contacts]]",
       {{"pair", R"("M-M")"},
        {"law", kelvin},
        chain("E_m", "1.115e10"),
        chain("C_m", "2.515e9"),
        chain("E", "[3.799e8, 1.600e9, 4.308e10]"),
        chain("C", "[8.950e9, 5.695e9, 1.114e9]"),
        {"alpha", "0.1"}},
       "Contact laws, one per pair of materials. These are published values of an AC 14 mixture; macadam fit computes "
       "values for your own mastic from measured moduli, and macadam calibrate finds values for your own mixture."},
      {"[[contacts]]",
       {{"pair", R"("M-A")"},
        {"law", kelvin},
        chain("E_m", "3.511e10"),
        chain("C_m", "7.921e9"),
        chain("E", "[1.197e9, 5.039e9, 1.357e11]"),
        chain("C", "[2.819e10, 1.794e10, 3.510e9]"),
        {"alpha", "0.1"}},
       "",
       false}};
  if (shift) {
    for (Part& law : out) {
      law.given.insert(
          law.given.end(),
          {{"shift", R"("wlf")"}, {"C1", "12.0"}, {"C2", R"("120 K")"}, {"reference_temperature", R"("20 degC")"}});
    }
    out.front().remark += " The shift is an example.";
  }
  const auto add = [&](const char* pair, const char* modulus, const char* alpha, const char* remark) {
    out.push_back({"[[contacts]]",
                   {{"pair", '"' + std::string(pair) + '"'}, {"law", elastic}, {"E", modulus}, {"alpha", alpha}},
                   remark,
                   false});
  };
  add("A-A", "1.151e11", "0.05", "");
  if (kind == NewKind::shapes || kind == NewKind::file) add("inner", "1.116e11", "0.05", "Spheres of one aggregate.");
  if (cracks) {
    out.front().remark +=
        " A contact cracks at its tensile_strength and takes its fracture_energy in J/m2; docs/cracks.md explains how "
        "to "
        "find the values for your own mixture.";
    const char* values[] = {R"({ tensile_strength = "1 MPa", fracture_energy = 50.0, friction = 0.5 })",
                            R"({ tensile_strength = "0.8 MPa", fracture_energy = 40.0, friction = 0.5 })",
                            R"({ tensile_strength = "2 MPa", fracture_energy = 60.0, friction = 0.6 })"};
    for (std::size_t pair = 0; pair < std::size(values); ++pair) out[pair].given.push_back({"crack", values[pair]});
  }
  add("A-W", "1.151e11", glued ? "0.05" : "0.0",
      glued ? "Platens that are glued to the specimen."
            : "Walls without shear stiffness, along which the specimen slides freely.");
  add("M-W", "3.511e10", glued ? "0.1" : "0.0", "");
  return out;
}

/// Returns `[materials]` with the laws of the phases. `densities`: whether the scene gives densities.
std::vector<Part> materials_with_laws(bool densities) {
  Part aggregate{"[materials.aggregate]",
                 {{"law", R"("elastic")"}, {"E", R"("60 GPa")"}, {"poisson_ratio", "0.28"}},
                 "Laws of rock and mastic, from which the stiffness of every contact follows. macadam fit computes the "
                 "law of your own mastic from measured moduli.",
                 true,
                 {"density"}};
  Part mastic{"[materials.mastic]",
              {{"law", R"("generalised_kelvin")"},
               chain("E_m", "5.931e9"),
               chain("C_m", "1.338e9"),
               chain("E", "[2.021e8, 8.511e8, 2.291e10]"),
               chain("C", "[4.761e9, 3.029e9, 5.926e8]"),
               {"poisson_ratio", "0.35"}},
              "",
              true,
              {"density"}};
  if (densities) {
    aggregate.given.insert(aggregate.given.begin(), {"density", R"("2.63 g/cm3")"});
    mastic.given.insert(mastic.given.begin(), {"density", R"("2.11 g/cm3")"});
  }
  return {{"[materials]", {}}, aggregate, mastic};
}

/// Replaces the box of a specimen by another domain with these dimensions.
void replace_box(Part& specimen, const std::string& domain, const std::vector<Given>& dimensions) {
  std::vector<Given>& given = specimen.given;
  const auto at = std::find_if(given.begin(), given.end(), [](const Given& g) { return g.key == "box"; });
  *at = {"domain", '"' + domain + '"'};
  given.insert(at + 1, dimensions.begin(), dimensions.end());
  specimen.not_these.push_back("box");
}

/// Gives a specimen the domain of a test that is not made on a box.
void set_domain(Part& specimen, const std::string& test) {
  if (test == "indirect_tension" || test == "indirect_tensile_strength")
    replace_box(specimen, "disc", {{"diameter", R"("60 mm")"}, {"thickness", R"("20 mm")"}});
  if (test == "bending" || test == "three_point_bending")
    replace_box(specimen, "beam", {{"length", R"("120 mm")"}, {"width", R"("20 mm")"}, {"height", R"("20 mm")"}});
  if (test == "semicircular_bending")
    replace_box(specimen, "half_disc", {{"diameter", R"("60 mm")"}, {"thickness", R"("20 mm")"}});
  if (test == "torsion") replace_box(specimen, "cylinder", {{"diameter", R"("24 mm")"}, {"height", R"("40 mm")"}});
}

/// Returns whether a test bends a specimen until it fails. Such a test usually has a notch.
bool bends_to_failure(const std::string& test) {
  return test == "semicircular_bending" || test == "three_point_bending";
}

/// Returns the notch of a specimen that is bent until it fails.
Part notch_of(const std::string& test) {
  const char* middle = test == "semicircular_bending" ? R"("30 mm")" : R"("60 mm")";
  return {"[[specimen.notch]]",
          {{"axis", R"("x")"}, {"at", middle}, {"z", R"(["0 mm", "6 mm"])"}},
          "A thin cut from the middle of the bottom upwards. Without this section the specimen has no notch."};
}

/// Returns whether a test measures a strength and needs cracks.
bool needs_cracks(const std::string& test) {
  return test == "indirect_tensile_strength" || test == "cooling" || bends_to_failure(test);
}

Part loading_of(const std::string& test, bool cracks) {
  Part out{"[loading]", {{"kind", '"' + test + '"'}}};
  const auto give = [&](const char* key, const char* value) { out.given.push_back({key, value}); };
  if (test == "cyclic") give("frequencies", "[2.0, 5.0, 10.0, 20.0]"), give("strain_amplitude", "1e-4");
  if (test == "indirect_tension") give("frequencies", "[0.01, 100.0]"), give("points_per_decade", "4");
  if (test == "indirect_tensile_strength") give("displacement", R"("0.4 mm")"), give("points", "100");
  if (test == "semicircular_bending") give("displacement", R"("0.3 mm")"), give("points", "100");
  if (test == "three_point_bending")
    give("rate", R"("50 mm/min")"), give("displacement", R"("0.5 mm")"), give("points", "100");
  if (test == "bending" || test == "sweep" || test == "torsion")
    give("frequencies", "[0.01, 100.0]"), give("points_per_decade", "4");
  if (test == "cooling") give("from", R"("20 degC")"), give("to", R"("-30 degC")"), give("rate", R"("10 K/h")");
  if (test == "relaxation") give("times", R"([1e-3, 1e3])"), give("points_per_decade", "4"), give("strain", "1e-4");
  if (test == "creep") give("times", R"([1e-3, 1e3])"), give("points_per_decade", "4"), give("stress", R"("100 kPa")");
  if (test == "monotonic" && cracks) give("rate", "1.0"), give("strain", "5e-3"), give("points", "100");
  if (test == "monotonic" && !cracks) give("rate", "1e-4"), give("strain", "1e-3"), give("points", "100");
  if (test == "history") {
    give("drive", R"("haversine")"), give("strain", "-1e-4"), give("pulse", R"("0.1 s")"), give("rest", R"("0.9 s")");
    give("duration", R"("5 s")");
  }
  // Leaves out keys that must not be given together with the keys above, and keys that only method "explicit" has.
  out.not_these = {"temperatures", "points", "platen_mass"};
  if (test == "monotonic") out.not_these = {"times", "points_per_decade"};
  if (test == "history")  // keys of other drives
    out.not_these = {"times", "strains", "file", "ramp", "hold", "smooth", "rate", "frequency"};
  return out;
}

/// Returns `[materials]` for laws in `[[contacts]]`. `densities`: whether the scene gives densities; `expansion`:
/// whether the materials expand.
std::vector<Part> materials_without_laws(bool densities, bool expansion) {
  std::vector<Part> out{{"[materials]", {}}};
  if (expansion) out.front().not_these.push_back("temperature");  // the test has temperatures of its own
  const auto add = [&](const char* title, const char* density, const char* per_kelvin) {
    Part part{title, {}, "", false};
    if (densities) part.given.push_back({"density", density});
    if (expansion) part.given.push_back({"expansion", per_kelvin});
    if (!part.given.empty()) out.push_back(part);
  };
  add("[materials.aggregate]", R"("2.63 g/cm3")", R"("8e-6 1/K")");
  add("[materials.mastic]", R"("2.11 g/cm3")", R"("5e-5 1/K")");
  return out;
}

/// Returns whether a section is about aggregates.
bool is_of_aggregates(const Part& part) {
  const auto is_pair = [](const Given& given) {
    return given.key == "pair" && given.value != R"("M-M")" && given.value != R"("M-W")";
  };
  return part.title == "[materials.aggregate]" || std::any_of(part.given.begin(), part.given.end(), is_pair);
}

constexpr const char* about_gaps =
    "Every facet between two cells is a contact, also across a gap between their spheres. gap_max = 0.1 keeps the "
    "contacts "
    "whose gap is at most 0.1 of the mean of the two radii, gap_max = 0.001 those of spheres that touch or overlap.";

}  // namespace

std::vector<std::string> tests_of_new_scenes() {
  for (const KnownKey& key : known_keys())
    if (key.section == "[loading]" && key.name == "kind") return key.words.choices;
  return {};
}

std::string new_scene(NewKind kind, const std::string& test, ContactRule rule, bool with_cracks) {
  const bool of_strength = needs_cracks(test), cracks = with_cracks || of_strength;
  if (cracks && has_laws_of_phases(rule))
    throw InputError(fmt::format(
        "{}: found {} with --rule {}, expected --rule centres; scenes with --rule series get a crack by hand",
        of_strength ? "--test" : "--cracks", of_strength ? test : "this option", to_string(rule)));
  if (cracks && test != "monotonic" && !of_strength) {
    throw InputError(
        fmt::format("--cracks: found this option with --test {}, expected --test monotonic, indirect_tensile_strength, "
                    "semicircular_bending, three_point_bending or cooling, which measure a strength",
                    test));
  }
  if ((test == "indirect_tension" || test == "bending" || test == "torsion") && rule == ContactRule::volumetric)
    throw InputError("--test: found " + test + " with --rule volumetric, expected --rule series or centres");
  std::vector<Part> parts = specimen_of(kind);
  set_domain(parts.front(), test);
  if (bends_to_failure(test)) parts.push_back(notch_of(test));
  const auto append = [&](std::vector<Part> more) { parts.insert(parts.end(), more.begin(), more.end()); };
  const bool of_phases = has_laws_of_phases(rule), densities = kind != NewKind::recipe, cools = test == "cooling";
  append(of_phases ? materials_with_laws(densities) : materials_without_laws(densities, cools));
  if (!of_phases) append(contacts_of(kind, cracks, cools, test == "torsion"));
  std::vector<std::string> not_set{"tolerance", "density_scaling", "safety",   "time_step", "damping", "damping_kind",
                                   "form",      "geometry",        "precision"};
  if (of_strength) not_set.insert(not_set.end(), {"linear", "inertia"});  // keys of time steps
  append({{"[network]",
           of_phases ? std::vector<Given>{{"rule", std::string("\"") + to_string(rule) + '"'}} : std::vector<Given>{},
           kind == NewKind::packing ? about_gaps : ""},
          loading_of(test, cracks),
          {"[solver]",
           of_strength ? std::vector<Given>{{"method", R"("quasi_static")"}}
           : cracks    ? std::vector<Given>{{"method", R"("explicit")"}, {"density_scaling", "10"}}
                       : std::vector<Given>{{"method", R"("harmonic")"}},
           "A line that begins with # is a key that is not set: remove the # and give it a value.", true, not_set},
          {"[output]", {}, "", true, {"every", "format"}}});
  if (kind == NewKind::packing) std::erase_if(parts, is_of_aggregates);
  std::string out =
      "# A scene of Macadam. Numbers are in SI units, or text with a unit, such as \"12.5 mm\". docs/scene.md explains "
      "scenes,\n"
      "# docs/keys.md lists every key.\n";
  const std::vector<KnownKey> keys = known_keys();
  for (const Part& part : parts) out += written(keys, part);
  return out;
}

}  // namespace macadam::scene
