// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_plan.hpp  Who computes what where a block of threads owns a box of particles (a tile of the layout).
///
/// A tile computes every contact that touches one of its particles: a contact across a box's face is computed by both
/// sides, from the same numbers in the same way, so only velocities cross.
///
/// The contacts whose end A a particle is are cut, in the order in which the network numbers them, into runs of two.
/// One thread steps a run and adds up its loads on that particle before it stores them. The particles of a tile are
/// ranked by the length of their rows of slots: a slot for each run, and then one for each contact whose end B they
/// are. A particle sums its slots in this order, which is the same for any tiles.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/layout.hpp"

namespace macadam::kernels {

/// A tile. Its table of velocities holds its own particles by rank, then the halo, then the six walls.
struct Tile {
  std::uint32_t first_body, bodies;  ///< first place
  std::uint32_t first_halo, halo;
  std::uint32_t first_packet, packets;
  std::uint32_t groups;     ///< of TilePlan::run packets, which come first; in the others, every contact is a run
  std::uint32_t inner;      ///< of the groups: the first, whose contacts touch no body of another tile
  std::uint32_t long_rows;  ///< the first ranks: their slots follow one another; of all others, slot e of rank r is at
                            ///< diagonal[e] + r
  std::uint32_t slots;
};

/// One contact as a tile computes it.
struct TileContact {
  std::uint32_t group_slot = UINT32_MAX;   ///< slot in its group; inert: UINT32_MAX
  std::uint16_t local_a = 0, local_b = 0;  ///< places in the table of velocities
  std::uint16_t slot_a = 0, slot_b = 0;  ///< of loads; no_slot where the body is not the tile's, more_of_run in slot_a
                                         ///< where the run goes on
  std::uint32_t group = 0;
  std::uint32_t wall_row = UINT32_MAX;  ///< number among the wall contacts: wall by wall, in order of their numbers
};

struct TilePlan {
  static constexpr std::uint32_t longest_short_row = 32;
  static constexpr std::uint16_t no_slot = UINT16_MAX, more_of_run = UINT16_MAX - 1;
  static constexpr std::uint32_t run = 2;  ///< contacts of a run at the most, and packets of a group
  /// Where another device's tiles begin, packets and places begin at a multiple of these: at a page of memory, 2 MiB.
  static constexpr std::size_t share_packets = 4096, share_places = 65536;
  std::vector<Tile> tile;
  std::vector<std::int32_t> body;       ///< [first_body + rank = place] body; −1 where there is none
  std::vector<std::uint32_t> row;       ///< [first_body + rank][2] slots of the row, first slot of a long row
  std::vector<std::uint32_t> diagonal;  ///< [tile][longest_short_row]
  std::vector<std::int32_t> halo;       ///< [first_halo + …] first_body + rank in its own tile
  std::vector<TileContact> contact;  ///< [packet][32]; a lane's contacts in the packets of a group follow one another
  std::vector<std::uint32_t> wall_begin;  ///< [wall + 1] of wall rows
  std::uint32_t most_bodies = 0, most_locals = 0, most_slots = 0;
  std::size_t packets() const { return contact.size() / 32; }
  /// Whether all local numbers fit their 16 bits.
  bool fits = true;
};

/// Plans the tiles of a layout with 32 lanes. `begins_share`: [tile] true where another device's tiles begin.
TilePlan plan_tiles(const ContactNetwork& network, const Layout& layout, const std::vector<bool>& begins_share = {});

}  // namespace macadam::kernels
