// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_code.hpp  Gives access to the CUDA backend, which is a plugin.
#pragma once

#include <chrono>
#include <string>

#include "kernels/compiled/cuda_plugin.hpp"

namespace macadam {

/// Returns the function table of the plugin. Without a usable plugin, returns nullptr and stores the reason in `why`.
/// The plugin is searched for once, in the folders of MACADAM_PLUGIN_PATH (separated by colons) and then in the folder
/// of the library itself.
const kernels::CudaCode* cuda_code(std::string* why = nullptr);

/// On a machine without devices, CUDA reports within this time that no device exists. If there are devices, counting
/// them takes some tenths of a second.
inline constexpr std::chrono::milliseconds none_is_known_within{50};

/// Returns the numbers of the devices that `asked` means for backend cuda: all devices, the first device (if `asked` is
/// empty), or the named devices. \throws InputError when a named device is not there.
DeviceList device_numbers(const DeviceList& asked);

}  // namespace macadam
