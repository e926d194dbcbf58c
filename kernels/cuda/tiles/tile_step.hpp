// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_step.hpp  Defines what the resident and the streamed kernel of the tile path have in common: the
/// arguments of a launch, one step of one contact, and the sums of loads in shared memory.
///
/// Callers are run_resident (resident_kernel.hpp) and run_streamed (streamed_kernel.hpp); tile_plan.hpp
/// explains the words. In every step a thread block takes the velocities of its particles, its halo and the walls from
/// a table in shared memory (TileVelocities); steps its contacts with step_in_block() and stores their loads in cells
/// (LoadCells); adds the cells of each particle with sum_lists(); and moves the particles.
///
/// Steps are taken in blocks of up to longest_block steps (see block_settling.hpp and model (6.8)). During a block a
/// contact stores only the change δf of its force density f since the beginning of the block and, if some law has a
/// memory, a sum of δf over the steps. The loads that belong to f at the beginning of the block are part of the
/// particles' `base` loads. The state of a contact is therefore in three places. The chain (ContactView::chain) holds
/// the viscoelastic state at the beginning of the block, in full precision (without a chain, f follows from the
/// displacements); settle_kernels.hpp updates it after the block. The words of states in memory (contact_words.hpp)
/// hold δf and the sum; they are valid between launches. During a launch of the resident kernel, registers hold δf and
/// the sum of most contacts. docs/gpu-step.md explains the whole path.
#pragma once

#include <type_traits>

#include "kernels/contact/block_step.hpp"
#include "kernels/contact/contact_kinematics.hpp"
#include "kernels/cuda/common/lane_item.hpp"
#include "kernels/cuda/device/launch.hpp"
#include "kernels/step/particle_motion.hpp"
#include "kernels/contact/precision.hpp"
#include "kernels/cuda/tiles/contact_words.hpp"
#include "kernels/layout/tile_plan.hpp"

namespace macadam::kernels {

/// The memory in which a resident tile keeps the data of its particles. The velocities that contacts see are always in
/// shared memory.
enum class BodyStorage {
  shared,  ///< all in shared memory
  split,   ///< full-precision velocities in shared memory, everything else in global memory
  global,  ///< all in global memory
};

/// The packets of a tile that one warp steps: first double packets, then single ones, chosen so that all warps have
/// about the same number of packets.
struct WarpPackets {
  std::uint32_t first_double, doubles, stride;  ///< double packets first_double, first_double + stride, …
  std::uint32_t first_one = 0, ones = 0;

  /// Returns the packets of warp `warp` among the double packets from `first` on and the single packets from `one` on.
  /// All warps except the first `free` step one more double packet, which these numbers do not include.
  __device__ __forceinline__ static WarpPackets of(const Tile& tile, std::uint32_t first, std::uint32_t one,
                                                   std::uint32_t warp, std::uint32_t warps, std::uint32_t free) {
    const std::uint32_t all = tile.double_packets - first, low = all / warps, with_more = all % warps;
    const std::uint32_t fair = (TilePlan::couple * (all + warps - free) + tile.packets - one + warps - 1) / warps;
    WarpPackets out{first + warp, low + (warp < with_more), warps};
    for (std::uint32_t k = 0; k <= warp; ++k) {
      const std::uint32_t busy = TilePlan::couple * (low + (k < with_more) + (k >= free));
      out.first_one = one;
      out.ones = min(fair - min(fair, busy), tile.packets - one);
      one += out.ones;
    }
    return out;
  }
  /// Returns the number of packets, and the k-th packet.
  __device__ __forceinline__ std::uint32_t count() const { return TilePlan::couple * doubles + ones; }
  __device__ __forceinline__ std::uint32_t operator[](std::uint32_t k) const {
    constexpr std::uint32_t couple = TilePlan::couple;
    return k < couple * doubles ? couple * (first_double + k / couple * stride) + k % couple
                                : first_one + (k - couple * doubles);
  }
};

/// Arguments of a kernel over tiles: the plan and the arrays of one device, passed by value.
template <class P>
struct TileArrays {
  using R = typename P::Particle;
  const Tile* tile;
  const std::int32_t* body;       ///< [place]
  const uint2* list;              ///< [place] number of cells; first cell of a long list
  const std::uint32_t* diagonal;  ///< [tile][longest_short_list]
  const std::int32_t* halo;       ///< [first_halo + …] place
  const float4* constant;         ///< [packet][word][lane] constants, see TileContactWords
  float4* state;                  ///< [packet][word][lane] states, see TileContactWords
  const R* base;                  ///< [body][8] loads at the beginning of the block, with body forces [N, N·m]
  R* force;                       ///< [body][8] loads after the last step of a launch [N, N·m]
  float4* wall_load;  ///< [wall contact number][2] change of the loads on the walls since the beginning of the block
                      ///< [N, N·m]
  ulonglong2 *even, *odd;  ///< [place][2] velocities and spins of even and odd steps in single precision; the streamed
                           ///< kernel has the walls after the last place
  ParticleMotion<P> motion;  ///< how bodies move; its table of wall velocities begins with the first step of the launch
  float4 law[pair_types];    ///< [group] coefficients of the step: rate·Δt, relax, α, follow
  unsigned char* body_data;  ///< [thread block] particle data that does not fit in shared memory
  BodyStorage storage;       ///< where the particle data is
  std::uint32_t most_bodies, most_locals, most_cells;  ///< maxima over the tiles, see TilePlan
  std::uint32_t shared_bytes;                          ///< shared memory of a resident tile [byte]
  std::uint32_t places;                                ///< number of places
  std::uint32_t first_tile;                            ///< first tile of this device
  bool moves_walls;   ///< whether the first tile of this device moves the walls; streamed kernel only
  bool begins_block;  ///< whether the first step of this launch is the first of a block; the states are then 0,
                      ///< whatever the memory holds

