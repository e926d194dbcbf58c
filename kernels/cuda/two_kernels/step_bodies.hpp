// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_bodies.hpp  Defines the kernel that sums the loads of each body and moves it: the first of the two
/// kernels of a step in ExecCuda.
#pragma once

#include "kernels/cuda/common/load_sums.hpp"
#include "kernels/cuda/device/tuning.hpp"
#include "kernels/step/particle_motion.hpp"

namespace macadam::kernels {

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

}  // namespace macadam::kernels
