// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_packing.cpp  Pushes overlapping bodies apart by iteration with momentum, and lets them grow whenever the
/// overlaps are small.
#include "host/specimen/packing/shape_packing.hpp"

#include <algorithm>
#include <cmath>

#include "host/spheres/neighbours.hpp"
#include "host/spheres/parallel_blocks.hpp"

namespace macadam {
namespace {

// Contacts have the stiffness 1 and the smallest body has the mass 1. For rotations, a contact at a distance of one
// radius from the centre of a body is stiffer by the factor (radius/lever_)² = 4, where lever_ is the length that
// converts rotations to displacements. A body has up to about twelve contacts, so stiffness divided by mass reaches
// about 50. An iteration with momentum is stable if this ratio is below 2·(1 + momentum)/step, which is 65.
constexpr double step = 0.06, momentum = 0.95;
constexpr double longest_move = 0.02;  // largest movement per iteration, divided by D^I of the smallest body
constexpr double skin_share = 0.2;     // skin of the neighbour lists, divided by D^I of the smallest body
// Largest allowed depths of contacts, divided by the gap (at 1 the surfaces touch). While the bodies grow they may
// overlap a little, but not so deeply that they could be pushed out on the wrong side. At the end at least half of the
// gap must be free.
constexpr double settled = 0.5, growing = 4;
constexpr double growth_a_gap = 0.15;  // relative growth in one iteration, divided by the relative gap
constexpr int most_idle = 2000;        // iterations without growth after which the bodies count as jammed
// At the end, bodies may touch according to the exact test although their samples show no contact. Such bodies are
// separated in at most this number of rounds.
constexpr int most_packing_rounds = 40;
constexpr double freeing = 1.4;  // factor by which the gaps of such bodies are widened in each round

/// A displacement or a force.
struct Motion {
  /// Displacement or force of the centre, and rotation or moment of the body. The rotation is multiplied by the body's
  /// lever arm and the moment divided by it, so that both members have the same unit.
  Vec3d shift{}, spin{};
};

/// Two neighbouring bodies and the contact between them.
struct PairContact {
  std::int32_t a, b;
  ShapeContact contact;
  double look_at;  ///< the pair is tested again when the two bodies together have travelled this far [m]
};

/// The state of a packing: bodies that grow, their contacts and their motion.
class Packing {
 public:
  Packing(const Domain& box, std::vector<ShapeBody>& bodies, double from, double gap)
      : box_(box),
        bodies_(bodies),
        gap_(gap),
        grown_(from),
        smallest_(smallest(bodies)),
        proxies_(proxies(bodies)),
        neighbours_(box, proxies_, skin_share * smallest_),
        extra_(bodies.size(), 1),
        travel_(bodies.size()),
        motion_(bodies.size()),
        push_(bodies.size()),
        walls_(bodies.size()) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const double ratio = bodies_[i].size / smallest_;
      mass_.push_back(ratio * ratio);  // the number of contacts that a body may have grows with its area
      lever_.push_back(proxies_[i].radius / 2);
    }
    list_pairs();
    grow(0);
  }

  double run(const std::function<void(double)>& progress) {
    const double begun = grown_;
    int rounds = 0;
    for (int idle = 0; idle < most_idle; ++idle) {
      find_contacts();
      if (deepest() < (grown_ < 1 ? growing : settled)) {
        idle = 0;
        if (grown_ < 1) {
          grow(growth_a_gap * gap_);
          progress((grown_ - begun) / (1 - begun));
        } else if (widen_gaps_of_overlaps() == 0) {
          return 1;
        } else if (++rounds > most_packing_rounds) {
          break;
        }
      }
      gather();
      move();
    }
    return std::min(grown_, 1 - 1e-6);  // less than 1, because full size with overlaps is not a valid packing
  }

 private:
  static double smallest(const std::vector<ShapeBody>& bodies) {
    double size = bodies.front().size;
    for (const ShapeBody& b : bodies) size = std::min(size, b.size);
    return size;
  }

  /// Returns the balls that contain the bodies at full size, for the neighbour lists.
  static std::vector<Ball> proxies(const std::vector<ShapeBody>& bodies) {
    std::vector<Ball> balls;
    for (const ShapeBody& b : bodies) balls.push_back({b.centre, ShapeBody(*b.geometry, b.size, b.sphere).radius()});
    return balls;
  }

  /// Returns the gap [m] that a body, or a pair of bodies, should keep.
  double gap(std::size_t i) const { return extra_[i] * gap_ * bodies_[i].size; }
  double gap(const PairContact& p) const { return std::min(gap(p.a), gap(p.b)); }

