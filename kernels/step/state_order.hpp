// SPDX-License-Identifier: GPL-3.0-or-later
/// \file state_order.hpp  Maps the numbers of a checkpoint (in the order of the specimen and the network) to their
/// indices in the arrays of an executor.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/contact/contact_data.hpp"

namespace macadam::kernels {

/// Order of an array whose items have the same number of words. Word k of item i of a checkpoint is at first[i] +
/// word[k] of the executor's array. If the executor stores the item twice (a contact computed by two tiles), the word
/// is also at twin[i] + word[k].
struct StateOrder {
  static constexpr std::uint64_t none = UINT64_MAX;
  std::vector<std::uint64_t> first, word;
  std::vector<std::uint64_t> twin;  ///< empty, or one per item: `none` if the item is stored once

  std::size_t size() const { return first.size() * word.size(); }

  /// Returns the numbers in the order of a checkpoint, from the executor's array `own`.
  template <class T>
  std::vector<T> gathered(const std::vector<T>& own) const {
    std::vector<T> out(size());
    each([&](std::size_t i, std::size_t k, std::size_t at) { out[at] = own[first[i] + word[k]]; });
    return out;
  }
  /// Writes numbers in the order of a checkpoint into the executor's array `own`.
  template <class T>
  void scatter(const std::vector<T>& from, std::vector<T>& own) const {
    each([&](std::size_t i, std::size_t k, std::size_t at) {
      own[first[i] + word[k]] = from[at];
      if (!twin.empty() && twin[i] != none) own[twin[i] + word[k]] = from[at];
    });
  }

 private:
  template <class F>
  void each(F&& f) const {
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t k = 0; k < word.size(); ++k) f(i, k, i * word.size() + k);
    }
  }
};

/// Returns 0, stride, 2·stride, …
inline std::vector<std::uint64_t> strided(std::size_t count, std::size_t stride) {
  std::vector<std::uint64_t> out(count);
  for (std::size_t k = 0; k < count; ++k) out[k] = k * stride;
  return out;
}

/// Returns the order of arrays [body][words], with or without the walls.
inline StateOrder body_order(const Layout& layout, std::size_t words, bool with_walls = true) {
  StateOrder out{{}, strided(words, 1), {}};
  const std::size_t n = layout.particles();
  for (std::size_t i = 0; i < n; ++i) out.first.push_back(static_cast<std::uint64_t>(layout.body[i]) * words);
  for (std::size_t w = 0; with_walls && w < walls; ++w) out.first.push_back((n + w) * words);
  return out;
}

/// Returns the slots of a group that have contacts, in the order of the contacts' numbers.
inline std::vector<std::uint32_t> slots_in_order(const GroupLayout& group) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t slot = 0; slot < group.contact.size(); ++slot) {
    if (group.contact[slot] != inert) out.push_back(slot);
  }
  std::sort(out.begin(), out.end(), [&](auto x, auto y) { return group.contact[x] < group.contact[y]; });
  return out;
}

/// Returns where the state of each contact of a group lies in an array [packet][words][lane] or, with `by_points`, in
/// an array [row][words][lane] with one row per contact point of a packet.
inline StateOrder contact_order(const Layout& layout, const GroupLayout& group, std::size_t words, bool by_points) {
  const auto lanes = static_cast<std::size_t>(layout.lanes);
  StateOrder out{{}, strided(words, lanes), {}};
  for (const std::uint32_t slot : slots_in_order(group)) {
    const std::size_t packet = slot / lanes, lane = slot % lanes;
    if (!by_points) out.first.push_back(packet * words * lanes + lane);
    for (std::uint32_t j = 0; by_points && j < group.points[slot]; ++j)
      out.first.push_back((group.packet_layer[packet] + j) * words * lanes + lane);
  }
  return out;
}

/// Returns a function that returns the order of the chains of a group (`chains`) or of its frames. `layout` and `group`
/// must live as long as the function.
template <class P>
auto state_order(const Layout& layout, const GroupLayout& group, const ContactView<P>& view, bool chains) {
  const auto words = static_cast<std::size_t>(chains ? view.components * (1 + view.units) : view.frame_words);
  const bool by_points = chains && view.by_points;
  return [&layout, &group, words, by_points] { return contact_order(layout, group, words, by_points); };
}

}  // namespace macadam::kernels
