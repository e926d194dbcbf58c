// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_code.hpp  The CUDA backend, where its plugin is found.
#pragma once

#include <string>

#include "kernels/cuda_plugin.hpp"

namespace macadam {

/// The plugin's code, or nullptr where there is none; `why` then says it. It is looked for once: in the folders that
/// MACADAM_PLUGIN_PATH names, with colons between them, then beside the library itself.
const kernels::CudaCode* cuda_code(std::string* why = nullptr);

/// The numbers of the devices that are meant, where cuda is the backend: all, the first, or those that are named.
/// \throws InputError for one that is not there.
DeviceList device_numbers(const DeviceList& asked);

}  // namespace macadam
