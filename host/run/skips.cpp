// SPDX-License-Identifier: GPL-3.0-or-later
// skips.cpp  Lists the parts of a run that are skipped. The code that makes the arrays of the step
// (kernels/contact/contact_data.hpp) leaves these parts out.
#include "host/run/skips.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/run/error_model.hpp"

namespace macadam {
namespace {

/// Returns the names of the pair types whose law fulfils a condition, and the number of their contacts.
template <class Condition>
std::pair<std::string, std::int64_t> pairs_that(const Scene& scene, const Preparation& prepared, Condition&& fulfils) {
  std::string names;
  std::int64_t contacts = 0;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (prepared.network.count[pair] == 0 || !std::visit(fulfils, *scene.laws[pair])) continue;
    names += (names.empty() ? "" : ", ") + std::string(to_string(static_cast<PairType>(pair)));
    contacts += prepared.network.count[pair];
  }
  return {names, contacts};
}

constexpr const char* same_bits = "none: the results are equal bit for bit";

}  // namespace

std::vector<Skip> geometry_skips(Geometry geometry, std::optional<double> strain) {
  if (geometry != Geometry::fixed) return {};
  return {{"geometry update", "normals and lever arms keep their initial values",
           strain ? fmt::format("at most about {:.0e} of |E*| at a strain of {:g}",
                                fixed_geometry_error(std::abs(*strain)), *strain)
                  : "grows as the square of the strain: see docs/choose-settings.md"}};
}

std::vector<Skip> asked_skips(const Scene& scene) {
  std::vector<Skip> out;
  if (!scene.network.lateral_walls)
    out.push_back({"lateral walls", "the sides are free", "none: the scene asks for free sides"});
  if (!scene.output.contacts) out.push_back({"contacts.csv", "not requested", same_bits});
  const bool cyclic = std::holds_alternative<experiments::Cyclic>(scene.experiment);
  if (cyclic && is_stepped(scene.solver.method) && !scene.output.response) {
    out.push_back({"observation",
                   "response.csv is not requested, so only the fitted cycles and the cycle before them are sampled",
                   same_bits});
  }
  return out;
}

std::vector<Skip> find_skips(const Scene& scene, const Preparation& prepared, ContactForm form, Geometry geometry,
                             std::optional<double> strain) {
  const bool reference = scene.solver.backend == Backend::reference;
  const bool fixed = geometry == Geometry::fixed;
  std::vector<Skip> out;
  const auto append = [&](const std::vector<Skip>& more) { out.insert(out.end(), more.begin(), more.end()); };
  const auto [unitless, unitless_count] = pairs_that(scene, prepared, [](const auto& law) { return law.units() == 0; });
  if (unitless_count > 0) {
    out.push_back(
        {"Kelvin units", fmt::format("{} contacts ({}) have no Kelvin units", unitless_count, unitless), "rounding"});
  }
  const auto [elastic, elastic_count] =
      pairs_that(scene, prepared, [](const auto& law) { return decltype(law.template step<double>(1.0))::memoryless; });
  if (elastic_count > 0 && fixed && !reference) {
    out.push_back(
        {"contact states",
         fmt::format("the forces of {} elastic contacts ({}) with fixed geometry follow from the displacements",
                     elastic_count, elastic),
         "rounding, because forces are not summed over the steps"});
  }
  const auto [smooth, smooth_count] =
      pairs_that(scene, prepared, []<class L>(const L& law) { return law.alpha == 0 && !coupled_law<L>; });
  if (smooth_count > 0 && !reference) {
    out.push_back({"shear", fmt::format("{} contacts ({}) have alpha = 0", smooth_count, smooth), same_bits});
  }
  if (!reference && nothing_turns(prepared.network, scene.laws)) {
    out.push_back({"rotations", "without shear and with centred facets particles do not rotate",
                   "a first moment of a facet counts as 0 if it is below 1e-12 × area × size of the facet"});
  }
  append(geometry_skips(geometry, strain));
  if (scene.network.quadrature == Quadrature::one_point && form == ContactForm::points) {
    out.push_back({"second moments",
                   "a facet has one contact point, so a contact has three sets of law states instead of six",
                   "rounding"});
  }
  if (const auto n = prepared.network.dropped_area; n > 0) {
    out.push_back({"tiny facets", fmt::format("{} facets with an area below area_min are not contacts", n),
                   fmt::format("|E*| changes by about {:.0e}, the dropped fraction of the facets' area",
                               prepared.network.dropped_share)});
  }
  if (const auto n = prepared.network.dropped_gap; n > 0) {
    out.push_back({"open facets", fmt::format("{} facets with a gap above gap_max are not contacts", n),
                   "the model changes: compare with a run without gap_max"});
  }
  append(asked_skips(scene));
  return out;
}

}  // namespace macadam
