// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_tiles_chained.hpp  Many steps in one launch with every chain advanced in every step: tiles as in
/// cuda_tiles_resident.hpp, states from memory.
///
/// A warp's contacts may differ in law: each law is a chain of as many Kelvin units as the longest has, whose
/// coefficients a thread looks up; units that a law lacks have none and stay at rest.
#pragma once

#include "kernels/contact_forces.hpp"
#include "kernels/cuda_lane_item.hpp"
#include "kernels/cuda_tile_exchange.hpp"
#include "kernels/cuda_tile_scene.hpp"

namespace macadam::kernels {

/// Six planes of numbers in shared memory: [component][place].
template <class T>
struct Planes {
  T* at;
  std::uint32_t size;
  __device__ __forceinline__ T& operator()(int c, std::uint32_t i) const { return at[c * size + i]; }
  __device__ __forceinline__ void add(std::uint32_t i, T (&f)[6]) const {
#pragma unroll
    for (int c = 0; c < 6; ++c) f[c] += at[c * size + i];
  }
  __device__ __forceinline__ Twist<T> twist(std::uint32_t i) const {
    return {{at[i], at[size + i], at[2 * size + i]}, {at[3 * size + i], at[4 * size + i], at[5 * size + i]}};
  }
};

/// One contact of a packet of 32, whose bodies are in the tile's tables.
template <class T>
struct TileItem : LaneItem {
  Planes<T> velocity;
  const double* displacement;  ///< of the tile: [place][4]
  static constexpr bool staged = true;

