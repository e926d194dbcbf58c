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

/// Returns the resident kernel for a geometry (`carried`: updated), a storage of bodies, and laws with or without a
/// memory. With updated geometry, laws with and without a memory have the same kernel.
template <class P>
ResidentKernel<P> resident_kernel(bool carried, BodyStorage storage, bool memory) {
  constexpr int threads = resident_threads;
  const auto of = [&](auto is_carried, auto has_memory) -> ResidentKernel<P> {
    constexpr bool c = decltype(is_carried)::value, m = decltype(has_memory)::value;
    return storage == BodyStorage::shared  ? run_resident<P, threads, c, m, BodyStorage::shared>
           : storage == BodyStorage::split ? run_resident<P, threads, c, m, BodyStorage::split>
                                           : run_resident<P, threads, c, m, BodyStorage::global>;
  };
  if (carried) return of(std::true_type{}, std::true_type{});
  return memory ? of(std::false_type{}, std::true_type{}) : of(std::false_type{}, std::false_type{});
}
/// Returns the streamed kernel for a geometry, and laws with or without a memory.
template <class P>
StreamedKernel<P> streamed_kernel(bool carried, bool memory) {
  if (carried) return run_streamed<P, streamed_threads, streamed_blocks, true, true>;
  return memory ? run_streamed<P, streamed_threads, streamed_blocks, false, true>
                : run_streamed<P, streamed_threads, streamed_blocks, false, false>;
}

/// Returns whether tiles can step a network. They cannot if a contact has rock in series: the words of a contact in a
/// tile (TileContactWords) do not include the factors by which rock in series reduces the change of its forces. Such a
/// network is stepped by two kernels (ExecCuda), whose description gives this reason.
inline bool tiles_can_step(const ContactNetwork& network) {
  return std::ranges::none_of(network.contacts, [](const Contact& c) { return c.series != 0; });
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
                     bool carried) {
  const auto limit = static_cast<std::uint32_t>(limits.shared);
  const auto largest = [&](BodyStorage storage, std::uint32_t available) {
    std::uint32_t bytes = 0;
    for (const Tile& tile : plan.tile)
      bytes = std::max(bytes, ResidentMemory<P>(tile, TileContactWords::constants(carried), storage, available).total);
    return bytes;
  };
  TileFit out{TileFit::Way::resident, BodyStorage::global, 0};
  for (const BodyStorage storage : {BodyStorage::split, BodyStorage::shared}) {
    if (largest(storage, 0) <= limit) out.storage = storage;
  }
  out.shared = largest(out.storage, limit);
  team.each([&](std::size_t m) {
    for (const bool memory : {true, false}) {
      if (!fits_resident(limits, resident_kernel<P>(carried, out.storage, memory), cuts.tile(m + 1) - cuts.tile(m),
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
                  bool carried) {
  if (!plan.fits) return {};
  if (!team.ranks()) {
    const TileFit resident = fit_resident<P>(plan, team, cuts, limits, carried);
    if (resident.way == TileFit::Way::resident) return resident;
  }
  const std::uint32_t shared = StreamedMemory(plan.most_locals, plan.most_cells).total;
  if (shared > static_cast<std::uint32_t>(limits.shared)) return {};
  team.each([&](std::size_t) {
    for (const bool memory : {true, false}) allow_all_shared_memory(limits, streamed_kernel<P>(carried, memory));
  });
  return {TileFit::Way::streamed, BodyStorage::global, shared};
}

}  // namespace macadam::kernels
