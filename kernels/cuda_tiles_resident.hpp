// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_tiles_resident.hpp  Many steps in one launch, where every tile has a multiprocessor of its own.
#pragma once

#include <cmath>

#include "kernels/cuda_tile_exchange.hpp"
#include "kernels/cuda_tile_scene.hpp"

namespace macadam::kernels {

/// Places in shared memory; `total` bytes in all.
template <class P>
struct ResidentMemory {
  using R = typename P::Particle;
  std::uint32_t velocity, spin, slots, own, rest, halo, diagonal, row, law, cache, total;

  /// Displacements, base loads, Δt/m and Δt/I, and then velocities in full precision: in memory where there is no room.
  __host__ __device__ static constexpr std::uint32_t rest_bytes(std::uint32_t bodies, TileRest rest) {
    const auto numbers = rest == TileRest::all_away ? 14u : 8u;
    return bodies * static_cast<std::uint32_t>(6 * sizeof(double) + numbers * sizeof(R));
  }

  __host__ __device__ ResidentMemory(std::uint32_t bodies, std::uint32_t halo_count, std::uint32_t locals,
                                     std::uint32_t slot_count, std::uint32_t cached_packets, bool carried,
                                     TileRest where) {
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
    own = take(where == TileRest::all_away ? 0 : 6 * sizeof(R) * bodies);
    rest = take(where == TileRest::here ? rest_bytes(bodies, where) : 0);
    halo = take(4 * halo_count);
    diagonal = take(4 * TilePlan::longest_short_row);
    row = take(8 * bodies);
    total = at;
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
  const double fullest = 1.06;  // of equal tiles, some have a few hundredths more than the mean
  const double bodies = fullest * static_cast<double>(of_end_a.size()) / static_cast<double>(tiles);
  const double halo = std::pow(std::cbrt(bodies) + 1.8, 3) - bodies;  // a layer of nine tenths of a body about a cube
  const auto whole = [](double x) { return static_cast<std::uint32_t>(x); };
  return ResidentMemory<P>(whole(bodies), whole(halo), whole(bodies + halo) + walls,
                           whole(fullest * static_cast<double>(slots) / static_cast<double>(tiles)), 0, false,
                           TileRest::all_away)
      .total;
}

/// A tile in the shared memory of its block, and what the threads do with it in a step.
template <class P, int Threads, bool carried>
class ResidentTile {
 public:
  using R = typename P::Particle;
  static constexpr unsigned warps = Threads / 32;

  __device__ __forceinline__ ResidentTile(const TileScene<P>& scene, unsigned char* shared, const ResidentMemory<P>& m)
      : s(scene),
        tile(s.tile[s.own_tile()]),
        body(s.body + tile.first_body),
        v(reinterpret_cast<float4*>(shared + m.velocity)),
        w(reinterpret_cast<float4*>(shared + m.spin)),
        law(reinterpret_cast<float4*>(shared + m.law)),
        cache(reinterpret_cast<float4*>(shared + m.cache)),
        constants(s.constant + std::size_t{tile.first_packet} * words * 32),
        states(s.state + std::size_t{tile.first_packet} * tile_states * 32),
        slots{reinterpret_cast<float2*>(shared + m.slots), s.most_slots},
        displacement(reinterpret_cast<double*>(
            s.where == TileRest::here
                ? shared + m.rest
                : s.rest + std::size_t{blockIdx.x} * ResidentMemory<P>::rest_bytes(s.most_bodies, s.where))),
        base(reinterpret_cast<R*>(displacement + 6 * s.most_bodies)),
        inverse(base + 6 * s.most_bodies),
        own(s.where == TileRest::all_away ? inverse + 2 * s.most_bodies : reinterpret_cast<R*>(shared + m.own)),
        halo(reinterpret_cast<std::int32_t*>(shared + m.halo)),
        diagonal(reinterpret_cast<std::uint32_t*>(shared + m.diagonal)),
        row(reinterpret_cast<uint2*>(shared + m.row)),
        cached(min(s.cached_packets, tile.packets)),
        first_wall(tile.bodies + tile.halo) {}

  /// Whether contacts that need no other tile are stepped while velocities are on their way: worth another barrier
  /// where there is much to step.
  __device__ __forceinline__ bool overlaps() const { return tile.groups > warps; }
  /// The packets of this warp whose states stay in registers, one after the other: a group, or single packets where
  /// there are more warps than groups; and those whose states are in memory.
  struct Share {
    std::uint32_t first, count;
    bool inner;  ///< stepped before the velocities of other tiles are there
    WarpPackets others;
  };
  __device__ __forceinline__ Share share() const {
    constexpr std::uint32_t run = TilePlan::run;
    const std::uint32_t warp = threadIdx.x / 32, groups = min(tile.groups, warps), free = warps - groups;
    const std::uint32_t inner = overlaps() ? min(tile.inner, warps) : 0;
    const std::uint32_t ones = run * tile.groups;  // the first
    const std::uint32_t each = free == 0 ? 0 : min(run, (tile.packets - ones + free - 1) / free);
    const std::uint32_t first = warp < groups ? run * warp : min(ones + (warp - groups) * each, tile.packets);
    return {
        first, warp < groups ? run : min(each, tile.packets - first), warp < inner,
        WarpPackets::of(tile, groups, min(ones + free * each, tile.packets), warp, warps, overlaps() ? inner : warps)};
  }
  __device__ __forceinline__ float4* state(std::uint32_t packet) const {
    return states + std::size_t{packet} * tile_states * 32 + threadIdx.x % 32;
  }

