// SPDX-License-Identifier: GPL-3.0-or-later
/// \file png_picture.hpp  Reads the RGB PNG files that the program writes.
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace macadam::test {

struct PngPicture {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> bytes;  ///< red, green and blue of each pixel, from left to right and from the top down
  std::array<std::uint8_t, 3> at(std::size_t x, std::size_t y) const {
    const std::size_t first = 3 * (x + width * y);
    return {bytes.at(first), bytes.at(first + 1), bytes.at(first + 2)};
  }
};

/// \throws std::runtime_error if the file does not have 8 bits of red, green and blue per pixel.
inline PngPicture read_png(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(file.at(at)); };
  const auto number = [&](std::size_t at) {
    return std::size_t{byte(at)} << 24 | std::size_t{byte(at + 1)} << 16 | std::size_t{byte(at + 2)} << 8 |
           byte(at + 3);
  };
  if (file.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0) throw std::runtime_error("no PNG file");
  if (byte(24) != 8 || byte(25) != 2 || byte(28) != 0) throw std::runtime_error("not 8 bits a colour, as rows");
  PngPicture out{number(16), number(20), {}};
  std::string packed;
  for (std::size_t at = 8; at < file.size(); at += 12 + number(at))
    if (file.compare(at + 4, 4, "IDAT") == 0) packed += file.substr(at + 8, number(at));
  const std::size_t row = 3 * out.width;
  std::vector<std::uint8_t> rows(out.height * (row + 1));
  uLongf size = rows.size();
  if (uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
      size != rows.size())
    throw std::runtime_error("rows that cannot be unpacked");
  out.bytes.resize(out.height * row);
  for (std::size_t y = 0; y < out.height; ++y) {
    const std::uint8_t filter = rows[y * (row + 1)];
    for (std::size_t n = 0; n < row; ++n) {
      std::uint8_t* here = &out.bytes[y * row + n];
      const int left = n < 3 ? 0 : here[-3], up = y == 0 ? 0 : *(here - row),
                corner = n < 3 || y == 0 ? 0 : *(here - row - 3);
      const int a = std::abs(up - corner), b = std::abs(left - corner), c = std::abs(left + up - 2 * corner);
      const int nearest = a <= b && a <= c ? left : b <= c ? up : corner;
      const int foretold[] = {0, left, up, (left + up) / 2, nearest};
      *here = static_cast<std::uint8_t>(rows[y * (row + 1) + 1 + n] + foretold[filter % 5]);
    }
  }
  return out;
}

}  // namespace macadam::test
