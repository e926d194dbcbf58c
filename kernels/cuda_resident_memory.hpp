// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_resident_memory.hpp  What a tile has in the shared memory of its multiprocessor, and where.
#pragma once

#include <cmath>
#include <vector>

#include "kernels/cuda_tile_scene.hpp"

namespace macadam::kernels {

inline constexpr std::uint32_t resident_threads = 512;  ///< all registers: a contact's state takes twelve
/// A warp keeps the states of so many groups of packets in registers: one that it steps before the velocities of other
/// tiles are there, and one after that.
inline constexpr std::uint32_t groups_in_registers = 2;
/// Of a tile, whose states are in registers, at the most.
inline constexpr std::uint32_t contacts_in_registers = groups_in_registers * TilePlan::run * resident_threads;
inline constexpr std::uint32_t packets_with_states = contacts_in_registers / 32;
/// Packets of a warp whose constants stay in registers besides: the last of those with states. `memory`: some law has
/// one, whose sums then leave no room.
__host__ __device__ constexpr std::uint32_t packets_with_constants(bool memory) { return memory ? 0 : 2; }

/// Six numbers of a body, or two, as threads read and write them: neighbours in other banks of shared memory.
template <class R>
struct alignas(2 * sizeof(R)) Six {
  R of[6];
};
template <class R>
struct alignas(2 * sizeof(R)) Two {
  R linear, angular;
};

/// Places in the shared memory that a tile has; `total` bytes in all, of which the last are packets of constants, as
/// many as there is room for.
template <class P>
struct ResidentMemory {
  using R = typename P::Particle;
  std::uint32_t velocity, slots, own, rest, halo, diagonal, row, law, others, cache, total;
  std::uint32_t cached;  ///< packets

  /// Displacements, base loads, Δt/m and Δt/I, and then velocities in full precision: in memory where there is no room.
  __host__ __device__ static constexpr std::uint32_t rest_bytes(std::uint32_t bodies, TileRest rest) {
    const auto numbers = rest == TileRest::all_away ? 14u : 8u;
    return bodies * static_cast<std::uint32_t>(6 * sizeof(double) + numbers * sizeof(R));
  }
  __host__ __device__ static constexpr std::uint32_t packet_bytes(std::uint32_t constants) {
    return constants * 32 * sizeof(float4);
  }

  /// `room`: bytes that there are; no packets have constants here where that is less than the rest needs.
  __host__ __device__ ResidentMemory(const Tile& tile, std::uint32_t constants, TileRest where, std::uint32_t room) {
    std::uint32_t at = 0;
    const auto take = [&](std::uint32_t bytes) {
      const std::uint32_t here = at;
      at += (bytes + 15) / 16 * 16;
      return here;
    };
    const std::uint32_t locals = tile.bodies + tile.halo + walls;
    velocity = take(SixTable::bytes(locals));
    law = take(16 * pair_types);
    slots = take(SixTable::bytes(tile.slots));
    own = take(where == TileRest::all_away ? 0 : tile.bodies * static_cast<std::uint32_t>(sizeof(Six<R>)));
    rest = take(where == TileRest::here ? rest_bytes(tile.bodies, where) : 0);
    halo = take(4 * tile.halo);
    diagonal = take(4 * TilePlan::longest_short_row);
    row = take(8 * tile.bodies);
    others = take(static_cast<std::uint32_t>(sizeof(WarpPackets)) * resident_threads / 32);
    cache = at;
    cached = room < at ? 0 : (room - at) / packet_bytes(constants);
    if (cached > packets_with_states) cached = packets_with_states;
    total = at + cached * packet_bytes(constants);
  }
};

/// Shared memory that the fullest of `tiles` equal tiles of a network is expected to need at the least.
template <class P>
std::size_t expected_resident_bytes(const ContactNetwork& network, std::size_t tiles) {
  std::vector<std::uint32_t> of_end_a(network.row_begin.size() - 1, 0);
  std::size_t slots = 0;  // of runs, and of ends B
  for (const Contact& c : network.contacts) {
    slots += (of_end_a[static_cast<std::size_t>(c.a)]++ % TilePlan::run == 0) + (c.b >= 0);
  }
  const double fullest = 1.06;  // some tiles have a few hundredths more than the mean
  const double bodies = fullest * static_cast<double>(of_end_a.size()) / static_cast<double>(tiles);
  const double halo = std::pow(std::cbrt(bodies) + 1.8, 3) - bodies;  // a layer of nine tenths of a body about a cube
  const auto whole = [](double x) { return static_cast<std::uint32_t>(x); };
  Tile tile{};
  tile.bodies = whole(bodies);
  tile.halo = whole(halo);
  tile.slots = whole(fullest * static_cast<double>(slots) / static_cast<double>(tiles));
  return ResidentMemory<P>(tile, tile_constants(false), TileRest::all_away, 0).total;
}

}  // namespace macadam::kernels
