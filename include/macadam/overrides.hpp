// SPDX-License-Identifier: GPL-3.0-or-later
/// \file overrides.hpp  Applies values given by the user that replace values in the scene.
#pragma once

#include <cstdint>
#include <optional>

#include "macadam/scene.hpp"

namespace macadam {

/// Options of commands and of Python. An empty option leaves the scene's value.
struct Overrides {
  std::optional<std::uint64_t> seed;
  std::optional<Backend> backend;
  std::optional<Precision> precision;
  std::optional<SolverMethod> method;
  std::optional<LinearMethod> linear;
  std::optional<int> threads;
  std::optional<DeviceList> devices;
};

/// Replaces values of the scene. \throws InputError if a seed is given but the scene takes its specimen from a file.
void apply(const Overrides& asked, Scene& scene);

}  // namespace macadam
