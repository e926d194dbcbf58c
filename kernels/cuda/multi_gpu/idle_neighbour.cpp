// SPDX-License-Identifier: GPL-3.0-or-later
// idle_neighbour.cpp  Decides whether a second device may be used although the user did not ask for it. Creates no
// context on that device.
#include <cuda_runtime.h>
#include <dlfcn.h>

#include <string>

#include "kernels/cuda/multi_gpu/idle_neighbour.hpp"

namespace macadam::kernels {
namespace {

/// NVML, NVIDIA's management library. It comes with the driver and has no header here. Its calls return 0 on success.
/// Any other result, for example on a machine that hides its processes, means that the device must not be taken.
class Management {
 public:
  Management() : library_(dlopen("libnvidia-ml.so.1", RTLD_NOW | RTLD_LOCAL)) {
    const auto init = function<int (*)()>("nvmlInit_v2");
    works_ = init && init() == 0;
  }
  Management(const Management&) = delete;
  ~Management() {
    const auto shutdown = works_ ? function<int (*)()>("nvmlShutdown") : nullptr;
    if (shutdown) shutdown();
    if (library_) dlclose(library_);
  }

  /// Returns whether no process computes on the device with this bus address.
  bool is_idle(const char* bus_address) const {
    if (!works_) return false;
    const auto find = function<int (*)(const char*, void**)>("nvmlDeviceGetHandleByPciBusId_v2");
    const auto processes = function<int (*)(void*, unsigned*, void*)>("nvmlDeviceGetComputeRunningProcesses_v3");
    void* device = nullptr;
    unsigned number = 0;  // no array is passed for the processes, so any running process gives an error
    return find && processes && find(bus_address, &device) == 0 && processes(device, &number, nullptr) == 0 &&
           number == 0;
  }

 private:
  template <class Function>
  Function function(const char* name) const {
    return library_ ? reinterpret_cast<Function>(dlsym(library_, name)) : nullptr;
  }
  void* library_;
  bool works_ = false;
};

/// Returns whether a call succeeded, and clears its error.
bool good(cudaError_t status) {
  if (status != cudaSuccess) cudaGetLastError();
  return status == cudaSuccess;
}
bool can_reach(int from, int to) {
  int can = 0;
  return good(cudaDeviceCanAccessPeer(&can, from, to)) && can;
}

}  // namespace

bool cuda_idle_beside(int device, int first) {
  cudaDeviceProp a{}, b{};
  if (!good(cudaGetDeviceProperties(&a, device)) || !good(cudaGetDeviceProperties(&b, first))) return false;
  const bool alike = std::string(a.name) == b.name && a.multiProcessorCount == b.multiProcessorCount;
  char address[32];  // 0000:00:00.0
  return alike && can_reach(device, first) && can_reach(first, device) &&
         good(cudaDeviceGetPCIBusId(address, sizeof address, device)) && Management().is_idle(address);
}

}  // namespace macadam::kernels
