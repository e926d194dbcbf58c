// SPDX-License-Identifier: GPL-3.0-or-later
/// \file spread_memory.hpp  Allocates memory with one range of addresses whose pages are on several devices. All
/// of these devices can read and write it.
#pragma once

#include <cuda.h>
#include <cuda_runtime.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "macadam/error.hpp"

namespace macadam::kernels {

/// One device's part of an array: the items from the end of the previous share up to `end` are on device `device`.
struct Share {
  std::size_t end;
  int device;
};
using Shares = std::vector<Share>;

/// \throws RunError that says how much memory the current device has left.
[[noreturn]] inline void throw_out_of_memory(std::size_t needed, const std::string& why) {
  std::size_t free = 0, total = 0;
  int device = 0;
  cudaGetDevice(&device);
  cudaMemGetInfo(&free, &total);
  throw RunError("CUDA: device " + std::to_string(device) + " has " + std::to_string(free >> 20) + " of " +
                 std::to_string(total >> 20) + " MiB left, and the next array needs " + std::to_string(needed >> 20) +
                 " MiB: " + why);
}

/// Returns a function of the CUDA driver, looked up by name. A program that is linked to the driver would not start on
/// a machine without the driver.
template <class Function>
Function driver_function(const char* name) {
  void* found = nullptr;
  cudaDriverEntryPointQueryResult result{};
#if CUDART_VERSION >= 12050
  const cudaError_t status = cudaGetDriverEntryPointByVersion(name, &found, 12000, cudaEnableDefault, &result);
#else
  const cudaError_t status = cudaGetDriverEntryPoint(name, &found, cudaEnableDefault, &result);
#endif
  if (status != cudaSuccess || !found) throw RunError(std::string("CUDA: the driver has no ") + name);
  return reinterpret_cast<Function>(found);
}

/// Memory for the items of `shares`; an item has `bytes` bytes. Each page is on the device whose items fill most of the
/// page.
class SpreadMemory {
 public:
  SpreadMemory() = default;
  /// \throws RunError if a device has too little memory left.
  // Calls the constructor without arguments first, so that the destructor also runs if the body below throws
  SpreadMemory(const Shares& shares, std::size_t bytes) : SpreadMemory() {
    const auto reserve = driver_function<decltype(&cuMemAddressReserve)>("cuMemAddressReserve");
    const auto granularity = driver_function<decltype(&cuMemGetAllocationGranularity)>("cuMemGetAllocationGranularity");
    const auto set_access = driver_function<decltype(&cuMemSetAccess)>("cuMemSetAccess");
    CUmemAllocationProp place{};
    place.type = CU_MEM_ALLOCATION_TYPE_PINNED;
    place.location.type = CU_MEM_LOCATION_TYPE_DEVICE;
    place.location.id = shares.front().device;
    std::size_t page = 0;
    check(granularity(&page, &place, CU_MEM_ALLOC_GRANULARITY_RECOMMENDED), "granularity");
    const std::size_t whole = (shares.back().end * bytes + page - 1) / page * page;
    check(reserve(&begin_, whole, 0, 0, 0), "reserving addresses");
    size_ = whole;
    std::vector<CUmemAccessDesc> readers;
    for (const Share& share : shares) {
      place.location.id = share.device;
      const std::size_t end = &share == &shares.back() ? size_ : (share.end * bytes + page / 2) / page * page;
      if (end > mapped_) map(place, end - mapped_);
      if (std::none_of(readers.begin(), readers.end(), [&](const auto& r) { return r.location.id == share.device; }))
        readers.push_back({place.location, CU_MEM_ACCESS_FLAGS_PROT_READWRITE});
    }
    check(set_access(begin_, size_, readers.data(), readers.size()), "access to spread memory");
  }
  SpreadMemory(SpreadMemory&& other) noexcept { *this = std::move(other); }
  SpreadMemory& operator=(SpreadMemory&& other) noexcept {
    std::swap(begin_, other.begin_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    return *this;
  }
  ~SpreadMemory() {
    if (size_ == 0) return;
    try {  // the driver that mapped the memory also has these functions, so look-up cannot fail
      if (mapped_ > 0) driver_function<decltype(&cuMemUnmap)>("cuMemUnmap")(begin_, mapped_);
      driver_function<decltype(&cuMemAddressFree)>("cuMemAddressFree")(begin_, size_);
    } catch (const RunError&) {}
  }

  void* data() const { return reinterpret_cast<void*>(begin_); }

 private:
  static void check(CUresult status, const std::string& what) {
    if (status != CUDA_SUCCESS)
      throw RunError("CUDA: " + what + ": error " + std::to_string(status) + " of the driver");
  }
  /// Maps the next pages, on the device that `place` names. The memory exists as long as the mapping.
  void map(const CUmemAllocationProp& place, std::size_t bytes) {
    CUmemGenericAllocationHandle pages{};
    const CUresult made = driver_function<decltype(&cuMemCreate)>("cuMemCreate")(&pages, bytes, &place, 0);
    if (made == CUDA_ERROR_OUT_OF_MEMORY) {
      cudaSetDevice(place.location.id);
      throw_out_of_memory(bytes, "out of memory");
    }
    check(made, "spread memory");
    const CUresult mapped = driver_function<decltype(&cuMemMap)>("cuMemMap")(begin_ + mapped_, bytes, 0, pages, 0);
    driver_function<decltype(&cuMemRelease)>("cuMemRelease")(pages);
    check(mapped, "mapping spread memory");
    mapped_ += bytes;
  }

  CUdeviceptr begin_ = 0;
  std::size_t size_ = 0, mapped_ = 0;
};

}  // namespace macadam::kernels
