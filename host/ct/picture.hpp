// SPDX-License-Identifier: GPL-3.0-or-later
/// \file picture.hpp  Pictures of coloured pixels, with short labels, as PNG files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace macadam::ct {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A white picture; y runs downwards.
struct Picture {
  std::size_t width, height;  ///< [pixels]
  std::vector<Colour> pixels;

  Picture(std::size_t width, std::size_t height)
      : width(width), height(height), pixels(width * height, Colour{255, 255, 255}) {}
  Colour& at(std::size_t x, std::size_t y) { return pixels[x + width * y]; }
  /// Fills a rectangle with black, as far as it lies in the picture.
  void fill(std::size_t x, std::size_t y, std::size_t wide, std::size_t high);
};

constexpr std::size_t label_height = 14;  ///< of write_label() [pixels]

/// Width of a label [pixels].
std::size_t label_width(std::string_view text);

/// Writes digits, points, blanks and the letters m, x, y, z in black; (x, y) is the upper left corner. Other characters
/// stay blank.
void write_label(Picture& picture, std::size_t x, std::size_t y, std::string_view text);

/// \throws RunError where the file cannot be written.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace macadam::ct
