// SPDX-License-Identifier: GPL-3.0-or-later
// tiff_directories.cpp  Reads both kinds of TIFF, classic (file offsets of 4 bytes) and BigTIFF (8 bytes), in either
// byte order.
#include "host/tools/ct/images/tiff_directories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Bytes per value, indexed by the TIFF type number; 0 for numbers that are not a type.
constexpr std::uint64_t bytes_of_type[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};

/// Reads whole numbers and texts at any byte of a file, in the file's byte order.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    char order[2] = {};
    in_.read(order, 2);
    big_endian_ = order[0] == 'M';
  }

  /// Returns the number stored in the `bytes` bytes at `place`. Afterwards good() is false if the file ends before
  /// them.
  std::uint64_t at(std::uint64_t place, int bytes) {
    unsigned char raw[8] = {};
    in_.seekg(static_cast<std::streamoff>(place));
    in_.read(reinterpret_cast<char*>(raw), bytes);
    std::uint64_t out = 0;
    for (int k = 0; k < bytes; ++k) out = out << 8 | raw[big_endian_ ? k : bytes - 1 - k];
    return out;
  }
  /// Returns the text in the `bytes` bytes at `place`, cut at 4096 bytes.
  std::string text(std::uint64_t place, std::uint64_t bytes) {
    std::string out(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, 4096)), '\0');
    in_.seekg(static_cast<std::streamoff>(place));
    in_.read(out.data(), static_cast<std::streamsize>(out.size()));
    return out;
  }
  bool good() const { return in_.good(); }
  bool big_endian() const { return big_endian_; }

 private:
  std::ifstream in_;
  bool big_endian_ = false;
};

/// Text tags that libtiff itself terminates: names of the document, the maker, the program and so on (TIFF 6.0).
constexpr std::uint64_t known_texts[] = {269, 270, 271, 272, 285, 305, 306, 315, 316, 333, 337, 33432};

namespace tags {
constexpr std::uint64_t kind = 254, width = 256, height = 257, bits = 258, compression = 259, meaning = 262,
                        bit_order = 266, description = 270, strips = 273, orientation = 274, values = 277,
                        first_of_tiles = 322, last_of_tiles = 325, format = 339;
}
/// Tags that ITK reads from the first page and applies to all pages.
constexpr std::uint64_t of_page[] = {tags::kind,    tags::width,  tags::height, tags::bits,
                                     tags::meaning, tags::values, tags::format};
/// Tags that determine whether the voxels are stored unchanged and contiguously.
constexpr std::uint64_t of_storage[] = {tags::compression, tags::bit_order, tags::strips, tags::orientation};

/// The facts of one page: the tags of the two lists above that hold a single whole number, and the text of the
/// description.
struct Page {
  std::map<std::uint64_t, std::uint64_t> numbers;
  std::string description;

  bool contains(std::uint64_t tag) const { return numbers.contains(tag); }
  std::uint64_t at(std::uint64_t tag) const { return numbers.at(tag); }
  std::uint64_t at(std::uint64_t tag, std::uint64_t otherwise) const { return contains(tag) ? at(tag) : otherwise; }
};

/// One directory of a file, with the checks of its tags.
struct Directory {
  const std::filesystem::path& file;
  Numbers& numbers;
  std::uint64_t size;  ///< size of the file [bytes]
  /// whether it is a BigTIFF
  bool wide;
  static constexpr std::uint64_t white_is_zero = 0;  ///< value of the tag PhotometricInterpretation

  /// Checks the tag whose entry begins at byte `entry`, and stores it in `page` if later checks need it. \throws
  /// InputError.
  void check_tag(std::uint64_t entry, Page& page) const {
    const int place_bytes = wide ? 8 : 4;
    const std::uint64_t tag = numbers.at(entry, 2), type = numbers.at(entry + 2, 2);
    const std::uint64_t values = numbers.at(entry + 4, place_bytes);
    const std::uint64_t inside = entry + 4 + static_cast<std::uint64_t>(place_bytes);
    const std::uint64_t bytes = type < std::size(bytes_of_type) ? bytes_of_type[type] : 0;
    if (bytes > 0 && values > size / bytes)
      refuse(tag, fmt::format("{} values of {} bytes", values, bytes),
             fmt::format("no more values than the {} bytes of the file can hold", size));
    if (tag >= tags::first_of_tiles && tag <= tags::last_of_tiles)
      refuse(tag, "tiles", "rows of voxels (strips), as ImageJ and ITK write them");
    // ITK reserves memory for one pointer for tag 336 (DotRange), but libtiff writes both numbers of the tag there
    if (tag == 336) refuse(tag, "a range of dots", "no such range, because a scan has none");
    if (std::ranges::count(of_page, tag) > 0) {
      if (tag == tags::bits && values > 1)
        refuse(tag, fmt::format("bits for {} values per voxel", values),
               std::string("bits for one grey value") + to_grey);
      if (values != 1 || !is_whole(type))
        refuse(tag, fmt::format("{} values of type {}", values, type), "one whole number, of type 1, 3 or 4");
      if (!page.numbers.emplace(tag, numbers.at(inside, static_cast<int>(bytes))).second)
        refuse(tag, "this tag twice", "this tag once");
    }
    // a tag of storage with several values gets the value 0, which raw_voxels() treats as not contiguous
    if (std::ranges::count(of_storage, tag) > 0)
      page.numbers.emplace(tag, values == 1 && is_whole(type) ? numbers.at(inside, static_cast<int>(bytes)) : 0);
    check_text(tag, type, values, inside);
    if (tag == tags::description && values > 0) page.description = text_of(values, inside);
  }

