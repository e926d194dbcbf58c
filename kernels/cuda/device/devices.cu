// SPDX-License-Identifier: GPL-3.0-or-later
// devices.cu  Finds the CUDA devices, and checks whether a device can be used. Creates a CUDA context only on a device
// that will be used.
#include <cuda_runtime.h>

#include <string>

#include "kernels/cuda/device/compiled_for.hpp"
#include "kernels/cuda/device/devices.hpp"

namespace macadam::kernels {

/// Empty kernel; its attributes show whether the device runs code of this build.
__global__ void probe() {}

void report_cuda_devices(BackendReport& report) {
  int count = 0;
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess) {
    report.cuda_status = std::string("no usable device: ") + cudaGetErrorString(error);
    cudaGetLastError();
    return;
  }
  for (int i = 0; i < count; ++i) {
    cudaDeviceProp p{};
    if (cudaGetDeviceProperties(&p, i) != cudaSuccess) continue;
    const DeviceInfo device{i, p.name, 10 * p.major + p.minor, static_cast<std::int64_t>(p.totalGlobalMem),
                            p.multiProcessorCount};
    (has_code_for(MACADAM_CUDA_CODE, p.major, p.minor) ? report.devices : report.devices_without_code)
        .push_back(device);
  }
  const std::size_t usable = report.devices.size();
  if (usable > 0) {
    report.cuda_status = std::to_string(usable) + (usable == 1 ? " device answers" : " devices answer");
  } else if (report.devices_without_code.empty()) {
    report.cuda_status = "no usable device: none answers";
  } else {
    report.cuda_status = report.devices_without_code.front().name + " cannot run this build's kernels, which are for " +
                         MACADAM_CUDA_CODE;
  }
}

std::string cuda_refusal(int device) {
  cudaFuncAttributes attributes{};
  cudaError_t error = cudaSetDevice(device);
  if (error == cudaSuccess) error = cudaFuncGetAttributes(&attributes, probe);
  if (error == cudaSuccess) return "";
  cudaGetLastError();
  return cudaGetErrorString(error);
}

}  // namespace macadam::kernels
