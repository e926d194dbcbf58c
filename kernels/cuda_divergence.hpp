// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_divergence.hpp  Finds on the device the first particle that moves beyond sense.
#pragma once

#include <cub/device/device_reduce.cuh>
#include <cuda/functional>
#include <cuda/std/functional>
#include <thrust/iterator/counting_iterator.h>

#include "kernels/contact_forces.hpp"
#include "kernels/cuda_array.hpp"
#include "kernels/layout.hpp"

namespace macadam::kernels {

/// The number (specimen order) of a body that moves more than its radius or turns more than one radian in a step, or
/// not finitely; UINT32_MAX of any other.
template <class P>
struct Divergent {
  const typename P::Particle* velocity;  ///< [body][8]
  const std::int32_t* particle;          ///< [body]
  const double* radius;                  ///< [body] [m]
  double dt;                             ///< [s]

  __device__ std::uint32_t operator()(std::int32_t i) const {
    const auto* w = velocity + static_cast<std::size_t>(i) * velocity_words;
    const double travel = dt * sqrt(double(w[0]) * w[0] + double(w[1]) * w[1] + double(w[2]) * w[2]);
    const double turn = dt * sqrt(double(w[4]) * w[4] + double(w[5]) * w[5] + double(w[6]) * w[6]);
    return travel <= radius[i] && turn <= 1.0 ? UINT32_MAX : static_cast<std::uint32_t>(particle[i]);
  }
};

/// Owns what the search needs.
template <class P>
class DivergenceSearch {
 public:
  /// `radius` in specimen order [m].
  DivergenceSearch(const Layout& layout, const std::vector<double>& radius)
      : particle_(DeviceArray<std::int32_t>::of(layout.particle)), first_(1) {
    std::vector<double> sorted;
    for (const auto i : layout.particle) sorted.push_back(radius[static_cast<std::size_t>(i)]);
    radius_ = DeviceArray<double>::of(sorted);
  }

  /// Queues the search among the bodies `begin` to `end` − 1, of velocities `velocity` [body][8] on the device, for
  /// first(): what Stepper::first_divergent() says, but UINT32_MAX for none.
  void queue(const typename P::Particle* velocity, double dt, std::size_t begin, std::size_t end, cudaStream_t stream) {
    const auto search = [&](std::size_t& bytes) {
      check_cuda(cub::DeviceReduce::TransformReduce(
                     work_.data(), bytes, thrust::make_counting_iterator(static_cast<std::int32_t>(begin)),
                     first_.data(), static_cast<int>(end - begin), ::cuda::minimum<std::uint32_t>{},
                     Divergent<P>{velocity, particle_.data(), radius_.data(), dt}, std::uint32_t{UINT32_MAX}, stream),
                 "divergence");
    };
    std::size_t bytes = work_.size();
    if (bytes == 0) {  // the first call only says how much room it needs
      search(bytes);
      work_ = DeviceArray<unsigned char>(bytes);
    }
    search(bytes);
  }
  /// On the device.
  const std::uint32_t* first() const { return first_.data(); }

 private:
  DeviceArray<std::int32_t> particle_;
  DeviceArray<double> radius_;
  DeviceArray<std::uint32_t> first_;
  DeviceArray<unsigned char> work_;
};

}  // namespace macadam::kernels
