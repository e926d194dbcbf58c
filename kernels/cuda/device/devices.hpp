// SPDX-License-Identifier: GPL-3.0-or-later
/// \file devices.hpp  Declares the functions that find and measure CUDA devices. Only in builds with CUDA.
#pragma once

#include <string>

#include "macadam/backend.hpp"

namespace macadam::kernels {

/// Fills in the devices and the status of the report, without creating a context on any device.
void report_cuda_devices(BackendReport& report);
/// Returns why this device cannot run the kernels; empty if it can. Creates a context on it.
std::string cuda_refusal(int device);
/// Measures the bandwidths and the clock of a device; see macadam::measure_device().
DeviceSpeed measure_device(int device);

}  // namespace macadam::kernels
