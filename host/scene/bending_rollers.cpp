// SPDX-License-Identifier: GPL-3.0-or-later
// bending_rollers.cpp  Computes the positions of the rollers of the bending tests, and refuses positions that no test
// has.
#include "host/scene/bending_rollers.hpp"

#include <fmt/format.h>

#include <string>

namespace macadam::scene {
namespace {

constexpr double sum_rounding = 1e-12;  // of sums of two lengths that a user has computed by hand

void refuse(const Section& root, const char* key, double found, const std::string& expected) {
  root.find("loading")->section().refuse(key, fmt::format("{:g} m", found), expected);
}

/// Distance of the two lower rollers and width of all rollers [m].
struct Sizes {
  double span, width;
  bool span_is_given;  ///< whether the scene gives the span
};

/// Returns two lower rollers, and one upper roller above their middle. `domain`: length along x [m], and its name in
/// messages. \throws InputError if a lower roller does not fit on the domain, or if the rollers are too wide.
domains::Rollers three_rollers(const Section& root, const Sizes& sizes, double domain, const std::string& name) {
  const auto [span, width, span_is_given] = sizes;
  const bool fits = span + width <= domain * (1 + sum_rounding);
  if (!fits && (span_is_given || span >= domain))
    refuse(root, "span", span, fmt::format("at most {:g} m, {} less the width of a roller", domain - width, name));
  if (!(width <= 0.25 * span * (1 + sum_rounding)))
    refuse(root, "roller_width", width, fmt::format("at most {:g} m, a quarter of the span", 0.25 * span));
  if (!fits) refuse(root, "roller_width", width, fmt::format("at most {:g} m, {} less the span", domain - span, name));
  const double middle = 0.5 * domain;
  return {{middle - 0.5 * span, middle + 0.5 * span}, {middle}, width};
}

/// Returns the same for a test to failure, in which the rollers turn with the specimen.
domains::Rollers turning_rollers(const Section& root, const Sizes& sizes, double domain, const std::string& name) {
  domains::Rollers out = three_rollers(root, sizes, domain, name);
  out.turn = true;
  return out;
}

domains::Rollers rollers_of(const experiments::Bending& test, double length, const Section& root) {
  const double span = test.span.value_or(experiments::usual_span * length),
               width = test.roller_width.value_or(experiments::usual_roller_width * span);
  domains::Rollers out = three_rollers(root, {span, width, test.span.has_value()}, length, "the length of the beam");
  if (test.rollers == 4) {
    // an upper roller may stand neither on the other upper roller nor above a lower one
    const double inner = test.inner_span.value_or(span / 3), least = width, most = span - 2 * width;
    if (!(inner >= least * (1 - sum_rounding) && inner <= most * (1 + sum_rounding)))
      refuse(root, "inner_span", inner,
             fmt::format("{:g} to {:g} m, because rollers of {:g} m must not overlap within a span of {:g} m", least,
                         most, width, span));
    const double middle = 0.5 * length;
    out.top = {middle - 0.5 * inner, middle + 0.5 * inner};
  } else if (test.inner_span) {
    refuse(root, "inner_span", *test.inner_span, "no such key with rollers = 3, which have one roller above the beam");
  }
  return out;
}

domains::Rollers rollers_of(const experiments::SemicircularBending& test, double diameter, const Section& root) {
  const double span = test.span.value_or(test.usual_span * diameter),
               width = test.roller_width.value_or(test.usual_roller_width * 0.5 * diameter);
  return turning_rollers(root, {span, width, test.span.has_value()}, diameter, "the diameter");
}

domains::Rollers rollers_of(const experiments::ThreePointBending& test, double length, const Section& root) {
  const double span = test.span.value_or(test.usual_span * test.height),
               width = test.roller_width.value_or(test.usual_roller_width * span);
  return turning_rollers(root, {span, width, test.span.has_value()}, length, "the length of the beam");
}

}  // namespace

void set_rollers(Scene& scene, const Section& root) {
  Domain& domain = scene.specimen.box;
  const std::string name = domain.name();
  if (const auto* test = std::get_if<experiments::Bending>(&scene.experiment); test && name == domains::Beam::name)
    domain.set_rollers(rollers_of(*test, domain.size.x, root));
  if (auto* test = std::get_if<experiments::SemicircularBending>(&scene.experiment)) {
    test->radius = domain.gauge_length();
    if (name == domains::HalfDisc::name) domain.set_rollers(rollers_of(*test, domain.size.x, root));
  }
  if (auto* test = std::get_if<experiments::ThreePointBending>(&scene.experiment)) {
    test->height = domain.gauge_length();
    if (name == domains::Beam::name) domain.set_rollers(rollers_of(*test, domain.size.x, root));
  }
}

}  // namespace macadam::scene
