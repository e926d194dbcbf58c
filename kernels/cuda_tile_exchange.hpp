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

/// Words of 16 bytes that a body's velocity and spin take: three floats and a tag, or a double and a tag.
template <class T>
inline constexpr std::uint32_t words_exchanged = sizeof(T) == 4 ? 2 : 6;

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

__device__ __forceinline__ void put_velocity(ulonglong2* to, const float (&y)[6], std::uint32_t tag) {
  const auto pair = [](std::uint32_t low, std::uint32_t high) {
    return static_cast<unsigned long long>(high) << 32 | low;
  };
  put_word(to, pair(__float_as_uint(y[0]), __float_as_uint(y[1])), pair(__float_as_uint(y[2]), tag));
  put_word(to + 1, pair(__float_as_uint(y[3]), __float_as_uint(y[4])), pair(__float_as_uint(y[5]), tag));
}
__device__ __forceinline__ void put_velocity(ulonglong2* to, const double (&y)[6], std::uint32_t tag) {
  for (int c = 0; c < 6; ++c) put_word(to + c, static_cast<unsigned long long>(__double_as_longlong(y[c])), tag);
}

/// The numbers of one word, once it bears the tag.
template <class T>
struct VelocityWord {
  T value[6 / words_exchanged<T>];
};
template <class T>
__device__ __forceinline__ VelocityWord<T> get_velocity_word(const ulonglong2* from, std::uint32_t tag) {
  ulonglong2 word = get_word(from);
  if constexpr (sizeof(T) == 4) {
    while (static_cast<std::uint32_t>(word.y >> 32) != tag) word = get_word(from);
    return {{__uint_as_float(static_cast<std::uint32_t>(word.x)),
             __uint_as_float(static_cast<std::uint32_t>(word.x >> 32)),
             __uint_as_float(static_cast<std::uint32_t>(word.y))}};
  } else {
    while (static_cast<std::uint32_t>(word.y) != tag) word = get_word(from);
    return {{__longlong_as_double(static_cast<long long>(word.x))}};
  }
}

}  // namespace macadam::kernels
