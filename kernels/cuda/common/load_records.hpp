// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_records.hpp  Defines the records in which contacts store their loads on the two bodies.
#pragma once

#include <cuda_runtime.h>

#include <cstdint>
#include <type_traits>

#include "kernels/contact/contact_kinematics.hpp"
#include "kernels/cuda/device/tuning.hpp"

namespace macadam::kernels {

inline constexpr unsigned record_words = 6;

/// The records in which contacts store their loads. A record is the load on one end; the records of a body are
/// consecutive.
template <class T>
struct LoadRecords {
  T* words;                         ///< [record][6] force, moment [N, N·m]
  const std::uint32_t* list_begin;  ///< [body + 1]
  const std::uint32_t* place;       ///< [slot][2] records of the A and the B end; UINT32_MAX in an inert slot

  using Two = std::conditional_t<sizeof(T) == 8, double2, float2>;
  static constexpr unsigned parts = record_words / 2;  ///< number of parts in which a record is written

  /// Writes one record.
  template <class U>
  __device__ __forceinline__ static void store(Two* to, const Vec3<U>& force, const Vec3<U>& moment) {
    to[0] = {T(force.x), T(force.y)};
    to[1] = {T(force.z), T(moment.x)};
    to[2] = {T(moment.y), T(moment.z)};
  }
  __device__ __forceinline__ Two* record(std::uint32_t number) const {
    return reinterpret_cast<Two*>(words) + static_cast<std::size_t>(number) * parts;
  }
  /// Returns the numbers of a slot's two records.
  __device__ __forceinline__ uint2 places(std::uint32_t slot) const {
    return __ldg(reinterpret_cast<const uint2*>(place) + slot);
  }

  /// Writes the loads of the contact in a slot to its two records; does nothing for an inert slot.
  template <class U>
  __device__ __forceinline__ void store(std::uint32_t slot, const ContactLoad<U>& load) const {
    const uint2 to = places(slot);
    if (to.x == UINT32_MAX) return;
    store(record(to.x), load.force_a, load.moment_a);
    store(record(to.y), -load.force_a, load.moment_b);
  }
  /// Writes the loads of all contacts of a warp to their records; called by all threads of the warp together. The
  /// records are transposed in shared memory, so that neighbouring threads write one record and memory receives whole
  /// sectors.
  template <class U>
  __device__ __forceinline__ void store_by_warp(std::uint32_t slot, const ContactLoad<U>& load) const {
    __shared__ Two turned[contact_threads][parts];
    const uint2 to = places(slot);
    const unsigned lane = threadIdx.x % 32, first = threadIdx.x - lane;
    const auto write = [&](std::uint32_t mine, const Vec3<U>& force, const Vec3<U>& moment) {
      __syncwarp();
      store(turned[threadIdx.x], force, moment);
      __syncwarp();
#pragma unroll
      for (unsigned k = 0; k < parts; ++k) {
        const unsigned of = (32 * k + lane) / parts, part = (32 * k + lane) % parts;
        const std::uint32_t number = __shfl_sync(0xffffffff, mine, static_cast<int>(of));
        if (number != UINT32_MAX) record(number)[part] = turned[first + of][part];
      }
    };
    write(to.x, load.force_a, load.moment_a);
    write(to.y, -load.force_a, load.moment_b);
  }
};

}  // namespace macadam::kernels
