// SPDX-License-Identifier: GPL-3.0-or-later
/// \file halo_exchange.hpp  Exchanges velocities between tiles (parts of the specimen, one per thread block) during a
/// launch of the resident kernel.
///
/// Velocities travel through global memory in words of 16 bytes: three floats and a tag, the number of the step. A word
/// is written and read by one 128-bit instruction, so a reader that sees the expected tag also sees the numbers that
/// belong to it. A particle has two words: velocity and spin. Readers poll the words that they need (wait_for_words()),
/// so no barrier between thread blocks is needed.
///
/// There are two sets of words, for even and for odd steps. Two are enough: a tile cannot be two steps ahead of a
/// neighbour, because it waits for the neighbour's previous step. The caller is ResidentTile in
/// resident_tile.hpp. After an error of one device the host writes a later tag into all words (release_of()), so
/// that the kernels of the other devices end. docs/gpu-step.md explains the whole path.
#pragma once

#include <cuda_runtime.h>

#include <cstdint>

namespace macadam::kernels {

/// Writes the 16 bytes a, b with one relaxed store that is visible to the whole system. Does nothing before compute
/// capability 7.0.
__device__ __forceinline__ void put_word(ulonglong2* to, unsigned long long a, unsigned long long b) {
#if __CUDA_ARCH__ >= 700
  asm volatile("{ .reg .b128 r; mov.b128 r, {%1, %2}; st.relaxed.sys.global.b128 [%0], r; }" ::"l"(to), "l"(a), "l"(b)
               : "memory");
#endif
}
/// Reads 16 bytes with one relaxed load.
__device__ __forceinline__ ulonglong2 get_word(const ulonglong2* from) {
  unsigned long long a = 0, b = 0;
#if __CUDA_ARCH__ >= 700
  asm volatile("{ .reg .b128 r; ld.relaxed.sys.global.b128 r, [%2]; mov.b128 {%0, %1}, r; }"
               : "=l"(a), "=l"(b)
               : "l"(from)
               : "memory");
#endif
  return {a, b};
}

/// Writes the velocity and spin y of a particle as two words that carry `tag`.
__device__ __forceinline__ void put_velocity(ulonglong2* to, const float (&y)[6], std::uint32_t tag) {
  const auto pair = [](std::uint32_t low, std::uint32_t high) {
    return static_cast<unsigned long long>(high) << 32 | low;
  };
  put_word(to, pair(__float_as_uint(y[0]), __float_as_uint(y[1])), pair(__float_as_uint(y[2]), tag));
  put_word(to + 1, pair(__float_as_uint(y[3]), __float_as_uint(y[4])), pair(__float_as_uint(y[5]), tag));
}
/// Returns whether a word carries the tag `tag` or a later one. A release tag counts as later.
__device__ __forceinline__ bool has_come(const ulonglong2& word, std::uint32_t tag) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(word.y >> 32) - tag) >= 0;
}
/// Returns the tag that ends all waiting. After a failure no more velocities arrive, so all words are overwritten with
/// this tag. Threads that wait for a word then stop waiting and continue with meaningless numbers. `tag`: tag of the
/// next step.
constexpr std::uint32_t release_of(std::uint32_t tag) { return tag + (1u << 30); }
/// Returns the three numbers of a word; the fourth component is 0.
__device__ __forceinline__ float4 numbers_of(const ulonglong2& word) {
  return {__uint_as_float(static_cast<std::uint32_t>(word.x)),
          __uint_as_float(static_cast<std::uint32_t>(word.x >> 32)),
          __uint_as_float(static_cast<std::uint32_t>(word.y)), 0};
}

/// Waits until the words at from(h), h < count, carry `tag`, and calls take(h, numbers) for each. The threads of a
/// block divide the words among them. A read from the L2 cache takes long, so a thread requests two words at once. All
/// threads of a warp must call this together.
template <class From, class Take>
__device__ __forceinline__ void wait_for_words(std::uint32_t count, std::uint32_t tag, From&& from, Take&& take) {
  const std::uint32_t stride = blockDim.x;
  for (std::uint32_t first = threadIdx.x / 32 * 32; first < count; first += 2 * stride) {  // h of the warp's first lane
    const std::uint32_t h = first + threadIdx.x % 32;
    const bool has_a = h < count, has_b = h + stride < count;
    const ulonglong2 *at_a = has_a ? from(h) : nullptr, *at_b = has_b ? from(h + stride) : nullptr;
    bool wait_a = has_a, wait_b = has_b;
    ulonglong2 a{}, b{};
    do {
      if (wait_a) a = get_word(at_a);
      if (wait_b) b = get_word(at_b);
      wait_a = wait_a && !has_come(a, tag);
      wait_b = wait_b && !has_come(b, tag);
    } while (__any_sync(0xffffffff, wait_a || wait_b));
    if (has_a) take(h, numbers_of(a));
    if (has_b) take(h + stride, numbers_of(b));
  }
}

}  // namespace macadam::kernels
