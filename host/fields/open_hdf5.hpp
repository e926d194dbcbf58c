// SPDX-License-Identifier: GPL-3.0-or-later
/// \file open_hdf5.hpp  Writes an HDF5 file that is complete on the disk after each flush. Disk space is reserved
/// before each change, so that HDF5 never fails because of a full disk.
#pragma once

#include <H5Cpp.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace macadam {

/// A file that is open for writing. HDF5 cannot recover from a failed write, so disk space is reserved before HDF5
/// writes. HDF5 keeps the metadata of the file in memory until a flush, so that after a kill the file is as the last
/// flush left it. The file is not locked: other programs may read it while it is written. A new file has a temporary
/// name until keep(), and is removed if keep() is never called.
class OpenHdf5 {
 public:
  enum class Begin : std::uint8_t { anew, as_it_is };
  /// \throws RunError when the file cannot be opened.
  OpenHdf5(const std::filesystem::path& file, Begin begin);
  ~OpenHdf5();
  OpenHdf5(const OpenHdf5&) = delete;
  OpenHdf5& operator=(const OpenHdf5&) = delete;

  /// Calls `change`, which may add at most about `bytes` bytes of arrays to the file, and flushes.
  /// \throws RunError, naming the file, if the disk has no space for it or if HDF5 fails.
  void write(std::size_t bytes, const std::function<void(H5::H5File&)>& change);
  /// Gives a new file its final name and replaces an older file. \throws RunError.
  void keep();
  /// Closes the file after the last change. \throws RunError, naming the file, if that fails.
  void end();
  H5::H5File& hdf5() { return *hdf5_; }

 private:
  void close();
  void close_hdf5();

  std::filesystem::path file_, part_;  ///< part_: temporary name of a new file until keep(); otherwise empty
  int descriptor_ = -1;                ///< descriptor of the same file, to reserve disk space and give it back
  std::unique_ptr<H5::H5File> hdf5_;
};

/// Calls f(). During the call HDF5 prints no errors. \throws RunError, naming the file, if HDF5 fails or memory runs
/// out.
void with_hdf5(const std::filesystem::path& file, const std::function<void()>& f);

}  // namespace macadam
