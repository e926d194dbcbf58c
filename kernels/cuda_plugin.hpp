// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_plugin.hpp  Everything that the library asks of CUDA, as a library of its own has it: libmacadam_cuda.so.
#pragma once

#include <memory>
#include <string>

#include "kernels/harmonic/linear_system.hpp"
#include "macadam/backend.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

struct CudaCode {
  /// Fills the report's devices and status, without a context on any of them.
  void (*report)(BackendReport& report);
  /// Why this device cannot run the kernels, as the one that is to; empty where it can.
  std::string (*refusal)(int device);
  /// Whether `device` could help `first` with a specimen: as cuda_idle_beside().
  bool (*idle_beside)(int device, int first);
  /// Other arguments as make_stepper(); the options' precision and device.
  std::unique_ptr<Stepper> (*make_stepper)(const Specimen& specimen, const ContactNetwork& network,
                                           const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                           std::unique_ptr<Stepper> used);
  /// Spreads the system over the devices, of known numbers. `loose`: set to the first body whose own stiffness is
  /// singular, else −1. \throws RunError where a device has too little memory.
  std::unique_ptr<DeviceSolver> (*make_solver)(const LinearSystem& system, const DeviceList& devices,
                                               std::int64_t& loose);
  DeviceSpeed (*measure)(int device);
};

/// What the plugin exports, under the C name `macadam_cuda_plugin`. The first two members stay what they are, so that
/// any library can tell whether it may use the third.
struct CudaPlugin {
  int interface;        ///< cuda_interface of its build
  const char* version;  ///< of Macadam
  const CudaCode* code;
};

/// Counted up with every change of CudaCode, or of what it is handed.
inline constexpr int cuda_interface = 7;

}  // namespace macadam::kernels
