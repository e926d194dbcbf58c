// SPDX-License-Identifier: GPL-3.0-or-later
// read_surface.cpp  STL, OFF, PLY and OBJ: which it is, and what a surface needs in any of them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <optional>

#include "host/shapes/equal_points.hpp"
#include "host/shapes/surface_files.hpp"
#include "host/shapes/surface_numbers.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr std::array<const char*, 4> endings{".stl", ".off", ".ply", ".obj"};

std::optional<SurfaceFormat> find_format(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = std::find(endings.begin(), endings.end(), ending);
  if (found == endings.end()) return std::nullopt;
  return static_cast<SurfaceFormat>(found - endings.begin());
}

SurfaceSoup read_soup(const SurfaceFile& file, SurfaceFormat format) {
  switch (format) {
    case SurfaceFormat::stl:
      return read_stl(file);
    case SurfaceFormat::off:
      return read_off(file);
    case SurfaceFormat::ply:
      return read_ply(file);
    case SurfaceFormat::obj:
      break;
  }
  return read_obj(file);
}

std::string bytes_of(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& found, const char* expected) {
    throw InputError(file.string(), 0, "surface", found, expected);
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) fail("a directory", "a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) fail("a device or pipe", "a file");
  errno = 0;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in && errno == ENOMEM) throw std::bad_alloc();
  if (!in) fail(std::strerror(errno), "a readable file");
  std::string bytes(static_cast<std::size_t>(in.tellg()), '\0');  // streams would take want of memory for a bad file
  if (!in.seekg(0).read(bytes.data(), std::ssize(bytes))) fail(std::strerror(errno), "a readable file");
  return bytes;
}

}  // namespace

SurfaceFormat format_of(const std::filesystem::path& file) {
  if (const auto format = find_format(file)) return *format;
  throw InputError(file.string(), 0, "ending", file.has_extension() ? file.extension().string() : "none",
                   fmt::format("one of {}", fmt::join(endings, " ")));
}

Surface surface_in(const SurfaceFile& file, SurfaceFormat format, double scale) {
  if (file.bytes.empty()) file.fail(0, "surface", "an empty file", "a triangulated surface");
  const SurfaceSoup soup = read_soup(file, format);
  if (soup.facets.empty()) file.fail(0, "surface", "no facet", "a triangulated surface");
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (soup.points.size() > most || soup.facets.size() > most)
    file.fail(0, "surface", fmt::format("{} points and {} facets", soup.points.size(), soup.facets.size()),
              fmt::format("at most {}", most));
  Surface surface{file.name, {}, {}};
  for (const Vec3d& p : soup.points) surface.points.push_back(scale * p);
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    auto& facet = surface.facets.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::int64_t p = soup.facets[f][k];
      if (p < 0 || p >= std::ssize(soup.points)) {
        file.fail(soup.line.empty() ? 0 : soup.line[f], fmt::format("facet {}", f), fmt::format("point {}", p),
                  fmt::format("a number below {}", soup.points.size()));
      }
      facet[k] = static_cast<std::int32_t>(p);
    }
  }
  require_sound_numbers(surface);
  join_equal_points(surface);
  return surface;
}

void require_scale(const std::filesystem::path& file, double scale) {
  if (!(scale > 0 && std::isfinite(scale))) {
    throw InputError(file.string(), 0, "scale (--scale), metres per unit of the file", fmt::format("{}", scale),
                     "a positive finite number");
  }
}

bool is_surface_file(const std::filesystem::path& file) { return find_format(file).has_value(); }

Surface read_surface(const std::filesystem::path& file, double scale) {
  require_scale(file, scale);
  const SurfaceFormat format = format_of(file);  // before reading: another ending is the first thing to say
  const std::string bytes = bytes_of(file);
  Surface surface = surface_in({file.string(), bytes}, format, scale);
  surface.name = file.stem().string();
  return surface;
}

std::vector<std::filesystem::path> surface_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_surface_file(entry.path())) files.push_back(entry.path());
  }
  if (files.empty())
    throw InputError(folder.string(), 0, "folder", "no surface in it",
                     fmt::format("files that end in {}", fmt::join(endings, " ")));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace macadam
