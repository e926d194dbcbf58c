// SPDX-License-Identifier: GPL-3.0-or-later
// iterations.cpp  Counts the iterations of the frequency-domain solver as specimens grow, with and without the coarse
// correction by boxes of particles.
//
// Usage: iterations_bench SCENE PARTICLES … : generates specimens by the scene's recipe, which must have particle
// counts, in boxes of the same shape. Solves on a CUDA device if one is available. Prints a CSV with one row per
// specimen and number of boxes.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "host/harmonic/check_solutions.hpp"
#include "host/harmonic/linear_solver.hpp"
#include "macadam/macadam.hpp"

namespace macadam {
namespace {

using namespace harmonic;

constexpr double frequency_hz = 20, tolerance = 1e-8;
constexpr std::size_t many_boxes = 640;  ///< gives a dense matrix of 118 MB

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Returns the recipe with the same gradation for another number of particles. \throws InputError if the recipe has no
/// counts.
SpecimenSpec resized(SpecimenSpec spec, std::int64_t particles) {
  if (!spec.mastic || !spec.mastic->count) throw InputError(spec.source + ": mastic without count");
  std::int64_t usual = *spec.mastic->count;
  for (const AggregateClass& c : spec.aggregate) {
    if (!c.count) throw InputError(spec.source + ": a class of aggregates without count");
    usual += *c.count;
  }
  const double times = static_cast<double>(particles) / static_cast<double>(usual);
  spec.box.size = std::cbrt(times) * spec.box.size;
  for (AggregateClass& c : spec.aggregate) {
    c.count = std::llround(times * static_cast<double>(*c.count));
    particles -= *c.count;
  }
  spec.mastic->count = particles;
  return spec;
}

/// A specimen, its network, and a linear system that is solved with several numbers of boxes.
class Case {
 public:
  Case(const Scene& scene, std::int64_t particles) {
    const auto start = Clock::now();
    specimen_ = generate_specimen(resized(scene.specimen, particles)).specimen;
    network_ = build_network(specimen_, tessellate(specimen_), scene.network);
    prepared_s_ = seconds_since(start);
    inertia_ = make_inertia(specimen_, scene.materials.aggregate, scene.materials.mastic);
    stiffness_ = pair_stiffness(scene.laws, Complex(0, 2 * std::numbers::pi * frequency_hz));
    free_ = find_free_motions(specimen_, network_, stiffness_, inertia_);
    right_ = ContactOperator(network_, specimen_.size()).wall_loads(stiffness_);
  }

  void solve() const {
    const std::size_t usual = usual_boxes(specimen_.size());
    for (const std::size_t boxes : {std::size_t{0}, usual, many_boxes}) {
      // with this many boxes a box would have fewer than 40 particles
      if (boxes == many_boxes && specimen_.size() < 40 * many_boxes) continue;
      const auto start = Clock::now();
      const auto solver = make_iterative_solver(specimen_, network_, stiffness_, inertia_, free_, backend_, {}, boxes);
      const double made_s = seconds_since(start);
      LinearTask task;
      task.stiffness = stiffness_;
      task.right = right_;
      task.tolerance = tolerance;
      const auto begun = Clock::now();
      solver->solve({&task}, {});
      const double solved_s = seconds_since(begun);
      fmt::print("{},{},{},{},{},{:.2e},{:.3g},{:.3g},{:.3g}\n", specimen_.size(), network_.contacts.size(), boxes,
                 task.iterations, task.converged ? "yes" : "no", residual(task), prepared_s_, made_s, solved_s);
      std::fflush(stdout);
    }
  }

 private:
  /// Returns ‖f − K·u‖ / ‖f‖, computed independently of the solver.
  double residual(const LinearTask& task) const {
    return check_solutions(network_, inertia_, {&task}, 0).front().residual / length(right_);
  }

  Specimen specimen_;
  ContactNetwork network_;
  Inertia inertia_;
  PairStiffness stiffness_;
  FreeMotions free_;
  Loads right_;
  double prepared_s_ = 0;
  Backend backend_ = select_backend(Backend::automatic);
};

std::int64_t number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != 0 || !(value >= 1 && value <= 1e8)) {
    throw InputError("found \"" + word + "\", expected a number of particles, 1 to 1e8");
  }
  return std::llround(value);
}

int main_function(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: iterations_bench SCENE PARTICLES ...\n");
    return 2;
  }
  const Scene scene = read_scene(argv[1]);
  fmt::print("particles,contacts,boxes,iterations,converged,residual,prepare_s,preconditioner_s,solve_s\n");
  for (int i = 2; i < argc; ++i) Case(scene, number(argv[i])).solve();
  return 0;
}

}  // namespace
}  // namespace macadam

int main(int argc, char** argv) {
  try {
    return macadam::main_function(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "iterations_bench: {}\n", error.what());
    return 1;
  }
}
