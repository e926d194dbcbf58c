// SPDX-License-Identifier: GPL-3.0-or-later
// enlarge.cpp  Makes a scan with smaller voxels from one with larger ones: interpolates the grey values between voxel
// centres and adds noise. Writes a MetaImage layer by layer, so that the output may be larger than memory.
//   enlarge SCAN.mha OUT.mha FACTOR NOISE      NOISE: standard deviation in grey values
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "macadam/ct.hpp"

namespace {

using macadam::Image;

/// The two voxels next to a position on an axis, and the weight of the second.
struct Between {
  std::int64_t low, high;
  float share;
};

/// Returns the neighbours of a fine voxel's centre among `size` coarse voxels.
Between between(std::int64_t fine, std::int64_t factor, std::int64_t size) {
  const double at = (static_cast<double>(fine) + 0.5) / static_cast<double>(factor) - 0.5, floor = std::floor(at);
  const auto inside = [size](double n) {
    return std::min(size - 1, std::max<std::int64_t>(0, static_cast<std::int64_t>(n)));
  };
  return {inside(floor), inside(floor + 1), static_cast<float>(at - floor)};
}

/// Returns noise with standard deviation 1 that depends on the voxel's index alone: the sum of four uniform numbers.
float noise_of(std::uint64_t voxel) {
  std::uint64_t z = voxel * 0x9e3779b97f4a7c15u + 0x9e3779b97f4a7c15u;  // SplitMix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  float sum = 0;
  for (int part = 0; part < 4; ++part, z >>= 16) sum += static_cast<float>(z & 0xffff) / 65536.0f - 0.5f;
  return sum * 1.7320508f;  // the variance of a uniform number of width 1 is 1/12, so the sum of four has a standard
                            // deviation of 1/√3
}

/// Writes the enlarged scan. It first interpolates along y and z for each row of coarse voxels, then along x.
void enlarge(const Image<std::uint16_t>& scan, const std::string& file, std::int64_t factor, float noise) {
  const auto n = [factor](std::int64_t size) { return size * factor; };
  const auto [nx, ny, nz] = std::array{n(scan.size[0]), n(scan.size[1]), n(scan.size[2])};
  const auto mm = [factor](double metres) { return 1e3 * metres / static_cast<double>(factor); };
  const auto first = [factor](double origin, double edge) {
    return 1e3 * (origin - 0.5 * edge + 0.5 * edge / static_cast<double>(factor));
  };
  std::ofstream out(file, std::ios::binary);
  out << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
      << "Offset = " << first(scan.origin.x, scan.spacing.x) << ' ' << first(scan.origin.y, scan.spacing.y) << ' '
      << first(scan.origin.z, scan.spacing.z) << "\nElementSpacing = " << mm(scan.spacing.x) << ' '
      << mm(scan.spacing.y) << ' ' << mm(scan.spacing.z) << "\nDimSize = " << nx << ' ' << ny << ' ' << nz
      << "\nElementType = MET_USHORT\nElementDataFile = LOCAL\n";
  std::vector<std::uint16_t> layer(static_cast<std::size_t>(nx * ny));
  std::vector<Between> along_x;
  for (std::int64_t i = 0; i < nx; ++i) along_x.push_back(between(i, factor, scan.size[0]));
  for (std::int64_t k = 0; k < nz; ++k) {
    const Between z = between(k, factor, scan.size[2]);
#pragma omp parallel for
    for (std::int64_t j = 0; j < ny; ++j) {
      const Between y = between(j, factor, scan.size[1]);
      std::vector<float> row(static_cast<std::size_t>(scan.size[0]));
      for (std::int64_t i = 0; i < scan.size[0]; ++i) {
        const auto mixed = [&](std::int64_t c) {
          return (1 - y.share) * scan.at(i, y.low, c) + y.share * scan.at(i, y.high, c);
        };
        row[static_cast<std::size_t>(i)] = (1 - z.share) * mixed(z.low) + z.share * mixed(z.high);
      }
      for (std::int64_t i = 0; i < nx; ++i) {
        const Between& x = along_x[static_cast<std::size_t>(i)];
        const float grey =
            (1 - x.share) * row[static_cast<std::size_t>(x.low)] + x.share * row[static_cast<std::size_t>(x.high)];
        const float noisy = grey + noise * noise_of(static_cast<std::uint64_t>(i + nx * (j + ny * k)));
        layer[static_cast<std::size_t>(i + nx * j)] =
            static_cast<std::uint16_t>(std::min(65535.0f, std::max(0.0f, noisy + 0.5f)));
      }
    }
    out.write(reinterpret_cast<const char*>(layer.data()), static_cast<std::streamsize>(2 * layer.size()));
  }
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) {
    std::fputs("enlarge SCAN.mha OUT.mha FACTOR NOISE\n", stderr);
    return 2;
  }
  try {
    enlarge(macadam::read_image<std::uint16_t>(arguments[1]), arguments[2], std::atoi(arguments[3]),
            static_cast<float>(std::atof(arguments[4])));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
