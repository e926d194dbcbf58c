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
  asm volatile("{ .reg .b128 r; mov.b128 r, {%1, %2}; st.relaxed.gpu.global.b128 [%0], r; }" ::"l"(to), "l"(a), "l"(b)
               : "memory");
#endif
}
__device__ __forceinline__ ulonglong2 get_word(const ulonglong2* from) {
  unsigned long long a = 0, b = 0;
#if __CUDA_ARCH__ >= 700
  asm volatile("{ .reg .b128 r; ld.relaxed.gpu.global.b128 r, [%2]; mov.b128 {%0, %1}, r; }"
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
/// Three numbers of one word, once it bears the tag.
__device__ __forceinline__ float4 wait_for_word(const ulonglong2* from, std::uint32_t tag) {
  ulonglong2 word = get_word(from);
  while (static_cast<std::uint32_t>(word.y >> 32) != tag) word = get_word(from);
  return {__uint_as_float(static_cast<std::uint32_t>(word.x)),
          __uint_as_float(static_cast<std::uint32_t>(word.x >> 32)),
          __uint_as_float(static_cast<std::uint32_t>(word.y)), 0};
}

}  // namespace macadam::kernels
