// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shipped_shapes.hpp  Gives access to the surface files of examples/shapes, which cmake/embed_shapes.cmake
/// compiles into the library.
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
