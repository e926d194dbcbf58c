// SPDX-License-Identifier: GPL-3.0-or-later
/// \file layout.hpp  The private order in which a backend keeps particles and contacts.
///
/// Particles are ordered by recursive bisection, so that neighbours in space are neighbours in memory; a tile is a run
/// of particles whose contacts fit a core's cache. Contacts are grouped by pair type (one law a group), then by tile,
/// then by number of points, and cut into packets of `lanes`; the rest of a packet is filled with inert contacts.
/// Walls are bodies too: they follow the particles as N…N+5.
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
  std::vector<std::uint32_t> contact;      ///< slot → network contact, or `inert`; a multiple of lanes
  std::vector<std::uint32_t> points;       ///< [slot] of its contact; 0 where inert
  std::vector<std::uint32_t> tile_packet;  ///< tile → first packet; tiles + 1 entries
  std::vector<std::uint32_t> packet_row;   ///< packet → first row of points; packets + 1 entries
  std::size_t packets() const { return tile_packet.back(); }
};

/// The whole order. Bodies are particles in device order, then the six walls.
struct Layout {
  int lanes = 1;
  std::vector<std::int32_t> particle;   ///< body → specimen particle (particles only)
  std::vector<std::int32_t> body;       ///< specimen particle → body
  std::vector<std::int32_t> tile_body;  ///< tile → first body; tiles + 1 entries
  std::vector<GroupLayout> groups;

  std::size_t tiles() const { return tile_body.size() - 1; }
  std::size_t particles() const { return particle.size(); }
  /// Body of a contact's end, which may be a Wall.
  std::int32_t body_of(std::int32_t end) const {
    return end >= 0 ? body[static_cast<std::size_t>(end)] : static_cast<std::int32_t>(particles()) - 1 - end;
  }
};

/// Body → tile.
std::vector<std::int32_t> tiles_of(const Layout& layout);

/// The order of the particles alone, in tiles of equal numbers of them.
Layout make_order(const Specimen& specimen, std::size_t tiles);

/// What is aimed at in a tile.
struct TileSize {
  std::size_t contacts;  ///< those of the network over the number of tiles, about
  bool even;  ///< all tiles are to touch equally many contacts, as they wait for one another; takes a few rounds

  TileSize(std::size_t contact_count, bool evenly = false) : contacts(contact_count), even(evenly) {}
};

/// Orders a network.
Layout make_layout(const Specimen& specimen, const ContactNetwork& network, int lanes, const TileSize& size);

}  // namespace macadam::kernels
