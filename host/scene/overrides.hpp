// SPDX-License-Identifier: GPL-3.0-or-later
/// \file overrides.hpp  What whoever runs a scene asks for instead of the scene's own.
#pragma once

#include <cstdint>
#include <optional>

#include "macadam/scene.hpp"

namespace macadam {

/// Options of commands, and of Python; none: as the scene has it.
struct Overrides {
  std::optional<std::uint64_t> seed;
  std::optional<Backend> backend;
  std::optional<Precision> precision;
  std::optional<SolverMethod> method;
  std::optional<LinearMethod> linear;
  std::optional<int> threads;
  std::optional<DeviceList> devices;
};

/// Changes the scene. \throws InputError for a seed of a scene that takes its specimen from a file.
void apply(const Overrides& asked, Scene& scene);

}  // namespace macadam
