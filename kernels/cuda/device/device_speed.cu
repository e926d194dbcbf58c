// SPDX-License-Identifier: GPL-3.0-or-later
// device_speed.cu  Measures the limits of a device (GPU): the bandwidths of its memories, and its clock under load.
#include <algorithm>
#include <functional>

#include "kernels/cuda/device/array.hpp"
#include "kernels/cuda/device/devices.hpp"

namespace macadam::kernels {
namespace {

constexpr unsigned threads = 512;

/// Copies `n` words from one array to the other and back, `turns` times in total.
__global__ void __launch_bounds__(threads) move_words(float4* a, float4* b, std::size_t n, int turns) {
  const std::size_t stride = std::size_t{gridDim.x} * threads;
  for (int turn = 0; turn < turns; ++turn) {
    const float4* from = turn % 2 ? b : a;
    float4* to = turn % 2 ? a : b;
    for (std::size_t i = blockIdx.x * std::size_t{threads} + threadIdx.x; i < n; i += stride) to[i] = __ldcg(from + i);
  }
}

/// Moves every word of shared memory by 32 places, `turns` times; each thread moves one word at a time. `ticks`
/// receives the number of clock ticks that the first thread block took.
__global__ void __launch_bounds__(threads) turn_shared(int turns, float* out, long long* ticks) {
  __shared__ float4 words[2][threads];
  words[0][threadIdx.x] = {1, 2, 3, static_cast<float>(threadIdx.x)};
  __syncthreads();
  const unsigned from = (threadIdx.x + 32) % threads;
  const long long begin = clock64();
#pragma unroll 8
  for (int turn = 0; turn < turns; ++turn) {
    words[(turn + 1) & 1][threadIdx.x] = words[turn & 1][from];
    __syncwarp();
  }
  if (blockIdx.x == 0 && threadIdx.x == 0) *ticks = clock64() - begin;
  out[blockIdx.x * threads + threadIdx.x] = words[turns & 1][threadIdx.x].w;
}

/// Returns the seconds that the device takes for the work that f enqueues: the shortest of nine measurements.
double seconds_of(const std::function<void()>& f) {
  cudaEvent_t begin = nullptr, end = nullptr;
  check_cuda(cudaEventCreate(&begin), "event");
  check_cuda(cudaEventCreate(&end), "event");
  double least = 0;
  for (int run = 0; run < 9; ++run) {
    check_cuda(cudaEventRecord(begin), "event");
    f();
    check_cuda(cudaEventRecord(end), "event");
    check_cuda(cudaEventSynchronize(end), "bandwidth");
    float ms = 0;
    check_cuda(cudaEventElapsedTime(&ms, begin, end), "event");
    if (run == 0 || 1e-3 * static_cast<double>(ms) < least) least = 1e-3 * static_cast<double>(ms);
  }
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  return least;
}

}  // namespace

DeviceSpeed measure_device(int device) {
  check_cuda(cudaSetDevice(device), "device");
  cudaDeviceProp properties{};
  check_cuda(cudaGetDeviceProperties(&properties, device), "device");
  DeviceSpeed out;
  out.name = properties.name;
  out.multiprocessors = properties.multiProcessorCount;
  check_cuda(cudaDriverGetVersion(&out.driver), "driver");
  check_cuda(cudaRuntimeGetVersion(&out.runtime), "runtime");
  out.cache_bytes = properties.l2CacheSize;
  {
    std::size_t free = 0, total = 0;
    check_cuda(cudaMemGetInfo(&free, &total), "memory");
    const std::size_t bytes = std::min<std::size_t>(std::size_t{1} << 30, free / 4);
    const DeviceArray<char> from(bytes), to(bytes);
    const auto copy = [&] {
      check_cuda(cudaMemcpyAsync(to.data(), from.data(), bytes, cudaMemcpyDeviceToDevice), "copy");
    };
    out.copy = 2 * static_cast<double>(bytes) / seconds_of(copy);
  }
  const auto blocks = static_cast<unsigned>(4 * properties.multiProcessorCount);
  {
    constexpr int turns = 20;
    // The two arrays together fill a third of the L2 cache
    const std::size_t words = static_cast<std::size_t>(properties.l2CacheSize) / 6 / sizeof(float4);
    const DeviceArray<float4> a(words), b(words);
    out.cache = 2.0 * turns * static_cast<double>(words * sizeof(float4)) / seconds_of([&] {
                  move_words<<<blocks, threads>>>(a.data(), b.data(), words, turns);
                  check_launch("bandwidth", nullptr);
                });
  }
  constexpr int turns = 20000;
  const DeviceArray<float> sink(blocks * threads);
  const DeviceArray<long long> ticks(1);
  const double seconds = seconds_of([&] {
    turn_shared<<<blocks, threads>>>(turns, sink.data(), ticks.data());
    check_launch("bandwidth", nullptr);
  });
  out.shared = 2.0 * turns * blocks * threads * sizeof(float4) / seconds;
  // one thread block runs alone, so long that the time of the launch is negligible
  const double alone = seconds_of([&] {
    turn_shared<<<1, threads>>>(20 * turns, sink.data(), ticks.data());
    check_launch("bandwidth", nullptr);
  });
  out.clock = static_cast<double>(ticks.download().front()) / alone;
  return out;
}

}  // namespace macadam::kernels
