// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cocg_memory.hpp  Allocates the device arrays of a linear system and of an iteration for a team of devices.
///
/// Each device (GPU) works on consecutive segments, which are ranges of bodies (cocg_view.hpp). The sums of each box of
/// bodies are written to all devices. So each device computes the same scalars itself and need not wait for the scalars
/// of another device. From other devices it only reads the motions of their bodies.
#pragma once

#include <algorithm>
#include <vector>

#include "kernels/cuda/multi_gpu/device_team.hpp"
#include "kernels/cuda/harmonic/cocg_coarse.hpp"
#include "kernels/cuda/harmonic/cocg_view.hpp"

namespace macadam::kernels {

/// The arrays of a linear system on the devices of a team.
struct SystemMemory {
  std::size_t bodies, boxes, segments;
  int free;
  std::vector<std::size_t> first_segment, first_body;  ///< [member + 1] of each member of the team
  Shares by_body;
  DeviceArray<std::int32_t> particle;
  DeviceArray<std::size_t> row_begin;
  DeviceArray<ContactEnd> ends;
  DeviceArray<double> series;                 ///< LinearSystem::series
  DeviceArray<double> mass, motion, inverse;  ///< inverse: packed blocks, filled in by invert_blocks
  DeviceArray<Lever> lever;
  /// Arrays of which each member of the team has its own.
  struct OfMember {
    DeviceArray<Segment> segment;
    DeviceArray<std::int32_t> box_segment;
    DeviceArray<double> coarse, weight;
    DeviceArray<unsigned> box_ticket, ticket;
  };
  std::vector<OfMember> members;

  SystemMemory(const LinearSystem& system, const DeviceTeam& team)
      : bodies(system.bodies()), boxes(system.boxes()), free(system.free) {
    std::vector<Segment> runs;
    std::vector<std::int32_t> box_segment{0};
    make_segments(system, team, runs, box_segment);
    segments = runs.size();
    for (std::size_t m = 0; m <= team.size(); ++m) {
      first_segment.push_back(m * segments / team.size());
      first_body.push_back(m == team.size() ? bodies : static_cast<std::size_t>(runs[first_segment.back()].first));
    }
    // Returns how an array is divided among the devices; first(b) is the index of the first item of body b
    const auto share = [&](auto&& first) {
      Shares out;
      for (std::size_t m = 0; m < team.size(); ++m) out.push_back({first(first_body[m + 1]), team.device(m)});
      return out;
    };
    const Shares rows = share([&](std::size_t body) { return body + (body == bodies); }),
                 contacts = share([&](std::size_t body) { return system.row_begin[body]; });
    by_body = share([](std::size_t body) { return body; });
    particle = DeviceArray<std::int32_t>::of(system.particle, by_body);
    row_begin = DeviceArray<std::size_t>::of(system.row_begin, rows);
    ends = DeviceArray<ContactEnd>::of(system.ends, contacts);
    if (!system.series.empty()) series = DeviceArray<double>::of(system.series, contacts);
    mass = DeviceArray<double>::of(system.mass, by_body);
    motion = DeviceArray<double>::of(system.motion, by_body);
    lever = DeviceArray<Lever>::of(system.lever, by_body);
    inverse = DeviceArray<double>(by_body, packed_block);
    team.each([&](std::size_t) {
      members.push_back({DeviceArray<Segment>::of(runs), DeviceArray<std::int32_t>::of(box_segment),
                         DeviceArray<double>::of(system.coarse), DeviceArray<double>::of(system.weight),
                         DeviceArray<unsigned>(boxes), DeviceArray<unsigned>(1)});
    });
  }

 private:
  /// Divides the bodies of each box into segments of a multiple of 32 bodies. There are about
  /// `segments_per_multiprocessor` segments per multiprocessor of one device. The number of segments does not depend on
  /// the number of devices.
  void make_segments(const LinearSystem& system, const DeviceTeam& team, std::vector<Segment>& runs,
                     std::vector<std::int32_t>& box_segment) const {
    int multiprocessors = 0;
    check_cuda(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, team.device(0)), "device");
    const std::size_t wanted = bodies / (static_cast<std::size_t>(multiprocessors) * segments_per_multiprocessor) + 1;
    const auto length = static_cast<std::int32_t>((wanted + 31) / 32 * 32);
    for (std::size_t b = 0; b < boxes; ++b) {
      for (std::int32_t i = system.box_body[b]; i < system.box_body[b + 1]; i += length) {
        runs.push_back({i, std::min(i + length, system.box_body[b + 1]), static_cast<std::int32_t>(b)});
      }
      box_segment.push_back(static_cast<std::int32_t>(runs.size()));
    }
  }
};

/// The vectors and sums of an iteration with F loads.
template <int F>
struct VectorMemory {
  static constexpr std::size_t lanes = 2 * F;
  DeviceArray<double> x, r, p, q, z;
  /// Arrays of which each member of the team has its own.
  struct OfMember {
    DeviceArray<double> segment_products, segment_sums, products, sums, loads, fine, boxes_move, coarse_sums;
    DeviceArray<CocgScalars<F>> scalars;
    DeviceArray<CocgBoxes> all;
  };
  std::vector<OfMember> members;

  VectorMemory(const SystemMemory& system, const DeviceTeam& team)
      : x(system.by_body, 6 * lanes),
        r(system.by_body, 6 * lanes),
        p(system.by_body, 6 * lanes),
        q(system.by_body, 6 * lanes),
        z(system.by_body, 6 * lanes) {
    const auto numbers = [](std::size_t count) { return DeviceArray<double>(count * lanes); };
    team.each([&](std::size_t) {
      members.push_back({numbers(system.segments * 2), numbers(system.segments * box_sums), numbers(system.boxes * 2),
                         numbers(system.boxes * fine_sums), numbers(system.boxes * 6), numbers(fine_sums),
                         numbers(system.boxes * 6), numbers(row_blocks(system.boxes) * coarse_sums),
                         DeviceArray<CocgScalars<F>>(1), DeviceArray<CocgBoxes>(team.size())});
    });
    std::vector<CocgBoxes> all;
    for (const OfMember& m : members) all.push_back({m.products.data(), m.sums.data(), m.loads.data()});
    for (OfMember& m : members) m.all.upload(all.data());
  }

  /// Returns the arguments of kernels on member m.
  CocgView<F> view(const SystemMemory& system, std::size_t m) const {
    const SystemMemory::OfMember& of_system = system.members[m];
    const OfMember& own = members[m];
    const auto scratch = [&](std::size_t member) -> CocgScratch {
      return {members[member].segment_products.data(), members[member].segment_sums.data(),
              system.members[member].box_ticket.data()};
    };
    return {of_system.segment.data(),
            of_system.box_segment.data(),
            system.row_begin.data(),
            system.ends.data(),
            system.series.size() > 0 ? system.series.data() : nullptr,
            system.mass.data(),
            system.inverse.data(),
            system.motion.data(),
            system.lever.data(),
            of_system.coarse.data(),
            of_system.weight.data(),
            x.data(),
            r.data(),
            p.data(),
            q.data(),
            z.data(),
            {own.products.data(), own.sums.data(), own.loads.data()},
            own.all.data(),
            scratch(m),
            scratch(0),
            own.fine.data(),
            own.boxes_move.data(),
            own.coarse_sums.data(),
            of_system.ticket.data(),
            own.scalars.data(),
            static_cast<unsigned>(members.size()),
            static_cast<unsigned>(system.boxes),
            system.free};
  }
};

}  // namespace macadam::kernels
