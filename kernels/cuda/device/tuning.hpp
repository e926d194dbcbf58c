// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tuning.hpp  Holds the numbers on which the speed of the CUDA code depends. Each comment gives the measurement
/// by which the number was chosen.
///
/// These numbers do not change results, with one exception: tile sizes change the layout, and the executor with two
/// kernels per step sums loads in the order of the layout. The times [µs] are per step of the full specimen (35,760
/// particles, some 221,000 contacts) on one H200, unless another device is named. They come from
/// bench/results/tried-gpu-step.csv ("tried" below). If measurements with other values are not recorded, the
/// comment says so. Two numbers of the tile path are in layout/tile_plan.hpp, because the plan is made without CUDA:
/// TilePlan::couple and TilePlan::longest_short_list.
#pragma once

#include <cstddef>
#include <cstdint>

namespace macadam::kernels {

// ---- two kernels per step (cuda/two_kernels), and the update between blocks (cuda/tiles/settle_kernels.hpp) ----

/// Threads per block of step_contacts and settle_contacts, and the smallest number of such blocks per multiprocessor.
/// Double precision: 46.2 µs with four blocks (126 registers per thread); blocks of 64, 96 or 256 threads, and 96 or 80
/// registers, change this by at most 2 % (tried).
inline constexpr unsigned contact_threads = 128, contact_blocks = 4;

/// Threads per block of the kernels that sum load records (eight threads per body). Double precision: 46.7 µs with
/// eight threads per body, 49.2 to 50.3 µs with four threads per body (tried).
inline constexpr unsigned body_threads = 256;
/// Smallest number of thread blocks of step_bodies per multiprocessor. With more, threads have too few registers to
/// request all records of a body at once. Double precision: 45.4 µs with four blocks, 47.1 µs with more.
inline constexpr unsigned body_blocks = 4;
/// Load records that a thread requests before it adds the first. A body has about twelve. Double precision: 63.4 µs
/// before records were requested in batches, 58.4 µs with batches of eight (tried).
inline constexpr unsigned records_requested = 8;
/// A body with more load records than this gets a thread block of its own. A large aggregate has hundreds of records.
/// Measurements with other values are not recorded.
inline constexpr std::uint32_t long_list = 64;
/// Steps that ExecCuda records in one graph; a graph of one step takes the remaining steps. Measurements with other
/// values are not recorded.
inline constexpr std::int64_t steps_per_graph = 64;

// ---- tiles in registers and shared memory (cuda/tiles/resident_kernel.hpp) ----

/// Threads per tile. With 512 threads a thread has 128 registers, and a contact's state takes twelve. Single precision:
/// 7.8 µs with 768 threads and three contacts per thread in registers, 7.7 µs with 576 threads and four contacts, 7.4
/// µs with 512 and five, 7.3 µs with 512 and four (tried).
inline constexpr std::uint32_t resident_threads = 512;
/// Double packets (pairs of packets) whose states a warp keeps in registers: one that it steps before the velocities of
/// other tiles have arrived, and one that it steps after that. Single precision: 10.2 µs without states in registers,
/// 9.0 µs with them (tried; both with particle data in global memory).
inline constexpr std::uint32_t double_packets_in_registers = 2;
/// Packets per warp that keep their constants in registers, too. They are the last ones among the packets that keep
/// their states in registers. `memory`: some law has a memory; the sums of its contacts then leave no registers for
/// constants. Elastic scenes in single precision: 5.40 µs with one packet, 4.99 µs with two (tried).
#ifdef __CUDACC__
__host__ __device__
#endif
    constexpr std::uint32_t
    packets_with_constants(bool memory) {
  return memory ? 0 : 2;
}
/// Smallest number of contacts per resident tile. Smaller tiles would consist mostly of halo (particles of other
/// tiles). Measurements with other values are not recorded.
inline constexpr std::size_t least_resident_contacts = 128;
/// Expected size of the fullest tile, divided by the mean size of the tiles. After the tiles are balanced the fullest
/// has 68 packets and the mean is 65 (tried), a ratio of 1.05.
inline constexpr double fullest_tile = 1.06;
/// Expected number of contacts that are computed, divided by the number of contacts: a contact between two tiles is
/// computed by both. The full specimen (221,000 contacts) in 132 tiles has 65 packets of 32 contacts per tile (tried),
/// which is 1.25 times the number of its contacts.
inline constexpr double computed_per_contact = 1.3;

// ---- tiles streamed from global memory (cuda/tiles/streamed_kernel.hpp) ----

/// Threads per tile, and tiles per multiprocessor. With two tiles, one works while the other waits at a barrier.
/// Measurements with other values are not recorded.
inline constexpr int streamed_threads = 256, streamed_blocks = 2;
/// Contacts per streamed tile: `streamed_contacts`, or fewer if two tiles would not fit in the shared memory of a
/// multiprocessor. `shared_bytes_per_contact` is about twice the shared memory that a tile needs per contact, its halo
/// included. Measurements with other values are not recorded. With tiles of this size a lattice of 1e6 particles
/// takes 514 µs per step in single precision (bench/results/bench-h200-2026-11-26-chip.csv).
inline constexpr std::size_t streamed_contacts = 1500, shared_bytes_per_contact = 115;

// ---- resident and streamed tiles ----

/// Samples that a device takes before the host reads them. After a particle has diverged, at most this many intervals
/// between samples are computed in vain. Measurements with other values are not recorded.
inline constexpr std::size_t samples_per_read = 64;
/// Threads per block of kernels that do little work per thread: the first move of streamed tiles, and body forces.
inline constexpr unsigned short_kernel_threads = 128;
/// Threads per block of the kernels that search for divergent particles and pack messages between ranks.
inline constexpr unsigned copy_threads = 256;

// ---- frequency domain (cuda/harmonic) ----

/// Threads per block of all kernels of the iterative solver. Measurements with other values are not recorded.
inline constexpr unsigned cocg_threads = 256;
/// A body with at least this many contacts is computed by all warps of a block. A large aggregate has hundreds of
/// contacts; one warp would need more time for it than all other warps for all other bodies. Measurements with other
/// values are not recorded.
inline constexpr unsigned many_contacts = 64;
/// Segments (ranges of bodies that one thread block works on) per multiprocessor of one device. The number of segments
/// does not depend on the number of devices. With two devices there are 8 segments per multiprocessor, which is the
/// largest number of blocks of `cocg_threads` threads that a multiprocessor can hold (2048 / 256). Measurements with
/// other values are not recorded.
inline constexpr std::size_t segments_per_multiprocessor = 16;
/// Iterations that the host enqueues before it looks at the residuals of the previous batch. Measurements with other
/// values are not recorded.
inline constexpr int iterations_per_batch = 8;

// ---- quasi-static increments (cuda/quasi_static) ----
// The numbers of this part have not been measured against others yet.

/// Threads per block of all kernels.
inline constexpr unsigned increment_threads = 256;
/// Threads that share the points of one contact; a contact has seven points on average.
inline constexpr unsigned point_lanes = 8;
/// Thread blocks of the product with the tangent; each has one partial sum.
inline constexpr unsigned product_blocks = 1056;
/// Iterations of conjugate gradients that the host enqueues before it looks at the result of the previous batch.
inline constexpr int increment_batch = 8;

}  // namespace macadam::kernels
