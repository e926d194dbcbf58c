// SPDX-License-Identifier: GPL-3.0-or-later
// read_notch.cpp  Reads `[[specimen.notch]]`: thin cuts that no contact crosses.
#include <fmt/format.h>

#include "host/scene/sections.hpp"

namespace macadam::scene {
namespace {

/// Returns a reader of the limits of a notch along an axis, `[from, to]` [m].
Reader limits_into(double& low, double& high) {
  const auto read = [&low, &high](const Value& value) {
    const std::vector<double> limits = value.numbers(length, any);
    if (limits.size() != 2) value.refuse(fmt::format("{} entries", limits.size()), "two, [from, to]");
    if (!(limits[0] < limits[1])) value.refuse(fmt::format("[{}, {}] m", limits[0], limits[1]), "from less than to");
    low = limits[0], high = limits[1];
  };
  return {read, {"list of two numbers", &length, any.words}};
}

}  // namespace

Notch read_notch(const Section& section, const Domain& domain) {
  Notch out;
  out.source = section.file(), out.line = section.line();
  const auto limits = [&](std::size_t axis, const char* text) {
    return Key{std::string(1, "xyz"[axis]), Need::optional, limits_into(out.low[axis], out.high[axis]), text,
               "the whole width"};
  };
  section.read({{"axis", Need::required, into<int>(out.axis, {{"x", 0}, {"y", 1}, {"z", 2}}),
                 "axis to which the notch is perpendicular"},
                {"at", Need::required, into(out.position, length, positive), "coordinate of the notch along its axis"},
                limits(0, "limits of the notch along x, if its axis is y or z"),
                limits(1, "limits of the notch along y, if its axis is z or x"),
                limits(2, "limits of the notch along z, if its axis is x or y")});
  const std::string own(1, "xyz"[out.axis]);
  if (section.has(own)) section.refuse(own, "limits along the axis of the notch", "limits along the other two axes");
  const double end = domain.gauge_length(out.axis);
  if (!(out.position < end))
    section.refuse("at", fmt::format("{} m, which is outside the specimen", out.position),
                   fmt::format("a position between 0 and {} m", end));
  return out;
}

}  // namespace macadam::scene
