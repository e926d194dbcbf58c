// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_limits.hpp  Determines the limits of the devices (GPUs), and whether a kernel of the tile path can run
/// within them.
///
/// By these limits, never by a device's name, fit_tiles() (tiles/tile_fit.hpp) decides whether tiles stay in registers
/// and shared memory (resident) or are read in every step (streamed). By the same limits ExecCudaTiles chooses the size
/// of the tiles, before the layout is made.
#pragma once

#include <algorithm>

#include "kernels/cuda/multi_gpu/device_team.hpp"

namespace macadam::kernels {

/// Limits of a device, or the smallest limits of all devices of a team.
struct DeviceLimits {
  /// Multiprocessors that may be used; shared memory that a thread block may request [byte].
  int multiprocessors = 0, shared = 0;
  bool cooperative = false;  ///< thread blocks of one launch may wait for one another
  /// One instruction writes or reads a word of 16 bytes (compute capability 7.0 or later).
  bool whole_words = false;

  /// Returns the limits of the current device. `multiprocessors`: as in StepperOptions. `shares`: number of equal parts
  /// into which the device is divided.
  static DeviceLimits query(int multiprocessors, int shares = 1) {
    int device = 0, cooperative = 0, major = 0;
    DeviceLimits out;
    check_cuda(cudaGetDevice(&device), "device");
    check_cuda(cudaDeviceGetAttribute(&out.multiprocessors, cudaDevAttrMultiProcessorCount, device), "device");
    check_cuda(cudaDeviceGetAttribute(&out.shared, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "device");
    check_cuda(cudaDeviceGetAttribute(&cooperative, cudaDevAttrCooperativeLaunch, device), "device");
    check_cuda(cudaDeviceGetAttribute(&major, cudaDevAttrComputeCapabilityMajor, device), "device");
    out.multiprocessors = std::max(1, out.multiprocessors / shares);
    if (multiprocessors > 0) out.multiprocessors = std::min(out.multiprocessors, multiprocessors);
    out.cooperative = cooperative != 0;
    out.whole_words = major >= 7;
    return out;
  }
  /// Returns limits that every member of the team satisfies.
  static DeviceLimits of_each(const DeviceTeam& team, int multiprocessors) {
    DeviceLimits out;
    team.each([&](std::size_t m) {
      const DeviceLimits own = query(multiprocessors, team.shares_of(m));
      out = m == team.first()
                ? own
                : DeviceLimits{std::min(out.multiprocessors, own.multiprocessors), std::min(out.shared, own.shared),
                               out.cooperative && own.cooperative, out.whole_words && own.whole_words};
    });
    if (Ranks* ranks = team.ranks()) {  // all ranks must plan the same tiles
      out.multiprocessors = static_cast<int>(ranks->least(out.multiprocessors));
      out.shared = static_cast<int>(ranks->least(out.shared));
    }
    return out;
  }
};

/// Allows launches of a kernel to use all shared memory that the device offers to a thread block. The limit applies to
/// the whole process: if it were set to the memory that one specimen needs, the kernel could not be launched for
/// another specimen that needs more.
template <class... Parameters>
void allow_all_shared_memory(const DeviceLimits& limits, void (*kernel)(Parameters...)) {
  cudaFuncAttributes attributes{};
  check_cuda(cudaFuncGetAttributes(&attributes, kernel), "shared memory");
  check_cuda(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                  limits.shared - static_cast<int>(attributes.sharedSizeBytes)),
             "shared memory");
}

/// Returns whether all thread blocks of a kernel can run on the device at the same time, one per multiprocessor.
template <class... Parameters>
bool fits_resident(const DeviceLimits& limits, void (*kernel)(Parameters...), std::size_t blocks, int threads,
                   std::uint32_t shared) {
  if (!limits.cooperative || !limits.whole_words || blocks > static_cast<std::size_t>(limits.multiprocessors)) {
    return false;
  }
  if (shared > static_cast<std::uint32_t>(limits.shared)) return false;
  int fitting = 0;
  allow_all_shared_memory(limits, kernel);
  check_cuda(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&fitting, kernel, threads, shared), "occupancy");
  return fitting > 0;
}

}  // namespace macadam::kernels