  /// Returns the tile of this thread block.
  __device__ __forceinline__ std::uint32_t own_tile() const { return first_tile + blockIdx.x; }
  /// Returns the array of velocities of step k.
  __device__ __forceinline__ ulonglong2* exchange(std::uint32_t k) const { return k & 1 ? odd : even; }
};

/// A table in shared memory with six floats (24 bytes) per entry, stored as one word of 16 bytes and one of 8 bytes.
/// Threads access the entries in any order; the smaller an entry is, the fewer bank conflicts there are.
struct SixTable {
  float4* first;
  float2* second;

  __host__ __device__ static constexpr std::uint32_t bytes(std::uint32_t entries) { return 24 * entries; }
  /// Returns the table of `entries` entries that begins at `address`.
  __device__ __forceinline__ static SixTable at(unsigned char* address, std::uint32_t entries) {
    return {reinterpret_cast<float4*>(address), reinterpret_cast<float2*>(address + 16 * entries)};
  }
};

/// Velocities and spins of the bodies that a tile's contacts touch, by local number.
struct TileVelocities : SixTable {
  __device__ __forceinline__ Twist<float> operator[](std::uint32_t i) const {
    const float4 a = first[i];
    const float2 b = second[i];
    return {{a.x, a.y, a.z}, {a.w, b.x, b.y}};
  }
  /// Sets velocity and spin of local number i.
  __device__ __forceinline__ void set(std::uint32_t i, const float (&y)[6]) const {
    first[i] = {y[0], y[1], y[2], y[3]};
    second[i] = {y[4], y[5]};
  }
  /// Sets the velocity or the spin of local number i from a word of the exchange between tiles.
  __device__ __forceinline__ void set_half(std::uint32_t i, bool spin, const float4& y) const {
    if (spin) {
      first[i].w = y.x;
      second[i] = {y.y, y.z};
    } else {
      *reinterpret_cast<float2*>(first + i) = {y.x, y.y};
      first[i].z = y.z;
    }
  }
};

/// The couple that a thread is stepping: the motion of the common end A, and the sum of the loads on it so far.
struct ContactCouple {
  Vec3<float> linear, angular, force, moment;
  bool continues = false;  ///< whether the next contact belongs to the same couple
};

/// Steps one contact by model (6.8), and returns the change of its loads since the beginning of the block. `change` is
/// δf; `sum` is the sum, over the steps of the block so far, of δf before the step and δf after it. Template arguments:
/// `first`, whether a couple begins here; `series`, whether some contact has rock in series; `memory`, whether some law
/// has a memory.
template <bool first, bool series = false, bool carried, bool memory>
__device__ __forceinline__ ContactLoad<float> step_in_block(const ContactInBlock<carried, memory>& contact,
                                                            const float4* law, const TileVelocities& velocity,
                                                            float (&change)[6], float (&sum)[6],
                                                            ContactCouple& couple) {
  const EndPair end = contact.ends();
  if (first || !couple.continues) {
    const Twist<float> a = velocity[end.a()];
    couple.linear = a.linear;
    couple.angular = a.angular;
    couple.force = couple.moment = {0, 0, 0};
  }
  couple.continues = contact.cells.a() == TilePlan::more_of_couple;
  float u[6];
  relative_rates(contact.frame, Twist<float>{couple.linear, couple.angular}, velocity[end.b()], u);
  const float4 l = law[contact.of.group()];
  if constexpr (memory) {
    float drift[6];
    contact.read_drift(drift);
    if constexpr (series) {
      // normal = 1/(1 + r·k), so 1/(1 + α·r·k) = normal/(normal + α·(1 − normal))
      const float normal = contact.series_factor();
      const SeriesFactors<float> factors{normal, __fdividef(normal, normal + l.z * (1 - normal))};
#pragma unroll
      for (int c = 0; c < 6; ++c)
        step_in_block_by<float>({l.x, l.y, l.w}, u[c], drift[c], change[c], sum[c], factors.of_component(c));
    } else {
#pragma unroll
      for (int c = 0; c < 6; ++c) step_in_block_by<float>({l.x, l.y, l.w}, u[c], drift[c], change[c], sum[c]);
    }
  } else {
#pragma unroll
    for (int c = 0; c < 6; ++c) change[c] = multiply_add(l.x, u[c], change[c]);
  }
  return contact.load(change, l.z);
}

/// The load cells of a tile in shared memory. A cell holds a force and a moment.
struct LoadCells : SixTable {
  /// Stores a load; does nothing if `cell` is no_cell or more_of_couple. Threads read the cells only after a barrier.
  /// So these stores may be reordered with other accesses to shared memory. The compiler would not reorder stores
  /// through a pointer; therefore the store is written in assembly.
  __device__ __forceinline__ void put(std::uint32_t cell, const Vec3<float>& force, const Vec3<float>& moment) const {
    static_assert(TilePlan::more_of_couple < TilePlan::no_cell);
    asm volatile(
        "{ .reg .pred cell; setp.lt.u32 cell, %0, %1;\n"
        "@cell st.shared.v4.f32 [%2], {%4, %5, %6, %7};\n"
        "@cell st.shared.v2.f32 [%3], {%8, %9}; }" ::"r"(cell),
        "n"(std::uint32_t{TilePlan::more_of_couple}),
        "r"(static_cast<std::uint32_t>(__cvta_generic_to_shared(first + cell))),
        "r"(static_cast<std::uint32_t>(__cvta_generic_to_shared(second + cell))), "f"(force.x), "f"(force.y),
        "f"(force.z), "f"(moment.x), "f"(moment.y), "f"(moment.z));
  }
  /// Adds the load in a cell to f.
  __device__ __forceinline__ void add(std::uint32_t cell, float (&f)[6]) const {
    const float4 a = first[cell];
    const float2 b = second[cell];
    f[0] += a.x, f[1] += a.y, f[2] += a.z, f[3] += a.w, f[4] += b.x, f[5] += b.y;
  }
  /// Adds the loads in the first `count` of four cells (in all four if count ≥ 4) to f. All are read before the first
  /// is added.
  __device__ __forceinline__ void add(const std::uint32_t (&cell)[4], std::uint32_t count, float (&f)[6]) const {
    float4 a[4];
    float2 b[4];
#pragma unroll
    for (std::uint32_t k = 0; k < 4; ++k) {
      a[k] = k < count ? first[cell[k]] : float4{0, 0, 0, 0};
      b[k] = k < count ? second[cell[k]] : float2{0, 0};
    }
#pragma unroll
    for (int k = 0; k < 4; ++k)
      f[0] += a[k].x, f[1] += a[k].y, f[2] += a[k].z, f[3] += a[k].w, f[4] += b[k].x, f[5] += b[k].y;
  }
  /// Adds the load on end A to the sum of the couple and stores it if the couple ends here; stores the load on end B.
  __device__ __forceinline__ void put(EndPair cells, const ContactLoad<float>& load, ContactCouple& couple) const {
    couple.force += load.force_a;
    couple.moment += load.moment_a;
    put(cells.a(), couple.force, couple.moment);
    put(cells.b(), -load.force_a, load.moment_b);
  }
};

/// Calls f(rank, load) for every particle of the tile; the load is the sum of the particle's cells. Each long list is
/// summed by a warp (the last warp sums the first list), each short list by a thread.
template <class F>
__device__ __forceinline__ void sum_lists(const Tile& tile, const uint2* list, const std::uint32_t* diagonal,
                                          const LoadCells& cells, F&& f) {
  const unsigned warp = threadIdx.x / 32, lane = threadIdx.x % 32, warps = blockDim.x / 32;
  for (std::uint32_t r = warps - 1 - warp; r < tile.long_lists; r += warps) {
    float sum[6] = {0, 0, 0, 0, 0, 0};
    const uint2 place = list[r];
    for (std::uint32_t e = lane; e < place.x; e += 32) cells.add(place.y + e, sum);
#pragma unroll
    for (int c = 0; c < 6; ++c) {
#pragma unroll
      for (int k = 16; k > 0; k /= 2) sum[c] += __shfl_xor_sync(0xffffffff, sum[c], k);
    }
    if (lane == 0) f(r, sum);
  }
  for (std::uint32_t r = tile.long_lists + threadIdx.x; r < tile.bodies; r += blockDim.x) {
    float sum[6] = {0, 0, 0, 0, 0, 0};
    const std::uint32_t n = list[r].x;
    for (std::uint32_t e = 0; e < n; e += 4) {
      const uint4 at = reinterpret_cast<const uint4*>(diagonal)[e / 4];
      cells.add({at.x + r, at.y + r, at.z + r, at.w + r}, n - e, sum);
    }
    f(r, sum);
  }
}

/// Returns the velocity of a driven wall at step k of the launch, rounded like the particles' velocities.
template <class P>
__device__ __forceinline__ Vec3<float> wall_velocity(const TileArrays<P>& s, int wall, std::uint32_t k) {
  const auto v = load_vec3(s.motion.wall.row(wall, k));
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Moves one axis of a wall over some steps of a launch. The constructor requests the data early; move() uses it later.
template <class P>
struct WallAxisMotion {
  using R = typename P::Particle;
  bool moves = false;  ///< whether the axis is driven
  int axis = 0;
  std::size_t at = 0;  ///< index of the axis in the arrays of velocities and displacements
  double u = 0;        ///< displacement [m]
  R v = 0;             ///< velocity of the first step [m/s]

  /// `number`: axis 0 to 17 (3·wall + 0, 1 or 2). Any other number gives an axis that does not move. `first`: first
  /// step, counted from the start of the launch.
  __device__ __forceinline__ WallAxisMotion(const TileArrays<P>& s, int number, std::uint32_t first)
      : moves(number >= 0 && number < wall_axes && s.motion.wall.moves(number / 3)), axis(number) {
    if (!moves) return;
    at = ParticleMotion<P>::place(s.motion.body.particles + axis / 3, axis % 3);
    u = s.motion.body.displacement[at];
    v = s.motion.wall.row(axis / 3, first)[axis % 3];
  }
  /// Applies the steps first … end − 1 and writes displacement and velocity to memory.
  __device__ __forceinline__ void move(const TileArrays<P>& s, std::uint32_t first, std::uint32_t end) {
    u = multiply_add(s.motion.dt, double(v), u);
#pragma unroll 8
    for (std::uint32_t k = first + 1; k < end; ++k) {
      v = s.motion.wall.row(axis / 3, k)[axis % 3];
      u = multiply_add(s.motion.dt, double(v), u);
    }
    s.motion.body.displacement[at] = u;
    s.motion.body.master[at] = v;
  }
};

/// Returns the index of component c (0…5) in the eight words v, –, ω, – of a body.
__host__ __device__ constexpr int moving_word(int c) { return c < 3 ? c : c + 1; }

/// Stores the load of a contact at a wall, by its wall contact number; does nothing for a contact between particles.
__device__ __forceinline__ void store_wall_load(float4* wall_load, GroupAndWallContact of,
                                                const ContactLoad<float>& load) {
  const std::uint32_t number = of.wall_contact();
  if (number == GroupAndWallContact::no_wall) return;
  wall_load[2 * number] = {-load.force_a.x, -load.force_a.y, -load.force_a.z, 0};
  wall_load[2 * number + 1] = {load.moment_b.x, load.moment_b.y, load.moment_b.z, 0};
}

}  // namespace macadam::kernels
