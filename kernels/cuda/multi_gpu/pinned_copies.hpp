// SPDX-License-Identifier: GPL-3.0-or-later
/// \file pinned_copies.hpp  Copies arrays from a device while it continues to work, through pinned host memory that the
/// device writes directly.
#pragma once

#include <algorithm>
#include <functional>

#include "kernels/cuda/multi_gpu/device_team.hpp"

namespace macadam::kernels {

/// Two buffers for copies of up to `size` items each, on the stream of a team's first member.
template <class T>
class PinnedCopies {
 public:
  explicit PinnedCopies(const DeviceTeam& team, std::size_t size = 1) : team_(team), size_(size) {
    check_cuda(cudaMallocHost(&host_, 2 * size * sizeof(T)), "pinned memory");
    for (cudaEvent_t& e : copied_) check_cuda(cudaEventCreateWithFlags(&e, cudaEventDisableTiming), "event");
  }
  PinnedCopies(const PinnedCopies&) = delete;
  ~PinnedCopies() {
    team_.wait_for_the_last();  // a copy, or kernels of other members that it waits for, may still run
    cudaFreeHost(host_);
    for (cudaEvent_t e : copied_) cudaEventDestroy(e);
  }
  std::size_t size() const { return size_; }
  /// Enqueues a copy into buffer `slot` (0 or 1).
  void copy(const T* from, std::size_t count, int slot) const {
    check_cuda(cudaMemcpyAsync(host_ + slot * size_, from, count * sizeof(T), cudaMemcpyDeviceToHost, team_.stream()),
               "copy from the device");
    check_cuda(cudaEventRecord(copied_[slot], team_.stream()), "copy from the device");
  }
  /// Waits for the copy into buffer `slot` and returns it.
  const T* wait(int slot) const {
    check_cuda(cudaEventSynchronize(copied_[slot]), "copy from the device");
    return host_ + slot * size_;
  }

 private:
  const DeviceTeam& team_;
  std::size_t size_;
  T* host_ = nullptr;
  cudaEvent_t copied_[2] = {};
};

/// Copies a long array in parts: while one part is used, the next one is copied. A copy into pageable memory would keep
/// one thread busy and take five times as long.
template <class T>
class PinnedParts {
 public:
  explicit PinnedParts(const DeviceTeam& team) : copies_(team, (std::size_t{8} << 20) / sizeof(T)) {}

  /// Calls take(index of the part's first item, part, count) for each part in turn. The work that fills `from` must
  /// already be in the team's stream.
  template <class Take>
  void copy(const T* from, std::size_t count, Take&& take) const {
    const std::size_t part = copies_.size(), parts = (count + part - 1) / part;
    const auto length = [&](std::size_t k) { return std::min(part, count - k * part); };
    for (std::size_t k = 0; k <= parts; ++k) {
      if (k < parts) copies_.copy(from + k * part, length(k), static_cast<int>(k % 2));
      if (k > 0) take((k - 1) * part, copies_.wait(static_cast<int>((k - 1) % 2)), length(k - 1));
    }
  }

 private:
  PinnedCopies<T> copies_;
};

}  // namespace macadam::kernels
