// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_code.hpp  The CUDA backend, where its plugin is found.
#pragma once

#include <chrono>
#include <string>

#include "kernels/cuda_plugin.hpp"

namespace macadam {

/// The plugin's code, or nullptr where there is none; `why` then says it. It is looked for once: in the folders that
/// MACADAM_PLUGIN_PATH names, with colons between them, then beside the library itself.
const kernels::CudaCode* cuda_code(std::string* why = nullptr);

/// Devices take some tenths of a second to be counted. Where none is there, that is known within so long.
inline constexpr std::chrono::milliseconds none_is_known_within{50};

/// The numbers of the devices that are meant, where cuda is the backend: all, the first, or those that are named.
/// \throws InputError for one that is not there.
DeviceList device_numbers(const DeviceList& asked);

}  // namespace macadam
