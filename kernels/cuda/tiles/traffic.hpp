// SPDX-License-Identifier: GPL-3.0-or-later
/// \file traffic.hpp  Counts the bytes that one step over tiles moves through shared memory, the L2 cache and
/// global memory.
///
/// The counts follow from the plan (packets, slots and particles of each tile) and from where the kernels keep the
/// data; nothing is measured. TileLaunch::traffic_by_place() calls these functions for the report of a run.
#pragma once

#include <algorithm>
#include <vector>

#include "kernels/cuda/tiles/shared_memory_map.hpp"

namespace macadam::kernels {

/// Returns the number of packets whose states stay in registers; must agree with ResidentTile::share().
inline std::int64_t packets_in_registers(const Tile& tile) {
  constexpr std::uint32_t most = double_packets_in_registers * resident_threads / 32, run = TilePlan::run;
  const std::uint32_t groups = std::min(tile.groups, most), ones = tile.packets - run * tile.groups;
  return run * groups + std::min(ones, run * (most - groups));
}

/// Returns the bytes through shared memory: velocities of both ends (end A once per run), and the loads.
inline std::int64_t shared_traffic(const Tile& tile) {
  constexpr std::int64_t of_velocity = SixTable::bytes(1), of_slot = 2 * SixTable::bytes(1);
  const std::int64_t contacts = 32 * std::int64_t{tile.packets};
  return of_velocity * (contacts + contacts / TilePlan::run + tile.bodies + tile.halo) + of_slot * tile.slots;
}

/// Returns the traffic of streamed tiles. `all`: bytes that a step moves through global memory.
inline Traffic traffic_streamed(const std::vector<Tile>& tiles, std::int64_t all) {
  Traffic out{all, 0, 0};
  for (const Tile& tile : tiles) out.shared += shared_traffic(tile);
  return out;
}

/// Returns the traffic of resident tiles; nothing goes through global memory.
template <class P>
Traffic traffic_on_chip(const std::vector<Tile>& tiles, const TileArrays<P>& scene, bool carried, bool memory) {
  constexpr std::int64_t of_packet = 32 * sizeof(float4), of_velocity = 32;
  const int words = TileContactWords::constants_read(carried, memory);
  const std::int64_t of_constants = of_packet * words,
                     of_states = 2 * of_packet * TileContactWords::states_moved(memory);
  // packets before `first` have their constants in shared memory, as far as they fit; the following ones have them in
  // registers
  const std::int64_t first = packets_with_states - packets_with_constants(memory) * resident_threads / 32;
  Traffic out;
  for (const Tile& tile : tiles) {
    const std::int64_t packets = tile.packets;
    const std::int64_t cached = std::min<std::int64_t>(
        {packets, first, ResidentMemory<P>(tile, static_cast<std::uint32_t>(words), scene.where, scene.room).cached});
    out.shared += shared_traffic(tile) + of_constants * cached;
    const std::int64_t kept = std::max<std::int64_t>(0, packets_in_registers(tile) - first);
    out.cache += of_constants * std::max<std::int64_t>(0, packets - cached - kept) +
                 of_states * (packets - packets_in_registers(tile)) + of_velocity * (tile.bodies + tile.halo);
    const auto rest = static_cast<std::int64_t>(ResidentMemory<P>::rest_bytes(tile.bodies, scene.where));
    (scene.where == BodyStorage::here ? out.shared : out.cache) += rest;
  }
  return out;
}

}  // namespace macadam::kernels
