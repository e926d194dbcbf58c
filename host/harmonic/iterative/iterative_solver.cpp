// SPDX-License-Identifier: GPL-3.0-or-later
// iterative_solver.cpp  A network made ready for block_cocg: order, rows and preconditioner.
#include <fmt/format.h>

#include <algorithm>

#include "host/harmonic/iterative/block_cocg.hpp"
#include "macadam/error.hpp"

namespace macadam::harmonic {
namespace {

std::size_t contacts_of_a_box(const Specimen& specimen, const ContactNetwork& network, std::size_t boxes) {
  if (boxes == 0) boxes = usual_boxes(specimen.size());  // threads share the particles by boxes
  return std::max<std::size_t>(network.contacts.size() / boxes, 1);
}

class IterativeSolver : public LinearSolver {
 public:
  IterativeSolver(const Specimen& specimen, const ContactNetwork& network, const PairStiffness& typical,
                  const Inertia& inertia, const FreeMotions& free, std::size_t boxes)
      : layout_(kernels::make_layout(specimen, network, 1, contacts_of_a_box(specimen, network, boxes))),
        rows_(network, layout_),
        levels_(specimen, network, layout_, typical, free),
        inertia_(inertia),
        free_(free) {
    if (boxes == 0) levels_.coarse.setZero();
  }

  void solve(const std::vector<LinearTask*>& tasks) override {
    constexpr std::size_t block = 4;
    for (std::size_t first = 0; first < tasks.size(); first += block) {
      const auto begin = tasks.begin() + static_cast<std::ptrdiff_t>(first);
      solve_block(rows_, levels_, layout_, inertia_, free_,
                  {begin, begin + static_cast<std::ptrdiff_t>(std::min(block, tasks.size() - first))});
    }
  }

 private:
  kernels::Layout layout_;
  ContactRows rows_;
  TwoLevel levels_;
  const Inertia& inertia_;
  const FreeMotions& free_;
};

}  // namespace

std::size_t usual_boxes(std::size_t particles) { return std::clamp<std::size_t>(particles / 40, 1, 160); }

std::unique_ptr<LinearSolver> make_iterative_solver(const Specimen& specimen, const ContactNetwork& network,
                                                    const PairStiffness& typical, const Inertia& inertia,
                                                    const FreeMotions& free, std::optional<std::size_t> boxes) {
  if (free.motions.size() > most_free_motions) {
    throw RunError(fmt::format("harmonic: found {} motions of the whole that no wall resists, expected at most {}",
                               free.motions.size(), most_free_motions));
  }
  return std::make_unique<IterativeSolver>(specimen, network, typical, inertia, free,
                                           boxes.value_or(usual_boxes(specimen.size())));
}

}  // namespace macadam::harmonic
