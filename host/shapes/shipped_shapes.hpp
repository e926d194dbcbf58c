// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shipped_shapes.hpp  The files of examples/shapes, put into the library by cmake/embed_shapes.cmake.
#pragma once

#include <string_view>
#include <vector>

namespace macadam {

struct ShippedShape {
  std::string_view name;  ///< without its ending
  std::string_view off;   ///< the file's text
};

/// All of them, by name.
const std::vector<ShippedShape>& shipped_shapes();

}  // namespace macadam
