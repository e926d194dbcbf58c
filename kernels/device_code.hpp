// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_code.hpp  Which devices a build has code for, by the list that CMake was given.
#pragma once

#include <algorithm>
#include <charconv>
#include <string_view>

namespace macadam::kernels {

/// `list`: of CMAKE_CUDA_ARCHITECTURES, parted by commas: "75-virtual,90-real", "86", "native". Machine code serves its
/// generation from its own version on, virtual code every later device. What is no number may fit: the device then
/// says so when it is used.
inline bool has_code_for(std::string_view list, int major, int minor) {
  while (!list.empty()) {
    std::string_view one = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), one.size() + 1));
    int number = 0;
    const auto [rest, error] = std::from_chars(one.data(), one.data() + one.size(), number);
    if (error != std::errc{}) return true;
    one.remove_prefix(static_cast<std::size_t>(rest - one.data()));
    const bool letter = !one.empty() && one.front() != '-';  // 90a, 100f: for that one alone, or its family
    const bool same = number == 10 * major + minor;
    const bool machine = one != "-virtual" && number / 10 == major && number % 10 <= minor;
    const bool later = one != "-real" && number <= 10 * major + minor;
    if (letter ? same : machine || later) return true;
  }
  return false;
}

}  // namespace macadam::kernels
