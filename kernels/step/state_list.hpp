// SPDX-License-Identifier: GPL-3.0-or-later
/// \file state_list.hpp  Lists the arrays that a step changes. Checkpoints copy and replace them through this list.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernels/step/state_order.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Holds two functions for each array, which copy and replace its values. So the list does not depend on where the
/// array is (host or GPU).
class StateList {
 public:
  using Order = std::function<StateOrder()>;

  /// Adds an array of `size` numbers of type T; an empty array is left out. `order`: order of the array in a
  /// checkpoint, made when needed. Without `order`, a checkpoint has the array in the order of memory.
  template <class T>
  void add(const std::string& name, const std::string& unit, std::size_t size, std::function<std::vector<T>()> copy,
           std::function<void(const std::vector<T>&)> replace, const Order& order = {}) {
    if (size == 0) return;
    using List = std::vector<T>;
    entries_.push_back({name, unit,
                        [copy, order] { return StateArray::Values(order ? order().gathered(copy()) : copy()); },
                        [size, order](const StateArray::Values& values) {
                          const std::size_t expected = order ? order().size() : size;
                          const auto* list = std::get_if<List>(&values);
                          return list && list->size() == expected ? 0 : expected;
                        },
                        [copy, replace, order](const StateArray::Values& values) {
                          const auto& list = std::get<List>(values);
                          if (!order) return replace(list);
                          List own = copy();
                          order().scatter(list, own);
                          replace(own);
                        }});
  }

  /// Adds an array in host memory.
  template <class T, class A>
  void add(const std::string& name, const std::string& unit, std::vector<T, A>& array, Order order = {}) {
    add<T>(
        name, unit, array.size(), [&array] { return std::vector<T>(array.begin(), array.end()); },
        [&array](const std::vector<T>& values) { std::copy(values.begin(), values.end(), array.begin()); },
        std::move(order));
  }

  void clear() { entries_.clear(); }

  /// Returns host copies of all arrays, in the order in which they were added.
  std::vector<StateArray> copy() const {
    std::vector<StateArray> out;
    for (const Entry& e : entries_) out.push_back({e.name, e.unit, e.copy()});
    return out;
  }

  /// Replaces each array by the given array of the same name. The given arrays may be in any order, and there may be
  /// others among them. If an array is missing or has another length, replaces none. \throws RunError naming the array
  /// that does not fit.
  void replace(std::span<const StateArray> arrays) const {
    std::vector<const StateArray*> found;
    for (const Entry& e : entries_) {
      const auto array = std::find_if(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == e.name; });
      if (array == arrays.end()) throw RunError("state: array " + e.name + ": found none");
      if (const std::size_t expected = e.missing(array->values); expected > 0) {
        throw RunError("state: array " + e.name + ": found an array of another length or precision, expected " +
                       std::to_string(expected) + " numbers");
      }
      found.push_back(&*array);
    }
    for (std::size_t i = 0; i < found.size(); ++i) entries_[i].replace(found[i]->values);
  }

 private:
  struct Entry {
    std::string name, unit;
    std::function<StateArray::Values()> copy;
    // 0: the array fits; otherwise the length that it should have
    std::function<std::size_t(const StateArray::Values&)> missing;
    std::function<void(const StateArray::Values&)> replace;
  };
  std::vector<Entry> entries_;
};

}  // namespace macadam::kernels
