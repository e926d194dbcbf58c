// SPDX-License-Identifier: GPL-3.0-or-later
// block_precision.cpp  Measures the rounding error of |E*| and phase for several block lengths. Writes CSV to standard
// output.
//
// A block is a sequence of time steps; the viscoelastic state of a contact is updated only at its end. Changes of force
// within a block, and the sums of these changes, are in single precision. The program steps the specimen t8 with fixed
// geometry through one cycle of 20 Hz from the steady state. The period has enough steps that blocks can be as long as
// kernels::longest_block allows. The result is compared with the same steps in double precision, which does not use
// blocks. The program takes some minutes.
//
// usage: block_precision [cpu|cuda]
#include <fmt/format.h>

#include <string>

#include "host/run/error_model.hpp"
#include "kernels/step/block_length.hpp"
#include "macadam/laws/facts.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::bench {
namespace {

constexpr double frequency = 20;  // [Hz]
constexpr std::int64_t steps_per_period = 4000000;
constexpr std::int64_t samples = 200;

/// One cycle of the specimen, stepped with different settings.
class OneCycle {
 public:
  explicit OneCycle(Backend backend) : backend_(backend) {
    Harmonic harmonic(scene_.specimen, scene_.network, scene_.laws, scene_.inertia, {}, frequency);
    start_ = steady_start(scene_.network, scene_.laws, harmonic.solve(frequency, 1, 0).motion, loading_);
  }

  Stiffness stepped(const StepperOptions& options) const {
    const auto stepper = make_stepper(backend_, scene_.specimen, scene_.network, scene_.laws, scene_.inertia, options);
    const Box& box = scene_.specimen.box;
    std::vector<ResponseSample> response;
    sample(*stepper, steps_per_period / samples, samples, [&](const Observation& now) {
      response.push_back(
          {frequency, now.time, now.top_displacement() / gauge_length(box), -now.top_force() / section_area(box)});
    });
    return evaluate_cyclic(response, frequency, 1).fit;
  }

  void print() const {
    StepperOptions options;
    options.geometry = Geometry::fixed;
    options.boundary = moving_top(loading_);
    options.dt = loading_.dt();
    options.observed_every = steps_per_period / samples;
    options.start = &start_;
    options.precision = Precision::double_;
    const Stiffness exact = stepped(options);
    for (const auto& [precision, name] : {std::pair{Precision::mixed, "mixed"}, {Precision::single, "single"}}) {
      options.precision = precision;
      for (const double blocks : {32000.0, 16000.0, 8000.0, 4000.0}) {
        options.blocks = blocks;
        const int steps = kernels::block_steps(options, facts_of(scene_.laws), scene_.specimen.box.size);
        const ErrorEstimate e = difference(stepped(options), exact);
        fmt::print("{},{},{},{},{:g},{},{:.2g},{:.2g}\n", to_string(backend_), name, scene_.specimen.size(),
                   steps_per_period, blocks, steps, e.e_star, e.phase_rad);
        std::fflush(stdout);
      }
    }
  }

 private:
  test::TestScene scene_ = test::make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}}));
  drives::Cyclic loading_{1e-4 * scene_.specimen.box.size.z, frequency, steps_per_period, 0};
  Backend backend_;
  StartState start_;
};

}  // namespace
}  // namespace macadam::bench

int main(int count, char** words) {
  using macadam::Backend;
  fmt::print(
      "# steps in blocks against steps in double precision; t8, geometry of the start, true mass, 20 Hz, steady start\n"
      "backend,precision,particles,steps_per_period,blocks,steps,e_star,phase_rad\n");
  macadam::bench::OneCycle(count > 1 && words[1] == std::string("cuda") ? Backend::cuda : Backend::cpu).print();
}
