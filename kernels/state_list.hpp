// SPDX-License-Identifier: GPL-3.0-or-later
/// \file state_list.hpp  The arrays that a step changes, named once: checkpoints copy and replace them through this
/// list.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernels/state_order.hpp"
#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Where an executor's arrays live (host or device) is the business of the two functions given for each.
class StateList {
 public:
  using Order = std::function<StateOrder()>;

  /// Takes an array of `size` numbers of type T. Empty ones are left out. `order`: made when needed; none: the array
  /// goes into a checkpoint as it is.
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

  /// Takes an array of the host's memory.
  template <class T, class A>
  void add(const std::string& name, const std::string& unit, std::vector<T, A>& array, Order order = {}) {
    add<T>(
        name, unit, array.size(), [&array] { return std::vector<T>(array.begin(), array.end()); },
        [&array](const std::vector<T>& values) { std::copy(values.begin(), values.end(), array.begin()); },
        std::move(order));
  }

  void clear() { entries_.clear(); }

  /// Host copies of all, in the order in which they were added.
  std::vector<StateArray> copy() const {
    std::vector<StateArray> out;
    for (const Entry& e : entries_) out.push_back({e.name, e.unit, e.copy()});
    return out;
  }

  /// Replaces all by the arrays of the same names, in any order and among others, or none. \throws RunError naming the
  /// array that does not fit.
  void replace(std::span<const StateArray> arrays) const {
    std::vector<const StateArray*> found;
    for (const Entry& e : entries_) {
      const auto array = std::find_if(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == e.name; });
      if (array == arrays.end()) throw RunError("state: array " + e.name + ": found none");
      if (const std::size_t expected = e.missing(array->values); expected > 0) {
        throw RunError("state: array " + e.name + ": found one of another length or precision, expected " +
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
    std::function<std::size_t(const StateArray::Values&)> missing;  // 0: it fits; else the length that does
    std::function<void(const StateArray::Values&)> replace;
  };
  std::vector<Entry> entries_;
};

}  // namespace macadam::kernels
