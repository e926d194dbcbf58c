// SPDX-License-Identifier: GPL-3.0-or-later
/// \file picture.hpp  Defines a picture of coloured pixels with short labels, and writes it as a PNG file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace macadam::ct {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A picture, initially white; y increases downwards.
struct Picture {
  std::size_t width, height;  ///< [pixels]
  std::vector<Colour> pixels;

  Picture(std::size_t width, std::size_t height)
      : width(width), height(height), pixels(width * height, Colour{255, 255, 255}) {}
  Colour& at(std::size_t x, std::size_t y) { return pixels[x + width * y]; }
  /// Fills a rectangle with black; the part outside the picture is ignored.
  void fill(std::size_t x, std::size_t y, std::size_t wide, std::size_t high);
};

constexpr std::size_t label_height = 14;  ///< height of the letters of write_label() [pixels]

/// Returns the width of a label [pixels].
std::size_t label_width(std::string_view text);

/// Draws digits, points, blanks and the letters m, x, y, z in black; (x, y) is the upper left corner. Other characters
/// are left blank.
void write_label(Picture& picture, std::size_t x, std::size_t y, std::string_view text);

/// Writes the picture. \throws RunError if the file cannot be written.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace macadam::ct