  /// Grows all bodies by a relative step.
  void grow(double step) {
    grown_ = std::min(1.0, grown_ * (1 + step));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      ShapeBody& b = bodies_[i];
      const double before = b.radius();
      b.scale = grown_ * b.size / b.geometry->shape.d_intermediate;
      travel_[i] += b.radius() - before;
    }
  }

  void list_pairs() {
    pairs_.clear();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (std::int32_t j : neighbours_.of(i))
        if (j > static_cast<std::int32_t>(i)) pairs_.push_back({static_cast<std::int32_t>(i), j, {}, 0});
  }

  /// Updates the contacts of the pairs that may have come into contact, and of all bodies with the walls.
  void find_contacts() {
    const bool threads = bodies_.size() >= parallel_from;
    for_each_in_blocks(pairs_.size(), threads, [&](std::size_t k) {
      PairContact& p = pairs_[k];
      const double travel = travel_[p.a] + travel_[p.b];
      if (travel < p.look_at) return;
      p.contact = contact(bodies_[p.a], bodies_[p.b], gap(p));
      p.look_at = travel + p.contact.clear;
    });
    for_each_in_blocks(bodies_.size(), threads,
                       [&](std::size_t i) { walls_[i] = wall_contact(bodies_[i], box_, gap(i)); });
  }

  /// Returns the depth of the deepest contact, divided by its gap.
  double deepest() const {
    double worst = 0;
    for (const PairContact& p : pairs_) worst = std::max(worst, p.contact.depth / gap(p));
    for (std::size_t i = 0; i < walls_.size(); ++i) worst = std::max(worst, walls_[i].depth / gap(i));
    return worst;
  }

  // Sums the forces on each body. Sums run over the contacts in order, on one thread, so that they have the same bits
  // for any number of threads.
  void gather() {
    std::fill(push_.begin(), push_.end(), Motion{});
    const auto push = [&](std::size_t i, const ShapeContact& c, double sign) {
      const Vec3d force = (sign * c.depth) * c.normal;
      push_[i].shift += force;
      push_[i].spin += (1 / lever_[i]) * cross(c.point - bodies_[i].centre, force);
    };
    for (const PairContact& p : pairs_)
      if (p.contact.depth > 0) push(p.a, p.contact, 1), push(p.b, p.contact, -1);
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      if (walls_[i].depth > 0) push(i, walls_[i], 1);
      push_[i].shift = (1 / mass_[i]) * push_[i].shift;
      push_[i].spin = (1 / mass_[i]) * push_[i].spin;
    }
  }

  /// Widens the gaps of all bodies that touch another body according to the exact test. Returns the number of touching
  /// pairs.
  int widen_gaps_of_overlaps() {
    std::vector<std::uint8_t> touch(pairs_.size());
    for_each_in_blocks(pairs_.size(), bodies_.size() >= parallel_from,
                       [&](std::size_t k) { touch[k] = overlap(bodies_[pairs_[k].a], bodies_[pairs_[k].b]); });
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      if (touch[k]) extra_[pairs_[k].a] *= freeing, extra_[pairs_[k].b] *= freeing;
    const auto touching = std::count(touch.begin(), touch.end(), 1);
    if (touching > 0)
      for (PairContact& p : pairs_) p.look_at = 0;  // the distances until the next test were computed for the old gaps
    return static_cast<int>(touching);
  }

  /// Moves all bodies by one step and updates the neighbour lists if needed.
  void move() {
    const double most = longest_move * smallest_;
    bool stale = false;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Motion& v = motion_[i];
      v.shift = momentum * v.shift + step * push_[i].shift;
      v.spin = momentum * v.spin + step * push_[i].spin;
      const double way = std::sqrt(dot(v.shift, v.shift) + dot(v.spin, v.spin));
      if (way > most) v.shift = (most / way) * v.shift, v.spin = (most / way) * v.spin;
      ShapeBody& b = bodies_[i];
      b.centre += v.shift;
      travel_[i] += norm(v.shift);
      if (!b.sphere) {
        const Vec3d angle = (1 / lever_[i]) * v.spin;
        b.set_turn(turned(b.turn, angle));
        travel_[i] += norm(angle) * b.radius();
      }
      proxies_[i].centre = b.centre;
      stale = stale || neighbours_.strayed(i);
    }
    if (!stale) return;
    neighbours_.rebuild();
    list_pairs();
  }

  const Domain& box_;
  std::vector<ShapeBody>& bodies_;
  double gap_;  // relative to the smaller body's D^I
  /// Present scale of the bodies, and the smallest D^I at full size [m].
  double grown_, smallest_;
  std::vector<Ball> proxies_;
  Neighbours neighbours_;
  std::vector<PairContact> pairs_;
  /// For each body: the factor by which its gap is widened, its mass, and its lever arm [m].
  std::vector<double> extra_, mass_, lever_;
  /// Upper bound of the distance that any point of a body has moved since the beginning [m].
  std::vector<double> travel_;
  std::vector<Motion> motion_, push_;
  std::vector<ShapeContact> walls_;
};

}  // namespace

double pack(const Domain& box, std::vector<ShapeBody>& bodies, double from, double gap,
            const std::function<void(double share)>& progress) {
  return bodies.empty() ? 1 : Packing(box, bodies, from, gap).run(progress);
}

}  // namespace macadam
