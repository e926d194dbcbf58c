// SPDX-License-Identifier: GPL-3.0-or-later
// picture.cpp  Draws letters of five by seven dots, and writes PNG with ITK.
#include "host/tools/ct/images/picture.hpp"

#include <itkPNGImageIO.h>

#include <algorithm>

#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

constexpr std::size_t dot_size = 2, glyph_columns = 5, glyph_rows = 7;  // pixels per dot, dots per letter
constexpr std::size_t advance = dot_size * (glyph_columns + 1);         // from letter to letter [pixels]
static_assert(dot_size * glyph_rows == label_height);

/// A letter as rows of dots.
struct Glyph {
  char letter;
  std::array<std::uint8_t, glyph_rows> dots;  ///< five bits per row; the leftmost dot is the highest bit
};

constexpr Glyph glyphs[] = {
    {'0', {0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110}},
    {'1', {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110}},
    {'2', {0b01110, 0b10001, 0b00001, 0b00010, 0b00100, 0b01000, 0b11111}},
    {'3', {0b11111, 0b00010, 0b00100, 0b00010, 0b00001, 0b10001, 0b01110}},
    {'4', {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010}},
    {'5', {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110}},
    {'6', {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110}},
    {'7', {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000}},
    {'8', {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110}},
    {'9', {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100}},
    {'.', {0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100}},
    {'m', {0b00000, 0b00000, 0b11010, 0b10101, 0b10101, 0b10101, 0b10101}},
    {'x', {0b00000, 0b00000, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001}},
    {'y', {0b00000, 0b00000, 0b10001, 0b10001, 0b01111, 0b00001, 0b01110}},
    {'z', {0b00000, 0b00000, 0b11111, 0b00010, 0b00100, 0b01000, 0b11111}},
};

}  // namespace

void Picture::fill(std::size_t x, std::size_t y, std::size_t wide, std::size_t high) {
  for (std::size_t j = y; j < std::min(height, y + high); ++j)
    for (std::size_t i = x; i < std::min(width, x + wide); ++i) at(i, j) = {0, 0, 0};
}

std::size_t label_width(std::string_view text) { return text.empty() ? 0 : advance * text.size() - dot_size; }

void write_label(Picture& picture, std::size_t x, std::size_t y, std::string_view text) {
  for (const char letter : text) {
    const Glyph* glyph = std::ranges::find(glyphs, letter, &Glyph::letter);
    for (std::size_t row = 0; glyph != std::end(glyphs) && row < glyph_rows; ++row) {
      for (std::size_t column = 0; column < glyph_columns; ++column)
        if (glyph->dots[row] >> (glyph_columns - 1 - column) & 1)
          picture.fill(x + dot_size * column, y + dot_size * row, dot_size, dot_size);
    }
    x += advance;
  }
}

void write_png(const std::filesystem::path& file, const Picture& picture) {
  const auto io = itk::PNGImageIO::New();
  io->SetFileName(file.string());
  io->SetNumberOfDimensions(2);
  io->SetDimensions(0, picture.width);
  io->SetDimensions(1, picture.height);
  io->SetNumberOfComponents(3);
  io->SetPixelType(itk::IOPixelEnum::RGB);
  io->SetComponentType(itk::IOComponentEnum::UCHAR);
  itk::ImageIORegion region(2);
  region.SetSize(0, picture.width);
  region.SetSize(1, picture.height);
  io->SetIORegion(region);
  try {
    io->Write(picture.pixels.data());
  } catch (const itk::ExceptionObject& error) {
    throw RunError(file.string() + ": cannot be written: " + error.GetDescription());
  }
}

}  // namespace macadam::ct
