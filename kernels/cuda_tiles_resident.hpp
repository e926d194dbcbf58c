// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_tiles_resident.hpp  Many steps in one launch, where every tile has a multiprocessor of its own.
#pragma once

#include "kernels/cuda_tile_exchange.hpp"
#include "kernels/cuda_tile_scene.hpp"

namespace macadam::kernels {

/// Places in shared memory; `total` bytes in all.
template <class P>
struct ResidentMemory {
  using R = typename P::Particle;
  std::uint32_t velocity, spin, slots, own, rest, halo, diagonal, row, law, cache, total;

  /// Base loads, displacements, Δt/m and Δt/I: in memory where there is no room for them.
  __host__ __device__ static constexpr std::uint32_t rest_bytes(std::uint32_t bodies) {
    return bodies * static_cast<std::uint32_t>(6 * sizeof(double) + 8 * sizeof(R));
  }

  __host__ __device__ ResidentMemory(std::uint32_t bodies, std::uint32_t halo_count, std::uint32_t locals,
                                     std::uint32_t slot_count, std::uint32_t cached_packets, bool carried, bool roomy) {
    std::uint32_t at = 0;
    const auto take = [&](std::uint32_t bytes) {
      const std::uint32_t here = at;
      at += (bytes + 15) / 16 * 16;
      return here;
    };
    velocity = take(16 * locals);
    spin = take(16 * locals);
    law = take(16 * pair_types);
    cache = take(cached_packets * static_cast<std::uint32_t>(tile_constants(carried)) * 512);
    slots = take(24 * slot_count);
    own = take(6 * sizeof(R) * bodies);
    rest = take(roomy ? rest_bytes(bodies) : 0);
    halo = take(4 * halo_count);
    diagonal = take(4 * TilePlan::longest_short_row);
    row = take(8 * bodies);
    total = at;
  }
};

/// Takes `steps` steps from tag `first_tag` on. Resident: packets of a warp whose states stay in registers.
template <class P, int Resident, int Threads, bool carried>
__global__ void __launch_bounds__(Threads, 1)
    run_resident(const __grid_constant__ TileScene<P> s, std::uint32_t steps, std::uint32_t first_tag) {
  using R = typename P::Particle;
  extern __shared__ __align__(16) unsigned char shared[];
  const ResidentMemory<P> m(s.most_bodies, s.most_halo, s.most_locals, s.most_slots, s.cached_packets, carried,
                            s.rest == nullptr);
  auto* v = reinterpret_cast<float4*>(shared + m.velocity);
  auto* w = reinterpret_cast<float4*>(shared + m.spin);
  auto* own = reinterpret_cast<R*>(shared + m.own);
  auto* displacement = reinterpret_cast<double*>(
      s.rest ? s.rest + std::size_t{blockIdx.x} * ResidentMemory<P>::rest_bytes(s.most_bodies) : shared + m.rest);
  auto* base = reinterpret_cast<R*>(displacement + 6 * s.most_bodies);
  auto* inverse = base + 6 * s.most_bodies;
  auto* halo = reinterpret_cast<std::int32_t*>(shared + m.halo);
  auto* diagonal = reinterpret_cast<std::uint32_t*>(shared + m.diagonal);
  auto* row = reinterpret_cast<uint2*>(shared + m.row);
  auto* law = reinterpret_cast<float4*>(shared + m.law);
  auto* cache = reinterpret_cast<float4*>(shared + m.cache);
  const TileSlots slots{reinterpret_cast<float2*>(shared + m.slots), s.most_slots};
  constexpr std::uint32_t words = tile_constants(carried);
  const unsigned tid = threadIdx.x, lane = tid % 32, warp = tid / 32;
  constexpr unsigned warps = Threads / 32;
  const Tile tile = s.tile[blockIdx.x];
  const std::uint32_t locals = tile.bodies + tile.halo + walls, stride = s.most_bodies;
  const std::int32_t* body = s.body + tile.first_body;

  for (std::uint32_t r = tid; r < tile.bodies; r += Threads) {
    const auto i = static_cast<std::size_t>(body[r]);
    for (int c = 0; c < 6; ++c) {
      own[c * stride + r] = s.motion.body.master[i * velocity_words + moving_word(c)];
      base[c * stride + r] = s.base[i * velocity_words + moving_word(c)];
      displacement[c * stride + r] = s.motion.body.displacement[i * displacement_words + moving_word(c)];
    }
    for (int c = 0; c < 2; ++c) inverse[c * stride + r] = s.motion.body.inverse[2 * i + c];
    row[r] = s.row[tile.first_body + r];
  }
  for (std::uint32_t h = tid; h < tile.halo; h += Threads) halo[h] = s.halo[tile.first_halo + h];
  for (std::uint32_t e = tid; e < TilePlan::longest_short_row; e += Threads)
    diagonal[e] = s.diagonal[blockIdx.x * TilePlan::longest_short_row + e];
  if (tid < pair_types) law[tid] = s.law[tid];
  if (tid < walls) v[locals - walls + tid] = w[locals - walls + tid] = {0, 0, 0, 0};
  const float4* constants = s.constant + static_cast<std::size_t>(tile.first_packet) * words * 32;
  const std::uint32_t cached = min(s.cached_packets, tile.packets);
  for (std::uint32_t i = tid; i < cached * words * 32; i += Threads) cache[i] = constants[i];
  float4* states = s.state + static_cast<std::size_t>(tile.first_packet) * tile_states * 32;
  float change[Resident > 0 ? Resident : 1][6], sum[Resident > 0 ? Resident : 1][6];
#pragma unroll
  for (int j = 0; j < Resident; ++j) {
    const std::uint32_t packet = warp + j * warps;
    if (packet < tile.packets) load_state(states + packet * tile_states * 32 + lane, change[j], sum[j]);
  }

  // A thread's last body is displaced while the thread waits for the neighbours: by then its velocity is on its way.
  constexpr std::uint32_t nobody = UINT32_MAX;
  std::uint32_t moved = nobody;
  R x[6];
  const auto displace = [&] {
    if (moved == nobody) return;
    for (int c = 0; c < 6; ++c) displacement[c * stride + moved] += s.motion.dt * x[c];
    moved = nobody;
  };
  const auto move = [&](std::uint32_t r, const R(&force)[6], std::uint32_t tag) {
    displace();
    moved = r;
    for (int c = 0; c < 6; ++c) {
      x[c] = s.motion.moved(own[c * stride + r], force[c], inverse[c / 3 * stride + r]);
      own[c * stride + r] = x[c];
    }
    const float y[6] = {float(x[0]), float(x[1]), float(x[2]), float(x[3]), float(x[4]), float(x[5])};
    put_velocity(s.exchange + 2 * (static_cast<std::size_t>(tag & 1) * s.bodies + tile.first_body + r), y, tag);
    v[r] = {y[0], y[1], y[2], 0};
    w[r] = {y[3], y[4], y[5], 0};
  };
  const auto receive = [&](std::uint32_t tag) {
    const ulonglong2* from = s.exchange + 2 * static_cast<std::size_t>(tag & 1) * s.bodies;
    wait_for_words(
        tid, Threads, 2 * tile.halo, tag,
        [&](std::uint32_t h) { return from + 2 * static_cast<std::size_t>(halo[h / 2]) + h % 2; }, displace,
        [&](std::uint32_t h, const float4& numbers) { (h % 2 ? w : v)[tile.bodies + h / 2] = numbers; });
  };

  const int wall = static_cast<int>(tid) - (Threads - walls);
  const bool drives_wall = wall >= 0 && s.motion.wall.moves(wall);
  __syncthreads();
  for (std::uint32_t k = 0; k < steps; ++k) {
    const std::uint32_t tag = first_tag + k;
    const bool last = k + 1 == steps;
    float4 of_wall;
    if (drives_wall) of_wall = wall_velocity(s, wall, k);  // asked for early: it comes while loads are summed
    if (k == 0) {
      for (std::uint32_t r = tid; r < tile.bodies; r += Threads) {
        R force[6];
        for (int c = 0; c < 6; ++c)
          force[c] = s.force[static_cast<std::size_t>(body[r]) * velocity_words + moving_word(c)];
        move(r, force, tag);
      }
    } else {
      sum_rows(tile, row, diagonal, slots, [&](std::uint32_t r, const float(&extra)[6]) {
        R force[6];
        for (int c = 0; c < 6; ++c) force[c] = base[c * stride + r] + static_cast<R>(extra[c]);
        move(r, force, tag);
      });
    }
    if (drives_wall) v[locals - walls + wall] = of_wall;
    receive(tag);
    __syncthreads();
    const auto step = [&](std::uint32_t packet, float(&df)[6], float(&both)[6]) {
      const float4* constant = packet < cached ? cache + packet * words * 32 + lane
                                               : constants + static_cast<std::size_t>(packet) * words * 32 + lane;
      std::uint32_t places, group;
      const auto load = step_in_block<carried>(constant, law, v, w, df, both, places, group);
      slots.put(places, load);
      if (last) store_wall_load(s.wall_load, group, load);
    };
#pragma unroll
    for (int j = 0; j < Resident; ++j) {
      const std::uint32_t packet = warp + j * warps;
      if (packet < tile.packets) step(packet, change[j], sum[j]);
    }
    for (std::uint32_t j = Resident; j < (tile.packets + warps - 1) / warps; ++j) {
      const std::uint32_t packet = warp + j * warps;
      if (packet >= tile.packets) continue;
      float df[6], both[6];
      float4* at = states + static_cast<std::size_t>(packet) * tile_states * 32 + lane;
      load_state(at, df, both);
      step(packet, df, both);
      store_state(at, df, both);
    }
    __syncthreads();
  }

#pragma unroll
  for (int j = 0; j < Resident; ++j) {
    const std::uint32_t packet = warp + j * warps;
    if (packet < tile.packets) store_state(states + packet * tile_states * 32 + lane, change[j], sum[j]);
  }
  sum_rows(tile, row, diagonal, slots, [&](std::uint32_t r, const float(&extra)[6]) {
    const auto i = static_cast<std::size_t>(body[r]);
    for (int c = 0; c < 6; ++c) {
      s.force[i * velocity_words + moving_word(c)] = base[c * stride + r] + static_cast<R>(extra[c]);
      s.motion.body.master[i * velocity_words + moving_word(c)] = own[c * stride + r];
      s.motion.body.displacement[i * displacement_words + moving_word(c)] = displacement[c * stride + r];
    }
  });
  if (blockIdx.x == 0 && tid < WallMotion::axes && s.motion.wall.moves(tid / 3))
    move_wall(s, tid / 3, tid % 3, 0, steps);
}

}  // namespace macadam::kernels
