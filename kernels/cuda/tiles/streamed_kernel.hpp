// SPDX-License-Identifier: GPL-3.0-or-later
/// \file streamed_kernel.hpp  Defines the streamed kernel, which takes one step per launch, for any number of
/// tiles.
///
/// TileLaunch uses this kernel if the tiles do not fit in registers and shared memory, and with several ranks. Two
/// tiles share a multiprocessor; the constants and states of contacts are read from global memory in every step.
/// begin_streamed moves the bodies before the first step of a sequence. Then each launch of run_streamed reads the
/// velocities of its step, steps all contacts of each tile, sums the loads, and moves the particles. There are two
/// arrays of velocities, for even and for odd steps; a launch reads one of them and writes the other. The last launch
/// of a sequence writes the loads instead of moving the particles. docs/gpu-step.md explains the whole path.
#pragma once

#include "kernels/cuda/tiles/tile_step.hpp"

namespace macadam::kernels {

/// Returns the array of the velocities of all bodies at step k. The index of a particle is its place (see
/// tile_plan.hpp); the walls come after the last place.
template <class P>
__device__ __forceinline__ float4* velocities_of(const TileArrays<P>& s, std::uint32_t k) {
  return reinterpret_cast<float4*>(s.exchange(k));
}
template <class P>
__device__ __forceinline__ float& wall_velocity_of(const TileArrays<P>& s, std::uint32_t k, int axis) {
  return reinterpret_cast<float*>(velocities_of(s, k) + 2 * (s.places + axis / 3))[axis % 3];
}

/// Moves body `i`, at place `place`, under `force` into step k, and stores its velocity for the contacts. k counts from
/// the beginning of the sequence.
template <class P>
__device__ __forceinline__ void move_body(const TileArrays<P>& s, std::size_t i, std::size_t place,
                                          const typename P::Particle (&force)[6], std::uint32_t k) {
  using R = typename P::Particle;
  const auto at = [&](int c) { return i * velocity_words + moving_word(c); };
  R x[6];
  for (int c = 0; c < 6; ++c)
    x[c] = s.motion.moved(s.motion.body.master[at(c)], force[c], s.motion.body.inverse[2 * i + c / 3]);
  for (int c = 0; c < 6; ++c) s.motion.displace(at(c), x[c]);
  float4* to = velocities_of(s, k) + 2 * place;
  to[0] = {float(x[0]), float(x[1]), float(x[2]), 0};
  to[1] = {float(x[3]), float(x[4]), float(x[5]), 0};
}

/// Moves the particles at places first … end − 1 and the walls into step k, by the loads in memory: the beginning of a
/// sequence of steps. Axes of walls at rest get velocity zero in the arrays of even and of odd steps.
template <class P>
__global__ void begin_streamed(const __grid_constant__ TileArrays<P> s, std::uint32_t k, std::uint32_t first,
                               std::uint32_t end) {
  using R = typename P::Particle;
  const std::uint32_t place = first + blockIdx.x * blockDim.x + threadIdx.x;
  const int axis = s.moves_walls ? static_cast<int>(place - first) : -1;
  WallAxisMotion<P> wall(s, axis, k);
  if (wall.moves) {
    wall.move(s, k, k + 1);
    wall_velocity_of(s, k, axis) = static_cast<float>(wall.v);
  } else if (axis >= 0 && axis < wall_axes) {
    wall_velocity_of(s, k, axis) = wall_velocity_of(s, k + 1, axis) = 0;
  }
  if (place >= end) return;
  const auto i = static_cast<std::size_t>(s.body[place]);
  R force[6];
  for (int c = 0; c < 6; ++c) force[c] = s.force[i * velocity_words + moving_word(c)];
  move_body(s, i, place, force, k);
}

/// Layout of the shared memory of run_streamed: the table of velocities, then the cells [byte].
struct StreamedMemory {
  std::uint32_t cells, total;
  __host__ __device__ StreamedMemory(std::uint32_t locals, std::uint32_t cell_count)
      : cells((SixTable::bytes(locals) + 15) / 16 * 16), total(cells + SixTable::bytes(cell_count)) {}
};

/// Steps the contacts in step k. Then moves the particles into step k + 1 or, if `last`, writes the loads. `memory`:
/// some law has a memory. `series`: some contact has rock in series; `carried` and `memory` are then true.
template <class P, int Threads, int Blocks, bool carried, bool memory, bool series = false>
__global__ void __launch_bounds__(Threads, Blocks)
    run_streamed(const __grid_constant__ TileArrays<P> s, std::uint32_t k, bool last) {
  using R = typename P::Particle;
  extern __shared__ __align__(16) unsigned char shared[];
  const StreamedMemory m(s.most_locals, s.most_cells);
  const TileVelocities velocity{SixTable::at(shared, s.most_locals)};
  const LoadCells cells{SixTable::at(shared + m.cells, s.most_cells)};
  const unsigned tid = threadIdx.x, lane = tid % 32, warp = tid / 32;
  constexpr unsigned warps = Threads / 32;
  constexpr std::uint32_t words = TileContactWords::constants(carried);
  const Tile tile = s.tile[s.own_tile()];
  const float4* from = velocities_of(s, k);
  // the last threads of the first tile move the walls; with several ranks, each rank moves its copy of the walls
  const int axis = !last && s.moves_walls && blockIdx.x == 0 ? static_cast<int>(tid) - (Threads - wall_axes) : -1;
  WallAxisMotion<P> wall(s, axis, k + 1);
  for (std::uint32_t r = tid; r < 2 * tile.bodies; r += Threads)
    velocity.set_half(r / 2, r % 2 == 1, from[2 * static_cast<std::size_t>(tile.first_body) + r]);
  for (std::uint32_t h = tid; h < 2 * tile.halo; h += Threads) {
    velocity.set_half(tile.bodies + h / 2, h % 2 == 1,
                      from[2 * static_cast<std::size_t>(s.halo[tile.first_halo + h / 2]) + h % 2]);
  }
  if (tid < walls) {
    const std::uint32_t at = tile.bodies + tile.halo + tid;
    velocity.set_half(at, false, from[2 * (s.places + tid)]);
    velocity.set_half(at, true, {0, 0, 0, 0});
  }
  __syncthreads();
  if (wall.moves) {
    wall.move(s, k + 1, k + 2);
    wall_velocity_of(s, k + 1, axis) = static_cast<float>(wall.v);
  }
  const auto mine = WarpPackets::of(tile, 0, TilePlan::couple * tile.double_packets, warp, warps, warps);
  ContactCouple couple;
#pragma unroll 4
  for (std::uint32_t packet = 0; packet < mine.count(); ++packet) {
    const std::size_t at = tile.first_packet + mine[packet];
    float4* state = s.state + at * TileContactWords::states * 32 + lane;
    float change[6], sum[6];
    TileContactWords::state_before<memory>(s.begins_block && k == 0, state, change, sum);
    ContactConstants<carried, memory> constant;
    constant.load(s.constant + at * words * 32 + lane);
    const ContactInBlock<carried, memory> contact(constant);
    const auto load = step_in_block<false, series>(contact, s.law, velocity, change, sum, couple);
    TileContactWords::write_state<memory>(state, change, sum);
    cells.put(contact.cells, load, couple);
    if (last) store_wall_load(s.wall_load, contact.of, load);
  }
  __syncthreads();
  sum_lists(tile, s.list + tile.first_body, s.diagonal + s.own_tile() * TilePlan::longest_short_list, cells,
            [&](std::uint32_t r, const float(&extra)[6]) {
              const std::size_t place = tile.first_body + r;
              const auto i = static_cast<std::size_t>(s.body[place]);
              R force[6];
              for (int c = 0; c < 6; ++c) {
                force[c] = s.base[i * velocity_words + moving_word(c)] + static_cast<R>(extra[c]);
                if (last) s.force[i * velocity_words + moving_word(c)] = force[c];
              }
              if (!last) move_body(s, i, place, force, k + 1);
            });
}

}  // namespace macadam::kernels
