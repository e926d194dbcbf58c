// SPDX-License-Identifier: GPL-3.0-or-later
// overlay.cpp  Draws a segmented scan: its three middle planes, and an oblique view of the grains.
#include "host/tools/ct/segment/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "host/tools/ct/images/picture.hpp"

namespace macadam::ct {
namespace {

// Sieves [mm], and the colours of the size classes between them, as red, green and blue. They are those of
// python/macadam/report/phases.py (tested by python/tests/test_report_colours.py).
constexpr double sieves[] = {0.063, 0.125, 0.25, 0.5, 1, 2, 2.8, 4, 5.6, 8, 11.2, 16, 22.4, 31.5, 45, 63};
constexpr std::uint32_t ladder[] = {0x983d10, 0x564db9, 0x710000, 0xde8b5d, 0x7e4884, 0x6bc9c0, 0xc8673f, 0x662a6c,
                                    0xe7b83c, 0xa9a39a, 0x1d6650, 0xc6d199, 0x663d99, 0x97adfb, 0xbf8a1a};
constexpr std::uint32_t aggregate_colour = 0xab8f66;  // of a grain of unknown size
static_assert(std::size(ladder) + 1 == std::size(sieves));

/// Returns the colour of a grain: the colour of the size class of its sieve [m], in a shade that differs between
/// neighbouring numbers. sieve: 0 if it is not known.
Colour colour_of(std::uint32_t label, double sieve) {
  const auto above = std::upper_bound(std::begin(sieves), std::end(sieves), 1e3 * sieve) - std::begin(sieves);
  const std::uint32_t of_class =
      sieve > 0 ? ladder[std::clamp<std::ptrdiff_t>(above - 1, 0, std::ssize(ladder) - 1)] : aggregate_colour;
  const double shade = 1 + 0.3 * (std::fmod(label * 0.6180339887, 1.0) - 0.5);  // multiples of the golden ratio
  const auto part = [&](unsigned shift) {
    return static_cast<std::uint8_t>(std::min(255.0, shade * ((of_class >> shift) & 255U)));
  };
  return {part(16), part(8), part(0)};
}

/// Returns the colour of each label from 0 to the largest label of the scan.
std::vector<Colour> colours_of_labels(const Segmentation& s) {
  std::uint32_t largest = 0;
  for (const std::uint32_t label : s.labels.voxels) largest = std::max(largest, label);
  std::vector<Colour> colours(std::size_t{largest} + 1);
  for (std::uint32_t label = 0; label <= largest; ++label) colours[label] = colour_of(label, 0);
  for (const ScannedGrain& grain : s.grains) {
    if (grain.id <= largest) colours[grain.id] = colour_of(grain.id, grain.sieve);
  }
  return colours;
}

/// Returns a + share·(b − a).
Colour mixed(const Colour& a, const Colour& b, double share) {
  Colour out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>((1 - share) * a[c] + share * b[c]);
  return out;
}

/// Returns the colour of a voxel: its grey value, tinted if it belongs to a grain, a void or the outside.
Colour colour_of_voxel(const Segmentation& s, const std::vector<Colour>& of_label, std::size_t at) {
  const double low = s.levels.has_air ? s.levels.air : s.levels.mastic - s.levels.contrast();
  const double high = s.levels.aggregate + 0.3 * s.levels.contrast();
  const auto grey = static_cast<std::uint8_t>(255 * std::clamp((s.grey.voxels[at] - low) / (high - low), 0.0, 1.0));
  const Colour plain{grey, grey, grey};
  const std::uint32_t label = s.labels.voxels[at];
  return label > 0                    ? mixed(plain, of_label[label], 0.65)
         : s.phases.voxels[at] == 255 ? mixed(plain, {255, 255, 255}, 0.7)
         : s.phases.voxels[at] == 0   ? mixed(plain, {0, 0, 120}, 0.5)
                                      : plain;
}

/// A plane of the picture: the axes of the scan that point right and up.
struct Plane {
  const char* name;
  std::size_t right, up;
};
constexpr Plane planes[] = {{"xy", 0, 1}, {"xz", 0, 2}, {"yz", 1, 2}};

/// Returns the edge of a pixel [m]: the smallest edge of a voxel, divided by up to 8 to make the picture 1200 pixels
/// wide.
double pixel_of(const Image<std::uint32_t>& image, const double (&edges)[3]) {
  constexpr double wanted = 1200;
  const double smallest = *std::min_element(edges, edges + 3);
  double width = 0;  // total width of the three planes
  for (const Plane& plane : planes) width += edges[plane.right] * static_cast<double>(image.size[plane.right]);
  return smallest / std::clamp(std::ceil(wanted * smallest / width - 1e-9), 1.0, 8.0);
}

/// Returns the largest length not above `longest` that is 1, 2 or 5 times a power of ten.
double round_length(double longest) {
  const double power = std::pow(10, std::floor(std::log10(longest)));
  return power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
}

}  // namespace

// Each pixel shows the voxel nearest to it, so that voxels with different edges keep their proportions.
void write_overlay(const std::filesystem::path& file, const Segmentation& s) {
  constexpr std::size_t gap = 16;  // between planes, and around the labels below them [pixels]
  const double edges[3] = {s.labels.spacing.x, s.labels.spacing.y, s.labels.spacing.z};
  const double pixel = pixel_of(s.labels, edges);
  std::size_t pixels[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double exact = edges[axis] * static_cast<double>(s.labels.size[axis]) / pixel;
    pixels[axis] = static_cast<std::size_t>(std::max(1.0, std::round(exact)));
  }
  const std::size_t high = std::max(pixels[1], pixels[2]);
  Picture picture(2 * pixels[0] + pixels[1] + 2 * gap, high + 2 * gap + label_height);
  const std::vector<Colour> of_label = colours_of_labels(s);
  std::size_t left = 0;
  for (const auto& [name, right, up] : planes) {
    std::int64_t voxel[3];
    for (std::size_t axis = 0; axis < 3; ++axis) voxel[axis] = s.labels.size[axis] / 2;
    const auto voxel_of = [&](std::size_t place, std::size_t axis) {
      const double exact = (static_cast<double>(place) + 0.5) * pixel / edges[axis];
      return std::min(static_cast<std::int64_t>(exact), s.labels.size[axis] - 1);
    };
    for (std::size_t y = 0; y < pixels[up]; ++y) {
      voxel[up] = voxel_of(pixels[up] - 1 - y, up);
      for (std::size_t x = 0; x < pixels[right]; ++x) {
        voxel[right] = voxel_of(x, right);
        const std::size_t at = s.labels.index(voxel[0], voxel[1], voxel[2]);
        Colour& drawn = picture.at(left + x, y);
        drawn = colour_of_voxel(s, of_label, at);
        // the last row or column of pixels before another grain is dark, so that grains of one class can be separated
        const auto other_grain = [&](std::size_t axis, std::int64_t next) {
          if (next < 0 || next >= s.labels.size[axis] || next == voxel[axis]) return false;
          std::int64_t beside[3] = {voxel[0], voxel[1], voxel[2]};
          beside[axis] = next;
          const std::uint32_t label = s.labels.voxels[s.labels.index(beside[0], beside[1], beside[2])];
          return label > 0 && label != s.labels.voxels[at];
        };
        const bool last_x = x + 1 < pixels[right] && other_grain(right, voxel_of(x + 1, right));
        const bool last_y = y + 1 < pixels[up] && other_grain(up, voxel_of(pixels[up] - 2 - y, up));
        if (s.labels.voxels[at] > 0 && (last_x || last_y)) drawn = mixed(drawn, {0, 0, 0}, 0.7);
      }
    }
    if (pixels[right] >= label_width(name)) write_label(picture, left, high + gap, name);
    left += pixels[right] + gap;
  }
  // the scale bar is below the first plane, right of its name
  const double bar = round_length(0.4 * edges[0] * static_cast<double>(s.labels.size[0]));
  const auto wide = static_cast<std::size_t>(std::round(bar / pixel));
  const std::string text = fmt::format("{:.6g} mm", 1e3 * bar);
  const std::size_t begin = label_width("xy") + 2 * gap;
  if (begin + wide + gap + label_width(text) > pixels[0]) return write_png(file, picture);
  picture.fill(begin, high + gap + label_height / 2 - 2, wide, 4);
  write_label(picture, begin + wide + gap, high + gap, text);
  write_png(file, picture);
}

// Draws the facets into a depth buffer: each pixel keeps the facet nearest to the viewer. The brightness of a facet
// follows from the angle between its normal and the light.
void write_view(const std::filesystem::path& file, const Segmentation& s) {
  constexpr std::size_t edge = 900;
  Picture picture(edge, edge);
  std::vector<double> depth(edge * edge, -std::numeric_limits<double>::infinity());
  // directions on the picture, for a view from the front left, above; `towards` points to the viewer
  const Vec3d right{0.8660254, -0.5, 0}, towards{-0.4330127, -0.75, 0.5}, up = cross(towards, right);
  const Vec3d size{s.labels.spacing.x * static_cast<double>(s.labels.size[0]),
                   s.labels.spacing.y * static_cast<double>(s.labels.size[1]),
                   s.labels.spacing.z * static_cast<double>(s.labels.size[2])};
  const Vec3d middle = s.labels.origin + 0.5 * (size - s.labels.spacing);
  const double scale = 0.95 * edge / norm(size);
  for (const ScannedGrain& grain : s.grains) {
    const Colour lit = colour_of(grain.id, grain.sieve);
    for (const auto& facet : grain.surface.facets) {
      Vec3d p[3];  // x and y: pixels right and down; z: distance towards the viewer
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3d x = grain.surface.points[static_cast<std::size_t>(facet[c])] - middle;
        p[c] = {0.5 * edge + scale * dot(x, right), 0.5 * edge - scale * dot(x, up), dot(x, towards)};
      }
      const auto corner = [&](std::size_t c) { return grain.surface.points[static_cast<std::size_t>(facet[c])]; };
      const Vec3d normal = cross(corner(1) - corner(0), corner(2) - corner(0));
      const double light = dot(normal, towards + 0.6 * up) / (1.17 * norm(normal));
      const double whole = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
      if (dot(normal, towards) <= 0 || whole == 0) continue;
      const Colour colour = mixed({20, 20, 20}, lit, std::clamp(0.25 + 0.75 * light, 0.0, 1.0));
      const auto [left, end_x] = std::minmax({p[0].x, p[1].x, p[2].x});
      const auto [top, end_y] = std::minmax({p[0].y, p[1].y, p[2].y});
      for (auto y = static_cast<std::int64_t>(std::max(0.0, std::ceil(top))); y <= std::min<double>(edge - 1, end_y);
           ++y) {
        for (auto x = static_cast<std::int64_t>(std::max(0.0, std::ceil(left))); x <= std::min<double>(edge - 1, end_x);
             ++x) {
          const auto a = static_cast<double>(x), b = static_cast<double>(y);
          const double v = ((a - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (b - p[0].y)) / whole;
          const double w = ((p[1].x - p[0].x) * (b - p[0].y) - (a - p[0].x) * (p[1].y - p[0].y)) / whole;
          if (v < 0 || w < 0 || v + w > 1) continue;
          const double near = p[0].z + v * (p[1].z - p[0].z) + w * (p[2].z - p[0].z);
          double& nearest = depth[static_cast<std::size_t>(x) + edge * static_cast<std::size_t>(y)];
          if (near <= nearest) continue;
          nearest = near;
          picture.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)) = colour;
        }
      }
    }
  }
  write_png(file, picture);
}

}  // namespace macadam::ct
