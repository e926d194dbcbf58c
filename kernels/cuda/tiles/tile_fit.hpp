// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_fit.hpp  Decides by the limits of the devices whether the planned tiles run resident (in registers and
/// shared memory), streamed (read from memory in every step) or not at all.
///
/// ExecCudaTiles asks fit_tiles() before it allocates anything on a device. docs/gpu-step.md explains resident and
/// streamed tiles.
#pragma once

#include <algorithm>

#include "kernels/cuda/device/tuning.hpp"
#include "kernels/cuda/multi_gpu/device_limits.hpp"
#include "kernels/cuda/tiles/resident_kernel.hpp"
#include "kernels/cuda/tiles/streamed_kernel.hpp"

namespace macadam::kernels {

template <class P>
using ResidentKernel = void (*)(TileArrays<P>, std::uint32_t steps, std::uint32_t first_tag);
template <class P>
using StreamedKernel = void (*)(TileArrays<P>, std::uint32_t step, bool last);

/// Returns whether tiles can step a network. They cannot if several ranks step contacts with rock in series, because
/// the messages between ranks do not include the factor of the rock. Such a network is stepped by two kernels
/// (ExecCuda), whose description gives this reason.
inline bool tiles_can_step(const ContactNetwork& network, const StepperOptions& options) {
  return !options.ranks || !tile_content(network, options).series;
}

/// Returns the resident kernel for a content, a storage of bodies, and laws with or without a memory. With frames, laws
/// with and without a memory have the same kernel.
template <class P>
ResidentKernel<P> resident_kernel(TileContent content, BodyStorage storage, bool memory) {
  constexpr int threads = resident_threads;
  const auto of = [&](auto is_carried, auto has_memory, auto has_series) -> ResidentKernel<P> {
    constexpr bool c = decltype(is_carried)::value, m = decltype(has_memory)::value, r = decltype(has_series)::value;
    return storage == BodyStorage::shared  ? run_resident<P, threads, c, m, BodyStorage::shared, r>
           : storage == BodyStorage::split ? run_resident<P, threads, c, m, BodyStorage::split, r>
                                           : run_resident<P, threads, c, m, BodyStorage::global, r>;
  };
  const std::true_type yes;
  const std::false_type no;
  if (content.series) return of(yes, yes, yes);
  if (content.carried) return of(yes, yes, no);
  return memory ? of(no, yes, no) : of(no, no, no);
}
/// Returns the streamed kernel for a content, and laws with or without a memory.
template <class P>
StreamedKernel<P> streamed_kernel(TileContent content, bool memory) {
  if (content.series) return run_streamed<P, streamed_threads, streamed_blocks, true, true, true>;
  if (content.carried) return run_streamed<P, streamed_threads, streamed_blocks, true, true>;
  return memory ? run_streamed<P, streamed_threads, streamed_blocks, false, true>
                : run_streamed<P, streamed_threads, streamed_blocks, false, false>;
}

/// Says by which kernel the tiles of a plan are stepped.
struct TileFit {
  enum class Way { none, resident, streamed };
  Way way = Way::none;                        ///< none: no kernel fits these devices
  BodyStorage storage = BodyStorage::global;  ///< resident tiles only
  std::uint32_t shared = 0;                   ///< shared memory of a thread block [byte]
};

/// Returns how resident tiles fit. Among the storages of bodies with which the tiles fit in shared memory, chooses the
/// one with the most data in shared memory.
template <class P>
TileFit fit_resident(const TilePlan& plan, const DeviceTeam& team, const TeamCuts& cuts, const DeviceLimits& limits,
                     TileContent content) {
  const auto limit = static_cast<std::uint32_t>(limits.shared);
  const auto largest = [&](BodyStorage storage, std::uint32_t available) {
    std::uint32_t bytes = 0;
    for (const Tile& tile : plan.tile)
      bytes = std::max(bytes,
                       ResidentMemory<P>(tile, TileContactWords::constants(content.carried), storage, available).total);
    return bytes;
  };
  TileFit out{TileFit::Way::resident, BodyStorage::global, 0};
  for (const BodyStorage storage : {BodyStorage::split, BodyStorage::shared}) {
    if (largest(storage, 0) <= limit) out.storage = storage;
  }
  out.shared = largest(out.storage, limit);
  team.each([&](std::size_t m) {
    for (const bool memory : {true, false}) {
      if (!fits_resident(limits, resident_kernel<P>(content, out.storage, memory), cuts.tile(m + 1) - cuts.tile(m),
                         resident_threads, out.shared))
        out.way = TileFit::Way::none;
    }
  });
  return out;
}

/// Returns how the tiles run on the devices of a team. With ranks, tiles cannot be resident, because resident tiles
/// read the memory of other devices.
template <class P>
TileFit fit_tiles(const TilePlan& plan, const DeviceTeam& team, const TeamCuts& cuts, const DeviceLimits& limits,
                  TileContent content) {
  if (!plan.fits) return {};
  if (!team.ranks()) {
    const TileFit resident = fit_resident<P>(plan, team, cuts, limits, content);
    if (resident.way == TileFit::Way::resident) return resident;
  }
  const std::uint32_t shared = StreamedMemory(plan.most_locals, plan.most_cells).total;
  if (shared > static_cast<std::uint32_t>(limits.shared)) return {};
  team.each([&](std::size_t) {
    for (const bool memory : {true, false}) allow_all_shared_memory(limits, streamed_kernel<P>(content, memory));
  });
  return {TileFit::Way::streamed, BodyStorage::global, shared};
}

}  // namespace macadam::kernels
