// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increment_system.hpp  Stores a contact network for quasi-static increments as arrays in the order of a device
/// (GPU), and declares the operations that the device computes.
///
/// Bodies are the particles, ordered so that those of one box follow one another (kernels/layout). A contact end is one
/// of the two sides of a contact. The tangent has one entry per body and end of a contact between two particles: a
/// block of 6 × 6 numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/quasi_static/contact_accept.hpp"
#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"

namespace macadam::kernels {

using IncrementLaws = std::array<IncrementLaw, pair_types>;  ///< by PairType
using WallMotions = std::array<Vec3d, wall_count>;           ///< by wall_index()

/// A contact in the order of the device.
struct IncrementContact {
  Placement<double> frame;
  double length;                         ///< [m]
  double series;                         ///< Contact::series [1/Pa]
  std::int32_t a, b;                     ///< bodies; b at a wall: −1 − wall_index()
  std::int32_t pair;                     ///< PairType
  std::uint32_t point_begin, point_end;  ///< of a contact with cracks; otherwise empty
};

/// Two boxes between which the tangent has entries, and the first of them in IncrementSystem::pair_entry.
struct BoxPair {
  std::int32_t row, column;  ///< row ≤ column
  std::uint32_t begin;
};

struct IncrementSystem {
  std::vector<std::int32_t> particle;      ///< body → particle
  std::vector<std::int32_t> box_body;      ///< box → first body; boxes + 1 entries
  std::vector<std::int32_t> box_of;        ///< body → box
  std::vector<Vec3d> lever;                ///< [body] from the centre of its box [m]
  std::vector<std::uint32_t> contact_of;   ///< contact → contact of the network
  std::vector<IncrementContact> contacts;  ///< contacts without cracks are the first ones
  std::vector<LinearContact> linear;       ///< of the contacts without cracks
  /// Points of contacts with cracks: number in the network, contact, coordinates and areas.
  std::vector<std::uint32_t> point_of, point_contact;
  std::vector<double> point_s, point_t, point_area;
  std::size_t network_points = 0;
  std::vector<std::uint32_t> end_begin;    ///< body → its first contact end; bodies + 1 entries
  std::vector<std::uint32_t> ends;         ///< 2·contact + end (0: A, 1: B), in the order of the network's row
  std::vector<std::int32_t> end_entry;     ///< entry of the tangent of each end; −1 at a wall
  std::vector<std::uint32_t> entry_begin;  ///< body → its first entry, which is the diagonal one; bodies + 1 entries
  std::vector<std::int32_t> entry_row, entry_column;       ///< bodies
  std::array<std::uint32_t, wall_count + 1> wall_begin{};  ///< first of the wall's contacts in wall_contact
  std::vector<std::uint32_t> wall_contact;                 ///< contacts at walls
  std::vector<BoxPair> pairs;                              ///< the last one ends the list
  std::vector<std::uint32_t> pair_entry;
  int linear_words = 1, point_words = 3;  ///< largest numbers of states per component

