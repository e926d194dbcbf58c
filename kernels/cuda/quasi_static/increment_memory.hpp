// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increment_memory.hpp  Allocates the arrays of quasi-static increments on a device.
#pragma once

#include "kernels/cuda/device/device_store.hpp"
#include "kernels/cuda/quasi_static/coarse_kernels.hpp"
#include "kernels/cuda/quasi_static/contact_kernels.hpp"

namespace macadam::kernels {

/// Returns the number of thread blocks that give `threads` threads.
inline unsigned blocks_of(std::size_t threads) {
  return static_cast<unsigned>((threads + increment_threads - 1) / increment_threads);
}
/// Returns the number of thread blocks with one warp per item.
inline unsigned warp_blocks(std::size_t items) {
  return static_cast<unsigned>((items + increment_warps - 1) / increment_warps);
}

/// All arrays of one specimen. They keep their addresses, so that graphs can be recorded.
class IncrementMemory {
 public:
  IncrementView view{};
  GradientView gradients{};
  IncrementLaw* laws;                     ///< by pair type
  double *intact, *correction, *by_wall;  ///< [6·bodies]
  double *openings, *sums;                ///< sums of thread blocks; results of sums
  IncrementSums* trial_sums;
  unsigned long long* loose;
  double *coarse, *least_pivots, *pivot_tile, *row_tiles, *column_tiles;
  unsigned tiles, pairs;
  std::size_t entries;

  explicit IncrementMemory(const IncrementSystem& s) {
    const std::size_t bodies = s.bodies(), degrees = 6 * bodies, contacts = s.contacts.size(),
                      points = s.point_s.size();
    entries = s.entry_row.size();
    IncrementView& v = view;
    v.bodies = static_cast<unsigned>(bodies), v.boxes = static_cast<unsigned>(s.boxes());
    v.contacts = static_cast<unsigned>(contacts), v.linear_contacts = static_cast<unsigned>(s.linear.size());
    v.points = static_cast<unsigned>(points);
    v.linear_words = s.linear_words, v.point_words = s.point_words;
    v.contact = store_.keep(s.contacts), v.linear = store_.keep(s.linear);
    v.point_of = store_.keep(s.point_of), v.point_contact = store_.keep(s.point_contact);
    v.point_s = store_.keep(s.point_s), v.point_t = store_.keep(s.point_t), v.point_area = store_.keep(s.point_area);
    v.end_begin = store_.keep(s.end_begin), v.ends = store_.keep(s.ends), v.end_entry = store_.keep(s.end_entry);
    v.entry_begin = store_.keep(s.entry_begin);
    v.entry_row = store_.keep(s.entry_row), v.entry_column = store_.keep(s.entry_column);
    v.wall_begin = store_.keep(s.wall_begin), v.wall_contact = store_.keep(s.wall_contact);
    v.box_body = store_.keep(s.box_body), v.lever = store_.keep(s.lever);
    v.pairs = store_.keep(s.pairs), v.pair_entry = store_.keep(s.pair_entry);
    v.laws = laws = store_.zeros<IncrementLaw>(pair_types);
    v.intact = intact = numbers(degrees);
    v.linear_state = numbers(6 * static_cast<std::size_t>(s.linear_words) * s.linear.size());
    v.point_state = numbers(3 * static_cast<std::size_t>(s.point_words) * points);
    v.linear_base = numbers(6 * s.linear.size()), v.point_base = numbers(3 * points);
    v.point_drag = numbers(3 * points);
    v.grew = store_.zeros<std::uint8_t>(points), v.grows = store_.zeros<std::uint8_t>(points);
    for (double** vector : {&v.displacement, &v.trial, &v.kept, &v.residual, &v.top, &correction, &by_wall})
      *vector = numbers(degrees);
    v.loads = numbers(12 * contacts), v.stiffness = numbers(36 * contacts), v.rate = numbers(6 * contacts);
    v.blocks = numbers(36 * entries);
    v.partial = numbers(most_sums * (blocks_of(contacts) + blocks_of(points) + warp_blocks(bodies) + 1024));
    openings = numbers(blocks_of(point_lanes * contacts) + 1);
    sums = numbers(16);
    trial_sums = store_.zeros<IncrementSums>(1);
    loose = store_.zeros<unsigned long long>(1);

    const std::size_t size = 6 * s.boxes();
    tiles = static_cast<unsigned>((size + tile - 1) / tile);
    pairs = static_cast<unsigned>(s.pairs.size() - 1);
    GradientView& g = gradients;
    for (double** vector : {&g.x, &g.r, &g.z, &g.p, &g.q}) *vector = numbers(degrees);
    inverse_ = numbers(36 * bodies);
    g.inverse = inverse_;
    g.coarse_stride = tiles * tile, g.coarse_blocks = warp_blocks(size);
    coarse = numbers(std::size_t{g.coarse_stride} * g.coarse_stride);
    least_pivots = numbers(g.coarse_stride);
    g.coarse = coarse;
    pivot_tile = numbers(tile_numbers), row_tiles = numbers(std::size_t{tiles} * tile_numbers);
    column_tiles = numbers(std::size_t{tiles} * tile_numbers);
    g.box_loads = numbers(size), g.box_moves = numbers(size);
    g.products = numbers(product_blocks), g.fine = numbers(s.boxes()), g.coarse_sums = numbers(g.coarse_blocks);
    g.state = store_.zeros<GradientState>(1);
  }

  double* inverse() const { return inverse_; }
  std::int64_t bytes() const { return store_.bytes(); }

 private:
  /// Sums per thread block, at most.
  static constexpr std::size_t most_sums = crack_sums;
  double* numbers(std::size_t count) { return store_.zeros<double>(count); }

  DeviceStore store_;
  double* inverse_;
};

}  // namespace macadam::kernels
