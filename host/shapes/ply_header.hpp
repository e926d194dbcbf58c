// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ply_header.hpp  What a PLY file says of itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/shapes/surface_readers.hpp"

namespace macadam {

/// A number's type. Each is exact as a double.
struct PlyType {
  std::string_view name, other_name;
  std::size_t bytes;
  double low, high;  ///< of whole numbers; 0, 0 where it is not one of them

  bool whole() const { return high > 0; }
};

struct PlyProperty {
  std::string name;
  const PlyType* type;
  const PlyType* count = nullptr;  ///< of a list: its length's type
  int line;
};

struct PlyElement {
  std::string name;
  std::size_t items;
  std::vector<PlyProperty> properties;
  int line;

  /// The number of a property; empty where there is none.
  std::optional<std::size_t> find(std::string_view property) const;
};

struct PlyHeader {
  bool text = false, big_endian = false;
  std::vector<PlyElement> elements;
  std::size_t end = 0;  ///< the first byte after it
  int lines = 0;
};

/// \throws InputError naming the line, also where an element has more items than the bytes after the header can hold.
PlyHeader read_ply_header(const SurfaceFile& file);

}  // namespace macadam
