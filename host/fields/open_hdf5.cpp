// SPDX-License-Identifier: GPL-3.0-or-later
// open_hdf5.cpp  Reserves disk space before HDF5 writes.
#include "host/fields/open_hdf5.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

#include "host/files/quiet_hdf5.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw RunError(file.string() + ": cannot be written: " + std::generic_category().message(error));
}

H5::FileAccPropList access() {
  H5::FileAccPropList out;
  H5Pset_file_locking(out.getId(), false, true);
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(out.getId(), &cache);
  cache.evictions_enabled = false;  // metadata are written to the file only in a flush
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  H5Pset_mdc_config(out.getId(), &cache);
  return out;
}

/// Returns creation properties with large tree nodes. HDF5 stores an array in pieces and finds the pieces by a tree.
/// When a node of the tree is full, HDF5 moves nodes. If the program is killed during a flush that moves nodes, frames
/// are lost. With this many pieces per node only about one flush in a few hundred moves nodes.
H5::FileCreatPropList creation() {
  constexpr unsigned half_of_pieces = 128;
  H5::FileCreatPropList out;
  out.setIstorek(half_of_pieces);
  return out;
}

}  // namespace

void with_hdf5(const std::filesystem::path& file, const std::function<void()>& f) {
  const QuietHdf5 quiet;
  const auto fail = [&](const std::string& what) {
    throw RunError(file.string() + ": HDF5 cannot continue the file: " + what +
                   (quiet.failed() ? ": " + quiet.why() : ""));
  };
  try {
    f();
  } catch (const H5::Exception& error) { fail(error.getDetailMsg()); } catch (const std::bad_alloc&) {
    throw RunError(file.string() + ": not enough memory to write the file");
  }
  if (quiet.failed()) fail("an array cannot be closed");
}

OpenHdf5::OpenHdf5(const std::filesystem::path& file, Begin begin) : file_(file) {
  const bool anew = begin == Begin::anew;
  if (anew) part_ = file.string() + ".part";
  const std::filesystem::path& name = anew ? part_ : file_;
  descriptor_ = ::open(name.c_str(), O_RDWR | O_CLOEXEC | (anew ? O_CREAT | O_TRUNC : 0), 0666);
  if (descriptor_ < 0) refuse(file, errno);
  try {
    with_hdf5(file, [&] {
      require_memory_for_hdf5(0);
      hdf5_ = std::make_unique<H5::H5File>(name.string(), anew ? H5F_ACC_TRUNC : H5F_ACC_RDWR, creation(), access());
      // A flush writes the recorded end of the file last. After a kill during a flush, arrays may lie beyond the
      // recorded end; this call moves the recorded end to the real one.
      if (!anew && H5Fincrement_filesize(hdf5_->getId(), 0) < 0) throw H5::FileIException("H5Fincrement_filesize");
    });
  } catch (...) {
    close();
    throw;
  }
}

OpenHdf5::~OpenHdf5() { close(); }

/// Deletes the HDF5 object only if closing the file succeeds: its destructor closes the file again, and HDF5 crashes if
/// the first attempt has failed.
void OpenHdf5::close_hdf5() {
  H5::H5File* const file = hdf5_.release();
  with_hdf5(file_, [&] { file->close(); });
  delete file;
}

void OpenHdf5::close() {
  try {
    if (hdf5_) close_hdf5();
  } catch (const RunError&) {  // ignored: end() was not called, so another error is already being handled
  }
  if (descriptor_ >= 0) ::close(descriptor_);
  std::error_code ignored;
  if (!part_.empty()) std::filesystem::remove(part_, ignored);
}

void OpenHdf5::write(std::size_t bytes, const std::function<void(H5::H5File&)>& change) {
  constexpr std::size_t bookkeeping = 1 << 21;  // upper bound of the bytes of tree nodes and array headers
  const off_t end = ::lseek(descriptor_, 0, SEEK_END);
  if (end < 0) refuse(file_, errno);
  if (const int error = ::posix_fallocate(descriptor_, end, static_cast<off_t>(bytes + bookkeeping)); error != 0) {
    if (::ftruncate(descriptor_, end) != 0) refuse(file_, errno);
    refuse(file_, error);
  }
  off_t size = 0;
  with_hdf5(file_, [&] {
    require_memory_for_hdf5(2 * bytes);  // twice the size: for converted values, and for HDF5's pieces of arrays
    change(*hdf5_);
    hdf5_->flush(H5F_SCOPE_GLOBAL);
    size = static_cast<off_t>(hdf5_->getFileSize());  // disk space that was reserved beyond this size is released
  });
  if (::ftruncate(descriptor_, size) != 0) refuse(file_, errno);
}

void OpenHdf5::end() {
  close_hdf5();
  if (::close(std::exchange(descriptor_, -1)) != 0) refuse(file_, errno);
}

void OpenHdf5::keep() {
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) refuse(file_, error.value());
  part_.clear();
}

}  // namespace macadam
