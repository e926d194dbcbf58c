// SPDX-License-Identifier: GPL-3.0-or-later
/// \file traffic.hpp  Counts the bytes that one step over tiles moves through shared memory, the L2 cache and
/// global memory.
///
/// The counts follow from the plan (packets, cells and particles of each tile) and from where the kernels keep the
/// data; nothing is measured. TileLaunch::traffic_by_place() calls these functions for the report of a run.
/// docs/gpu-step.md explains the whole path.
#pragma once

#include <algorithm>
#include <vector>

#include "kernels/cuda/tiles/shared_memory_map.hpp"

namespace macadam::kernels {

/// Returns the number of packets whose states stay in registers; must agree with ResidentTile::packets_of_warp().
inline std::int64_t packets_in_registers(const Tile& tile) {
  constexpr std::uint32_t most = double_packets_in_registers * resident_threads / 32, couple = TilePlan::couple;
  const std::uint32_t doubles = std::min(tile.double_packets, most), ones = tile.packets - couple * tile.double_packets;
  return couple * doubles + std::min(ones, couple * (most - doubles));
}

/// Returns the bytes that a step moves through shared memory: the velocities of both ends of each contact (of end A
/// once per couple), and the loads.
inline std::int64_t shared_traffic(const Tile& tile) {
  constexpr std::int64_t of_velocity = SixTable::bytes(1), of_cell = 2 * SixTable::bytes(1);
  const std::int64_t contacts = 32 * std::int64_t{tile.packets};
  return of_velocity * (contacts + contacts / TilePlan::couple + tile.bodies + tile.halo) + of_cell * tile.cells;
}

/// Returns the traffic of streamed tiles. `all`: bytes that a step moves through global memory.
inline Traffic traffic_streamed(const std::vector<Tile>& tiles, std::int64_t all) {
  Traffic out{all, 0, 0};
  for (const Tile& tile : tiles) out.shared += shared_traffic(tile);
  return out;
}

/// Returns the traffic of resident tiles; nothing goes through global memory.
template <class P>
Traffic traffic_on_chip(const std::vector<Tile>& tiles, const TileArrays<P>& arrays, bool carried, bool memory) {
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
        {packets, first,
         ResidentMemory<P>(tile, static_cast<std::uint32_t>(words), arrays.storage, arrays.shared_bytes).cached});
    out.shared += shared_traffic(tile) + of_constants * cached;
    const std::int64_t kept = std::max<std::int64_t>(0, packets_in_registers(tile) - first);
    out.cache += of_constants * std::max<std::int64_t>(0, packets - cached - kept) +
                 of_states * (packets - packets_in_registers(tile)) + of_velocity * (tile.bodies + tile.halo);
    const auto body_data = static_cast<std::int64_t>(ResidentMemory<P>::body_bytes(tile.bodies, arrays.storage));
    (arrays.storage == BodyStorage::shared ? out.shared : out.cache) += body_data;
  }
  return out;
}

}  // namespace macadam::kernels
