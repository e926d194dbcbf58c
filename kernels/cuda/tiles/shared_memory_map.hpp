// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shared_memory_map.hpp  Divides the shared memory and the registers of a multiprocessor for the resident
/// kernel (resident_kernel.hpp).
///
/// ResidentMemory computes the position of each array in a tile's shared memory. The host (fit_tiles()) uses it to
/// decide whether a tile fits in shared memory, and the kernel uses it to find the arrays. The remaining shared memory
/// holds constants of packets (the cache). expected_resident_bytes() estimates the size of shared memory that a tile
/// needs, before the tiles exist, so that ExecCudaTiles can choose their size. docs/gpu-step.md explains the whole
/// path.
#pragma once

#include <cmath>
#include <vector>

#include "kernels/cuda/device/tuning.hpp"
#include "kernels/cuda/tiles/tile_step.hpp"

namespace macadam::kernels {

/// Largest number of contacts of one tile whose states fit in registers.
inline constexpr std::uint32_t contacts_in_registers =
    double_packets_in_registers * TilePlan::couple * resident_threads;
inline constexpr std::uint32_t packets_with_states = contacts_in_registers / 32;

/// Six or two numbers of a body, aligned so that threads with neighbouring bodies access different banks of shared
/// memory.
template <class R>
struct alignas(2 * sizeof(R)) Six {
  R of[6];
};
template <class R>
struct alignas(2 * sizeof(R)) Two {
  R linear, angular;
};

/// Positions of the arrays in the shared memory of a tile [byte]. `total` is the size of all arrays. The last array,
/// the cache, holds the constants of all packets that fit.
template <class P>
struct ResidentMemory {
  using R = typename P::Particle;
  std::uint32_t velocity, cells, full_velocity, body_data, halo, diagonal, list, law, spilled, cache, total;
  std::uint32_t cached;  ///< number of packets in the cache

  /// Returns the size of a tile's particle data: displacements, base loads, Δt/m and Δt/I and, with
  /// BodyStorage::global, the velocities in full precision. The data is in global memory if it does not fit in shared
  /// memory.
  __host__ __device__ static constexpr std::uint32_t body_bytes(std::uint32_t bodies, BodyStorage storage) {
    const auto numbers = storage == BodyStorage::global ? 14u : 8u;
    return bodies * static_cast<std::uint32_t>(6 * sizeof(double) + numbers * sizeof(R));
  }
  __host__ __device__ static constexpr std::uint32_t packet_bytes(std::uint32_t constants) {
    return constants * 32 * sizeof(float4);
  }

  /// `constants`: constant words per packet. `available`: bytes of shared memory available; if they do not suffice for
  /// the other arrays, the cache is empty.
  __host__ __device__ ResidentMemory(const Tile& tile, std::uint32_t constants, BodyStorage storage,
                                     std::uint32_t available) {
    std::uint32_t at = 0;
    const auto take = [&](std::uint32_t bytes) {
      const std::uint32_t here = at;
      at += (bytes + 15) / 16 * 16;
      return here;
    };
    const std::uint32_t locals = tile.bodies + tile.halo + walls;
    velocity = take(SixTable::bytes(locals));
    law = take(16 * pair_types);
    cells = take(SixTable::bytes(tile.cells));
    full_velocity = take(storage == BodyStorage::global ? 0 : tile.bodies * static_cast<std::uint32_t>(sizeof(Six<R>)));
    body_data = take(storage == BodyStorage::shared ? body_bytes(tile.bodies, storage) : 0);
    halo = take(4 * tile.halo);
    diagonal = take(4 * TilePlan::longest_short_list);
    list = take(8 * tile.bodies);
    spilled = take(static_cast<std::uint32_t>(sizeof(WarpPackets)) * resident_threads / 32);
    cache = at;
    cached = available < at ? 0 : (available - at) / packet_bytes(constants);
    if (cached > packets_with_states) cached = packets_with_states;
    total = at + cached * packet_bytes(constants);
  }
};

/// Returns the shared memory that the fullest of `tiles` equal tiles of a network will need at least [byte], estimated
/// before the tiles are made.
template <class P>
std::size_t expected_resident_bytes(const ContactNetwork& network, std::size_t tiles) {
  std::vector<std::uint32_t> of_end_a(network.row_begin.size() - 1, 0);
  std::size_t cells = 0;  // number of load cells: one per couple and one per end B
  for (const Contact& c : network.contacts) {
    cells += (of_end_a[static_cast<std::size_t>(c.a)]++ % TilePlan::couple == 0) + (c.b >= 0);
  }
  const double bodies = fullest_tile * static_cast<double>(of_end_a.size()) / static_cast<double>(tiles);
  // Particles in a layer of 0.9 particle diameters around a cube of `bodies` particles
  const double halo = std::pow(std::cbrt(bodies) + 1.8, 3) - bodies;
  const auto whole = [](double x) { return static_cast<std::uint32_t>(x); };
  Tile tile{};
  tile.bodies = whole(bodies);
  tile.halo = whole(halo);
  tile.cells = whole(fullest_tile * static_cast<double>(cells) / static_cast<double>(tiles));
  return ResidentMemory<P>(tile, TileContactWords::constants(false), BodyStorage::global, 0).total;
}

}  // namespace macadam::kernels
