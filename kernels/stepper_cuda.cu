// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_cuda.cu  The step compiled for CUDA devices, and what devices there are.
#include "kernels/exec_cuda.hpp"
#include "kernels/stepper_impl.hpp"
#include "kernels/steppers.hpp"

namespace macadam::kernels {

std::unique_ptr<Stepper> make_cuda_stepper(const Specimen& specimen, const ContactNetwork& network,
                                           const std::array<std::optional<Law>, pair_types>& laws,
                                           const Inertia& inertia, const StepperOptions& options) {
  return make_in_precision<ExecCuda>(options.precision, specimen, network, laws, inertia, options);
}

std::vector<DeviceInfo> cuda_devices(std::string& status) {
  int count = 0;
  std::vector<DeviceInfo> devices;
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess) {
    status = std::string("no usable device: ") + cudaGetErrorString(error);
    return devices;
  }
  for (int i = 0; i < count; ++i) {
    cudaDeviceProp p{};
    if (cudaGetDeviceProperties(&p, i) != cudaSuccess) continue;
    devices.push_back(
        {p.name, 10 * p.major + p.minor, static_cast<std::int64_t>(p.totalGlobalMem), p.multiProcessorCount});
  }
  status = std::to_string(devices.size()) + (devices.size() == 1 ? " device answers" : " devices answer");
  return devices;
}

}  // namespace macadam::kernels
