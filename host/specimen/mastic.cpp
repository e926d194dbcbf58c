// SPDX-License-Identifier: GPL-3.0-or-later
// mastic.cpp  Relaxes the mastic repeatedly. Between two relaxations, moves hidden spheres (those without a Laguerre
// cell) to new random places.
#include "host/specimen/mastic.hpp"

#include <algorithm>
#include <string>

#include "host/base/seconds_of.hpp"
#include "host/spheres/relaxation.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr int most_relaxations = 10;  // rounds of relaxation after which remaining hidden spheres are an error

/// Moves hidden mastic spheres to new random places.
void reinsert(const std::vector<std::int32_t>& hidden, Specimen& specimen, Placement& placement) {
  for (std::int32_t i : hidden)
    if (specimen.phase[i] == Phase::mastic) specimen.centre[i] = placement.point_outside_aggregates();
}

[[noreturn]] void give_up(const Origin& origin, const std::vector<std::int32_t>& hidden) {
  std::string message = std::to_string(hidden.size()) + " particles have no Laguerre cell after " +
                        std::to_string(most_relaxations) + " rounds of relaxation:";
  constexpr std::size_t shown = 10;
  for (std::size_t k = 0; k < std::min(hidden.size(), shown); ++k) message += " " + std::to_string(hidden[k]);
  if (hidden.size() > shown) message += " …";
  throw RunError(origin.text() + message + "; choose fewer mastic spheres, or radii that differ less");
}

}  // namespace

SettledMastic settle_mastic(Specimen& specimen, Placement& placement, bool fix_aggregates, const Origin& origin,
                            const Enclosure& wall,
                            const std::function<void(const char* stage, double share)>& progress) {
  const auto report = [&](const char* stage, double share) {
    if (progress) progress(stage, share);
  };
  SettledMastic out;
  for (int round = 0; round < most_relaxations; ++round) {
    reinsert(out.tessellation.hidden, specimen, placement);
    out.iterations += relax(
        specimen, fix_aggregates, [&](double share) { report("relaxing mastic", share); }, wall);
    report("tessellation", 0);
    out.seconds_tessellation = seconds_of([&] { out.tessellation = tessellate(specimen); });
    if (out.tessellation.hidden.empty()) return out;
  }
  give_up(origin, out.tessellation.hidden);
}

void part_voids(std::size_t first, std::size_t end, Specimen& specimen) {
  for (std::size_t i = first; i < end; ++i) specimen.voids.push_back({specimen.centre[i], specimen.radius[i]});
  const auto erase = [&](auto& list) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(first), list.begin() + static_cast<std::ptrdiff_t>(end));
  };
  erase(specimen.centre), erase(specimen.radius), erase(specimen.phase), erase(specimen.body);
}

}  // namespace macadam
