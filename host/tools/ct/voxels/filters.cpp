// SPDX-License-Identifier: GPL-3.0-or-later
// filters.cpp  Calls ITK's filters: median, and distance to the nearest voxel outside.
#include <itkMedianImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#include <omp.h>

#include "host/tools/ct/voxels/distance.hpp"
#include "host/tools/ct/images/itk_image.hpp"
#include "host/tools/ct/voxels/smoothing.hpp"

namespace macadam::ct {

void median(Image<float>& image) {
  const auto filter = itk::MedianImageFilter<itk::Image<float, 3>, itk::Image<float, 3>>::New();
  filter->SetInput(as_itk(image));
  filter->SetNumberOfWorkUnits(static_cast<unsigned>(omp_get_max_threads()));
  filter->SetRadius(1);
  filter->Update();
  std::copy_n(filter->GetOutput()->GetBufferPointer(), image.count(), image.voxels.begin());
}

Image<float> distance_inside(Image<std::uint8_t>& mask) {
  const auto filter = itk::SignedMaurerDistanceMapImageFilter<itk::Image<std::uint8_t, 3>, itk::Image<float, 3>>::New();
  filter->SetInput(as_itk(mask));
  filter->SetNumberOfWorkUnits(static_cast<unsigned>(omp_get_max_threads()));
  filter->SetSquaredDistance(false);
  filter->SetInsideIsPositive(true);
  filter->SetUseImageSpacing(true);
  filter->Update();
  Image<float> distance = Image<float>::like(mask);
  // ITK measures from the centres of the outermost voxels inside, half a voxel below the surface
  const auto half = static_cast<float>(0.5 * std::cbrt(mask.voxel_volume()));
  const float* found = filter->GetOutput()->GetBufferPointer();
  for (std::size_t i = 0; i < mask.count(); ++i) distance.voxels[i] = mask.voxels[i] ? found[i] + half : -1;
  return distance;
}

}  // namespace macadam::ct
