// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rank_messages.hpp  Sends the messages between tiles of several processes (ranks).
///
/// With ranks every GPU has whole arrays, and each rank computes its own tiles (ranges of neighbouring particles). In
/// every step TileLaunch sends the velocities of halo particles, which are particles that contacts of another tile
/// touch. Between two blocks of steps it sends the displacements, load records and constants that the next kernels read
/// (RankExchange in rank_exchange.hpp). One process sends nothing, because its devices read each other's memory.
/// docs/gpu-step.md explains the whole path.
#pragma once

#include <vector>

#include "kernels/cuda/common/crossing_contacts.hpp"
#include "kernels/cuda/tiles/settle_launch.hpp"
#include "kernels/cuda/tiles/contact_positions.hpp"
#include "kernels/cuda/tiles/tile_step.hpp"

namespace macadam::kernels {

/// Finds the member of a team that owns a place or packet of the plan.
class TileOwners {
 public:
  TileOwners(const TilePlan& plan, const TeamCuts& cuts) {
    for (std::size_t m = 0; m < cuts.members(); ++m) {
      first_place_.push_back(plan.tile[cuts.tile(m)].first_body);
      first_packet_.push_back(plan.tile[cuts.tile(m)].first_packet);
    }
    first_place_.push_back(plan.body.size());
    first_packet_.push_back(plan.packets());
  }
  /// First place or packet of member m; the number of places or packets for m = number of members.
  std::size_t first_place(std::size_t m) const { return first_place_[m]; }
  std::size_t first_packet(std::size_t m) const { return first_packet_[m]; }
  std::size_t of_place(std::size_t place) const { return owner(first_place_, place); }
  /// Returns the member that owns contact number `contact` of the plan.
  std::size_t of_contact(std::size_t contact) const { return owner(first_packet_, contact / 32); }

 private:
  static std::size_t owner(const std::vector<std::size_t>& first, std::size_t item) {
    std::size_t m = 0;
    while (m + 2 < first.size() && item >= first[m + 1]) ++m;
    return m;
  }
  std::vector<std::size_t> first_place_, first_packet_;  // [member + 1]
};

/// Six exchanges; each sends a fixed list of items whenever its function is called.
template <class P>
class TileMessages {
 public:
  using R = typename P::Particle;

  /// Prepares the messages. Called once; the arrays must keep their addresses. `positions` must still be on the host.
  void make_ready(const DeviceTeam& team, const Layout& layout, const TeamCuts& cuts, const TilePlan& plan,
                  const TileOwners& owners, const TilePositions& positions, const Crossing& crossing,
                  const TileArrays<P>& scene, const SettledArrays<P>& settled, double* before, R* base, bool carried) {
    RankItems halo(team), constants(team), wall_rows(team), wall_bodies(team);
    for (std::size_t m = 0; m < team.size(); ++m) {
      for (std::size_t t = cuts.tile(m); t < cuts.tile(m + 1); ++t) {
        for (std::uint32_t h = 0; h < plan.tile[t].halo; ++h) {
          const auto place = static_cast<std::size_t>(plan.halo[plan.tile[t].first_halo + h]);
          halo.add(place, owners.of_place(place), m);
        }
      }
    }
    positions.for_each_slot(cuts, [&](std::size_t m, const uint2& place) {
      for (const std::uint32_t p : {place.x, place.y}) {
        if (p == UINT32_MAX) continue;
        const std::size_t reader = owners.of_contact(p);
        const std::size_t first = TileContactWords::first(p, TileContactWords::constants(carried));
        for (const auto& field : TileContactWords::settled_fields(carried))
          constants.add(first + 32 * static_cast<std::size_t>(field.word), m, reader);
      }
    });
    for (std::size_t i = 0; i < plan.contact.size(); ++i) {
      if (plan.contact[i].wall_contact != UINT32_MAX)
        wall_rows.add_for_all(plan.contact[i].wall_contact, owners.of_contact(i));
    }
    for (std::size_t w = 0; w < walls; ++w) wall_bodies.add_for_all(layout.particles() + w, team.size() - 1);

    even_.add(scene.even, 2, halo);
    odd_.add(scene.odd, 2, halo);
    now_.add(scene.motion.body.displacement, displacement_words, crossing.bodies);
    settled_.add(settled.records.words, record_words, crossing.records);
    settled_.add(settled.constant, 1, constants);
    before_.add(before, displacement_words, crossing.bodies);
    walls_.add(scene.wall_load, 2, wall_rows);
    walls_.add(base, velocity_words, wall_bodies);
    for (RankExchange* each : {&even_, &odd_, &now_, &settled_, &before_, &walls_}) each->make_ready(team);
  }

  /// Sends the velocities of step k of halo particles.
  void velocities(const DeviceTeam& team, std::uint32_t k) const { (k & 1 ? odd_ : even_).queue(team); }
  /// Sends the current displacements of bodies whose contacts another rank updates.
  void before_settling(const DeviceTeam& team) const { now_.queue(team); }
  /// Sends the load records and the constants of contacts that settle_contacts has written.
  void after_settling(const DeviceTeam& team) const { settled_.queue(team); }
  /// Sends the displacements at the beginning of the new block of steps, for bodies whose contacts another rank
  /// updates.
  void after_base(const DeviceTeam& team) const { before_.queue(team); }
  /// Sends the loads on the walls and their base loads to all ranks.
  void wall_loads(const DeviceTeam& team) const { walls_.queue(team); }

 private:
  RankExchange even_, odd_, now_, settled_, before_, walls_;
};

}  // namespace macadam::kernels
