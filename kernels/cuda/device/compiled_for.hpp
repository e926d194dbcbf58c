// SPDX-License-Identifier: GPL-3.0-or-later
/// \file compiled_for.hpp  Determines which devices can run the code of a build, from the list of architectures given
/// to CMake.
#pragma once

#include <algorithm>
#include <charconv>
#include <string_view>

namespace macadam::kernels {

/// Returns whether a device of compute capability major.minor can run a build. `list`: CMAKE_CUDA_ARCHITECTURES,
/// separated by commas: "75-virtual,90-real", "86", "native". Machine code runs on devices of the same major version
/// from its own minor version on; virtual code runs on every later device. An entry that is not a number counts as
/// suitable; if it is not, the device reports an error when it is used.
inline bool has_code_for(std::string_view list, int major, int minor) {
  while (!list.empty()) {
    std::string_view one = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), one.size() + 1));
    int number = 0;
    const auto [rest, error] = std::from_chars(one.data(), one.data() + one.size(), number);
    if (error != std::errc{}) return true;
    one.remove_prefix(static_cast<std::size_t>(rest - one.data()));
    const bool letter = !one.empty() && one.front() != '-';  // 90a, 100f: only for that architecture, or its family
    const bool same = number == 10 * major + minor;
    const bool machine = one != "-virtual" && number / 10 == major && number % 10 <= minor;
    const bool later = one != "-real" && number <= 10 * major + minor;
    if (letter ? same : machine || later) return true;
  }
  return false;
}

}  // namespace macadam::kernels
