// SPDX-License-Identifier: GPL-3.0-or-later
/// \file divergence.hpp  Finds on the device (GPU) the first particle that moves too far in one step.
#pragma once

#include "kernels/contact/contact_step.hpp"
#include "kernels/cuda/device/array.hpp"
#include "kernels/cuda/device/launch.hpp"
#include "kernels/cuda/device/tuning.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::kernels {

/// Tests whether a body diverges, that is, moves more than its radius in one step, turns more than one radian in one
/// step, or has a velocity that is not finite. Returns the number of the body in the specimen if the body diverges,
/// otherwise UINT32_MAX.
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

/// Searches the bodies `begin` … `end` − 1. `*first` must be UINT32_MAX before the launch, and becomes the smallest
/// number of a particle that has diverged.
template <class P>
__global__ void find_divergent(const Divergent<P> of_body, std::int32_t begin, std::int32_t end, std::uint32_t* first) {
  const auto body = begin + static_cast<std::int32_t>(blockIdx.x * blockDim.x + threadIdx.x);
  if (body >= end) return;
  const std::uint32_t found = of_body(body);
  if (found != UINT32_MAX) atomicMin(first, found);
}

/// Owns the arrays of the search.
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

  /// Enqueues the search among the bodies `begin` … `end` − 1. `velocity`: [body][8] on the device. `first`, on the
  /// device, must be UINT32_MAX; it becomes the result of Stepper::first_divergent() if a particle is found.
  void queue(const typename P::Particle* velocity, double dt, std::size_t begin, std::size_t end, std::uint32_t* first,
             cudaStream_t stream) const {
    launch("divergence", find_divergent<P>, (end - begin + copy_threads - 1) / copy_threads, copy_threads, 0, stream,
           Divergent<P>{velocity, particle_.data(), radius_.data(), dt}, static_cast<std::int32_t>(begin),
           static_cast<std::int32_t>(end), first);
  }

  /// Searches the velocities for the first particle that has diverged, and waits for the result. Returns the number of
  /// this particle, or UINT32_MAX if no particle diverges.
  std::uint32_t find(const typename P::Particle* velocity, double dt, std::size_t begin, std::size_t end,
                     cudaStream_t stream) const {
    std::uint32_t out = UINT32_MAX;
    copy_now(first_.data(), &out, sizeof out, "divergence");
    queue(velocity, dt, begin, end, first_.data(), stream);
    check_cuda(cudaStreamSynchronize(stream), "divergence");
    copy_now(&out, first_.data(), sizeof out, "divergence");
    return out;
  }

 private:
  DeviceArray<std::int32_t> particle_;
  DeviceArray<double> radius_;
  DeviceArray<std::uint32_t> first_;  // result of find()
};

}  // namespace macadam::kernels
