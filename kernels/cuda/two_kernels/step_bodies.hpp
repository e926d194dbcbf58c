// SPDX-License-Identifier: GPL-3.0-or-later
/// \file step_bodies.hpp  Defines the kernel that sums the loads of each body and moves it: the first of the two
/// kernels of a step in ExecCuda.
#pragma once

#include "kernels/cuda/common/load_sums.hpp"
#include "kernels/cuda/device/tuning.hpp"
#include "kernels/step/particle_motion.hpp"

namespace macadam::kernels {

/// Moves the bodies first … end − 1. `has_external_loads`: as in ParticleMotion::word(). The first `long_lists` thread
/// blocks handle one body each, the bodies in `long_body`, which have long load lists. The walls' table holds only the
/// row of this step.
template <class P, bool has_external_loads>
__global__ void __launch_bounds__(body_threads, body_blocks)
    step_bodies(const __grid_constant__ ParticleMotion<P> motion, const LoadRecords<typename P::Geometry> records,
                const std::uint32_t* long_body, std::uint32_t long_lists, std::uint32_t first, std::uint32_t end) {
  const int w = static_cast<int>(threadIdx.x % velocity_words);
  const auto particles = static_cast<std::uint32_t>(motion.body.particles);
  if (blockIdx.x < long_lists) {
    const std::uint32_t body = long_body[blockIdx.x];
    const auto force = sum_by_block<typename P::Particle>(records, body);
    if (threadIdx.x < velocity_words)
      motion.template word<has_external_loads>(static_cast<std::int32_t>(body), w, force, 0);
    return;
  }
  const std::uint32_t body = first + (blockIdx.x - long_lists) * bodies_a_block + threadIdx.x / velocity_words;
  if (body >= end) return;
  typename P::Particle force = 0;
  if (has_external_loads || body < particles) {
    const std::uint32_t list = records.list_begin[body], list_end = records.list_begin[body + 1];
    if (list_end - list > long_list) return;
    force = sum_words<typename P::Particle>(records, list, list_end, 1, static_cast<unsigned>(w));
  }
  motion.template word<has_external_loads>(static_cast<std::int32_t>(body), w, force, 0);
}

}  // namespace macadam::kernels
