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

#include "macadam/error.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Where an executor's arrays live (host or device) is the business of the two functions given for each.
class StateList {
 public:
  /// Takes an array of `size` numbers of type T. Empty ones are left out.
  template <class T>
  void add(const std::string& name, const std::string& unit, std::size_t size, std::function<std::vector<T>()> copy,
           std::function<void(const std::vector<T>&)> replace) {
    if (size == 0) return;
    using List = std::vector<T>;
    entries_.push_back(
        {name, unit, size, [copy = std::move(copy)] { return StateArray::Values(copy()); },
         [size](const StateArray::Values& values) {
           return std::holds_alternative<List>(values) && std::get<List>(values).size() == size;
         },
         [replace = std::move(replace)](const StateArray::Values& values) { replace(std::get<List>(values)); }});
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
      if (array == arrays.end() || !e.fits(array->values)) {
        throw RunError("state: array " + e.name + ": found " +
                       (array == arrays.end() ? "none" : "one of another length or precision") + ", expected " +
                       std::to_string(e.size) + " numbers");
      }
      found.push_back(&*array);
    }
    for (std::size_t i = 0; i < found.size(); ++i) entries_[i].replace(found[i]->values);
  }

 private:
  struct Entry {
    std::string name, unit;
    std::size_t size;
    std::function<StateArray::Values()> copy;
    std::function<bool(const StateArray::Values&)> fits;
    std::function<void(const StateArray::Values&)> replace;
  };
  std::vector<Entry> entries_;
};

}  // namespace macadam::kernels
