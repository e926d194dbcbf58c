// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_notes.hpp  What is seen of a run at its samples, noted on the device while the run goes on.
///
/// The host reads several notes at a time: it waits once for all of them, and the device never for the host.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/cuda_array.hpp"
#include "kernels/cuda_launch.hpp"
#include "kernels/layout.hpp"

namespace macadam::kernels {

/// What is seen of the walls, in words as kernels have them, and of the particles. R: precision of the particles.
template <class R>
struct Note {
  R force[walls * velocity_words];                  ///< by the particles [N, N·m]
  R velocity[walls * velocity_words];               ///< at the last half step [m/s, rad/s]
  double displacement[walls * displacement_words];  ///< at the whole step [m, rad]
  std::uint32_t divergent;                          ///< first particle that left the range of sense, UINT32_MAX: none
};

/// One block: all but `divergent`. Arrays are those of a note, on the device.
template <class R>
__global__ void take_note(Note<R>* note, const R* force, const R* velocity, const double* displacement) {
  for (unsigned i = threadIdx.x; i < walls * velocity_words; i += blockDim.x) {
    note->force[i] = force[i];
    note->velocity[i] = velocity[i];
  }
  for (unsigned i = threadIdx.x; i < walls * displacement_words; i += blockDim.x)
    note->displacement[i] = displacement[i];
}

/// Some notes on the device, and the host's copy of them.
template <class R>
class Notes {
 public:
  static constexpr std::size_t most = 64;  ///< at a time

  Notes() : taken_(most) { check_cuda(cudaMallocHost(&read_, most * sizeof(Note<R>)), "pinned memory"); }
  Notes(const Notes&) = delete;
  ~Notes() { cudaFreeHost(read_); }

  /// Queues that all say of no particle that it has diverged.
  void clear(cudaStream_t stream) { check_cuda(cudaMemsetAsync(taken_.data(), 0xff, taken_.bytes(), stream), "notes"); }
  /// Queues note number `k`, but for its particle that has diverged.
  void take(std::size_t k, const R* force, const R* velocity, const double* displacement, cudaStream_t stream) {
    launch("notes", take_note<R>, 1, walls * displacement_words, 0, stream, taken_.data() + k, force, velocity,
           displacement);
  }
  /// Where that particle of note number `k` is written.
  std::uint32_t* divergent(std::size_t k) { return &(taken_.data() + k)->divergent; }
  /// Queues that the first `number` are read.
  void read(std::size_t number, cudaStream_t stream) {
    check_cuda(cudaMemcpyAsync(read_, taken_.data(), number * sizeof(Note<R>), cudaMemcpyDeviceToHost, stream),
               "notes");
  }
  /// Note number `k` as it was read.
  const Note<R>& operator[](std::size_t k) const { return read_[k]; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(taken_.bytes()); }

 private:
  DeviceArray<Note<R>> taken_;
  Note<R>* read_ = nullptr;  // memory of the host that a device writes
};

}  // namespace macadam::kernels
