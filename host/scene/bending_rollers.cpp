// SPDX-License-Identifier: GPL-3.0-or-later
// bending_rollers.cpp  Computes the positions of the rollers of a bending test, and refuses positions that no test has.
#include "host/scene/bending_rollers.hpp"

#include <fmt/format.h>

#include <string>

namespace macadam::scene {

void set_rollers(Scene& scene, const Section& root) {
  const auto* test = std::get_if<experiments::Bending>(&scene.experiment);
  Domain& beam = scene.specimen.box;
  if (!test || beam.name() != std::string(domains::Beam::name)) return;
  const auto refuse = [&](const char* key, double found, const std::string& expected) {
    root.find("loading")->section().refuse(key, fmt::format("{:g} m", found), expected);
  };
  constexpr double rounding = 1e-12;  // of sums of two lengths that a user has computed by hand
  const double length_of_beam = beam.size.x, span = test->span.value_or(experiments::usual_span * length_of_beam),
               width = test->roller_width.value_or(experiments::usual_roller_width * span);
  if (test->span && !(span + width <= length_of_beam * (1 + rounding)))
    refuse("span", span,
           fmt::format("at most {:g} m, the length of the beam less the width of a roller", length_of_beam - width));
  if (!(width <= 0.25 * span * (1 + rounding)))
    refuse("roller_width", width, fmt::format("at most {:g} m, a quarter of the span", 0.25 * span));
  if (!(span + width <= length_of_beam * (1 + rounding)))
    refuse("roller_width", width,
           fmt::format("at most {:g} m, the length of the beam less the span", length_of_beam - span));

  const double middle = 0.5 * length_of_beam;
  domains::Rollers rollers{{middle - 0.5 * span, middle + 0.5 * span}, {middle}, width};
  if (test->rollers == 4) {
    // an upper roller may stand neither on the other upper roller nor above a lower one
    const double inner = test->inner_span.value_or(span / 3), least = width, most = span - 2 * width;
    if (!(inner >= least * (1 - rounding) && inner <= most * (1 + rounding)))
      refuse("inner_span", inner,
             fmt::format("{:g} to {:g} m, because rollers of {:g} m must not overlap within a span of {:g} m", least,
                         most, width, span));
    rollers.top = {middle - 0.5 * inner, middle + 0.5 * inner};
  } else if (test->inner_span) {
    refuse("inner_span", *test->inner_span, "no such key with rollers = 3, which have one roller above the beam");
  }
  beam.set_rollers(rollers);
}

}  // namespace macadam::scene
