// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_sums.hpp  Sums the load records of each body in fixed order, with eight threads per body, one per word.
#pragma once

#include "kernels/contact/contact_step.hpp"
#include "kernels/cuda/common/load_records.hpp"
#include "kernels/cuda/device/tuning.hpp"

namespace macadam::kernels {

/// Bodies per thread block.
inline constexpr unsigned bodies_a_block = body_threads / velocity_words;

/// Returns word w of [force, –, moment, –] of the sum of the records first, first + stride, … < end, added in precision
/// R.
template <class R, class T>
__device__ __forceinline__ R sum_words(const LoadRecords<T>& records, std::uint32_t first, std::uint32_t end,
                                       std::uint32_t stride, unsigned w) {
  constexpr unsigned batch = records_requested;
  R sum = 0;
  if (w % 4 == 3) return sum;
  const T* words = records.words + (w - w / 4);
  for (std::uint32_t r = first; r < end; r += batch * stride) {
    T part[batch];
#pragma unroll
    for (unsigned k = 0; k < batch; ++k) {
      const std::uint32_t at = r + k * stride;
      part[k] = at < end ? __ldg(words + static_cast<std::size_t>(at) * record_words) : T(0);
    }
#pragma unroll
    for (unsigned k = 0; k < batch; ++k) sum += part[k];
  }
  return sum;
}

/// Returns word w = threadIdx.x % 8 of the load of one body, summed by a whole thread block. Only the first eight
/// threads have the result.
template <class R, class T>
__device__ R sum_by_block(const LoadRecords<T>& records, std::uint32_t body) {
  __shared__ R part[body_threads];
  const unsigned w = threadIdx.x % velocity_words, lane = threadIdx.x / velocity_words;
  part[threadIdx.x] =
      sum_words<R>(records, records.list_begin[body] + lane, records.list_begin[body + 1], bodies_a_block, w);
  __syncthreads();
  R sum = 0;
  if (lane == 0) {
    for (unsigned k = 0; k < bodies_a_block; ++k) sum += part[k * velocity_words + w];
  }
  return sum;
}

/// Writes the sums of the loads of the bodies first + blockIdx.x, eight words each.
template <class R, class T>
__global__ void __launch_bounds__(body_threads) sum_loads(const LoadRecords<T> records, R* out, std::uint32_t first) {
  const R sum = sum_by_block<R>(records, first + blockIdx.x);
  if (threadIdx.x < velocity_words) out[blockIdx.x * velocity_words + threadIdx.x] = sum;
}

}  // namespace macadam::kernels
