// SPDX-License-Identifier: GPL-3.0-or-later
/// \file settle_kernels.hpp  Defines the kernels that run between two blocks of steps on the tile path. They update the
/// viscoelastic states in full precision and prepare the next block.
///
/// Words: to settle is to update a contact between two blocks. f is the force density of one displacement component of
/// a contact; δf is its change since the beginning of the block. The drift is the change of f per step without motion.
/// A record is the load of one contact on one of its two bodies; the records of a body are consecutive (its load list).
/// The base load of a body is the sum of its records at the beginning of a block. The slot of a contact is its number
/// in the layout.
///
/// TileBlocks launches two kernels in this order:
/// 1. settle_contacts (through Settling in settle_launch.hpp), one thread per slot. It reads the two numbers that the
///    tiles have accumulated per component: δf, and the sum over the steps of the block of δf before and after the
///    step. It updates the contact's chain by model (6.9), writes the drift (and with updated geometry the frame) for
///    the next block into the tiles' constants, at the one or two positions of the contact in the tiles, and stores the
///    loads of the current f as records.
/// 2. sum_base sums the records of each body to its new base load, and stores the body's displacement as its
///    displacement at the beginning of the block.
/// The formulas of one contact are in block_settling.hpp. docs/gpu-step.md explains the whole path.
#pragma once

#include "kernels/contact/block_settling.hpp"
#include "kernels/contact/law_functors.hpp"
#include "kernels/cuda/common/load_sums.hpp"
#include "kernels/cuda/tiles/tile_step.hpp"

namespace macadam::kernels {

/// Value of the argument `steps` (number of steps of the block that ends) before the first step of a run, when no block
/// has ended. The constants then get their values for the undeformed contact.
inline constexpr int settling_starts = -1;

/// Settles the contacts of one group; one thread per contact.
template <class P, class Block, int Units, Geometry geometry>
struct SettleContact {
  /// The update of one contact, as in block_settling.hpp.
  BlockSettling<P, Block, Units, geometry> settling;
  /// Whether some contact of any group has rock in series; the words of all contacts then include frames.
  bool series;

  /// `position`: the one or two positions of the contact in the tiles; x is UINT32_MAX for an inert slot. `now`,
  /// `before`: displacements now and at the beginning of the block, [body][8]. `steps`: number of steps of the block
  /// that ends; 0 if no block has ended; settling_starts before the first step. `record`: number of the slot among the
  /// slots of all groups.
  __device__ void operator()(std::uint32_t slot, uint2 position, float4* constant, const float4* state,
                             const double* now, const double* before, int steps,
                             const LoadRecords<typename P::Particle>& records, std::uint32_t record) const {
    if (position.x == UINT32_MAX) return;
    if (steps == settling_starts) {
      begin(slot, position, constant);
      return;
    }
    float change[6], sum[6];
    TileContactWords::read_state(TileContactWords::at(state, position.x, TileContactWords::states), change, sum);
    const auto [frame, drift, load] = settling(LaneItem{slot % 32}, slot / 32, change, sum, now, before, steps);
    records.store(record, load);

    const float factor = series_factor(slot);
    with_words([&](auto is_carried) {
      constexpr bool carried = decltype(is_carried)::value;
      for (const std::uint32_t p : {position.x, position.y}) {
        if (p != UINT32_MAX)
          TileContactWords::settle<carried>(TileContactWords::at(constant, p, TileContactWords::constants(carried)),
                                            frame, drift, factor);
      }
    });
  }

 private:
  /// Calls f(std::bool_constant) with whether the words of a contact include its frame.
  template <class F>
  __device__ void with_words(F&& f) const {
    if constexpr (geometry == Geometry::updated)
      f(std::true_type{});
    else if (series)
      f(std::true_type{});
    else
      f(std::false_type{});
  }
  /// Returns the factor of rock in series in the normal components of a contact; 1 without rock.
  __device__ float series_factor(std::uint32_t slot) const {
    const ContactView<P>& view = settling.view;
    if (view.series == 0) return 1;
    const auto* g = view.geometry + static_cast<std::size_t>(slot / 32) * view.geometry_words * 32 + slot % 32;
    return static_cast<float>(1 / (1 + static_cast<double>(g[view.series * 32]) * settling.law.rate));
  }
  /// Writes constants without drift, with the frame of the undeformed contact.
  __device__ void begin(std::uint32_t slot, uint2 position, float4* constant) const {
    const ContactView<P>& view = settling.view;
    const auto* g = view.geometry + static_cast<std::size_t>(slot / 32) * view.geometry_words * 32 + slot % 32;
    const auto word = [&](int k) { return static_cast<float>(g[k * 32]); };
    const float factor = series_factor(slot);
    with_words([&](auto is_carried) {
      constexpr bool carried = decltype(is_carried)::value;
      for (const std::uint32_t p : {position.x, position.y}) {
        if (p != UINT32_MAX)
          TileContactWords::begin<carried>(TileContactWords::at(constant, p, TileContactWords::constants(carried)),
                                           word, factor);
      }
    });
  }
};

/// Functor types that settle a law: one for each number of Kelvin units that has its own code. A law that cannot be
/// stepped in blocks has no such type.
template <class P, class L, Geometry geometry>
auto settle_functors() {
  if constexpr (!has_blocks<L>)
    return std::tuple<>{};
  else if constexpr (units_of<L>() >= 0)
    return std::tuple<SettleContact<P, typename L::Block, units_of<L>(), geometry>>{};
  else
    return std::tuple<SettleContact<P, typename L::Block, 3, geometry>,
                      SettleContact<P, typename L::Block, -1, geometry>>{};
}

/// The settling functors of all groups, passed to the kernel by value.
template <class P, class AnyLaw, Geometry geometry>
struct SettleGroups;
template <class P, class... L, Geometry geometry>
struct SettleGroups<P, std::variant<L...>, geometry> {
  using Functors = decltype(std::tuple_cat(settle_functors<P, L, geometry>()...));
  struct Group {
    std::uint32_t first_slot = 0;  ///< number of the group's first slot among all groups
    typename AnyFunctorOf<Functors>::type functor;
  };
  Group group[pair_types];
  const uint2* position;  ///< [slot of all groups] the positions of its contact in the tiles
};

/// The slots of each group that one launch settles. Thread blocks first_block, first_block + 1, … handle slots begin …
/// end − 1.
struct SettleRanges {
  struct Range {
    std::uint32_t first_block = UINT32_MAX, begin = 0, end = 0;
  };
  Range of[pair_types];
  std::uint32_t blocks = 0;

