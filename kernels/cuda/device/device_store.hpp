// SPDX-License-Identifier: GPL-3.0-or-later
/// \file device_store.hpp  Owns arrays in the memory of devices (GPUs), of any element type.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernels/cuda/device/array.hpp"

namespace macadam::kernels {

/// Owns device arrays of any type; they are freed with this object.
class DeviceStore {
 public:
  /// Copies a host array to the device and keeps it. Returns the device address.
  template <class Array>
  auto keep(const Array& array) {
    using T = typename Array::value_type;
    return own(DeviceArray<T>::of(array));
  }
  /// Copies a host array to the devices and keeps it. Its items are spread over several devices, as `shares` says.
  template <class Array>
  auto keep(const Array& array, const Shares& shares) {
    using T = typename Array::value_type;
    return own(DeviceArray<T>::of(array, shares));
  }
  /// Keeps an array of n zeros.
  template <class T>
  T* zeros(std::size_t n) {
    return own(DeviceArray<T>(n));
  }
  /// Keeps an array of zeros with `words` numbers per item. The items are spread over several devices, as `shares`
  /// says.
  template <class T>
  T* zeros(const Shares& shares, std::size_t words) {
    return own(DeviceArray<T>(shares, words));
  }
  std::int64_t bytes() const { return bytes_; }  ///< size of all arrays

 private:
  template <class T>
  T* own(DeviceArray<T> array) {
    bytes_ += static_cast<std::int64_t>(array.bytes());
    auto kept = std::make_shared<DeviceArray<T>>(std::move(array));
    owned_.push_back(kept);
    return kept->data();
  }
  std::vector<std::shared_ptr<void>> owned_;
  std::int64_t bytes_ = 0;
};

}  // namespace macadam::kernels
