// SPDX-License-Identifier: GPL-3.0-or-later
/// \file open_hdf5.hpp  An HDF5 file on the disk that is whole after each flush, and never meets a full disk.
#pragma once

#include <H5Cpp.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace macadam {

/// A file open for writing. HDF5 does not survive errors of the disk, so room is taken before it writes; and what it
/// knows of the file stays in memory until a flush, so that a kill in between leaves what the flush before it left.
/// Others may read it meanwhile: it is not locked. A new one has another name until keep(), and is removed without it.
class OpenHdf5 {
 public:
  enum class Begin : std::uint8_t { anew, as_it_is };
  /// \throws RunError when the file cannot be opened.
  OpenHdf5(const std::filesystem::path& file, Begin begin);
  ~OpenHdf5();
  OpenHdf5(const OpenHdf5&) = delete;
  OpenHdf5& operator=(const OpenHdf5&) = delete;

  /// Lets `change` change the file by at most about so many bytes of arrays, and flushes.
  /// \throws RunError naming the file: no room for it on the disk, or what HDF5 says.
  void write(std::size_t bytes, const std::function<void(H5::H5File&)>& change);
  /// Gives a new file its name, in place of an older one. \throws RunError.
  void keep();
  /// After the last change. \throws RunError naming the file, where closing it fails.
  void end();
  H5::H5File& hdf5() { return *hdf5_; }

 private:
  void close();
  void close_hdf5();

  std::filesystem::path file_, part_;  ///< the latter: of a new file that is not kept yet; else empty
  int descriptor_ = -1;                ///< of the same file, to take and give back room
  std::unique_ptr<H5::H5File> hdf5_;
};

/// f(), in which HDF5 prints no errors and throws them as an exception alone. \throws RunError naming the file.
void with_hdf5(const std::filesystem::path& file, const std::function<void()>& f);

}  // namespace macadam
