// SPDX-License-Identifier: GPL-3.0-or-later
/// \file launch.hpp  Checks errors of the CUDA runtime, and launches kernels.
#pragma once

#include <cuda_runtime.h>
#include <nvtx3/nvToolsExt.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Throws if a call of the CUDA runtime has failed. \throws RunError with `what`, the action that failed, and CUDA's
/// message.
inline void check_cuda(cudaError_t status, const char* what) {
  if (status != cudaSuccess) throw RunError(std::string("CUDA: ") + what + ": " + cudaGetErrorString(status));
}

/// copy_now() copies memory to, from or within a device; clear_now() sets memory to zero. Both functions wait until the
/// copy or reset has finished, but not for other work of the device, because several specimens may share the device. No
/// kernel may be using the memory.
inline void copy_now(void* to, const void* from, std::size_t bytes, const char* what) {
  check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, cudaStreamPerThread), what);
  check_cuda(cudaStreamSynchronize(cudaStreamPerThread), what);
}
inline void clear_now(void* data, std::size_t bytes, const char* what) {
  check_cuda(cudaMemsetAsync(data, 0, bytes, cudaStreamPerThread), what);
  check_cuda(cudaStreamSynchronize(cudaStreamPerThread), what);
}

/// A named range of the host's work, for profilers that read NVTX.
class Range {
 public:
  explicit Range(const char* name) { nvtxRangePushA(name); }
  Range(const Range&) = delete;
  ~Range() { nvtxRangePop(); }
};

/// Returns whether MACADAM_CUDA_SYNC is set: then the host waits for every kernel, so that an error names the kernel
/// that failed.
inline bool waits_for_launches() {
  static const bool set = std::getenv("MACADAM_CUDA_SYNC") != nullptr;
  return set;
}

/// Checks a launch; called after every launch of a kernel.
inline void check_launch(const char* name, cudaStream_t stream) {
  check_cuda(cudaGetLastError(), name);
  if (waits_for_launches()) check_cuda(cudaStreamSynchronize(stream), name);
}

/// Launches a kernel in a stream and checks the launch. Does nothing if `blocks` is 0.
template <class... Parameters, class... Arguments>
void launch(const char* name, void (*kernel)(Parameters...), std::size_t blocks, unsigned threads, std::size_t shared,
            cudaStream_t stream, Arguments&&... arguments) {
  if (blocks == 0) return;
  kernel<<<static_cast<unsigned>(blocks), threads, shared, stream>>>(std::forward<Arguments>(arguments)...);
  check_launch(name, stream);
}
/// Launches thread blocks that wait for one another, and possibly for thread blocks of another device. Either all
/// blocks of the launch are on the device at the same time, or the launch fails. The caller checks errors once all
/// launches are made.
template <class... Parameters>
void launch_together(const char* name, void (*kernel)(Parameters...), std::size_t blocks, unsigned threads,
                     std::size_t shared, cudaStream_t stream, Parameters... parameters) {
  void* list[] = {&parameters...};
  if (blocks == 0) return;
  check_cuda(cudaLaunchCooperativeKernel(kernel, static_cast<unsigned>(blocks), threads, list, shared, stream), name);
}

/// Returns the resources that a kernel uses on a multiprocessor. `shared`: dynamic shared memory [bytes].
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

}  // namespace macadam::kernels
