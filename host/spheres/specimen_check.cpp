// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_check.cpp  Makes the checks that every specimen must pass, whether it was read or generated.
#include "macadam/specimen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"

namespace macadam {

const char* to_string(Phase phase) {
  switch (phase) {
    case Phase::aggregate:
      return "aggregate";
    case Phase::mastic:
      return "mastic";
    case Phase::air_void:
      return "void";
  }
  return "unknown";
}

Specimen with_voids_as_cells(const Specimen& specimen) {
  Specimen out = specimen;
  out.voids.clear();
  for (const VoidSphere& v : specimen.voids) {
    out.centre.push_back(v.centre);
    out.radius.push_back(v.radius);
    out.phase.push_back(Phase::air_void);
    out.body.push_back(-1);
  }
  return out;
}

std::string shown(double value) { return domains::shortest_text(value); }

namespace {

std::string point(const Vec3d& v) { return "(" + shown(v.x) + ", " + shown(v.y) + ", " + shown(v.z) + ")"; }

/// Checks the box, the number of particles and the lengths of the arrays.
std::optional<SpecimenFault> fault_of_arrays(const Specimen& s) {
  for (double edge : {s.box.size.x, s.box.size.y, s.box.size.z})
    if (!(std::isfinite(edge) && edge > 0)) return SpecimenFault{-1, "box", point(s.box.size), "positive edges"};
  if (const char* expected = s.box.expected_size())
    return SpecimenFault{-1, std::string("bounding box of the ") + s.box.name(), point(s.box.size), expected};
  const std::size_t n = s.size();
  if (n == 0) return SpecimenFault{-1, "particles", "0", "at least 1"};
  if (s.cells() > static_cast<std::size_t>(most_particles))
    return SpecimenFault{-1, "particles", std::to_string(s.cells()), "at most " + std::to_string(most_particles)};
  const std::pair<const char*, std::size_t> lengths[] = {
      {"radius", s.radius.size()}, {"phase", s.phase.size()}, {"body", s.body.size()}};
  for (const auto& [name, length] : lengths)
    if (length != n)
      return SpecimenFault{-1, std::string("length of array ") + name, std::to_string(length), std::to_string(n)};
  return std::nullopt;
}

/// Checks one sphere. `is_void`: whether the sphere is one of the voids, which follow the particles.
std::optional<SpecimenFault> fault_of_sphere(const Specimen& s, std::size_t i, bool is_void) {
  const Vec3d c = s.centre[i], l = s.box.size;
  const auto fault = [&](const char* what, std::string found, std::string expected) {
    return SpecimenFault{static_cast<std::int64_t>(i), what, std::move(found), std::move(expected)};
  };
  // The conditions are written such that NaN fails too.
  if (!(c.x >= 0 && c.x <= l.x && c.y >= 0 && c.y <= l.y && c.z >= 0 && c.z <= l.z))
    return fault("centre", point(c), "a point in the box from (0, 0, 0) to " + point(l));
  if (!s.box.contains(c))
    return fault("centre", point(c), "a point in the " + s.box.dimensions() + ", " + s.box.position());
  if (!(std::isfinite(s.radius[i]) && s.radius[i] > 0))
    return fault("radius", shown(s.radius[i]), "a finite positive number");
  if (is_void) return std::nullopt;
  if (s.phase[i] != Phase::aggregate && s.phase[i] != Phase::mastic)
    return fault("phase", std::to_string(static_cast<int>(s.phase[i])), "aggregate or mastic");
  if (s.phase[i] == Phase::mastic && s.body[i] != -1)
    return fault("body of a mastic particle", std::to_string(s.body[i]), "-1");
  if (s.phase[i] == Phase::aggregate && s.body[i] < 0)
    return fault("body of an aggregate particle", std::to_string(s.body[i]), "a number of 0 or more");
  return std::nullopt;
}

std::optional<SpecimenFault> coincident_centres(const Specimen& s) {
  const auto key = [&](std::int32_t i) { return std::tie(s.centre[i].x, s.centre[i].y, s.centre[i].z); };
  std::vector<std::int32_t> order(s.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
  // Selects, among all coincident pairs, the pair whose second particle has the lowest number.
  std::pair<std::int32_t, std::int32_t> first{-1, -1};
  for (std::size_t k = 1; k < order.size(); ++k)
    if (key(order[k - 1]) == key(order[k]) && (first.second < 0 || order[k] < first.second))
      first = {order[k - 1], order[k]};
  if (first.second < 0) return std::nullopt;
  return SpecimenFault{
      first.second, "centre",
      point(s.centre[first.second]) + ", which is also the centre of particle " + std::to_string(first.first),
      "no two coincident centres"};
}

}  // namespace

std::optional<SpecimenFault> find_fault(const Specimen& specimen) {
  if (auto fault = fault_of_arrays(specimen)) return fault;
  const Specimen all = with_voids_as_cells(specimen);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (auto fault = fault_of_sphere(all, i, i >= specimen.size())) return fault;
  return coincident_centres(all);
}

void validate(const Specimen& specimen, const std::string& source) {
  if (const auto fault = find_fault(specimen)) {
    const bool is_void = fault->particle >= static_cast<std::int64_t>(specimen.size());
    const std::string whose =
        fault->particle >= 0 ? (is_void ? "void " : "particle ") + std::to_string(fault->particle) + ": " : "";
    throw InputError(source, fault->particle >= 0 ? specimen.line_of(fault->particle) : 0, whose + fault->what,
                     fault->found, fault->expected);
  }
}

}  // namespace macadam
