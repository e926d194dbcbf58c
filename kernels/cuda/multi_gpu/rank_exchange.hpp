// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rank_exchange.hpp  Sends messages between the GPUs of several processes (ranks), after each part of a step.
///
/// An array is complete on every device, with each item at the same index. The rank that computes an item sends it to
/// the ranks that read it. RankItems lists these items; a RankExchange sends the items of some arrays together, one
/// message per pair of ranks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "kernels/cuda/device/array.hpp"
#include "kernels/cuda/device/tuning.hpp"
#include "kernels/cuda/multi_gpu/device_team.hpp"

namespace macadam::kernels {

/// Items of an array that ranks send each other. All ranks build the same list; each keeps only the items that it sends
/// or receives. So sender and receiver of a message have its items in the same order.
class RankItems {
 public:
  explicit RankItems(const DeviceTeam& team) : own_(team.first()), send_(team.size()), receive_(team.size()) {}

  /// Adds an item that the rank `owner` sends to the rank `reader`; it is sent once even if it is added several times.
  void add(std::size_t item, std::size_t owner, std::size_t reader) {
    if (owner == reader) return;
    if (owner == own_) send_[reader].push_back(item);
    if (reader == own_) receive_[owner].push_back(item);
  }
  /// Adds an item that the rank `owner` sends to all others.
  void add_for_all(std::size_t item, std::size_t owner) {
    for (std::size_t reader = 0; reader < send_.size(); ++reader) add(item, owner, reader);
  }
  /// Items sent to and received from each rank, [rank], in rising order.
  std::vector<std::vector<std::size_t>> sent() const { return sorted(send_); }
  std::vector<std::vector<std::size_t>> received() const { return sorted(receive_); }

 private:
  using Lists = std::vector<std::vector<std::size_t>>;
  static Lists sorted(Lists lists) {
    for (auto& list : lists) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return lists;
  }
  std::size_t own_;
  Lists send_, receive_;  // [rank]
};

/// Copies items between an array and a message buffer, in words of eight bytes; one thread per word.
template <bool into_buffer>
__global__ void move_items(uint2* array, uint2* buffer, const std::uint32_t* item, const std::uint32_t* place,
                           std::uint32_t items, std::uint32_t words) {
  const std::size_t thread = blockIdx.x * std::size_t{blockDim.x} + threadIdx.x, k = thread / words, w = thread % words;
  if (k >= items) return;
  uint2& in_array = array[std::size_t{item[k]} * words + w];
  uint2& in_buffer = buffer[place[k] + w];
  if constexpr (into_buffer)
    in_buffer = in_array;
  else
    in_array = in_buffer;
}

/// Items of some arrays that are sent together, in one message from a rank to another.
class RankExchange {
 public:
  /// Adds items of `array`, which must keep its address. \throws RunError if an item is not a multiple of eight bytes.
  template <class T>
  void add(T* array, std::size_t words_an_item, const RankItems& items) {
    const std::size_t bytes = words_an_item * sizeof(T);
    if (bytes % sizeof(uint2) != 0)
      throw RunError("ranks: found an array with " + std::to_string(bytes) +
                     " bytes per item, expected a multiple of 8 bytes");
    parts_.push_back({reinterpret_cast<uint2*>(array), static_cast<std::uint32_t>(bytes / sizeof(uint2)), items.sent(),
                      items.received()});
  }

  /// Builds the message buffers and uploads the indices; nothing can be added after this. \throws RunError for messages
  /// of more than 2^32 words or items.
  void make_ready(const DeviceTeam& team) {
    assign_buffer_positions(team, &Part::send, sent_);
    assign_buffer_positions(team, &Part::receive, received_);
    parts_.clear();
  }

  /// Enqueues the messages behind the work in the team's stream. Does nothing if nothing was added.
  void queue(const DeviceTeam& team) const {
    if (sent_.messages.empty() && received_.messages.empty()) return;
    move<true>(sent_, team.stream());
    team.ranks()->queue(sent_.messages, received_.messages, team.stream());
    move<false>(received_, team.stream());
  }

 private:
  using Lists = std::vector<std::vector<std::size_t>>;
  struct Part {
    uint2* array;
    std::uint32_t words;
    Lists send, receive;  // [rank]; empty after make_ready()
  };
  /// Buffer and copies of one direction: sent data, or received data.
  struct Way {
    struct Moved {
      uint2* array;
      std::uint32_t words, items;
      DeviceArray<std::uint32_t> item, place;
    };
    std::vector<Moved> moved;  // one for each part
    DeviceArray<uint2> buffer;
    std::vector<Ranks::Message> messages;
  };

  /// Gives every item its position in the message buffer: all data of one rank are contiguous, array after array.
  void assign_buffer_positions(const DeviceTeam& team, Lists Part::*lists, Way& way) {
    std::vector<std::vector<std::uint32_t>> item(parts_.size()), place(parts_.size());
    std::size_t next = 0;
    std::vector<std::size_t> begin{0};
    for (std::size_t rank = 0; rank < team.size(); ++rank) {
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        for (const std::size_t i : (parts_[p].*lists)[rank]) {
          item[p].push_back(number(i));
          place[p].push_back(number(next));
          next += parts_[p].words;
        }
      }
      begin.push_back(next);
    }
    way.buffer = DeviceArray<uint2>(next);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      way.moved.push_back({parts_[p].array, parts_[p].words, static_cast<std::uint32_t>(item[p].size()),
                           DeviceArray<std::uint32_t>::of(item[p]), DeviceArray<std::uint32_t>::of(place[p])});
    }
    for (std::size_t rank = 0; rank < team.size(); ++rank) {
      const std::size_t words = begin[rank + 1] - begin[rank];
      if (words > 0)
        way.messages.push_back({static_cast<int>(rank), way.buffer.data() + begin[rank], words * sizeof(uint2)});
    }
  }
  static std::uint32_t number(std::size_t n) {
    if (n > UINT32_MAX)
      throw RunError("ranks: a message between two ranks has " + std::to_string(n) +
                     " entries, expected fewer than 2^32");
    return static_cast<std::uint32_t>(n);
  }
  template <bool into_buffer>
  static void move(const Way& way, cudaStream_t stream) {
    for (const auto& m : way.moved) {
      const std::size_t words = std::size_t{m.items} * m.words;
      launch("messages", move_items<into_buffer>, (words + copy_threads - 1) / copy_threads, copy_threads, 0, stream,
             m.array, way.buffer.data(), m.item.data(), m.place.data(), m.items, m.words);
    }
  }

  std::vector<Part> parts_;
  Way sent_, received_;
};

/// Completes an array on every device: rank m has the items first(m) … first(m + 1) − 1 and sends them to all other
/// ranks. An item has `words` numbers. Does nothing with one process.
template <class T, class First>
void queue_whole(const DeviceTeam& team, T* array, std::size_t words, First&& first) {
  if (!team.ranks() || !array) return;
  const auto own = team.first();
  const auto begin = [&](std::size_t m) { return static_cast<std::size_t>(first(m)) * words; };
  std::vector<Ranks::Message> sent, received;
  for (std::size_t m = 0; m < team.size(); ++m) {
    const auto add = [&](std::vector<Ranks::Message>& to, std::size_t of) {
      const std::size_t size = (begin(of + 1) - begin(of)) * sizeof(T);
      if (size > 0) to.push_back({static_cast<int>(m), const_cast<std::remove_const_t<T>*>(array) + begin(of), size});
    };
    if (m == own) continue;
    add(sent, own);
    add(received, m);
  }
  team.ranks()->queue(sent, received, team.stream());
}

}  // namespace macadam::kernels
