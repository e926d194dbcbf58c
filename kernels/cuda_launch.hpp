// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_launch.hpp  Errors of the CUDA runtime, and arrays that live on the device.
#pragma once

#include <cuda_runtime.h>
#include <nvtx3/nvToolsExt.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "kernels/state_list.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// \throws RunError naming what was done and what CUDA says.
inline void check_cuda(cudaError_t status, const char* what) {
  if (status != cudaSuccess) throw RunError(std::string("CUDA: ") + what + ": " + cudaGetErrorString(status));
}

/// A named stretch of the host's work, for profilers that read NVTX.
class Range {
 public:
  explicit Range(const char* name) { nvtxRangePushA(name); }
  Range(const Range&) = delete;
  ~Range() { nvtxRangePop(); }
};

/// Whether MACADAM_CUDA_SYNC is set: then the host waits for every kernel, and an error names the one that failed.
inline bool waits_for_launches() {
  static const bool set = std::getenv("MACADAM_CUDA_SYNC") != nullptr;
  return set;
}

/// Every launch of a kernel ends here.
inline void check_launch(const char* name, cudaStream_t stream) {
  check_cuda(cudaGetLastError(), name);
  if (waits_for_launches()) check_cuda(cudaStreamSynchronize(stream), name);
}

/// Launches a kernel in a stream and checks the launch; an empty grid is no launch.
template <class... Parameters, class... Arguments>
void launch(const char* name, void (*kernel)(Parameters...), std::size_t blocks, unsigned threads, std::size_t shared,
            cudaStream_t stream, Arguments&&... arguments) {
  if (blocks == 0) return;
  kernel<<<static_cast<unsigned>(blocks), threads, shared, stream>>>(std::forward<Arguments>(arguments)...);
  check_launch(name, stream);
}
/// The same for blocks that wait for one another: all are on the device at once, or the launch fails.
template <class... Parameters>
void launch_together(const char* name, void (*kernel)(Parameters...), std::size_t blocks, unsigned threads,
                     std::size_t shared, cudaStream_t stream, Parameters... parameters) {
  void* list[] = {&parameters...};
  check_cuda(cudaLaunchCooperativeKernel(kernel, static_cast<unsigned>(blocks), threads, list, shared, stream), name);
  check_launch(name, stream);
}

/// What a launch of a kernel takes of a multiprocessor. `shared`: dynamic shared memory [bytes].
template <class... Parameters>
KernelUse kernel_use(const char* name, void (*kernel)(Parameters...), unsigned threads, std::size_t shared) {
  cudaFuncAttributes attributes{};
  check_cuda(cudaFuncGetAttributes(&attributes, kernel), name);
  int blocks = 0, most_threads = 0;
  check_cuda(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, static_cast<int>(threads), shared), name);
  int device = 0;
  check_cuda(cudaGetDevice(&device), name);
  check_cuda(cudaDeviceGetAttribute(&most_threads, cudaDevAttrMaxThreadsPerMultiProcessor, device), name);
  return {name, attributes.numRegs, static_cast<std::int64_t>(attributes.sharedSizeBytes + shared),
          static_cast<double>(blocks) * threads / most_threads};
}

/// An array on the device, zero at first, from its making to its end.
template <class T>
class DeviceArray {
 public:
  DeviceArray() = default;
  explicit DeviceArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    if (const cudaError_t status = cudaMalloc(&data_, bytes()); status != cudaSuccess) {
      cudaGetLastError();
      std::size_t free = 0, total = 0;
      cudaMemGetInfo(&free, &total);
      throw RunError("CUDA: the device has " + std::to_string(free >> 20) + " of " + std::to_string(total >> 20) +
                     " MiB left, and the next array needs " + std::to_string(bytes() >> 20) +
                     " MiB: " + cudaGetErrorString(status));
    }
    clear();
  }
  template <class Array>
  static DeviceArray of(const Array& host) {
    DeviceArray out(host.size());
    out.upload(host.data());
    return out;
  }
  DeviceArray(DeviceArray&& other) noexcept : data_(std::exchange(other.data_, nullptr)), size_(other.size_) {}
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~DeviceArray() { cudaFree(data_); }

  void clear() {
    if (size_ > 0) check_cuda(cudaMemset(data_, 0, bytes()), "clearing an array");
  }
  void upload(const T* host) {
    if (size_ > 0) check_cuda(cudaMemcpy(data_, host, bytes(), cudaMemcpyHostToDevice), "copy to the device");
  }
  std::vector<T> download() const {
    std::vector<T> out(size_);
    if (size_ > 0) check_cuda(cudaMemcpy(out.data(), data_, bytes(), cudaMemcpyDeviceToHost), "copy from the device");
    return out;
  }
  T* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Adds an array on the device, which must stay where it is, to what a checkpoint copies and replaces.
template <class T>
void add_device_state(StateList& states, const std::string& name, const std::string& unit, T* data, std::size_t size,
                      StateList::Order order = {}) {
  const std::size_t bytes = size * sizeof(T);
  states.add<T>(
      name, unit, size,
      [=] {
        std::vector<T> out(size);
        check_cuda(cudaMemcpy(out.data(), data, bytes, cudaMemcpyDeviceToHost), "copy of the state");
        return out;
      },
      [=](const std::vector<T>& values) {
        check_cuda(cudaMemcpy(data, values.data(), bytes, cudaMemcpyHostToDevice), "setting the state");
      },
      std::move(order));
}

}  // namespace macadam::kernels
