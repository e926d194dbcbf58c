// SPDX-License-Identifier: GPL-3.0-or-later
/// \file resident_tile.hpp  Defines the parts of a step that the threads of one resident tile compute.
///
/// run_resident (resident_kernel.hpp) calls them in order. Words: tile, packet, couple, double packet, load cell, load
/// list and halo are explained in tile_plan.hpp and in docs/gpu-step.md. The packets `early` and `late` of a warp have
/// their states in registers, its packets `spilled` have them in memory. The cache is the part of shared memory
/// that holds constants of packets; `cached` is the number of packets in it.
#pragma once

#include <cuda_pipeline_primitives.h>

#include "kernels/cuda/tiles/halo_exchange.hpp"
#include "kernels/cuda/tiles/shared_memory_map.hpp"

namespace macadam::kernels {

/// One tile, and the parts of a step that its threads compute. All data of a body is read before any of it is written.
/// Otherwise each read would wait for the write before it, because the compiler must assume that both may have the same
/// address. `memory`: some law has a memory. Without memory a contact has fewer constants and no sums, so more
/// constants fit in shared memory. `series`: some contact has rock in series; `carried` and `memory` are then true.
template <class P, int Threads, bool carried, bool memory, BodyStorage storage, bool series>
class ResidentTile {
 public:
  using R = typename P::Particle;
  static constexpr unsigned warps = Threads / 32;
  using Constants = ContactConstants<carried, memory>;
  using Contact = ContactInBlock<carried, memory>;
  /// Number of words of constants per contact. words: in memory; words_read: those that a step reads and the cache
  /// holds.
  static constexpr std::uint32_t words = TileContactWords::constants(carried), words_read = Constants::words;

  __device__ __forceinline__ ResidentTile(const TileArrays<P>& scene, const Tile& own_tile, unsigned char* shared,
                                          const ResidentMemory<P>& m)
      : s(scene),
        tile(own_tile),
        body(s.body + tile.first_body),
        velocity{SixTable::at(shared + m.velocity, tile.bodies + tile.halo + walls)},
        law(reinterpret_cast<float4*>(shared + m.law)),
        cache(reinterpret_cast<float4*>(shared + m.cache)),
        constants(s.constant + std::size_t{tile.first_packet} * words * 32),
        states(s.state + std::size_t{tile.first_packet} * TileContactWords::states * 32),
        cells{SixTable::at(shared + m.cells, tile.cells)},
        displacement(reinterpret_cast<Six<double>*>(body_data_place(shared, m))),
        base(reinterpret_cast<Six<R>*>(displacement + tile.bodies)),
        inverse(reinterpret_cast<Two<R>*>(base + tile.bodies)),
        full_velocity(full_velocity_place(shared, m)),
        halo(reinterpret_cast<std::int32_t*>(shared + m.halo)),
        diagonal(reinterpret_cast<std::uint32_t*>(shared + m.diagonal)),
        list(reinterpret_cast<uint2*>(shared + m.list)),
        cached(m.cached),
        first_wall(tile.bodies + tile.halo) {}

  /// Returns the number of double packets that are stepped before the halo's velocities have arrived. Returns zero if
  /// there are few, because stepping some packets early costs one more barrier.
  __device__ __forceinline__ std::uint32_t inner() const { return 2 * tile.inner < warps ? 0 : tile.inner; }
  /// Some consecutive packets: first and count. They are packed into one word, because registers are scarce.
  struct Packets {
    std::uint32_t word;
    __device__ __forceinline__ Packets(std::uint32_t first, std::uint32_t count) : word(first << 4 | count) {}
    __device__ __forceinline__ std::uint32_t first() const { return word >> 4; }
    __device__ __forceinline__ std::uint32_t count() const { return word & 15; }
  };
  /// The packets that one warp steps. The states of `early` and `late` stay in registers; the states of `spilled` are
  /// in memory.
  struct PacketsOfWarp {
    Packets early, late;
    bool ahead;  ///< whether `early` needs no velocities of other tiles
    WarpPackets spilled;
  };
  /// Returns the packets of this thread's warp.
  __device__ __forceinline__ PacketsOfWarp packets_of_warp() const {
    constexpr std::uint32_t couple = TilePlan::couple, capacity = double_packets_in_registers * warps;
    const std::uint32_t warp = threadIdx.x / 32, doubles = min(tile.double_packets, capacity),
                        free = capacity - doubles;
    const std::uint32_t ahead = min(inner(), warps);
    const std::uint32_t first_one = couple * tile.double_packets, ones = tile.packets - first_one;
    const std::uint32_t each = free == 0 ? 0 : min(couple, (ones + free - 1) / free);
    const auto packets = [&](std::uint32_t k) -> Packets {
      if (k < doubles) return {couple * k, couple};
      const std::uint32_t at = min((k - doubles) * each, ones);
      return {first_one + at, min(each, ones - at)};
    };
    return {packets(warp), packets(warps + warp), warp < ahead,
            WarpPackets::of(tile, doubles, first_one + min(free * each, ones), warp, warps, ahead)};
  }
  /// Returns the position in the cache of the constants of a warp's packet j; the packet is cached if this position is
  /// less than `cached`. The first packets of all warps come first, so that no warp has many more uncached packets than
  /// another.
  __device__ __forceinline__ static std::uint32_t place_in_cache(std::uint32_t j) {
    return j * warps + threadIdx.x / 32;
  }
  /// Value of a position in the cache that means: the constants are in global memory.
  static constexpr std::uint32_t in_memory = UINT32_MAX;
  /// Among the packets of a warp whose states are in registers: the first one whose constants are in registers, too.
  static constexpr std::uint32_t first_in_registers =
      double_packets_in_registers * TilePlan::couple - packets_with_constants(memory);
  /// Returns the address of the state of this thread's contact in a packet.
  __device__ __forceinline__ float4* state(std::uint32_t packet) const {
    return states + std::size_t{packet} * TileContactWords::states * 32 + threadIdx.x % 32;
  }

