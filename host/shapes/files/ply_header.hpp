// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ply_header.hpp  Reads the header of a PLY file: its format and the elements and properties that it declares.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/shapes/files/surface_readers.hpp"

namespace macadam {

/// A number type of PLY. A double can hold every value of every type exactly.
struct PlyType {
  std::string_view name, other_name;
  std::size_t bytes;
  double low, high;  ///< range of an integer type; 0 and 0 for floating-point types

  /// Returns whether the type is an integer type.
  bool is_integer() const { return high > 0; }
};

/// One property of an element: a number, or a list of numbers.
struct PlyProperty {
  std::string name;
  const PlyType* type;
  const PlyType* count = nullptr;  ///< type of the list's length; null if the property is not a list
  int line;
};

/// One element, such as `vertex` or `face`: how many items it has and the properties of each item.
struct PlyElement {
  std::string name;
  std::size_t items;
  std::vector<PlyProperty> properties;
  int line;

  /// Returns the index of a property, if there is one of this name.
  std::optional<std::size_t> find(std::string_view property) const;
};

/// The header of a PLY file.
struct PlyHeader {
  bool text = false, big_endian = false;
  std::vector<PlyElement> elements;
  std::size_t end = 0;  ///< offset of the first byte after the header
  int lines = 0;
};

/// Reads and checks the header. \throws InputError naming the line if the header is not valid, or if an element has
/// more items than the bytes after the header can hold.
PlyHeader read_ply_header(const SurfaceFile& file);

}  // namespace macadam
