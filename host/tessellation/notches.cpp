// SPDX-License-Identifier: GPL-3.0-or-later
// notches.cpp  Cuts polygons by notches, and checks notches against the domain of a specimen.
#include "host/tessellation/notches.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "host/tessellation/domain_walls.hpp"
#include "host/tessellation/facets.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Smallest part of a section that counts as a notch; smaller parts are rounding.
constexpr double smallest_notch = 1e-9;
/// Smallest part of a section that counts as a ligament. Smaller parts can result from the planes that represent curved
/// sides, which are up to 2.6e-5 radii beside them.
constexpr double smallest_ligament = 1e-4;

/// Returns the section of the domain by the plane of a notch; empty if the plane misses the domain.
Polygon section_at(const Notch& notch, const Domain& domain) {
  WallPlane plane(2 * notch.axis + 1, domain.size);
  if (!(notch.position > 0 && notch.position < plane.position)) return {};
  plane.position = notch.position;
  Polygon out, scratch;
  DomainWalls(domain).section(plane, rounding_bound(domain.size), out, scratch);
  return out;
}

double area_of(std::span<const Polygon> parts, int axis) {
  Vec3d normal{};
  (axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z) = 1;
  double sum = 0;
  for (const Polygon& part : parts) sum += std::abs(measure(part, normal).area);
  return sum;
}

}  // namespace

std::vector<Polygon> outside_of(const Notch& notch, std::span<const Polygon> parts, double tolerance) {
  std::vector<Polygon> out;
  Polygon scratch;
  const auto stay = [](const Vec3d&) {};
  for (Polygon inside : parts) {
    for (int axis = 0; axis < 3 && !inside.empty(); ++axis) {
      if (axis == notch.axis) continue;
      const auto k = static_cast<std::size_t>(axis);
      for (const auto& [limit, sign] : {std::pair(notch.low[k], -1.0), std::pair(notch.high[k], 1.0)}) {
        if (std::isinf(limit) || inside.empty()) continue;
        const auto beyond = [&, limit = limit, sign = sign](const Vec3d& p) { return sign * (along(p, axis) - limit); };
        Polygon part = inside;
        clip(
            part, scratch, tolerance, [&](const Vec3d& p) { return -beyond(p); }, stay);
        merge_vertices(part, tolerance);
        if (part.size() > 2) out.push_back(std::move(part));
        clip(inside, scratch, tolerance, beyond, stay);
      }
    }
  }
  return out;
}

std::string words_of(const Notch& notch) {
  return fmt::format("a notch at {} = {} m", "xyz"[notch.axis], notch.position);
}

std::vector<Notch> checked_notches(const Domain& domain, std::span<const Notch> notches) {
  std::vector<Notch> out(notches.begin(), notches.end());
  const auto refuse = [](const Notch& notch, const std::string& found, const std::string& expected) {
    throw InputError(notch.source, notch.line, "[[specimen.notch]]", words_of(notch) + found, expected);
  };
  const double tolerance = rounding_bound(domain.size);
  for (Notch& notch : out) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      if (notch.low[k] <= 0) notch.low[k] = -infinity;
      if (notch.high[k] >= domain.gauge_length(axis)) notch.high[k] = infinity;
    }
    const Polygon section = section_at(notch, domain);
    if (section.empty())
      refuse(notch, ", which is outside the specimen",
             fmt::format("a position between 0 and {} m", domain.gauge_length(notch.axis)));
    const double whole = area_of(std::span(&section, 1), notch.axis);
    const double left = area_of(outside_of(notch, std::span(&section, 1), tolerance), notch.axis);
    if (!(whole - left > smallest_notch * whole))
      refuse(notch, " with limits outside the specimen", "limits inside the " + domain.dimensions());
  }
  for (const Notch& notch : out) {
    std::vector<Polygon> left{section_at(notch, domain)};
    const double whole = area_of(left, notch.axis);
    for (const Notch& other : out)
      if (other.axis == notch.axis && other.position == notch.position) left = outside_of(other, left, tolerance);
    if (!(area_of(left, notch.axis) > smallest_ligament * whole))
      refuse(notch, " that severs the specimen", "a notch that leaves a ligament");
  }
  return out;
}

}  // namespace macadam
