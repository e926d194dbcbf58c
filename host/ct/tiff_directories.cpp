// SPDX-License-Identifier: GPL-3.0-or-later
// tiff_directories.cpp  Both kinds of TIFF, with numbers of 4 and of 8 bytes for places, in either order of bytes.
#include "host/ct/tiff_directories.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Of a value, by the number of its type; 0: no type.
constexpr std::uint64_t bytes_of_type[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};

/// Whole numbers in a file, wherever they stand.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    char order[2] = {};
    in_.read(order, 2);
    big_endian_ = order[0] == 'M';
  }

  /// Of so many bytes from `place` on; good() is false where the file has none there.
  std::uint64_t at(std::uint64_t place, int bytes) {
    unsigned char raw[8] = {};
    in_.seekg(static_cast<std::streamoff>(place));
    in_.read(reinterpret_cast<char*>(raw), bytes);
    std::uint64_t out = 0;
    for (int k = 0; k < bytes; ++k) out = out << 8 | raw[big_endian_ ? k : bytes - 1 - k];
    return out;
  }
  bool good() const { return in_.good(); }

 private:
  std::ifstream in_;
  bool big_endian_ = false;
};

/// Texts whose end libtiff sees to: names of the document, the maker, the program and the like (TIFF 6.0).
constexpr std::uint64_t known_texts[] = {269, 270, 271, 272, 285, 305, 306, 315, 316, 333, 337, 33432};

constexpr std::uint64_t bits_per_sample = 258, samples_per_pixel = 277;

/// The tag whose entry in a directory begins at `entry`; its number.
std::uint64_t check_tag(const std::filesystem::path& file, Numbers& numbers, std::uint64_t size, bool wide,
                        std::uint64_t entry) {
  constexpr std::uint64_t text = 2;
  const std::uint64_t place_bytes = wide ? 8 : 4;
  const std::uint64_t tag = numbers.at(entry, 2), type = numbers.at(entry + 2, 2);
  const std::uint64_t values = numbers.at(entry + 4, static_cast<int>(place_bytes));
  const std::uint64_t bytes = type < std::size(bytes_of_type) ? bytes_of_type[type] : 0;
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw InputError(file.string(), 0, "tag " + std::to_string(tag) + " of the TIFF file", found, expected);
  };
  if (bytes > 0 && values > size / bytes)
    refuse(std::to_string(values) + " values of " + std::to_string(bytes) + " bytes",
           "as many as the " + std::to_string(size) + " bytes of the file hold");
  const std::uint64_t inside = entry + 4 + place_bytes;
  const std::uint64_t value = bytes > 0 ? numbers.at(inside, static_cast<int>(bytes)) : 0;
  if (tag == samples_per_pixel && value != 1)
    refuse(std::to_string(value) + " values a voxel", "one grey value a voxel");
  if (tag == bits_per_sample && value != 8 && value != 16 && value != 32 && value != 64)
    refuse(std::to_string(value) + " bits a voxel", "8, 16, 32 or 64");
  const bool known = std::ranges::count(known_texts, tag) > 0;
  if (known && type != text) refuse("type " + std::to_string(type), "a text, type " + std::to_string(text));
  if (type != text || values == 0 || known) return tag;
  const std::uint64_t begin = values <= place_bytes ? inside : numbers.at(inside, static_cast<int>(place_bytes));
  if (begin >= size || values > size - begin || numbers.at(begin + values - 1, 1) != 0)
    refuse("a text without an end", "a last byte of 0");
  return tag;
}

}  // namespace

void check_tiff_directories(const std::filesystem::path& file) {
  Numbers numbers(file);
  const std::uint64_t version = numbers.at(2, 2);
  const bool wide = version == 43;
  if (!numbers.good() || (version != 42 && !wide)) return;
  const int place_bytes = wide ? 8 : 4, count_bytes = wide ? 8 : 2, entry_bytes = wide ? 20 : 12;
  const std::uint64_t size = std::filesystem::file_size(file);
  std::set<std::uint64_t> seen;
  for (std::uint64_t place = numbers.at(wide ? 8 : 4, place_bytes); numbers.good() && place != 0;) {
    if (!seen.insert(place).second)
      throw InputError(file.string(), 0, "directories of the TIFF file", "byte " + std::to_string(place) + " again",
                       "a chain that ends");
    const std::uint64_t entries = place < size ? numbers.at(place, count_bytes) : 0;
    if (place >= size || !numbers.good() || entries > (size - place) / static_cast<std::uint64_t>(entry_bytes))
      throw InputError(file.string(), 0, "directories of the TIFF file",
                       "one at byte " + std::to_string(place) + " with " + std::to_string(entries) + " entries",
                       "as many as the " + std::to_string(size) + " bytes of the file hold");
    bool says_bits = false;
    for (std::uint64_t e = 0; e < entries; ++e)
      if (check_tag(file, numbers, size, wide,
                    place + static_cast<std::uint64_t>(count_bytes) + e * static_cast<std::uint64_t>(entry_bytes)) ==
          bits_per_sample)
        says_bits = true;
    if (!says_bits)  // libtiff takes 1 then, for which ITK has no room
      throw InputError(file.string(), 0, "directories of the TIFF file",
                       "one at byte " + std::to_string(place) + " without the bits of a voxel (tag 258)",
                       "one with them");
    place =
        numbers.at(place + static_cast<std::uint64_t>(count_bytes) + entries * static_cast<std::uint64_t>(entry_bytes),
                   place_bytes);
  }
}

}  // namespace macadam::ct
