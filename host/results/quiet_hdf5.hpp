// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quiet_hdf5.hpp  HDF5 prints its errors unless told not to.
#pragma once

#include <H5Cpp.h>

namespace macadam {

/// While it lives, errors of HDF5 are exceptions alone.
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