  /// Checks the combination of all tags of a page. \throws InputError for voxels that ITK would misread or cannot read.
  void check_voxels(const Page& page) const {
    if (page.at(tags::values, 1) != 1)
      refuse(tags::values, fmt::format("{} values per voxel", page.at(tags::values)),
             std::string("one grey value per voxel") + to_grey);
    constexpr std::uint64_t palette = 3;
    if (const std::uint64_t meaning = page.at(tags::meaning, 1); meaning > 1 && meaning != palette)
      refuse(tags::meaning, fmt::format("PhotometricInterpretation {}", meaning),
             std::string("grey values, 0 or 1") + to_grey);
    const char* known = "8 or 16 bits per voxel for whole numbers, or 32 bits for floats";
    if (!page.contains(tags::bits)) refuse(tags::bits, "no bits of a voxel", known);
    // sample format 2: signed; 4: undefined, which is read as a whole number too (TIFF 6.0)
    constexpr std::uint64_t whole = 1, floating = 3;
    const std::uint64_t n = page.at(tags::bits), as = page.at(tags::format, whole);
    const bool is_known = as == floating ? n == 32 : (as == whole || as == 2 || as == 4) && (n == 8 || n == 16);
    if (!is_known)
      refuse(tags::bits, fmt::format("{} bits per voxel, of format {} (tag {})", n, as, tags::format), known);
    if (as == floating && page.at(tags::meaning, 1) == white_is_zero)
      refuse(tags::meaning, "PhotometricInterpretation 0 (white is 0) of floats",
             "PhotometricInterpretation 1 (black is 0), because floats cannot be inverted: their largest value is "
             "unknown");
  }

  [[noreturn]] void refuse(std::uint64_t tag, const std::string& found, const std::string& expected) const {
    throw InputError(file.string(), 0, fmt::format("tag {} of the TIFF file", tag), found, expected);
  }

 private:
  static constexpr const char* to_grey = ", because colours are not read; save the scan as grey values of 8 or 16 bits";

  /// Whether a TIFF type is an unsigned whole number.
  bool is_whole(std::uint64_t type) const { return type == 1 || type == 3 || type == 4 || (type == 16 && wide); }

  /// Returns the text of a tag; empty if the file is too short for it.
  std::string text_of(std::uint64_t values, std::uint64_t inside) const {
    const std::uint64_t begin = values <= (wide ? 8 : 4) ? inside : numbers.at(inside, wide ? 8 : 4);
    return begin < size && values <= size - begin ? numbers.text(begin, values) : "";
  }

  /// Checks a text tag. \throws InputError if a known text tag is not a text, or another text lacks its final 0.
  void check_text(std::uint64_t tag, std::uint64_t type, std::uint64_t values, std::uint64_t inside) const {
    constexpr std::uint64_t text = 2;
    const bool known = std::ranges::count(known_texts, tag) > 0;
    if (known && type != text) refuse(tag, fmt::format("type {}", type), fmt::format("a text, type {}", text));
    if (type != text || values == 0 || known) return;
    const std::uint64_t begin = values <= (wide ? 8 : 4) ? inside : numbers.at(inside, wide ? 8 : 4);
    if (begin >= size || values > size - begin || numbers.at(begin + values - 1, 1) != 0)
      refuse(tag, "a text without an end", "a last byte of 0");
  }
};

/// Checks that a page has the same size and type as the first one and is not a thumbnail or mask. All pages must form
/// one volume, but ITK looks at the first page only; it skips thumbnails and masks when it counts pages, but not when
/// it reads them. \throws InputError.
void check_alike(const Directory& directory, const Page& first, const Page& page, int number) {
  for (const std::uint64_t tag : of_page) {
    const auto value_of = [&](const Page& p) { return p.contains(tag) ? fmt::format("{}", p.at(tag)) : "none"; };
    if (value_of(first) != value_of(page))
      directory.refuse(tag, fmt::format("{} in page {}", value_of(page), number),
                       value_of(first) + ", as in the first page");
  }
  constexpr std::uint64_t reduced_or_mask = 1 | 4;
  if (page.contains(tags::kind) && (page.at(tags::kind) & reduced_or_mask))
    directory.refuse(tags::kind, fmt::format("a reduced image or a mask in page {}", number), "only slices");
}

