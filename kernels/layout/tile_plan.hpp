// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_plan.hpp  Plans the tile path: decides which thread block computes which contact, and where the block
/// stores the loads.
///
/// The tile path is the fast way to step condensed contacts on a GPU. A tile is a set of neighbouring particles (a tile
/// of the layout) that one thread block owns. The block computes every contact that touches one of its particles. A
/// contact between particles of two tiles is computed by both blocks, from the same numbers in the same order of
/// operations. So tiles exchange only velocities, not loads. ExecCudaTiles::plan() calls plan_tiles() once per network,
/// before the first step; the kernels read the plan through TileArrays (tile_step.hpp).
///
/// Reading order of the tile path: this file; contact_words.hpp (the words of a contact); tile_step.hpp (one step of
/// one contact, and the arrays); shared_memory_map.hpp, resident_kernel.hpp and resident_tile.hpp (the resident
/// kernel); halo_exchange.hpp (velocities between tiles); streamed_kernel.hpp (the kernel for larger scenes);
/// settle_kernels.hpp (updating viscoelastic states between blocks of steps); tile_blocks.hpp, tile_launch.hpp,
/// tile_data.hpp and exec_cuda_tiles.hpp (the host side).
///
/// docs/gpu-step.md explains the whole path, with a picture. Words of the tile path, as the identifiers use them:
/// - body: a particle or a wall, in the order of the layout.
/// - rank: index of a particle within its tile; particles with the most load cells come first.
/// - halo: the particles of other tiles that the contacts of a tile touch.
/// - place: the place of a body is first_body of its tile + its rank. A local number is an index in the tile's table of
///   velocities, which holds the tile's particles by rank, then the halo, then the six walls.
/// - tile position: the index of a contact in TilePlan::contact (packet · 32 + lane).
/// - packet: 32 contacts that a warp steps together. A lane is one of them, and the thread that steps it.
/// - couple: two contacts (or one) with the same end A. One thread steps them one after the other and adds up their
///   loads on A before it stores the sum. Couples are formed in the order in which the network numbers the contacts.
/// - double packet: two packets that hold the first and the second contacts of 32 couples.
/// - group, slot: as in the layout; a group holds the contacts of one pair type, and a slot is a position in it.
/// - load cell: six words in shared memory into which a couple or a contact stores its load on one particle of the
/// tile.
/// - load list: the load cells of one particle: first one for each couple whose end A it is, then one for each contact
///   whose end B it is. The particle sums them in this order, which does not depend on how particles are divided into
///   tiles.
/// - wall contact number: the number of a contact among all contacts at walls.
/// - share: the consecutive tiles that one GPU computes, if several GPUs step one specimen.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/layout/layout.hpp"

namespace macadam::kernels {

/// One tile; see the top of the file for the table of velocities.
struct Tile {
  std::uint32_t first_body, bodies;  ///< first place of its particles; number of particles
  std::uint32_t first_halo, halo;
  std::uint32_t first_packet, packets;
  std::uint32_t double_packets;  ///< Number of double packets. They come first; in the other packets every contact is a
                                 ///< couple of its own.
  std::uint32_t inner;           ///< Number of double packets that touch no particle of another tile. They come first.
  std::uint32_t long_lists;      ///< Number of particles with a long load list (see TilePlan::longest_short_list). They
                             ///< have the ranks 0 … long_lists − 1. The load cells of such a particle are stored one
                             ///< after another. The load cells of all other particles are stored as jagged diagonals:
                             ///< cell e of the particle of rank r has the index diagonal[e] + r.
  std::uint32_t cells;  ///< Total number of load cells of the tile (six words each, in shared memory).
};

/// One contact as one tile computes it.
struct TileContact {
  std::uint32_t group_slot = UINT32_MAX;    ///< slot in its group of the layout; UINT32_MAX: inert
  std::uint16_t local_a = 0, local_b = 0;   ///< local numbers of the two bodies
  std::uint16_t cell_a = 0, cell_b = 0;     ///< cells for the loads; no_cell if the body does not belong to the tile;
                                            ///< cell_a is more_of_couple for all contacts of a couple except the last
  std::uint32_t group = 0;                  ///< index of the layout's group
  std::uint32_t wall_contact = UINT32_MAX;  ///< number among the wall contacts, counted wall by wall in the order of
                                            ///< the network; UINT32_MAX: no wall contact
};

/// The plan of all tiles.
struct TilePlan {
  static constexpr std::uint32_t longest_short_list = 32;  ///< a list with more cells is long; a whole warp sums it
  static constexpr std::uint16_t no_cell = UINT16_MAX, more_of_couple = UINT16_MAX - 1;
  /// Largest number of contacts in a couple, and number of packets in a double packet.
  static constexpr std::uint32_t couple = 2;
  /// The first packet and the first place of a device's share are multiples of these, so that they begin at a memory
  /// page of 2 MiB.
  static constexpr std::size_t share_packets = 4096, share_places = 65536;
  std::vector<Tile> tile;
  std::vector<std::int32_t> body;   ///< [place] body; −1: unused place
  std::vector<std::uint32_t> list;  ///< [place][2] number of cells in the list; first cell of a long list
  /// [tile][longest_short_list]. Cell e of a particle of rank r ≥ long_lists is at diagonal[e] + r.
  std::vector<std::uint32_t> diagonal;
  std::vector<std::int32_t> halo;  ///< [first_halo + …] place of the halo particle in the tile that owns it
  /// Contacts in the order [packet][lane], 32 lanes per packet. If a couple has two contacts, they are in the same lane
  /// of the two packets of their double packet, so that one thread steps both.
  std::vector<TileContact> contact;
  std::vector<std::uint32_t> wall_begin;  ///< [wall + 1] first wall contact number of each wall
  /// Maxima over the tiles: particles, entries of the table of velocities, cells.
  std::uint32_t most_bodies = 0, most_locals = 0, most_cells = 0;
  std::size_t packets() const { return contact.size() / 32; }
  /// Whether all local numbers and cells fit 16 bits.
  bool fits = true;
};

/// Plans the tiles of a layout that has 32 lanes. `begins_share`: [tile] true for the first tile of each further
/// device.
TilePlan plan_tiles(const ContactNetwork& network, const Layout& layout, const std::vector<bool>& begins_share = {});

}  // namespace macadam::kernels
