// SPDX-License-Identifier: GPL-3.0-or-later
// overlay.cpp  Planes and a view of a segmentation, as PNG by ITK.
#include "host/ct/overlay.hpp"

#include <itkPNGImageIO.h>

#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

using Colour = std::array<std::uint8_t, 3>;

struct Picture {
  std::size_t width, height;
  std::vector<Colour> pixels;
  Picture(std::size_t width, std::size_t height)
      : width(width), height(height), pixels(width * height, Colour{255, 255, 255}) {}
  Colour& at(std::size_t x, std::size_t y) { return pixels[x + width * y]; }
};

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

/// Colours of neighbouring numbers differ much: hues by the golden ratio.
Colour colour_of(std::uint32_t label) {
  const double hue = 6 * std::fmod(label * 0.6180339887, 1.0);
  const auto part = [&](double shift) {
    const double t = std::fmod(hue + shift, 6.0);
    return static_cast<std::uint8_t>(255 * std::clamp(std::abs(t - 3) - 1, 0.15, 1.0));
  };
  return {part(0), part(4), part(2)};
}

Colour mixed(const Colour& a, const Colour& b, double share) {
  Colour out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>((1 - share) * a[c] + share * b[c]);
  return out;
}

}  // namespace

void write_overlay(const std::filesystem::path& file, const Segmentation& s) {
  const auto [nx, ny, nz] = s.labels.size;
  constexpr std::int64_t gap = 8;
  Picture picture(static_cast<std::size_t>(nx + gap + nx + gap + ny), static_cast<std::size_t>(std::max(ny, nz)));
  const double low = s.levels.has_air ? s.levels.air : s.levels.mastic - s.levels.contrast();
  const double high = s.levels.aggregate + 0.3 * s.levels.contrast();
  const auto draw = [&](std::int64_t x, std::int64_t y, std::int64_t i, std::int64_t j, std::int64_t k) {
    const std::size_t at = s.labels.index(i, j, k);
    const auto grey = static_cast<std::uint8_t>(255 * std::clamp((s.grey.voxels[at] - low) / (high - low), 0.0, 1.0));
    const Colour plain{grey, grey, grey};
    const std::uint32_t label = s.labels.voxels[at];
    picture.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)) =
        label > 0                    ? mixed(plain, colour_of(label), 0.4)
        : s.phases.voxels[at] == 255 ? mixed(plain, {255, 255, 255}, 0.7)
        : s.phases.voxels[at] == 0   ? mixed(plain, {0, 0, 120}, 0.5)
                                     : plain;
  };
  for (std::int64_t j = 0; j < ny; ++j)
    for (std::int64_t i = 0; i < nx; ++i) draw(i, ny - 1 - j, i, j, nz / 2);
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t i = 0; i < nx; ++i) draw(nx + gap + i, nz - 1 - k, i, ny / 2, k);
    for (std::int64_t j = 0; j < ny; ++j) draw(2 * (nx + gap) + j, nz - 1 - k, nx / 2, j, k);
  }
  write_png(file, picture);
}

void write_view(const std::filesystem::path& file, const Segmentation& s) {
  constexpr std::size_t edge = 900;
  Picture picture(edge, edge);
  std::vector<double> depth(edge * edge, -std::numeric_limits<double>::infinity());
  // right, up and towards the eye: from the front left, above
  const Vec3d right{0.8660254, -0.5, 0}, towards{-0.4330127, -0.75, 0.5}, up = cross(towards, right);
  const Vec3d size{s.labels.spacing.x * static_cast<double>(s.labels.size[0]),
                   s.labels.spacing.y * static_cast<double>(s.labels.size[1]),
                   s.labels.spacing.z * static_cast<double>(s.labels.size[2])};
  const Vec3d middle = s.labels.origin + 0.5 * (size - s.labels.spacing);
  const double scale = 0.95 * edge / norm(size);
  for (const ScannedGrain& grain : s.grains) {
    for (const auto& facet : grain.surface.facets) {
      Vec3d p[3];  // pixels right and down, and nearness
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3d x = grain.surface.points[static_cast<std::size_t>(facet[c])] - middle;
        p[c] = {0.5 * edge + scale * dot(x, right), 0.5 * edge - scale * dot(x, up), dot(x, towards)};
      }
      const auto corner = [&](std::size_t c) { return grain.surface.points[static_cast<std::size_t>(facet[c])]; };
      const Vec3d normal = cross(corner(1) - corner(0), corner(2) - corner(0));
      const double light = dot(normal, towards + 0.6 * up) / (1.17 * norm(normal));
      const double whole = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
      if (dot(normal, towards) <= 0 || whole == 0) continue;
      const Colour colour = mixed({20, 20, 20}, colour_of(grain.id), std::clamp(0.25 + 0.75 * light, 0.0, 1.0));
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