  /// Adds a group. Its thread blocks follow the thread blocks of the groups added before.
  void add(int group, std::size_t begin, std::size_t end) {
    of[group] = {blocks, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
    blocks += static_cast<std::uint32_t>((end - begin + contact_threads - 1) / contact_threads);
  }
};

/// Settles the contacts of all groups. Each thread block handles contacts of one group only.
template <class P, class AnyLaw, Geometry geometry>
__global__ void __launch_bounds__(contact_threads)
    settle_contacts(const __grid_constant__ SettleGroups<P, AnyLaw, geometry> groups,
                    const __grid_constant__ SettleRanges ranges, float4* constant, const float4* state,
                    const double* now, const double* before, int steps,
                    const LoadRecords<typename P::Particle> records) {
  int number = 0;
  while (number + 1 < pair_types && ranges.of[number + 1].first_block <= blockIdx.x) ++number;
  const auto& group = groups.group[number];
  const auto& range = ranges.of[number];
  const std::uint32_t slot = range.begin + (blockIdx.x - range.first_block) * contact_threads + threadIdx.x;
  if (slot >= range.end) return;
  const std::uint32_t record = group.first_slot + slot;
  group.functor.visit([&](const auto& functor) {
    functor(slot, groups.position[record], constant, state, now, before, steps, records, record);
  });
}

/// Sets the loads to the body forces alone, before the first step.
template <class R>
__global__ void begin_with_weight(const R* weight, std::uint32_t particles, R* force) {
  const std::uint32_t body = blockIdx.x * blockDim.x + threadIdx.x;
  if (body >= particles) return;
  for (unsigned w = 0; w < 3; ++w) force[body * std::size_t{velocity_words} + w] = weight[body * std::size_t{4} + w];
}

/// Sums the base loads (records and body force) of the bodies first … end − 1, walls included, and copies their
/// displacements from `now` to `before`. The first `long_lists` thread blocks handle one body each, as in
/// step_bodies().
template <class P>
__global__ void __launch_bounds__(body_threads)
    sum_base(const LoadRecords<typename P::Particle> records, const std::uint32_t* long_body, std::uint32_t long_lists,
             std::uint32_t first, std::uint32_t end, const typename P::Particle* weight, std::uint32_t particles,
             typename P::Particle* base, const double* now, double* before) {
  using R = typename P::Particle;
  const unsigned w = threadIdx.x % velocity_words;
  const auto keep = [&](std::uint32_t body, R sum) {
    if (weight && body < particles && w < 3) sum += weight[body * std::size_t{4} + w];
    base[body * std::size_t{velocity_words} + w] = sum;
    before[body * std::size_t{displacement_words} + w] = now[body * std::size_t{displacement_words} + w];
  };
  if (blockIdx.x < long_lists) {
    const std::uint32_t body = long_body[blockIdx.x];
    const R sum = sum_by_block<R>(records, body);
    if (threadIdx.x < velocity_words) keep(body, sum);
    return;
  }
  const std::uint32_t body = first + (blockIdx.x - long_lists) * bodies_a_block + threadIdx.x / velocity_words;
  if (body >= end) return;
  const std::uint32_t list = records.list_begin[body], list_end = records.list_begin[body + 1];
  if (list_end - list <= long_list) keep(body, sum_words<R>(records, list, list_end, 1, w));
}

/// Writes the load on each wall: its base load plus the sum of the loads of its contacts, which are in `wall_load`.
/// Adds them in fixed order. One thread block per wall; all arguments except `wall_load` are arrays of the walls alone.
template <class R>
__global__ void __launch_bounds__(body_threads)
    add_wall_loads(const float* wall_load, const std::uint32_t* wall_begin, const R* base, R* force) {
  __shared__ R part[body_threads];
  const unsigned w = threadIdx.x % velocity_words, lane = threadIdx.x / velocity_words;
  R sum = 0;
  for (std::uint32_t r = wall_begin[blockIdx.x] + lane; r < wall_begin[blockIdx.x + 1]; r += bodies_a_block)
    sum += wall_load[r * std::size_t{velocity_words} + w];
  part[threadIdx.x] = sum;
  __syncthreads();
  if (lane > 0) return;
  sum = base[blockIdx.x * velocity_words + w];
  for (unsigned k = 0; k < bodies_a_block; ++k) sum += part[k * velocity_words + w];
  force[blockIdx.x * velocity_words + w] = sum;
}

}  // namespace macadam::kernels
