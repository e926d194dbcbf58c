// SPDX-License-Identifier: GPL-3.0-or-later
// iterative_solver.cpp  Prepares a network for the iterative solver, on the CPU or on a CUDA device.
#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <system_error>

#include "host/harmonic/iterative/make_system.hpp"
#include "host/backends/cuda_code.hpp"
#include "host/harmonic/harmonic_code.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

constexpr auto block = static_cast<std::size_t>(kernels::most_loads);

/// Calls f for each block of up to four tasks.
template <class F>
void for_each_block(const std::vector<LinearTask*>& tasks, F&& f) {
  for (std::size_t first = 0; first < tasks.size(); first += block) {
    const auto begin = tasks.begin() + static_cast<std::ptrdiff_t>(first);
    f(std::vector<LinearTask*>(begin, begin + static_cast<std::ptrdiff_t>(std::min(block, tasks.size() - first))));
  }
}

/// The iterative solver on the CPU.
class CpuSolver : public LinearSolver {
 public:
  CpuSolver(kernels::Layout layout, kernels::LinearSystem system)
      : layout_(std::move(layout)), system_(std::move(system)), inverse_(invert_particle_blocks(system_, layout_)) {}

  void solve(const std::vector<LinearTask*>& tasks, const std::function<bool()>& stop) override {
    for_each_block(tasks, [&](const std::vector<LinearTask*>& some) {
      harmonic_code().solve_block(system_, inverse_, layout_, some, stop);
    });
  }

 private:
  kernels::Layout layout_;
  kernels::LinearSystem system_;
  std::vector<double> inverse_;
};

/// The iterative solver on CUDA devices (GPUs). The whole iteration runs on the devices.
class CudaSolver : public LinearSolver {
 public:
  CudaSolver(kernels::Layout layout, const kernels::LinearSystem& system, const DeviceList& devices)
      : layout_(std::move(layout)) {
    std::int64_t loose = -1;
    solver_ = cuda_code()->make_solver(system, device_numbers(devices), loose);
    if (loose >= 0) refuse_loose_particle(loose, layout_);
  }

  void solve(const std::vector<LinearTask*>& tasks, const std::function<bool()>& stop) override {
    for_each_block(tasks, [&](const std::vector<LinearTask*>& some) { solve_some(some, stop); });
  }

 private:
  void solve_some(const std::vector<LinearTask*>& tasks, const std::function<bool()>& stop) {
    std::vector<kernels::LinearLoad> loads;
    for (const LinearTask* task : tasks) {
      loads.push_back({{},
                       task->motion.empty() ? nullptr : task->motion.data(),
                       task->stiffness.k,
                       task->stiffness.alpha,
                       task->inertia,
                       length(task->right),
                       task->tolerance,
                       task->energy_limit});
      for (const ParticleLoad& on : task->right) {
        kernels::BodyLoad& load = loads.back().right.emplace_back();
        load.body = layout_.body_of(on.particle);
        std::copy(on.load.begin(), on.load.end(), load.load);
      }
    }
    // Allocating memory for large solutions takes the CPU as long as tens of iterations take the device. So another
    // thread allocates the memory while the device iterates.
    const auto make_room = [&] {
      for (LinearTask* task : tasks) task->motion.resize(6 * layout_.particles());
    };
    std::future<void> room;
    try {
      room = std::async(std::launch::async, make_room);
    } catch (const std::system_error&) {}  // no thread is available: the memory is allocated after the iteration
    const std::vector<kernels::LinearState> states = solver_->solve(loads, [&] { require_not_stopped(stop); });
    if (room.valid())
      room.get();  // throws std::bad_alloc if there was not enough memory
    else
      make_room();
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      LinearTask& task = *tasks[t];
      task.energy = states[t].energy;
      task.iterations += states[t].iterations;
      task.converged = states[t].converged;
      solver_->solution(t, [&task](std::size_t first, const Complex* numbers, std::size_t count) {
#pragma omp parallel for schedule(static)
        for (std::size_t i = 0; i < count; ++i) task.motion[first + i] = numbers[i];
      });
    }
  }

  kernels::Layout layout_;
  std::unique_ptr<kernels::DeviceSolver> solver_;
};

}  // namespace

std::size_t usual_boxes(std::size_t particles) { return std::clamp<std::size_t>(particles / 40, 1, 160); }

std::unique_ptr<LinearSolver> make_iterative_solver(const Specimen& specimen, const ContactNetwork& network,
                                                    const PairStiffness& typical, const Inertia& inertia,
                                                    const FreeMotions& free, Backend backend, const DeviceList& devices,
                                                    std::optional<std::size_t> asked) {
  if (free.motions.size() > kernels::most_free_motions) {
    throw NotIterable(
        fmt::format("harmonic: found {} rigid motions of the whole specimen that no wall resists, expected at most {}",
                    free.motions.size(), kernels::most_free_motions));
  }
  const std::size_t usual = usual_boxes(specimen.size()), boxes = asked.value_or(usual);
  kernels::Layout layout = kernels::make_order(specimen, boxes > 0 ? boxes : usual);
  kernels::LinearSystem system = make_system(network, specimen, layout, typical, inertia, free);
  if (boxes == 0) std::fill(system.coarse.begin(), system.coarse.end(), 0.0);
  if (backend == Backend::cuda) return std::make_unique<CudaSolver>(std::move(layout), system, devices);
  return std::make_unique<CpuSolver>(std::move(layout), std::move(system));
}

}  // namespace macadam::harmonic
