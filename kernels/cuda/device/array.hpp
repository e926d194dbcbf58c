// SPDX-License-Identifier: GPL-3.0-or-later
/// \file array.hpp  Allocates arrays in the memory of one device, or spread over several devices.
#pragma once

#include <utility>
#include <vector>

#include "kernels/cuda/device/launch.hpp"
#include "kernels/cuda/device/spread_memory.hpp"
#include "kernels/step/state_list.hpp"

namespace macadam::kernels {

/// An array on the current device (GPU), zero at first. No kernel or copy may still use it when it is destroyed.
/// Allocation and release go through the calling thread's own stream, so that they do not stop other work on the
/// device.
template <class T>
class DeviceArray {
 public:
  DeviceArray() = default;
  explicit DeviceArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    if (const cudaError_t status = cudaMallocAsync(&data_, bytes(), cudaStreamPerThread); status != cudaSuccess) {
      cudaGetLastError();
      throw_out_of_memory(bytes(), cudaGetErrorString(status));
    }
    clear();
  }
  /// An array with `words` numbers per item, spread over devices as `shares` says.
  DeviceArray(const Shares& shares, std::size_t words) {
    if (shares.size() == 1) {
      *this = DeviceArray(shares.back().end * words);
      return;
    }
    size_ = shares.back().end * words;
    if (size_ == 0) return;
    spread_ = SpreadMemory(shares, words * sizeof(T));
    data_ = static_cast<T*>(spread_.data());
    clear();
  }
  /// Returns a device array with a copy of a host array.
  template <class Array>
  static DeviceArray of(const Array& host) {
    DeviceArray out(host.size());
    out.upload(host.data());
    return out;
  }
  template <class Array>
  static DeviceArray of(const Array& host, const Shares& shares) {
    if (host.empty()) return {};
    DeviceArray out(shares, host.size() / shares.back().end);
    out.upload(host.data());
    return out;
  }
  DeviceArray(DeviceArray&& other) noexcept { *this = std::move(other); }
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(spread_, other.spread_);
    return *this;
  }
  ~DeviceArray() {
    if (!spread_.data() && data_) cudaFreeAsync(data_, cudaStreamPerThread);
  }

  void clear() {
    if (size_ > 0) clear_now(data_, bytes(), "clearing an array");
  }
  void upload(const T* host) {
    if (size_ > 0) copy_now(data_, host, bytes(), "copy to the device");
  }
  std::vector<T> download() const {
    std::vector<T> out(size_);
    if (size_ > 0) copy_now(out.data(), data_, bytes(), "copy from the device");
    return out;
  }
  T* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
  SpreadMemory spread_;
};

/// Adds a device array to the states that a checkpoint copies and replaces. The array must keep its address.
template <class T>
void add_device_state(StateList& states, const std::string& name, const std::string& unit, T* data, std::size_t size,
                      StateList::Order order = {}) {
  const std::size_t bytes = size * sizeof(T);
  states.add<T>(
      name, unit, size,
      [=] {
        std::vector<T> out(size);
        copy_now(out.data(), data, bytes, "copy of the state");
        return out;
      },
      [=](const std::vector<T>& values) { copy_now(data, values.data(), bytes, "setting the state"); },
      std::move(order));
}

}  // namespace macadam::kernels