/// Returns the number after `key=` in a description that ImageJ wrote, one key per line; 0 if the key is missing.
std::int64_t number_in(const std::string& description, const std::string& key) {
  if (!description.starts_with("ImageJ=")) return 0;
  const std::size_t begin = description.find('\n' + key + '=');
  if (begin == std::string::npos) return 0;
  const char* first = description.data() + begin + key.size() + 2;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(first, description.data() + description.size(), number);
  return error == std::errc{} && number > 0 ? number : 0;
}

/// Returns the offset of the first page's voxels if they are contiguous, uncompressed and not rotated; otherwise
/// nothing.
std::optional<std::uint64_t> raw_voxels(const Page& page) {
  for (const std::uint64_t tag : {tags::compression, tags::bit_order, tags::orientation})
    if (page.at(tag, 1) != 1) return {};
  return page.at(tags::strips, 0) > 0 ? std::optional(page.at(tags::strips)) : std::nullopt;
}

/// Returns the voxel type of a page that check_voxels() accepted.
VoxelType type_of(const Page& page) {
  const std::uint64_t format = page.at(tags::format, 1);
  if (page.at(tags::bits) == 32) return VoxelType::f32;
  if (page.at(tags::bits) == 16) return format == 2 ? VoxelType::i16 : VoxelType::u16;
  return format == 2 ? VoxelType::i8 : VoxelType::u8;
}

/// Returns the facts that follow from the first page and the number of pages. \throws InputError for several channels
/// or times.
TiffPages pages_of(const Page& first, std::size_t number, bool big_endian, const std::filesystem::path& file) {
  TiffPages out;
  out.pages = static_cast<std::int64_t>(number);
  if (number == 0) return out;
  out.width = static_cast<std::int64_t>(std::min<std::uint64_t>(first.at(tags::width, 0), 0xffffffff));
  out.height = static_cast<std::int64_t>(std::min<std::uint64_t>(first.at(tags::height, 0), 0xffffffff));
  out.type = type_of(first);
  out.white_is_zero = first.at(tags::meaning, 1) == Directory::white_is_zero;
  out.described = number_in(first.description, "images");
  out.raw = raw_voxels(first);
  out.big_endian = big_endian;
  for (const char* axis : {"channels", "frames"}) {
    if (const std::int64_t n = number_in(first.description, axis); n > 1)
      throw InputError(file.string(), 0, "description of the TIFF file", fmt::format("{}={}", axis, n),
                       "one grey value per voxel, and slices of one time");
  }
  return out;
}

}  // namespace

TiffPages check_tiff_directories(const std::filesystem::path& file) {
  Numbers numbers(file);
  const std::uint64_t version = numbers.at(2, 2);
  const bool wide = version == 43;
  if (!numbers.good() || (version != 42 && !wide)) return {};
  const int place_bytes = wide ? 8 : 4, count_bytes = wide ? 8 : 2, entry_bytes = wide ? 20 : 12;
  const std::uint64_t size = std::filesystem::file_size(file);
  const Directory directory{file, numbers, size, wide};
  Page first;
  std::set<std::uint64_t> seen;
  for (std::uint64_t place = numbers.at(wide ? 8 : 4, place_bytes); numbers.good() && place != 0;) {
    if (!seen.insert(place).second)
      throw InputError(file.string(), 0, "directories of the TIFF file",
                       "a second reference to the directory at byte " + std::to_string(place),
                       "one reference to each directory");
    const std::uint64_t entries = place < size ? numbers.at(place, count_bytes) : 0;
    if (place >= size || !numbers.good() || entries > (size - place) / static_cast<std::uint64_t>(entry_bytes))
      throw InputError(file.string(), 0, "directories of the TIFF file",
                       "one at byte " + std::to_string(place) + " with " + std::to_string(entries) + " entries",
                       "no more entries than the " + std::to_string(size) + " bytes of the file can hold");
    Page page;
    for (std::uint64_t e = 0; e < entries; ++e)
      directory.check_tag(place + static_cast<std::uint64_t>(count_bytes) + e * static_cast<std::uint64_t>(entry_bytes),
                          page);
    directory.check_voxels(page);
    if (seen.size() == 1) first = page;
    if (seen.size() > 1) check_alike(directory, first, page, static_cast<int>(seen.size()));
    place =
        numbers.at(place + static_cast<std::uint64_t>(count_bytes) + entries * static_cast<std::uint64_t>(entry_bytes),
                   place_bytes);
  }
  return pages_of(first, seen.size(), numbers.big_endian(), file);
}

}  // namespace macadam::ct