  /// Loads the tile from global memory, except for the states of the contacts.
  __device__ __forceinline__ void load() const {
    for (std::uint32_t r = threadIdx.x; r < tile.bodies; r += Threads) {
      const auto i = static_cast<std::size_t>(body[r]);
      Six<R> velocities, loads;
      Six<double> moved;
      for (int c = 0; c < 6; ++c) {
        velocities.of[c] = s.motion.body.master[i * velocity_words + moving_word(c)];
        loads.of[c] = s.base[i * velocity_words + moving_word(c)];
        moved.of[c] = s.motion.body.displacement[i * displacement_words + moving_word(c)];
      }
      const Two<R> by{s.motion.body.inverse[2 * i], s.motion.body.inverse[2 * i + 1]};
      const uint2 of_list = s.list[tile.first_body + r];
      full_velocity[r] = velocities, base[r] = loads, displacement[r] = moved, inverse[r] = by, list[r] = of_list;
    }
    for (std::uint32_t h = threadIdx.x; h < tile.halo; h += Threads) halo[h] = s.halo[tile.first_halo + h];
    for (std::uint32_t e = threadIdx.x; e < TilePlan::longest_short_list; e += Threads)
      diagonal[e] = s.diagonal[s.own_tile() * TilePlan::longest_short_list + e];
    if (threadIdx.x < pair_types) law[threadIdx.x] = s.law[threadIdx.x];
    if (threadIdx.x < walls) velocity.set(first_wall + threadIdx.x, {0, 0, 0, 0, 0, 0});
    const PacketsOfWarp mine = packets_of_warp();
    const auto keep = [&](const Packets& packets, std::uint32_t first) {
      for (std::uint32_t k = 0; k < packets.count(); ++k) {
        const std::uint32_t at = place_in_cache(first + k);
        for (std::uint32_t i = threadIdx.x % 32; at < cached && i < words_read * 32; i += 32) {
          __pipeline_memcpy_async(&cache[at * words_read * 32 + i],
                                  &constants[std::size_t{packets.first() + k} * words * 32 + i], sizeof(float4));
        }
      }
    };
    keep(mine.early, 0);
    keep(mine.late, TilePlan::couple);
    __pipeline_commit();
  }
  /// Waits until the constants that load() requested for this thread have arrived.
  __device__ __forceinline__ static void wait_for_load() { __pipeline_wait_prior(0); }

  /// Moves all particles of the tile by their loads in global memory (first step of a launch).
  __device__ __forceinline__ void move_by_memory(std::uint32_t tag) const {
    for (std::uint32_t r = threadIdx.x; r < tile.bodies; r += Threads) {
      R force[6];
      for (int c = 0; c < 6; ++c)
        force[c] = s.force[static_cast<std::size_t>(body[r]) * velocity_words + moving_word(c)];
      move(r, force, tag);
    }
  }
  /// Moves all particles by the base loads plus the loads that the contacts have stored in cells in the last step.
  __device__ __forceinline__ void move_by_sums(std::uint32_t tag) const {
    sum_lists(tile, list, diagonal, cells, [&](std::uint32_t r, const float(&extra)[6]) {
      Six<R> force = base[r];
      for (int c = 0; c < 6; ++c) force.of[c] += static_cast<R>(extra[c]);
      move(r, force.of, tag);
    });
  }
  /// Enters the velocity of a wall in the table of velocities.
  __device__ __forceinline__ void set_wall(int wall, const Vec3<float>& v) const {
    velocity.set(first_wall + static_cast<std::uint32_t>(wall), {v.x, v.y, v.z, 0, 0, 0});
  }

