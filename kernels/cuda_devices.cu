// SPDX-License-Identifier: GPL-3.0-or-later
// cuda_devices.cu  What CUDA devices answer.
#include <cuda_runtime.h>

#include "kernels/steppers.hpp"

namespace macadam::kernels {

/// Asked whether the device has code for it: compiled for it, or to be compiled by its driver.
__global__ void probe() {}

std::vector<DeviceInfo> cuda_devices(std::string& status) {
  int count = 0;
  std::vector<DeviceInfo> devices;
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess) {
    status = std::string("no usable device: ") + cudaGetErrorString(error);
    return devices;
  }
  for (int i = 0; i < count; ++i) {
    cudaDeviceProp p{};
    if (cudaGetDeviceProperties(&p, i) != cudaSuccess || cudaSetDevice(i) != cudaSuccess) continue;
    cudaFuncAttributes attributes{};
    if (cudaFuncGetAttributes(&attributes, probe) != cudaSuccess) {
      status = std::string(p.name) + " cannot run this build's kernels: " + cudaGetErrorString(cudaGetLastError());
      continue;
    }
    devices.push_back(
        {p.name, 10 * p.major + p.minor, static_cast<std::int64_t>(p.totalGlobalMem), p.multiProcessorCount});
  }
  if (devices.empty()) return devices;
  cudaSetDevice(0);
  status = std::to_string(devices.size()) + (devices.size() == 1 ? " device answers" : " devices answer");
  return devices;
}

}  // namespace macadam::kernels