  std::size_t bodies() const { return particle.size(); }
  std::size_t boxes() const { return box_body.size() - 1; }
};

/// Sums at a trial. `size`, `scale`: Σ load²/intact stiffness of the loads out of balance and of all loads.
struct IncrementSums {
  double size = 0, scale = 0, opening = 0;
  double reaction[wall_count][3] = {};
};
/// Sums of an assembled tangent.
struct AssembledSums {
  std::int64_t loose = 0;
  double wall_stiffness = 0;
};
/// How a linear system was solved.
struct IncrementSolution {
  bool solved = false, negative = false;
  int iterations = 0;
};
/// States in the order of the device: number n of component k of contact or point i is at [(k·words + n)·count + i].
struct IncrementStates {
  std::vector<double> displacement;    ///< [6·bodies]
  std::vector<double> linear, points;  ///< 6 and 3 components
  std::vector<std::uint8_t> grew;      ///< [point]
};

/// A broken point: its number in the network, how it broke, and opening and slip of its crack [m].
struct BrokenPoint {
  std::uint32_t point;
  Break how;
  double opening, slip;
};
/// Cracks of all points: number and area of the points that have begun to crack, by PairType, energies, and the broken
/// points in any order.
struct CrackTotals {
  std::array<std::int64_t, pair_types> cracked{};
  std::array<double, pair_types> area{};
  double energy = 0, friction = 0;
  std::vector<BrokenPoint> broken;
};

/// Vectors of the device that the host may read or write.
enum class IncrementVector : std::uint8_t { residual, top, correction, by_wall, displacement, trial };

/// Largest number of iterations for a linear system, on CPU and GPU.
inline constexpr int most_increment_iterations = 600;
/// Largest number of vectors of a basis, before GMRES starts again.
inline constexpr int gmres_vectors = 50;
/// Whether GMRES would need more than `left` iterations to reduce the residual to `goal`, if each start from now on
/// reduced it by the same factor as the last one. `before`: the residual at the last start; 0 before the second
/// start.
inline bool is_too_slow(double before, double now, double goal, int left) {
  return before > 0 && gmres_vectors * std::log(now / goal) > left * std::log(before / now);
}

/// The operations of Newton's method on a device, in double precision. All sums have a fixed order, so the same device
/// computes the same bits in every run. The operations are those of host/quasi_static/engine.hpp.
class DeviceIncrements {
 public:
  virtual ~DeviceIncrements() = default;
  /// Prepares an increment, whose trial has been written; `growing_area`: of the points that grew in the last one [m²];
  /// `drags`: whether the laws have a drag.
  virtual void begin(const IncrementLaws& laws, double growing_area, bool drags) = 0;
  virtual IncrementSums evaluate(const WallMotions& wall) = 0;
  /// Assembles the tangent at the last evaluation, or its symmetric part, with `held` of the intact stiffness added to
  /// the diagonal; particles with less than `loose` of their intact stiffness get this part instead.
  virtual AssembledSums assemble(bool symmetric, double held, double loose) = 0;
  /// Returns the diagonal numbers of the tangent [6·bodies].
  virtual std::vector<double> diagonal() const = 0;
  virtual void set_intact(const std::vector<double>& stiffness) = 0;
  /// Returns the blocks of the tangent, entry after entry, each of them column by column.
  virtual std::vector<double> blocks() const = 0;

  /// Updates the preconditioner for the assembled tangent.
  virtual void precondition() = 0;
  /// Solves K·x = −residual or K·x = −top column, by conjugate gradients for the symmetric part, else by GMRES.
  virtual IncrementSolution solve(bool by_wall, double tolerance) = 0;
  virtual void add_by_wall(double factor) = 0;
  virtual double on_top(bool by_wall) = 0;
  virtual double opening_change(bool by_wall) = 0;

  virtual void keep() = 0;
  virtual void move(double length) = 0;
  virtual ContactEnergies accept() = 0;
  virtual double growing_area() = 0;  ///< of the points that grow at the last evaluation [m²]

  virtual std::vector<double> read(IncrementVector which) const = 0;
  virtual void write(IncrementVector which, const std::vector<double>& numbers) = 0;
  virtual IncrementStates states() const = 0;
  virtual void set_states(const IncrementStates& states) = 0;
  /// Fills in cracks and breaks of all points of the network. Points that cannot crack stay as they are.
  virtual void read_cracks(std::vector<laws::PointCrack>* cracks, std::vector<Break>* breaks) const = 0;
  virtual CrackTotals crack_totals() = 0;
  virtual std::int64_t bytes() const = 0;
};

/// Makes the operations on one device. Only in builds with CUDA. \throws RunError if the device has too little memory.
std::unique_ptr<DeviceIncrements> make_device_increments(const IncrementSystem& system, int device);

}  // namespace macadam::kernels
