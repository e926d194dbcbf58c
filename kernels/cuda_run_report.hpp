// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_run_report.hpp  What the host asks for after every run of steps, queued behind the steps themselves.
///
/// What it asked for after one run follows the next one, and is there when that is done. So it waits once, not once a
/// question; and not for the steps of other specimens, which begin on a shared device as soon as these are done.
#pragma once

#include <cstdint>
#include <utility>

#include "kernels/cuda_launch.hpp"
#include "kernels/layout.hpp"

namespace macadam::kernels {

/// Of particle precision R.
template <class R>
class RunReport {
 public:
  /// Memory of the host that a device writes.
  struct Content {
    R force[walls * velocity_words], velocity[walls * velocity_words];  ///< of the walls
    double displacement[walls * displacement_words];                    ///< of the walls
    std::uint32_t divergent[1];                                         ///< first particle, UINT32_MAX: none
  };
  enum Part : unsigned { force = 1, motion = 2, divergence = 4 };

  RunReport() { check_cuda(cudaMallocHost(&content_, sizeof(Content)), "pinned memory"); }
  RunReport(const RunReport&) = delete;
  ~RunReport() { cudaFreeHost(content_); }

  /// This part as it was after the last run, or null where it was not queued or does not hold any more. It is asked for
  /// of the next run too.
  const Content* find(Part part) const {
    asked_ |= part;
    return there_ & part ? content_ : nullptr;
  }
  /// Nothing holds any more.
  void forget() const { there_ = 0; }
  /// Parts that were asked for since the last call.
  unsigned asked() { return std::exchange(asked_, 0u); }
  /// Queues a copy of device memory into a part.
  template <class T, std::size_t n>
  void copy(T (Content::*to)[n], const T* from, cudaStream_t stream) {
    check_cuda(cudaMemcpyAsync(content_->*to, from, n * sizeof(T), cudaMemcpyDeviceToHost, stream), "report");
  }
  /// These parts are there.
  void arrived(unsigned parts) { there_ = parts; }

 private:
  Content* content_ = nullptr;
  mutable unsigned asked_ = 0, there_ = 0;
};

}  // namespace macadam::kernels
