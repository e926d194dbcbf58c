// SPDX-License-Identifier: GPL-3.0-or-later
// scan_faults.cpp  Adds the faults. Each slice has its own stream of random numbers, so that the result does not depend
// on the number of threads.
#include "host/tools/ct/synthetic/scan_faults.hpp"

#include <itkDiscreteGaussianImageFilter.h>

#include <cmath>
#include <numbers>

#include "host/tools/ct/images/itk_image.hpp"
#include "kernels/base/parallel.hpp"
#include "host/spheres/random_stream.hpp"

namespace macadam::ct {
namespace {

/// Numbers of the streams of random numbers.
constexpr std::uint64_t drift_stream = 1, ring_stream = 2, slice_streams = 1000;

/// Returns a sample of the standard normal distribution (Box and Muller).
double normal(RandomStream& random) {
  const double u = 1 - random.uniform(), v = random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

/// Gaussian blur; `voxels` is the standard deviation [voxels].
void blur(Image<float>& grey, double voxels) {
  using Filter = itk::DiscreteGaussianImageFilter<itk::Image<float, 3>, itk::Image<float, 3>>;
  const auto filter = Filter::New();
  filter->SetInput(as_itk(grey));
  filter->SetUseImageSpacing(false);
  filter->SetVariance(voxels * voxels);
  filter->SetMaximumError(1e-3);
  filter->Update();
  const float* out = filter->GetOutput()->GetBufferPointer();
  grey.voxels.assign(out, out + grey.count());
}

/// Returns the brightness factor of each slice: 1 plus a slow wave plus a random number. The standard deviation of the
/// random numbers is a third of the wave's amplitude.
std::vector<double> drift(const PhantomSpec& spec, std::int64_t slices) {
  RandomStream random(spec.seed, drift_stream);
  const double phase = random.uniform(0, 2 * std::numbers::pi);
  std::vector<double> out;
  for (std::int64_t k = 0; k < slices; ++k) {
    const double way = static_cast<double>(k) / static_cast<double>(slices);
    out.push_back(1 + spec.drift * (std::sin(3 * std::numbers::pi * way + phase) + normal(random) / 3));
  }
  return out;
}

}  // namespace

void add_faults(Image<float>& grey, const PhantomSpec& spec, double radius) {
  if (spec.blur > 0) blur(grey, spec.blur);
  const double range = spec.grey_aggregate - spec.grey_air;
  const std::vector<double> brightness = drift(spec, grey.size[2]);
  // twice the position of the axis
  const Vec3d axis = grey.centre(0, 0, 0) + grey.centre(grey.size[0] - 1, grey.size[1] - 1, 0);
  const auto from_axis = [&](std::int64_t i, std::int64_t j) {
    const Vec3d p = grey.centre(i, j, 0);
    return std::hypot(p.x - axis.x / 2, p.y - axis.y / 2);
  };
  const double edge = std::min(grey.spacing.x, grey.spacing.y);
  // offsets of the rings that are the same in all slices
  std::vector<double> lasting(static_cast<std::size_t>(from_axis(0, 0) / edge) + 1);
  RandomStream of_rings(spec.seed, ring_stream);
  for (double& offset : lasting) offset = normal(of_rings);

  for_each_in_parallel(static_cast<std::size_t>(grey.size[2]), [&](std::size_t slice) {
    RandomStream random(spec.seed, slice_streams + slice);
    std::vector<double> ring(lasting.size());
    // half of the variance of a ring is the same in all slices, the other half is drawn separately for each slice
    for (std::size_t k = 0; k < ring.size(); ++k)
      ring[k] = spec.rings * range * std::sqrt(0.5) * (lasting[k] + normal(random));
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < grey.size[1]; ++j) {
      for (std::int64_t i = 0; i < grey.size[0]; ++i) {
        const double r = from_axis(i, j), share = std::min(1.0, r / radius);
        double value = grey.at(i, j, k) * brightness[slice] * (1 - spec.cupping * (1 - share * share));
        value += ring[static_cast<std::size_t>(r / edge)];
        if (spec.noise > 0) value += spec.noise * range * normal(random);
        grey.at(i, j, k) = static_cast<float>(value);
      }
    }
  });
}

}  // namespace macadam::ct
