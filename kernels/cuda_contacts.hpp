// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_contacts.hpp  All groups of contacts in one launch: a block of threads belongs to one group, so that no
/// warp does two things.
#pragma once

#include <cstring>
#include <type_traits>

#include <algorithm>
#include "kernels/cuda_lane_item.hpp"
#include "kernels/cuda_launch.hpp"
#include "macadam/laws/all.hpp"

namespace macadam::kernels {

/// Where the loads of a contact go: eight words a record, so that one record is one sector; the records of a body
/// follow one another.
template <class T>
struct LoadRecords {
  T* words;                        ///< [record][8] force, –, moment, – [N, N·m]
  const std::uint32_t* row_begin;  ///< [body + 1]
  const std::uint32_t* place;      ///< [slot][2] records of the A and the B end; UINT32_MAX in an inert slot

  __device__ __forceinline__ static void store(float* to, const Vec3<float>& f, const Vec3<float>& m) {
    reinterpret_cast<float4*>(to)[0] = {f.x, f.y, f.z, 0};
    reinterpret_cast<float4*>(to)[1] = {m.x, m.y, m.z, 0};
  }
  __device__ __forceinline__ static void store(double* to, const Vec3<double>& f, const Vec3<double>& m) {
    auto* out = reinterpret_cast<double2*>(to);
    out[0] = {f.x, f.y}, out[1] = {f.z, 0}, out[2] = {m.x, m.y}, out[3] = {m.z, 0};
  }
  template <class U>
  __device__ __forceinline__ void store(std::uint32_t slot, const ContactLoad<U>& load) const {
    const uint2 to = __ldg(reinterpret_cast<const uint2*>(place) + slot);
    if (to.x == UINT32_MAX) return;
    const auto rounded = [](const Vec3<U>& v) { return Vec3<T>{T(v.x), T(v.y), T(v.z)}; };
    store(words + static_cast<std::size_t>(to.x) * velocity_words, rounded(load.force_a), rounded(load.moment_a));
    store(words + static_cast<std::size_t>(to.y) * velocity_words, rounded(-load.force_a), rounded(load.moment_b));
  }
};

inline constexpr unsigned contact_threads = 128;

/// Asks for a line of memory to be brought into the second-level cache.
__device__ __forceinline__ void prefetch(const void* line) { asm volatile("prefetch.global.L2 [%0];" ::"l"(line)); }

/// The functors of all groups, by value: they reach the kernel as its parameters.
template <class P, ContactForm form, Geometry geometry>
struct ContactGroups {
  template <class Step, int Units>
  using Of = ContactForces<P, Step, Units, form, geometry>;
  using State = typename P::State;
  using Elastic = Of<laws::Elastic::Step<State>, 0>;
  using KelvinThree = Of<laws::GeneralisedKelvin::Step<State>, 3>;
  using KelvinAny = Of<laws::GeneralisedKelvin::Step<State>, -1>;
  struct Group {
    std::uint32_t first_block = UINT32_MAX;  ///< of this group
    std::uint32_t first_slot = 0, slots = 0;
    int kind = 0;
    alignas(8) unsigned char functor[std::max({sizeof(Elastic), sizeof(KelvinThree), sizeof(KelvinAny)})] = {};
  };
  Group group[pair_types];

  template <class Forces>
  static constexpr int kind_of() {
    return std::is_same_v<Forces, Elastic> ? 0 : std::is_same_v<Forces, KelvinThree> ? 1 : 2;
  }
  /// Adds a group behind the ones before; returns the blocks of all.
  template <class Forces>
  std::uint32_t add(int number, std::uint32_t first_block, std::uint32_t first_slot, std::uint32_t slots,
                    const Forces& forces) {
    static_assert(kind_of<Forces>() != 2 || std::is_same_v<Forces, KelvinAny>, "a law without a kernel");
    Group& g = group[number];
    g.first_block = first_block, g.first_slot = first_slot, g.slots = slots, g.kind = kind_of<Forces>();
    std::memcpy(g.functor, &forces, sizeof forces);
    return first_block + (slots + contact_threads - 1) / contact_threads;
  }
  /// Calls f(functor) of a group.
  template <class F>
  __device__ __forceinline__ static void visit(const Group& g, F&& f) {
    if (g.kind == 0)
      f(*reinterpret_cast<const Elastic*>(g.functor));
    else if (g.kind == 1)
      f(*reinterpret_cast<const KelvinThree*>(g.functor));
    else
      f(*reinterpret_cast<const KelvinAny*>(g.functor));
  }
};

/// Steps every contact and writes its loads. The last thing a step does: it counts the step.
template <class P, ContactForm form, Geometry geometry>
__global__ void __launch_bounds__(contact_threads)
    step_contacts(const __grid_constant__ ContactGroups<P, form, geometry> groups, const MotionView<P> motion,
                  const LoadRecords<typename P::Geometry> records, std::int64_t* step) {
  if (blockIdx.x == 0 && threadIdx.x == 0) ++*step;
  int number = 0;
  while (number + 1 < pair_types && groups.group[number + 1].first_block <= blockIdx.x) ++number;
  const auto& group = groups.group[number];
  const std::uint32_t slot = (blockIdx.x - group.first_block) * contact_threads + threadIdx.x;
  if (slot >= group.slots) return;
  ContactGroups<P, form, geometry>::visit(group, [&](const auto& forces) {
    // a warp's states are one run of memory: asked for now, they are near when kinematics is done
    if constexpr (form == ContactForm::condensed && !std::decay_t<decltype(forces)>::stateless) {
      const auto& view = forces.view;
      const auto bytes =
          static_cast<std::uint32_t>(view.components * (1 + view.units) * 32 * sizeof(typename P::State));
      const char* chain = reinterpret_cast<const char*>(view.chain) + std::size_t{slot / 32} * bytes;
      for (std::uint32_t at = slot % 32 * 128; at < bytes; at += 32 * 128) prefetch(chain + at);
      const auto words = static_cast<std::uint32_t>(view.geometry_words * 32 * sizeof(typename P::Geometry));
      const char* facets = reinterpret_cast<const char*>(view.geometry) + std::size_t{slot / 32} * words;
      for (std::uint32_t at = slot % 32 * 128; at < words; at += 32 * 128) prefetch(facets + at);
    }
    records.store(group.first_slot + slot, forces(LaneItem{slot % 32}, slot / 32, motion));
  });
}

}  // namespace macadam::kernels