  /// Receives the velocities of the halo from other tiles; waits for them.
  __device__ __forceinline__ void receive(std::uint32_t tag) const {
    const ulonglong2* from = s.exchange(tag);
    wait_for_words(
        2 * tile.halo, tag, [&](std::uint32_t h) { return from + 2 * static_cast<std::size_t>(halo[h / 2]) + h % 2; },
        [&](std::uint32_t h, const float4& numbers) { velocity.set_half(tile.bodies + h / 2, h % 2 == 1, numbers); });
  }
  /// Adds Δt times the current velocity to the displacement of each particle. Starts with the last warps, which have
  /// the least work.
  __device__ __forceinline__ void displace() const {
    for (std::uint32_t r = Threads - 1 - threadIdx.x; r < tile.bodies; r += Threads) {
      Six<double> u = displacement[r];
      const Six<R> x = full_velocity[r];
      for (int c = 0; c < 6; ++c) u.of[c] = multiply_add(s.motion.dt, double(x.of[c]), u.of[c]);
      displacement[r] = u;
    }
  }

  /// Returns the constants of this thread's contact in a packet. `at`: place_in_cache(), or in_memory.
  __device__ __forceinline__ Constants constants_of(std::uint32_t packet, std::uint32_t at) const {
    const unsigned lane = threadIdx.x % 32;
    Constants out;
    // Two branches, so that the compiler knows for each load whether it is from shared or global memory
    if (at < cached)
      out.load(cache + at * words_read * 32 + lane);
    else
      out.load(constants + std::size_t{packet} * words * 32 + lane);
    return out;
  }
  /// Steps one contact and stores its load into cells. `first`: a couple begins here.
  template <bool first>
  __device__ __forceinline__ void step(const Constants& constant, float (&change)[6], float (&sum)[6],
                                       ContactCouple& couple) const {
    const Contact contact(constant);
    const auto load = step_in_block<first, series>(contact, law, velocity, change, sum, couple);
    cells.put(contact.cells, load, couple);
  }
  /// Writes the loads on walls to global memory, after the last step.
  __device__ __forceinline__ void store_wall_loads(std::uint32_t packet, const float (&change)[6]) const {
    const Constants constant = constants_of(packet, in_memory);
    const Contact contact(constant);
    store_wall_load(s.wall_load, contact.of, contact.load(change, law[contact.of.group()].z));
  }

  /// Writes the particles and their current loads to global memory.
  __device__ __forceinline__ void store() const {
    sum_lists(tile, list, diagonal, cells, [&](std::uint32_t r, const float(&extra)[6]) {
      const auto i = static_cast<std::size_t>(body[r]);
      for (int c = 0; c < 6; ++c) {
        s.force[i * velocity_words + moving_word(c)] = base[r].of[c] + static_cast<R>(extra[c]);
        s.motion.body.master[i * velocity_words + moving_word(c)] = full_velocity[r].of[c];
        s.motion.body.displacement[i * displacement_words + moving_word(c)] = displacement[r].of[c];
      }
    });
  }

 private:
  // the branch is decided at compile time, so that the compiler knows which data is in shared memory
  __device__ __forceinline__ unsigned char* body_data_place(unsigned char* shared, const ResidentMemory<P>& m) const {
    if constexpr (storage == BodyStorage::shared)
      return shared + m.body_data;
    else
      return s.body_data + std::size_t{blockIdx.x} * ResidentMemory<P>::body_bytes(s.most_bodies, storage);
  }
  __device__ __forceinline__ Six<R>* full_velocity_place(unsigned char* shared, const ResidentMemory<P>& m) const {
    if constexpr (storage == BodyStorage::global)
      return reinterpret_cast<Six<R>*>(inverse + tile.bodies);
    else
      return reinterpret_cast<Six<R>*>(shared + m.full_velocity);
  }
  /// Moves particle r under `force`, publishes its velocity with `tag`, and enters it in the table of velocities.
  __device__ __forceinline__ void move(std::uint32_t r, const R (&force)[6], std::uint32_t tag) const {
    const Two<R> by = inverse[r];
    Six<R> now = full_velocity[r];
    for (int c = 0; c < 6; ++c) now.of[c] = s.motion.moved(now.of[c], force[c], c < 3 ? by.linear : by.angular);
    full_velocity[r] = now;
    const R(&x)[6] = now.of;
    const float y[6] = {float(x[0]), float(x[1]), float(x[2]), float(x[3]), float(x[4]), float(x[5])};
    put_velocity(s.exchange(tag) + 2 * (static_cast<std::size_t>(tile.first_body) + r), y, tag);
    velocity.set(r, y);
  }

  const TileArrays<P>& s;
  const Tile tile;
  const std::int32_t* body;
  const TileVelocities velocity;
  float4 *law, *cache;
  const float4* constants;
  float4* states;
  const LoadCells cells;
  Six<double>* displacement;
  Six<R>* base;
  Two<R>* inverse;
  Six<R>* full_velocity;
  std::int32_t* halo;
  std::uint32_t* diagonal;
  uint2* list;
  const std::uint32_t cached, first_wall;
};

}  // namespace macadam::kernels
