// SPDX-License-Identifier: GPL-3.0-or-later
/// \file itk_image.hpp  Passes an Image to ITK's filters without copying its voxels. Only the few files that call ITK
/// filters include this header.
#pragma once

#include <itkImage.h>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Returns an ITK image that uses the voxels of `image` without a copy; `image` must outlive it. The spacing is in
/// metres, the origin stays 0.
template <class T>
typename itk::Image<T, 3>::Pointer as_itk(Image<T>& image) {
  const auto out = itk::Image<T, 3>::New();
  typename itk::Image<T, 3>::SizeType size;
  typename itk::Image<T, 3>::SpacingType spacing;
  const double edges[3] = {image.spacing.x, image.spacing.y, image.spacing.z};
  for (unsigned axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<itk::SizeValueType>(image.size[axis]);
    spacing[axis] = edges[axis];
  }
  out->SetRegions(size);
  out->SetSpacing(spacing);
  out->GetPixelContainer()->SetImportPointer(image.voxels.data(), image.count(), false);
  return out;
}

}  // namespace macadam::ct
