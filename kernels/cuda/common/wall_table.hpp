// SPDX-License-Identifier: GPL-3.0-or-later
/// \file wall_table.hpp  Uploads rows of the walls' table (one row of prescribed motion per step) while the GPU takes
/// steps.
#pragma once

#include <cstring>
#include <vector>

#include "kernels/cuda/multi_gpu/device_team.hpp"

namespace macadam::kernels {

/// The table on the device, whose address does not change, and two host buffers that fill it in turn. The copy from one
/// buffer is enqueued behind the steps that still read the table. Meanwhile the host writes the other buffer.
template <class R>
class WallRowsOnDevice {
 public:
  WallRowsOnDevice() = default;
  WallRowsOnDevice(const WallRowsOnDevice&) = delete;
  ~WallRowsOnDevice() { forget(); }

  /// Allocates the table and the buffers and returns the address of the table, or null if `most_values` is 0.
  const R* prepare(std::size_t most_values) {
    if (most_values == table_.size()) return table_.data();
    forget();
    table_ = DeviceArray<R>(most_values);
    for (Buffer& b : buffers_) {
      if (most_values == 0) continue;
      check_cuda(cudaMallocHost(reinterpret_cast<void**>(&b.values), most_values * sizeof(R)), "walls' table");
      check_cuda(cudaEventCreateWithFlags(&b.copied, cudaEventDisableTiming), "walls' table");
    }
    return table_.data();
  }

  /// Size on the device.
  std::size_t bytes() const { return table_.bytes(); }

  /// Enqueues the upload of the rows, behind all work in the stream of the team's first device.
  void put(const std::vector<R>& rows, const DeviceTeam& team) {
    if (rows.empty()) return;
    Buffer& b = buffers_[next_ ^= 1];
    team.wait_for(b.copied, "walls' table");
    const std::size_t bytes = rows.size() * sizeof(R);
    std::memcpy(b.values, rows.data(), bytes);
    check_cuda(cudaMemcpyAsync(table_.data(), b.values, bytes, cudaMemcpyHostToDevice, team.stream()), "walls' table");
    check_cuda(cudaEventRecord(b.copied, team.stream()), "walls' table");
  }

 private:
  struct Buffer {
    R* values = nullptr;
    cudaEvent_t copied = nullptr;
  };
  void forget() {
    for (Buffer& b : buffers_) {
      if (b.values) cudaFreeHost(b.values);
      if (b.copied) cudaEventDestroy(b.copied);
      b = {};
    }
  }

  DeviceArray<R> table_;
  Buffer buffers_[2];
  int next_ = 0;
};

}  // namespace macadam::kernels
