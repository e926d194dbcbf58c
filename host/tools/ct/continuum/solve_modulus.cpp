// SPDX-License-Identifier: GPL-3.0-or-later
// solve_modulus.cpp  Solves all frequencies and temperatures with elements of three sizes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/seconds_of.hpp"
#include "host/tools/ct/continuum/compression.hpp"
#include "host/tools/ct/continuum/scan_modulus.hpp"
#include "macadam/error.hpp"

namespace macadam::continuum {
namespace {

/// Residual at which the solver stops, over the residual of a strain along z alone. The modulus follows from the
/// energy, whose relative error is about its square.
constexpr double tolerance = 1e-6;

/// Measures the work in elements, and shows how much is done.
class Work {
 public:
  Work(const ModulusPlan& plan, std::size_t points, const ModulusWatcher& watcher) : watcher_(watcher) {
    for (const int block : plan.blocks)
      total_ += double(points) * (block == 1 ? 1 : 2) * double(plan.scan.size.elements()) / std::pow(block, 3);
  }

  /// Shows a solution of `elements` at a residual. \throws InterruptedError if the watcher asks to stop.
  void show(const std::string& stage, double elements, double residual) const {
    const double part = std::clamp(std::log(residual) / std::log(tolerance), 0.0, 1.0);
    if (watcher_.progress) watcher_.progress(stage, (done_ + part * elements) / total_);
    if (watcher_.stop && watcher_.stop()) throw InterruptedError("interrupted at: " + stage);
  }
  void add(double elements, double seconds) { done_ += elements, seconds_ += seconds; }
  /// Returns the remaining time [s] if each remaining element takes as long as the elements so far.
  double seconds_left() const { return done_ > 0 ? seconds_ / done_ * (total_ - done_) : 0; }

 private:
  const ModulusWatcher& watcher_;
  double total_ = 0, done_ = 0, seconds_ = 0;
};

/// The results of a point for both mixing rules.
struct SizesOfPoint {
  Sizes stiff, soft;
};

}  // namespace

std::vector<PointModulus> solve_modulus(const ModulusPlan& plan, const ScanPhases& phases,
                                        const ModulusWatcher& watcher) {
  Work work(plan, phases.points.size(), watcher);
  std::vector<SizesOfPoint> sizes(phases.points.size());
  std::vector<PointModulus> out(phases.points.size());
  for (std::size_t size = 0; size < plan.blocks.size(); ++size) {
    const double voxel = plan.edge(size);
    const PhaseFractions fractions = of_blocks(plan.scan, plan.blocks[size]);
    const bool mixed = fractions.has_mixed_voxels();
    const auto elements = double(plan.scan.size.elements()) / std::pow(plan.blocks[size], 3);
    // One displacement for each mixing rule. Every point starts from the displacement of the previous point.
    Field<double> displacement[2];
    for (std::size_t p = 0; p < phases.points.size(); ++p) {
      const ModulusPoint& point = phases.points[p];
      const std::string stage = fmt::format("elements of {:.4g} mm, {:g} Hz", 1e3 * voxel, point.frequency_hz);
      for (const Mixing mixing : {Mixing::stiff, Mixing::soft}) {
        if (mixing == Mixing::soft && !mixed) {  // no mixture: the same moduli
          sizes[p].soft.push_back(sizes[p].stiff.back());
          continue;
        }
        work.show(stage, elements, 1);
        Compression found;
        const double seconds = seconds_of([&] {
          found = compress(grid_of(fractions, point.mastic, phases.rock, mixing), fractions.area, tolerance,
                           displacement[mixing == Mixing::stiff ? 0 : 1],
                           [&](double residual) { work.show(stage, elements, residual); });
        });
        work.add(elements, seconds);
        found.modulus *= point.mastic.modulus;
        (mixing == Mixing::stiff ? sizes[p].stiff : sizes[p].soft).push_back({voxel, found.modulus, found.poisson});
        if (watcher.solved) watcher.solved({p, voxel, mixing, found.modulus, found.poisson, found.iterations, seconds});
      }
      if (size == 0) continue;
      out[p] = {extrapolated(sizes[p].stiff, sizes[p].soft), int(size) + 1, voxel};
      if (watcher.improved) watcher.improved(out);
    }
    if (size == 0 && watcher.expected) watcher.expected(work.seconds_left());
  }
  return out;
}

}  // namespace macadam::continuum
