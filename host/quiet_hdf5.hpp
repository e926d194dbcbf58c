// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quiet_hdf5.hpp  HDF5 without its own messages, and for one thread at a time.
#pragma once

#include <H5Cpp.h>

#include <mutex>

namespace macadam {

/// HDF5 prints its errors unless told not to: it is silent while one of these lives. Runs side by side write files, and
/// HDF5 is not for several threads, nor are two files in memory of one name: whoever makes one waits for the others.
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
  static std::recursive_mutex& one_at_a_time() {
    static std::recursive_mutex mutex;
    return mutex;
  }
  std::lock_guard<std::recursive_mutex> alone_{one_at_a_time()};
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace macadam
