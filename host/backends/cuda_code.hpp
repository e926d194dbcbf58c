// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_code.hpp  Gives access to the CUDA backend, which is a plugin.
#pragma once

#include <chrono>
#include <string>

#include "kernels/compiled/cuda_plugin.hpp"

namespace macadam {

/// Returns the code of the plugin, or nullptr without a plugin; `why` then gets the reason. The plugin is searched for
/// once, in the folders of MACADAM_PLUGIN_PATH (separated by colons) and then in the folder of the library itself.
const kernels::CudaCode* cuda_code(std::string* why = nullptr);

/// Time within which a machine without devices reports that it has none. Counting devices, if there are any, takes some
/// tenths of a second.
inline constexpr std::chrono::milliseconds none_is_known_within{50};

/// Returns the numbers of the devices that `asked` means for backend cuda: all, the first (if `asked` is empty), or the
/// named ones.
/// \throws InputError when a named device is not there.
DeviceList device_numbers(const DeviceList& asked);

}  // namespace macadam
