// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sample_buffer.hpp  Takes samples of a run on the device (GPU) while the run continues.
///
/// A sample holds the wall forces, the motion of the walls, and the first particle that has diverged. The executors
/// enqueue samples between steps. The host reads several at a time: it waits once for all of them, and the device
/// never waits for the host.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/cuda/device/array.hpp"
#include "kernels/cuda/device/launch.hpp"
#include "kernels/cuda/device/tuning.hpp"
#include "kernels/layout/layout.hpp"

namespace macadam::kernels {

/// One sample as the kernels write it. R: precision of the particles.
template <class R>
struct DeviceSample {
  R force[walls * velocity_words];                  ///< exerted by the particles [N, N·m]
  R velocity[walls * velocity_words];               ///< at the last half step [m/s, rad/s]
  double displacement[walls * displacement_words];  ///< at the whole step [m, rad]
  /// First particle that moves too far in a step (divergence.hpp); UINT32_MAX: none.
  std::uint32_t divergent;
};

/// Writes everything except `divergent` into a sample. Launched with one thread block. `force`, `velocity` and
/// `displacement` point to the words of the walls, in the same order as in DeviceSample.
template <class R>
__global__ void take_sample(DeviceSample<R>* sample, const R* force, const R* velocity, const double* displacement) {
  for (unsigned i = threadIdx.x; i < walls * velocity_words; i += blockDim.x) {
    sample->force[i] = force[i];
    sample->velocity[i] = velocity[i];
  }
  for (unsigned i = threadIdx.x; i < walls * displacement_words; i += blockDim.x)
    sample->displacement[i] = displacement[i];
}

/// Samples on the device, and their copies on the host.
template <class R>
class DeviceSamples {
 public:
  DeviceSamples() : taken_(samples_per_read) {
    check_cuda(cudaMallocHost(&read_, samples_per_read * sizeof(DeviceSample<R>)), "pinned memory");
  }
  DeviceSamples(const DeviceSamples&) = delete;
  ~DeviceSamples() { cudaFreeHost(read_); }

  /// Enqueues the reset of all samples. After it, no sample reports a diverged particle.
  void clear(cudaStream_t stream) {
    check_cuda(cudaMemsetAsync(taken_.data(), 0xff, taken_.bytes(), stream), "samples");
  }
  /// Enqueues the copy of wall forces and motion into sample `k`. The diverged particle is written separately, to
  /// divergent(k).
  void take(std::size_t k, const R* force, const R* velocity, const double* displacement, cudaStream_t stream) {
    launch("samples", take_sample<R>, 1, walls * displacement_words, 0, stream, taken_.data() + k, force, velocity,
           displacement);
  }
  /// Returns the device address of the diverged particle of sample `k`.
  std::uint32_t* divergent(std::size_t k) { return &(taken_.data() + k)->divergent; }
  /// Enqueues the copy of the first `number` samples to the host.
  void read(std::size_t number, cudaStream_t stream) {
    check_cuda(cudaMemcpyAsync(read_, taken_.data(), number * sizeof(DeviceSample<R>), cudaMemcpyDeviceToHost, stream),
               "samples");
  }
  /// Returns the host copy of sample `k`.
  const DeviceSample<R>& operator[](std::size_t k) const { return read_[k]; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(taken_.bytes()); }

 private:
  DeviceArray<DeviceSample<R>> taken_;
  DeviceSample<R>* read_ = nullptr;  // pinned host memory
};

}  // namespace macadam::kernels
