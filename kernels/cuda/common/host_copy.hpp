// SPDX-License-Identifier: GPL-3.0-or-later
/// \file host_copy.hpp  Copies arrays of a device into memory of the host that is kept between copies.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "kernels/cuda/device/launch.hpp"

namespace macadam::kernels {

/// Host memory for copies of device arrays. It is allocated once for the largest copy so far, and pinned, because the
/// driver copies to memory that is new or not pinned at a fraction of the speed of the bus. If no more memory can be
/// pinned, uses other memory. No copy may still run when it is destroyed; all copies of this class are complete.
template <class T>
class HostCopy {
 public:
  HostCopy() = default;
  HostCopy(const HostCopy&) = delete;
  HostCopy& operator=(const HostCopy&) = delete;
  ~HostCopy() { release(); }

  /// Returns a copy of `count` values at a device address. It is valid until the next call.
  std::span<const T> copy(const T* from, std::size_t count) {
    if (count == 0) return {};
    reserve(count);
    copy_now(data_, from, count * sizeof(T), "copy from the device");
    return {data_, count};
  }

 private:
  void reserve(std::size_t count) {
    if (count <= size_) return;
    release();
    if (cudaMallocHost(&pinned_, count * sizeof(T)) == cudaSuccess) {
      data_ = pinned_;
    } else {
      cudaGetLastError();
      pinned_ = nullptr;
      plain_.resize(count);
      data_ = plain_.data();
    }
    size_ = count;
  }
  void release() {
    if (pinned_) cudaFreeHost(pinned_);
    pinned_ = data_ = nullptr;
    plain_ = {};
    size_ = 0;
  }

  T *pinned_ = nullptr, *data_ = nullptr;
  std::vector<T> plain_;
  std::size_t size_ = 0;
};

}  // namespace macadam::kernels
