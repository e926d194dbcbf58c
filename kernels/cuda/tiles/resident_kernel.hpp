// SPDX-License-Identifier: GPL-3.0-or-later
/// \file resident_kernel.hpp  Defines the resident kernel, which takes many steps in one launch, with one tile per
/// multiprocessor.
///
/// run_resident is launched by TileLaunch with one thread block per tile; all of them run at the same time (a
/// cooperative launch). A thread block loads its tile into shared memory, takes the steps, and writes the tile back.
/// Particles, load cells and velocities stay in shared memory as far as they fit; each warp keeps the states of its
/// first packets in registers.
///
/// The order of one step is: sum the cells of each particle and move it; publish its velocity for other tiles
/// (halo_exchange.hpp); step the contacts that touch no halo particle while velocities are in transit; receive the
/// halo's velocities; step the other contacts, which store their loads into cells.
///
/// ResidentTile (resident_tile.hpp) has the parts of a step. docs/gpu-step.md explains the whole path.
#pragma once

#include "kernels/cuda/tiles/resident_tile.hpp"

namespace macadam::kernels {

/// Takes `steps` steps. The velocities of the first step have the tag `first_tag`. The states of the first packets of
/// each warp stay in registers. `series`: as in ResidentTile.
template <class P, int Threads, bool carried, bool memory, BodyStorage storage, bool series = false>
__global__ void __launch_bounds__(Threads, 1)
    run_resident(const __grid_constant__ TileArrays<P> s, std::uint32_t steps, std::uint32_t first_tag) {
  extern __shared__ __align__(16) unsigned char shared[];
  const Tile own_tile = s.tile[s.own_tile()];
  using OfTile = ResidentTile<P, Threads, carried, memory, storage, series>;
  const ResidentMemory<P> memory_map(own_tile, OfTile::words_read, storage, s.shared_bytes);
  OfTile tile(s, own_tile, shared, memory_map);
  const auto mine = tile.packets_of_warp();
  // the list of the warp's spilled packets is in shared memory, because registers are scarce
  auto& spilled = reinterpret_cast<WarpPackets*>(shared + memory_map.spilled)[threadIdx.x / 32];
  if (threadIdx.x % 32 == 0) spilled = mine.spilled;
  tile.load();
  constexpr std::uint32_t couple = TilePlan::couple;
  float change[double_packets_in_registers * couple][6], sum[double_packets_in_registers * couple][6];
  static_assert(couple == 2 && double_packets_in_registers == 2);
  // f(index of the state, packet); the indices are compile-time constants, so that the arrays stay in registers
  const auto each_of = [](const auto& packets, auto begin, auto&& f) {
    const auto one = [&](auto j) {
      if (j < packets.count()) f(std::integral_constant<std::uint32_t, begin() + j()>{}, packets.first() + j);
    };
    one(std::integral_constant<std::uint32_t, 0>{});
    one(std::integral_constant<std::uint32_t, 1>{});
  };
  constexpr std::integral_constant<std::uint32_t, 0> early{};
  constexpr std::integral_constant<std::uint32_t, couple> late{};
  const auto each_resident = [&](auto&& f) {
    each_of(mine.early, early, f);
    each_of(mine.late, late, f);
  };
  typename OfTile::Constants constants[double_packets_in_registers * couple];  // used from first_in_registers on
  each_resident([&](auto k, std::uint32_t packet) {
    TileContactWords::state_before<memory>(s.begins_block, tile.state(packet), change[k], sum[k]);
    if constexpr (k() >= OfTile::first_in_registers) constants[k] = tile.constants_of(packet, OfTile::in_memory);
  });

  const bool inner = tile.inner() > 0;
  const int wall = static_cast<int>(threadIdx.x) - (Threads - walls);
  const bool drives_wall = wall >= 0 && s.motion.wall.moves(wall);
  OfTile::wait_for_load();
  __syncthreads();
  for (std::uint32_t k = 0; k < steps; ++k) {
    const std::uint32_t tag = first_tag + k;
    Vec3<float> of_wall;
    if (drives_wall) of_wall = wall_velocity(s, wall, k);  // requested early, so that it arrives while loads are summed
    if (k == 0)
      tile.move_by_memory(tag);
    else
      tile.move_by_sums(tag);
    if (drives_wall) tile.set_wall(wall, of_wall);
    ContactCouple contacts;
    const auto step = [&](auto k, std::uint32_t packet) {
      constexpr bool begins_couple = k() % couple == 0;
      if constexpr (k() >= OfTile::first_in_registers)
        tile.template step<begins_couple>(constants[k], change[k], sum[k], contacts);
      else
        tile.template step<begins_couple>(tile.constants_of(packet, OfTile::place_in_cache(k)), change[k], sum[k],
                                          contacts);
    };
    if (inner) __syncthreads();
#pragma unroll 1
    for (int turn = 0; turn < 2; ++turn) {  // turn 0, while velocities are in transit: `early` packets that need no
                                            // other tile; turn 1: all other `early` packets
      if (mine.ahead == (turn == 0)) each_of(mine.early, early, step);
      if (turn > 0) break;
      if (inner) tile.displace();
      tile.receive(tag);
      __syncthreads();
      if (!inner) tile.displace();
    }
    each_of(mine.late, late, step);
#pragma unroll 1
    for (std::uint32_t k = 0; k < spilled.count(); ++k) {
      const std::uint32_t packet = spilled[k];
      float df[6], both[6];
      TileContactWords::state_before<memory>(s.begins_block && tag == first_tag, tile.state(packet), df, both);
      tile.template step<false>(tile.constants_of(packet, OfTile::in_memory), df, both, contacts);
      TileContactWords::write_state<memory>(tile.state(packet), df, both);
    }
    __syncthreads();
  }

  each_resident([&](auto k, std::uint32_t packet) {
    TileContactWords::write_state<memory>(tile.state(packet), change[k], sum[k]);
    tile.store_wall_loads(packet, change[k]);
  });
  for (std::uint32_t k = 0; k < spilled.count(); ++k) {
    float df[6], both[6];
    TileContactWords::read_state<memory>(tile.state(spilled[k]), df, both);
    tile.store_wall_loads(spilled[k], df);
  }
  tile.store();
  if (s.own_tile() == 0) {
    WallAxisMotion<P> axis(s, static_cast<int>(threadIdx.x), 0);
    if (axis.moves) axis.move(s, 0, steps);
  }
}

}  // namespace macadam::kernels
