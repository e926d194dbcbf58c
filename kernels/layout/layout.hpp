// SPDX-License-Identifier: GPL-3.0-or-later
/// \file layout.hpp  Defines the order in which the CPU and CUDA backends store particles and contacts. It is never
/// visible outside a backend.
///
/// Particles are ordered by recursive bisection, so that neighbours in space are neighbours in memory. A tile is a
/// range of particles whose contacts fit the cache of one core or, on the tile path of the GPU, the memory of one
/// multiprocessor (see tile_plan.hpp).
///
/// Contacts are sorted by pair type, then by tile, then by number of contact points. The contacts of one pair type are
/// a group; all of them have the same law. A group is cut into packets of `lanes` contacts, which a SIMD register or a
/// warp steps together. A slot is the position of a contact in its group. Slots that fill up a tile's last packet are
/// inert: they hold no contact.
///
/// A body is a particle or a wall, numbered in this order. The six walls follow the N particles as bodies N…N+5.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/specimen.hpp"

namespace macadam::kernels {

inline constexpr int walls = wall_count;
inline constexpr std::uint32_t inert = UINT32_MAX;

/// Contacts of one pair type in device order.
struct GroupLayout {
  PairType pair = PairType::mm;
  std::vector<std::uint32_t> contact;      ///< slot → network contact, or `inert`; the size is a multiple of `lanes`
  std::vector<std::uint32_t> points;       ///< [slot] number of contact points of the contact; 0 where inert
  std::vector<std::uint32_t> tile_packet;  ///< tile → first packet; tiles + 1 entries
  /// Packet → first layer of contact points (one point of each lane); packets + 1 entries.
  std::vector<std::uint32_t> packet_layer;
  bool series = false;  ///< whether any contact has rock in series (Contact::series)
  std::size_t packets() const { return tile_packet.back(); }
};

/// The order of all particles and contacts. Bodies are the particles in device order, then the six walls.
struct Layout {
  int lanes = 1;
  std::vector<std::int32_t> particle;   ///< body → specimen particle (particles only)
  std::vector<std::int32_t> body;       ///< specimen particle → body
  std::vector<std::int32_t> tile_body;  ///< tile → first body; tiles + 1 entries
  std::vector<GroupLayout> groups;

  std::size_t tiles() const { return tile_body.size() - 1; }
  std::size_t particles() const { return particle.size(); }
  /// Returns the body at one end of a contact. `end` is a particle or, if negative, a wall.
  std::int32_t body_of(std::int32_t end) const {
    return end >= 0 ? body[static_cast<std::size_t>(end)] : static_cast<std::int32_t>(particles()) - 1 - end;
  }
};

/// Returns the tile of each particle: body → tile. Walls belong to no tile.
std::vector<std::int32_t> tiles_of(const Layout& layout);

/// Orders the particles only, without contacts, into `tiles` tiles with equal numbers of particles.
Layout make_order(const Specimen& specimen, std::size_t tiles);

/// Target size of the tiles.
struct TileSize {
  std::size_t contacts;  ///< contacts per tile: the number of tiles is the network's contacts divided by this
  bool even;  ///< gives all tiles about the same number of contacts, because tiles wait for one another; bisects four
              ///< times

  TileSize(std::size_t contact_count, bool evenly = false) : contacts(contact_count), even(evenly) {}
};

/// Orders the particles and contacts of a network. `lanes`: contacts per packet.
Layout make_layout(const Specimen& specimen, const ContactNetwork& network, int lanes, const TileSize& size);

}  // namespace macadam::kernels
