// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_sums.hpp  Defines the kernels that sum the loads of each body in fixed order and move the bodies, with
/// eight threads per body, one per word.
#pragma once

#include "kernels/cuda/two_kernels/step_contacts.hpp"
#include "kernels/step/particle_motion.hpp"

namespace macadam::kernels {

inline constexpr unsigned body_threads = 256, bodies_a_block = body_threads / velocity_words;
inline constexpr std::uint32_t long_row = 64;  ///< a body with more records than this has a thread block of its own

/// Returns word w of [force, –, moment, –] of the sum of the records first, first + stride, … < end, added in precision
/// R.
template <class R, class T>
__device__ __forceinline__ R sum_words(const LoadRecords<T>& records, std::uint32_t first, std::uint32_t end,
                                       std::uint32_t stride, unsigned w) {
  constexpr unsigned batch = 8;  // records requested at the same time; a body has about twelve
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
      sum_words<R>(records, records.row_begin[body] + lane, records.row_begin[body + 1], bodies_a_block, w);
  __syncthreads();
  R sum = 0;
  if (lane == 0) {
    for (unsigned k = 0; k < bodies_a_block; ++k) sum += part[k * velocity_words + w];
  }
  return sum;
}

/// Smallest number of thread blocks of step_bodies() per multiprocessor. With more, threads would have too few
/// registers to request all records of a body at once (full specimen in double precision: 45.4 µs per step with 4, 47.1
/// µs with more).
inline constexpr unsigned body_blocks = 4;

/// Moves the bodies first … end − 1. `pushed`: as in ParticleMotion::word(). The first `long_rows` thread blocks handle
/// one body each, from `long_body`. The walls' table holds only the row of this step.
template <class P, bool pushed>
__global__ void __launch_bounds__(body_threads, body_blocks)
    step_bodies(const __grid_constant__ ParticleMotion<P> motion, const LoadRecords<typename P::Geometry> records,
                const std::uint32_t* long_body, std::uint32_t long_rows, std::uint32_t first, std::uint32_t end) {
  const int w = static_cast<int>(threadIdx.x % velocity_words);
  const auto particles = static_cast<std::uint32_t>(motion.body.particles);
  if (blockIdx.x < long_rows) {
    const std::uint32_t body = long_body[blockIdx.x];
    const auto force = sum_by_block<typename P::Particle>(records, body);
    if (threadIdx.x < velocity_words) motion.template word<pushed>(static_cast<std::int32_t>(body), w, force, 0);
    return;
  }
  const std::uint32_t body = first + (blockIdx.x - long_rows) * bodies_a_block + threadIdx.x / velocity_words;
  if (body >= end) return;
  typename P::Particle force = 0;
  if (pushed || body < particles) {
    const std::uint32_t row = records.row_begin[body], row_end = records.row_begin[body + 1];
    if (row_end - row > long_row) return;
    force = sum_words<typename P::Particle>(records, row, row_end, 1, static_cast<unsigned>(w));
  }
  motion.template word<pushed>(static_cast<std::int32_t>(body), w, force, 0);
}

/// Writes the sums of the loads of the bodies first + blockIdx.x, eight words each.
template <class R, class T>
__global__ void __launch_bounds__(body_threads) sum_loads(const LoadRecords<T> records, R* out, std::uint32_t first) {
  const R sum = sum_by_block<R>(records, first + blockIdx.x);
  if (threadIdx.x < velocity_words) out[blockIdx.x * velocity_words + threadIdx.x] = sum;
}

}  // namespace macadam::kernels
