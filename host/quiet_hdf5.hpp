// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quiet_hdf5.hpp  HDF5 without its own messages.
#pragma once

#include <H5Cpp.h>

namespace macadam {

/// HDF5 prints its errors unless told not to: it is silent while one of these lives.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5::Exception::getAutoPrint(print_, &data_);
    H5::Exception::dontPrint();
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() { H5::Exception::setAutoPrint(print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace macadam
