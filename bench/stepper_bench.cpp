// SPDX-License-Identifier: GPL-3.0-or-later
// stepper_bench.cpp  How fast is a step of the full specimen, and what share of the copy bandwidth does it reach?
//
// Each line: one backend, form, precision, geometry and number of threads on tests/data/ss_full.csv.gz with the paper's
// AM1 laws. Counters: contacts/s, GB/s of counted bytes (Stepper::traffic), and their share of the bandwidth of a plain
// copy with as many threads, measured just before in the same run (bytes read plus bytes written).
#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <random>

#include "tests/test_scenes.hpp"

namespace macadam {
namespace {

const test::TestScene& full_specimen() {
  static const test::TestScene scene =
      test::make_scene(read_specimen_csv(MACADAM_TEST_DATA "/ss_full.csv.gz", {{0.05, 0.05, 0.08}}));
  return scene;
}

/// Bytes read plus written in a second by a copy of 256 MiB; the best of nine, because a copy has no better use.
double copy_bandwidth(int threads) {
  constexpr std::size_t size = 256u << 20;
  static std::vector<char> from(size, 1), to(size, 2);
  double best = 0;
  for (int k = 0; k < 9; ++k) {
    const auto start = std::chrono::steady_clock::now();
#pragma omp parallel num_threads(threads)
    {
      const std::size_t part = size / static_cast<std::size_t>(threads);
      const std::size_t first = part * static_cast<std::size_t>(omp_get_thread_num());
      std::memcpy(to.data() + first, from.data() + first, part);
    }
    benchmark::ClobberMemory();
    best = std::max(best, 2.0 * size / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

void step(benchmark::State& state, Backend backend, ContactForm form, Precision precision, Geometry geometry,
          int threads) {
  const test::TestScene& scene = full_specimen();
  StepperOptions options = test::shaking_options(scene);
  options.form = form;
  options.precision = precision;
  options.geometry = geometry;
  options.threads = threads;
  const auto stepper = make_stepper(backend, scene.specimen, scene.network, scene.laws, scene.inertia, options);
  stepper->advance(20);  // real motion in every array before the clock runs
  const double bandwidth = backend == Backend::cpu ? copy_bandwidth(threads) : 0;
  constexpr std::int64_t steps = 5;
  for (auto unused : state) { stepper->advance(steps); }
  const auto per_iteration = [&](double x) {
    return benchmark::Counter(x * steps, benchmark::Counter::kIsIterationInvariantRate);
  };
  state.counters["contacts/s"] = per_iteration(static_cast<double>(scene.network.contacts.size()));
  state.counters["steps/s"] = per_iteration(1);
  state.counters["bytes/s"] = per_iteration(static_cast<double>(stepper->traffic()));
  state.counters["bytes/contact"] =
      static_cast<double>(stepper->traffic()) / static_cast<double>(scene.network.contacts.size());
  if (bandwidth > 0) {
    state.counters["copy_bytes/s"] = bandwidth;
    state.counters["share_of_copy"] = per_iteration(static_cast<double>(stepper->traffic()) / bandwidth);
  }
}

void register_all() {
  std::vector<int> threads{1};
  if (omp_get_max_threads() > 1) threads.push_back(2);
  if (omp_get_max_threads() > 2) threads.push_back(omp_get_max_threads());
  for (const Backend backend : test::tested_backends()) {
    for (const ContactForm form : {ContactForm::condensed, ContactForm::points}) {
      for (const Precision precision : {Precision::double_, Precision::mixed, Precision::single}) {
        for (const Geometry geometry : {Geometry::updated, Geometry::fixed}) {
          for (const int n : threads) {
            if (backend != Backend::cpu && n > 1) continue;
            const std::string name = std::string("step/") + to_string(backend) + "/" + to_string(form) + "/" +
                                     to_string(precision) + "/" + to_string(geometry) + "/threads:" + std::to_string(n);
            benchmark::RegisterBenchmark(name.c_str(), step, backend, form, precision, geometry, n)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace macadam

int main(int argc, char** argv) {
  macadam::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
