// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_tile_exchange.hpp  How velocities cross between tiles within a launch: words of 16 bytes, numbers and the
/// step's tag, written and read whole.
///
/// A reader waits for the tag, so there is no barrier among blocks. Two sets of words take turns; a tile cannot be two
/// steps ahead of a neighbour, because it waits for the neighbour's last step.
#pragma once

#include <cuda_runtime.h>

#include <cstdint>

namespace macadam::kernels {

__device__ __forceinline__ void put_word(ulonglong2* to, unsigned long long a, unsigned long long b) {
#if __CUDA_ARCH__ >= 700
  asm volatile("{ .reg .b128 r; mov.b128 r, {%1, %2}; st.relaxed.sys.global.b128 [%0], r; }" ::"l"(to), "l"(a), "l"(b)
               : "memory");
#endif
}
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

/// A body's velocity and spin are two words.
__device__ __forceinline__ void put_velocity(ulonglong2* to, const float (&y)[6], std::uint32_t tag) {
  const auto pair = [](std::uint32_t low, std::uint32_t high) {
    return static_cast<unsigned long long>(high) << 32 | low;
  };
  put_word(to, pair(__float_as_uint(y[0]), __float_as_uint(y[1])), pair(__float_as_uint(y[2]), tag));
  put_word(to + 1, pair(__float_as_uint(y[3]), __float_as_uint(y[4])), pair(__float_as_uint(y[5]), tag));
}
/// Whether a word bears the tag or a later one, as a release does.
__device__ __forceinline__ bool has_come(const ulonglong2& word, std::uint32_t tag) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(word.y >> 32) - tag) >= 0;
}
/// The tag of words that take the place of all others where no more of these will come: every reader goes on, with
/// numbers that mean nothing. `tag`: of the next step.
constexpr std::uint32_t release_of(std::uint32_t tag) { return tag + (1u << 30); }
/// The three numbers of a word.
__device__ __forceinline__ float4 numbers_of(const ulonglong2& word) {
  return {__uint_as_float(static_cast<std::uint32_t>(word.x)),
          __uint_as_float(static_cast<std::uint32_t>(word.x >> 32)),
          __uint_as_float(static_cast<std::uint32_t>(word.y)), 0};
}

/// Calls take(h, numbers) for the words h < count at from(h), which the threads of a block share out, when they bear
/// the tag. A word's way from the second-level cache is long: a thread asks for two at once. A warp goes on together.
template <class From, class Take>
__device__ __forceinline__ void wait_for_words(std::uint32_t count, std::uint32_t tag, From&& from, Take&& take) {
  const std::uint32_t stride = blockDim.x;
  for (std::uint32_t first = threadIdx.x / 32 * 32; first < count; first += 2 * stride) {  // of the warp
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
