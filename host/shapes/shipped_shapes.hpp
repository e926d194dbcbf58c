// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shipped_shapes.hpp  The surface files of examples/shapes, compiled into the library by
/// cmake/embed_shapes.cmake.
#pragma once

#include <string_view>
#include <vector>

namespace macadam {

/// One shipped surface, in the OFF format.
struct ShippedShape {
  std::string_view name;  ///< file name without the ending
  std::string_view off;   ///< content of the file
};

/// Returns all shipped shapes, ordered by name.
const std::vector<ShippedShape>& shipped_shapes();

}  // namespace macadam