  /// From memory: all but the states of the contacts.
  __device__ __forceinline__ void load() const {
    for (std::uint32_t r = threadIdx.x; r < tile.bodies; r += Threads) {
      const auto i = static_cast<std::size_t>(body[r]);
      for (int c = 0; c < 6; ++c) {
        own[c * stride() + r] = s.motion.body.master[i * velocity_words + moving_word(c)];
        base[c * stride() + r] = s.base[i * velocity_words + moving_word(c)];
        displacement[c * stride() + r] = s.motion.body.displacement[i * displacement_words + moving_word(c)];
      }
      for (int c = 0; c < 2; ++c) inverse[c * stride() + r] = s.motion.body.inverse[2 * i + c];
      row[r] = s.row[tile.first_body + r];
    }
    for (std::uint32_t h = threadIdx.x; h < tile.halo; h += Threads) halo[h] = s.halo[tile.first_halo + h];
    for (std::uint32_t e = threadIdx.x; e < TilePlan::longest_short_row; e += Threads)
      diagonal[e] = s.diagonal[s.own_tile() * TilePlan::longest_short_row + e];
    if (threadIdx.x < pair_types) law[threadIdx.x] = s.law[threadIdx.x];
    if (threadIdx.x < walls) v[first_wall + threadIdx.x] = w[first_wall + threadIdx.x] = {0, 0, 0, 0};
    for (std::uint32_t i = threadIdx.x; i < cached * words * 32; i += Threads) cache[i] = constants[i];
  }

  /// Moves all bodies by their loads in memory, or by those that the last contacts left in shared memory.
  __device__ __forceinline__ void move_by_memory(std::uint32_t tag) const {
    for (std::uint32_t r = threadIdx.x; r < tile.bodies; r += Threads) {
      R force[6];
      for (int c = 0; c < 6; ++c)
        force[c] = s.force[static_cast<std::size_t>(body[r]) * velocity_words + moving_word(c)];
      move(r, force, tag);
    }
  }
  __device__ __forceinline__ void move_by_sums(std::uint32_t tag) const {
    sum_rows(tile, row, diagonal, slots, [&](std::uint32_t r, const float(&extra)[6]) {
      R force[6];
      for (int c = 0; c < 6; ++c) force[c] = base[c * stride() + r] + static_cast<R>(extra[c]);
      move(r, force, tag);
    });
  }
  __device__ __forceinline__ void set_wall(int wall, const float4& velocity) const { v[first_wall + wall] = velocity; }

  /// Waits for the velocities of the bodies of other tiles.
  __device__ __forceinline__ void receive(std::uint32_t tag) const {
    const ulonglong2* from = s.exchange(tag);
    wait_for_words(
        threadIdx.x, Threads, 2 * tile.halo, tag,
        [&](std::uint32_t h) { return from + 2 * static_cast<std::size_t>(halo[h / 2]) + h % 2; },
        [&](std::uint32_t h, const float4& numbers) { (h % 2 ? w : v)[tile.bodies + h / 2] = numbers; });
  }
  /// Displaces all bodies by their velocities of now. The last warps begin, which have least to do.
  __device__ __forceinline__ void displace() const {
    for (std::uint32_t r = Threads - 1 - threadIdx.x; r < tile.bodies; r += Threads) {
      for (int c = 0; c < 6; ++c) {
        double& u = displacement[c * stride() + r];
        u = multiply_add(s.motion.dt, double(own[c * stride() + r]), u);
      }
    }
  }

  __device__ __forceinline__ void step(std::uint32_t packet, float (&change)[6], float (&sum)[6], ContactRun& run,
                                       bool last) const {
    const unsigned lane = threadIdx.x % 32;
    ContactConstants<carried> constant;
    if (packet < cached)  // one of the two, for the sake of loads that know where they load from
      constant.load(cache + packet * words * 32 + lane);
    else
      constant.load(constants + std::size_t{packet} * words * 32 + lane);
    EndPair places;
    GroupAndRow of;
    const auto load = step_in_block(constant, law, v, w, change, sum, places, of, run);
    slots.put(places, load, run);
    if (last) store_wall_load(s.wall_load, of, load);
  }