  __device__ TileItem(std::uint32_t of_lane, Planes<T> table, const double* moved)
      : LaneItem{of_lane}, velocity(table), displacement(moved) {}
  template <class R>
  __device__ __forceinline__ Twist<R> twist(const R*, const std::int32_t* body) const {
    return velocity.twist(static_cast<std::uint32_t>(body[lane]));
  }
  template <class To, class R>
  __device__ __forceinline__ Vec3<To> relative(const R*, const std::int32_t* a, const std::int32_t* b) const {
    const double *ua = displacement + 4 * static_cast<std::size_t>(a[lane]),
                 *ub = displacement + 4 * static_cast<std::size_t>(b[lane]);
    return {static_cast<To>(ub[0] - ua[0]), static_cast<To>(ub[1] - ua[1]), static_cast<To>(ub[2] - ua[2])};
  }
};

/// Coefficients of one group's law.
template <class P>
struct ChainLaw {
  typename laws::GeneralisedKelvin::Step<typename P::State> step;
  typename P::Geometry alpha;
  bool wall;
};

/// What run_chained() gets besides the tiles.
template <class P>
struct ChainScene {
  TileScene<P> tiles;                  ///< without constants, states and exchange
  ContactView<P> view;                 ///< of all tiles' contacts; bodies are places in the tile's table
  const uint2* slots;                  ///< [contact] slot_a | slot_b << 16, group | wall row << 4
  ulonglong2* exchange;                ///< [2][body][words_exchanged]
  double* displacement;                ///< [tile][most_locals][4]; updated geometry only
  ChainLaw<P> law[pair_types];
};

template <class P>
struct ChainMemory {
  using G = typename P::Geometry;
  std::uint32_t velocity, slots, halo, diagonal, row, law, total;
  __host__ __device__ ChainMemory(std::uint32_t bodies, std::uint32_t halo_count, std::uint32_t locals,
                                  std::uint32_t slot_count) {
    std::uint32_t at = 0;
    const auto take = [&](std::size_t bytes) {
      const std::uint32_t here = at;
      at += static_cast<std::uint32_t>((bytes + 15) / 16 * 16);
      return here;
    };
    law = take(sizeof(ChainLaw<P>) * pair_types);
    velocity = take(6 * sizeof(G) * locals);
    slots = take(6 * sizeof(G) * slot_count);
    halo = take(4 * halo_count);
    diagonal = take(4 * TilePlan::longest_short_row);
    row = take(8 * bodies);
    total = at;
  }
};

/// Takes `steps` steps from tag `first_tag` on.
template <class P, int Units, Geometry geometry, int Threads>
__global__ void __launch_bounds__(Threads, 1)
    run_chained(const __grid_constant__ ChainScene<P> scene, std::uint32_t steps, std::uint32_t first_tag) {
  using R = typename P::Particle;
  using G = typename P::Geometry;
  using Forces = ContactForces<P, laws::GeneralisedKelvin::Step<typename P::State>, Units, ContactForm::condensed, geometry>;
  constexpr bool carried = geometry == Geometry::updated;
  extern __shared__ __align__(16) unsigned char shared[];
  const TileScene<P>& s = scene.tiles;
  const ChainMemory<P> m(s.most_bodies, s.most_halo, s.most_locals, s.most_slots);
  const Planes<G> velocity{reinterpret_cast<G*>(shared + m.velocity), s.most_locals};
  const Planes<G> slots{reinterpret_cast<G*>(shared + m.slots), s.most_slots};
  auto* halo = reinterpret_cast<std::int32_t*>(shared + m.halo);
  auto* diagonal = reinterpret_cast<std::uint32_t*>(shared + m.diagonal);
  auto* row = reinterpret_cast<uint2*>(shared + m.row);
  auto* law = reinterpret_cast<ChainLaw<P>*>(shared + m.law);
  const unsigned tid = threadIdx.x, lane = tid % 32, warp = tid / 32;
  constexpr unsigned warps = Threads / 32;
  const Tile tile = s.tile[blockIdx.x];
  const std::uint32_t locals = tile.bodies + tile.halo + walls;
  const std::int32_t* body = s.body + tile.first_body;
  double* displacement = scene.displacement + static_cast<std::size_t>(blockIdx.x) * s.most_locals * 4;

  for (std::uint32_t r = tid; r < tile.bodies; r += Threads) row[r] = s.row[tile.first_body + r];
  for (std::uint32_t h = tid; h < tile.halo; h += Threads) halo[h] = s.halo[tile.first_halo + h];
  for (std::uint32_t e = tid; e < TilePlan::longest_short_row; e += Threads)
    diagonal[e] = s.diagonal[blockIdx.x * TilePlan::longest_short_row + e];
  if (tid < pair_types) law[tid] = scene.law[tid];
  if (tid < walls) {
    for (int c = 0; c < 6; ++c) velocity(c, locals - walls + tid) = 0;
  }
  const auto top_wall = static_cast<std::size_t>(s.motion.body.particles) + 5;
  double wall_at = s.motion.body.displacement[top_wall * displacement_words + 2];
  if constexpr (carried) {
    for (std::uint32_t i = tid; i < locals; i += Threads) {
      const auto b = static_cast<std::size_t>(
          i < tile.bodies             ? body[i]
          : i < tile.bodies + tile.halo ? s.body[s.halo[tile.first_halo + i - tile.bodies]]
                                        : s.motion.body.particles + static_cast<std::int32_t>(i - (locals - walls)));
      for (int c = 0; c < 3; ++c) displacement[4 * i + c] = s.motion.body.displacement[b * displacement_words + c];
    }
  }

  const auto move = [&](std::uint32_t r, const R(&force)[6], std::uint32_t tag) {
    const auto i = static_cast<std::size_t>(body[r]);
    R x[6];
    for (int c = 0; c < 6; ++c) {
      R& v = s.motion.body.master[i * velocity_words + moving_word(c)];
      x[c] = v = s.motion.moved(v, force[c], s.motion.body.inverse[2 * i + c / 3]);
    }
    G y[6];
    for (int c = 0; c < 6; ++c) velocity(c, r) = y[c] = static_cast<G>(x[c]);
    put_velocity(scene.exchange + words_exchanged<G> * (static_cast<std::size_t>(tag & 1) * s.bodies + tile.first_body + r),
                 y, tag);
    double* u = s.motion.body.displacement + i * displacement_words;
    for (int c = 0; c < 6; ++c) u[moving_word(c)] = fma(s.motion.dt, double(x[c]), u[moving_word(c)]);
  };
  const auto receive = [&](std::uint32_t tag) {
    const ulonglong2* from = scene.exchange + words_exchanged<G> * static_cast<std::size_t>(tag & 1) * s.bodies;
    constexpr std::uint32_t words = words_exchanged<G>;
    for (std::uint32_t h = tid; h < words * tile.halo; h += Threads) {
      const auto word = get_velocity_word<G>(from + words * static_cast<std::size_t>(halo[h / words]) + h % words, tag);
      for (std::uint32_t c = 0; c < 6 / words; ++c)
        velocity(static_cast<int>(h % words * (6 / words) + c), tile.bodies + h / words) = word.value[c];
    }
  };

  __syncthreads();
  for (std::uint32_t k = 0; k < steps; ++k) {
    const std::uint32_t tag = first_tag + k;
    const bool last = k + 1 == steps;
    if (k == 0) {
      for (std::uint32_t r = tid; r < tile.bodies; r += Threads) {
        R force[6];
        for (int c = 0; c < 6; ++c)
          force[c] = s.force[static_cast<std::size_t>(body[r]) * velocity_words + moving_word(c)];
        move(r, force, tag);
      }
    } else {
      sum_rows<R>(tile, row, diagonal, slots, [&](std::uint32_t r, const R(&force)[6]) { move(r, force, tag); });
    }
    if (tid == Threads - 1 && s.motion.loaded) {
      const R top = static_cast<R>(s.wall_velocity[k]);
      velocity(2, locals - 1) = static_cast<G>(top);
      wall_at += s.motion.dt * top;
    }
    if (s.early == 0) receive(tag);
    __syncthreads();
    const auto shift = [&] {
      if constexpr (carried) {
        const double dt = s.motion.dt;
        for (std::uint32_t i = tid; i < locals; i += Threads) {
          for (int c = 0; c < 3; ++c) {
            // own bodies and walls move by their unrounded velocities
            if (i < tile.bodies)
              displacement[4 * i + c] =
                  s.motion.body.displacement[static_cast<std::size_t>(body[i]) * displacement_words + c];
            else if (i < locals - walls)
              displacement[4 * i + c] = fma(dt, double(velocity(c, i)), displacement[4 * i + c]);  // as its owner
          }
        }
        if (tid == Threads - 1) displacement[4 * (locals - 1) + 2] = wall_at;
      }
    };
    if (s.early == 0) {
      shift();
      if constexpr (carried) __syncthreads();
    }
    for (std::uint32_t j = 0; j < (tile.packets + warps - 1) / warps; ++j) {
      if (s.early > 0 && j == s.early) {
        receive(tag);
        __syncthreads();
      }
      const std::uint32_t packet = warp + j * warps;
      if (packet >= tile.packets) continue;
      const std::uint32_t number = tile.first_packet + packet;
      const uint2 places = __ldg(scene.slots + static_cast<std::size_t>(number) * 32 + lane);
      const ChainLaw<P>& own_law = law[places.y & 15];
      Forces forces{scene.view, own_law.step, static_cast<typename P::State>(s.motion.dt)};
      forces.view.alpha = own_law.alpha;
      forces.view.wall = own_law.wall;
      const auto load = forces(TileItem<G>(lane, velocity, displacement), number, MotionView<P>{});
      const auto put = [&](std::uint32_t slot, const Vec3<G>& force, const Vec3<G>& moment) {
        if (slot == TilePlan::no_slot) return;
        slots(0, slot) = force.x, slots(1, slot) = force.y, slots(2, slot) = force.z;
        slots(3, slot) = moment.x, slots(4, slot) = moment.y, slots(5, slot) = moment.z;
      };
      put(places.x & 0xffff, load.force_a, load.moment_a);
      put(places.x >> 16, -load.force_a, load.moment_b);
      if (last && (places.y >> 4) != no_wall_row) {
        R* to = reinterpret_cast<R*>(s.wall_load) + std::size_t{places.y >> 4} * velocity_words;
        const Vec3<G> force = -load.force_a;
        to[0] = force.x, to[1] = force.y, to[2] = force.z, to[3] = 0;
        to[4] = load.moment_b.x, to[5] = load.moment_b.y, to[6] = load.moment_b.z, to[7] = 0;
      }
    }
    __syncthreads();
  }

  sum_rows<R>(tile, row, diagonal, slots, [&](std::uint32_t r, const R(&force)[6]) {
    for (int c = 0; c < 6; ++c) s.force[static_cast<std::size_t>(body[r]) * velocity_words + moving_word(c)] = force[c];
  });
  if (blockIdx.x == 0 && tid == Threads - 1 && s.motion.loaded) {
    s.motion.body.master[top_wall * velocity_words + 2] = static_cast<R>(s.wall_velocity[steps - 1]);
    s.motion.body.displacement[top_wall * displacement_words + 2] = wall_at;
  }
}

}  // namespace macadam::kernels
