// SPDX-License-Identifier: GPL-3.0-or-later
// smoothing.cpp  Implements edge-preserving diffusion with explicit steps.
#include "host/tools/ct/voxels/smoothing.hpp"

#include "kernels/base/parallel.hpp"

namespace macadam::ct {

// Each round adds to a voxel a fraction of the differences d to its six neighbours, weighted with 1/(1 + (d/edge)²), so
// that large differences count little.
void diffuse(Image<float>& image, double edge, int rounds) {
  const auto [nx, ny, nz] = image.size;
  const float scale = static_cast<float>(1 / (edge * edge));
  constexpr float step = 1.0f / 7;  // explicit steps are stable below 1/6
  Image<float> next = Image<float>::like(image);
  for (int round = 0; round < rounds; ++round) {
    for_each_in_parallel(static_cast<std::size_t>(nz), [&, nx = nx, ny = ny, nz = nz](std::size_t slice) {
      const auto k = static_cast<std::int64_t>(slice);
      for (std::int64_t j = 0; j < ny; ++j) {
        const float* here = &image.at(0, j, k);
        // at the ends of the image the values are mirrored
        const float* const rows[4] = {
            &image.at(0, std::max<std::int64_t>(j - 1, 0), k), &image.at(0, std::min(j + 1, ny - 1), k),
            &image.at(0, j, std::max<std::int64_t>(k - 1, 0)), &image.at(0, j, std::min(k + 1, nz - 1))};
        float* out = &next.at(0, j, k);
        const auto flow = [scale](float difference) { return difference / (1 + difference * difference * scale); };
        const auto one = [&](std::int64_t i, std::int64_t left, std::int64_t right) {
          const float grey = here[i];
          out[i] = grey + step * (flow(rows[0][i] - grey) + flow(rows[1][i] - grey) + flow(rows[2][i] - grey) +
                                  flow(rows[3][i] - grey) + flow(here[left] - grey) + flow(here[right] - grey));
        };
        one(0, 0, std::min<std::int64_t>(1, nx - 1));
        for (std::int64_t i = 1; i + 1 < nx; ++i) one(i, i - 1, i + 1);
        if (nx > 1) one(nx - 1, nx - 2, nx - 1);
      }
    });
    std::swap(image.voxels, next.voxels);
  }
}

}  // namespace macadam::ct
