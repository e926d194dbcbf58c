// SPDX-License-Identifier: GPL-3.0-or-later
/// \file itk_image.hpp  An image as ITK sees it, on the same memory. For the few files that call ITK's filters.
#pragma once

#include <itkImage.h>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// On the memory of `image`, which must live longer. Spacing in metres.
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
