// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_plugin.hpp  Declares the interface of libmacadam_cuda.so: all functions that the library needs from CUDA.
#pragma once

#include <memory>
#include <string>

#include "kernels/harmonic/linear_system.hpp"
#include "kernels/quasi_static/increment_system.hpp"
#include "macadam/backend.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// The functions of the plugin.
struct CudaCode {
  /// Fills in the devices and the status of the report, without creating a context on any device.
  void (*report)(BackendReport& report);
  /// Returns why this device cannot run the kernels; empty if it can. Creates a context on it.
  std::string (*refusal)(int device);
  /// Returns whether `device` is idle and could share a specimen with `first`; see cuda_idle_beside().
  bool (*idle_beside)(int device, int first);
  /// Makes a stepper. The arguments are those of make_stepper(); precision and devices are in the options.
  std::unique_ptr<Stepper> (*make_stepper)(const Specimen& specimen, const ContactNetwork& network,
                                           const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                           std::unique_ptr<Stepper> used);
  /// Makes a solver of the frequency domain that distributes the linear system over the devices. `singular_body`: set
  /// to the first body whose own stiffness is singular, else −1. \throws RunError if a device has too little memory.
  std::unique_ptr<DeviceSolver> (*make_solver)(const LinearSystem& system, const DeviceList& devices,
                                               std::int64_t& singular_body);
  /// Makes the operations of quasi-static increments on a device; see make_device_increments().
  std::unique_ptr<DeviceIncrements> (*make_increments)(const IncrementSystem& system, int device);
  /// Measures the bandwidths and the clock of a device.
  DeviceSpeed (*measure)(int device);
};

/// The symbol that the plugin exports, with the C name `macadam_cuda_plugin`. The first two members never change, so
/// that any library can decide whether it can use the third.
struct CudaPlugin {
  int interface;        ///< cuda_interface of the plugin's build
  const char* version;  ///< version of Macadam
  const CudaCode* code;
};

/// Version of the interface; increases with every change of CudaCode, or of the types in its functions.
inline constexpr int cuda_interface = 9;

}  // namespace macadam::kernels