  /// To memory: the bodies, with their loads of now.
  __device__ __forceinline__ void store() const {
    sum_rows(tile, row, diagonal, slots, [&](std::uint32_t r, const float(&extra)[6]) {
      const auto i = static_cast<std::size_t>(body[r]);
      for (int c = 0; c < 6; ++c) {
        s.force[i * velocity_words + moving_word(c)] = base[c * stride() + r] + static_cast<R>(extra[c]);
        s.motion.body.master[i * velocity_words + moving_word(c)] = own[c * stride() + r];
        s.motion.body.displacement[i * displacement_words + moving_word(c)] = displacement[c * stride() + r];
      }
    });
  }

 private:
  static constexpr std::uint32_t words = tile_constants(carried);
  __device__ __forceinline__ std::uint32_t stride() const { return s.most_bodies; }
  __device__ __forceinline__ void move(std::uint32_t r, const R (&force)[6], std::uint32_t tag) const {
    R x[6];
    for (int c = 0; c < 6; ++c) {
      x[c] = s.motion.moved(own[c * stride() + r], force[c], inverse[c / 3 * stride() + r]);
      own[c * stride() + r] = x[c];
    }
    const float y[6] = {float(x[0]), float(x[1]), float(x[2]), float(x[3]), float(x[4]), float(x[5])};
    put_velocity(s.exchange(tag) + 2 * (static_cast<std::size_t>(tile.first_body) + r), y, tag);
    v[r] = {y[0], y[1], y[2], 0};
    w[r] = {y[3], y[4], y[5], 0};
  }

  const TileScene<P>& s;
  const Tile tile;
  const std::int32_t* body;
  float4 *v, *w, *law, *cache;
  const float4* constants;
  float4* states;
  const TileSlots slots;
  double* displacement;
  R *base, *inverse, *own;
  std::int32_t* halo;
  std::uint32_t* diagonal;
  uint2* row;
  const std::uint32_t cached, first_wall;
};

/// Takes `steps` steps from tag `first_tag` on. The states of a warp's first packets stay in registers.
template <class P, int Threads, bool carried>
__global__ void __launch_bounds__(Threads, 1)
    run_resident(const __grid_constant__ TileScene<P> s, const __grid_constant__ ResidentMemory<P> memory,
                 std::uint32_t steps, std::uint32_t first_tag) {
  extern __shared__ __align__(16) unsigned char shared[];
  using OfTile = ResidentTile<P, Threads, carried>;
  OfTile tile(s, shared, memory);
  const auto share = tile.share();
  tile.load();
  float change[TilePlan::run][6], sum[TilePlan::run][6];
  const auto each_resident = [&](auto&& f) {
#pragma unroll
    for (std::uint32_t j = 0; j < TilePlan::run; ++j) {
      if (j < share.count) f(share.first + j, change[j], sum[j]);
    }
  };
  each_resident([&](std::uint32_t packet, auto& df, auto& both) { load_state(tile.state(packet), df, both); });

  const int wall = static_cast<int>(threadIdx.x) - (Threads - walls);
  const bool drives_wall = wall >= 0 && s.motion.wall.moves(wall);
  __syncthreads();
  for (std::uint32_t k = 0; k < steps; ++k) {
    const std::uint32_t tag = first_tag + k;
    const bool last = k + 1 == steps;
    float4 of_wall;
    if (drives_wall) of_wall = wall_velocity(s, wall, k);  // asked for early: it comes while loads are summed
    if (k == 0)
      tile.move_by_memory(tag);
    else
      tile.move_by_sums(tag);
    if (drives_wall) tile.set_wall(wall, of_wall);
    ContactRun run;
    if (tile.overlaps()) __syncthreads();
#pragma unroll 1
    for (int turn = 0; turn < 2; ++turn) {  // what needs no other tile is done while their velocities are on their way
      if (share.inner == (turn == 0))
        each_resident([&](std::uint32_t packet, auto& df, auto& both) { tile.step(packet, df, both, run, last); });
      if (turn > 0) break;
      tile.receive(tag);
      __syncthreads();
      tile.displace();
    }
#pragma unroll 1
    for (std::uint32_t k = 0; k < share.others.count(); ++k) {
      const std::uint32_t packet = share.others[k];
      float df[6], both[6];
      load_state(tile.state(packet), df, both);
      tile.step(packet, df, both, run, last);
      store_state(tile.state(packet), df, both);
    }
    __syncthreads();
  }

  each_resident([&](std::uint32_t packet, auto& df, auto& both) { store_state(tile.state(packet), df, both); });
  tile.store();
  if (s.own_tile() == 0) {
    WallAxisMotion<P> axis(s, static_cast<int>(threadIdx.x), 0);
    if (axis.moves) axis.move(s, 0, steps);
  }
}

}  // namespace macadam::kernels
