// SPDX-License-Identifier: GPL-3.0-or-later
/// \file values.hpp  Gives access to the coefficients of any law by name, for reading, shifting with temperature and
/// calibration.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

#include "macadam/laws/all.hpp"

namespace macadam::laws {

/// Calls f(name, value, kind, need) for every coefficient of a law, under the names of `each_parameter`: E_1 is the
/// first of the list `E`.
template <class L, class F>
void each_value(L& law, F&& f) {
  law.each_key([&](const char* key, auto& member, ValueKind kind, ValueNeed need) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>) {
      f(std::string(key), member, kind, need);
    } else {
      for (std::size_t l = 0; l < member.size(); ++l) {
        f(std::string(key) + "_" + std::to_string(l + 1), member[l], kind, need);
      }
    }
  });
}

/// Returns whether every coefficient is positive, and finite unless it may be infinite.
inline bool usable(const Law& law) {
  bool good = true;
  std::visit(
      [&](auto l) {
        each_value(l, [&](const std::string&, double& value, ValueKind, ValueNeed need) {
          good = good && value > 0 && (std::isfinite(value) || need == ValueNeed::may_be_infinite);
        });
      },
      law);
  return good;
}

/// Returns whether a law has viscosities. Only these change with temperature.
inline bool flows(const Law& law) {
  bool out = false;
  std::visit(
      [&](auto l) {
        l.each_key([&](const char*, auto&, ValueKind kind, ValueNeed) { out = out || kind == ValueKind::viscosity; });
      },
      law);
  return out;
}

}  // namespace macadam::laws
