// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_increments.hpp  Stores the states of all contacts, and computes the forces and the tangent stiffness
/// of each contact in a quasi-static increment.
///
/// A contact has six relative displacements u (kernels/contact/contact_kinematics.hpp), and six forces F that do the
/// work F·du. Contacts of linear laws are condensed, contacts with cracks are summed over their points.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/quasi_static/contact_accept.hpp"
#include "macadam/quasi_static.hpp"

namespace macadam::quasi_static {

using Six = std::array<double, 6>;
/// Derivatives of six forces with respect to six displacements, row by row.
using SixBySix = std::array<double, 36>;

/// Durations of an increment for the law of each pair type [s].
using LawTimes = std::array<double, pair_types>;

using kernels::ContactEnergies;

/// The law of a pair type. Elastic laws are chains without dashpots.
struct PairLaw {
  laws::GeneralisedKelvin chain;
  std::optional<laws::Cracked<laws::GeneralisedKelvin>> cracked;

  kernels::IncrementLaw increment(double dt) const {
    return kernels::IncrementLaw::of(chain, cracked ? &*cracked : nullptr, dt);
  }
};
using PairLaws = std::array<PairLaw, pair_types>;
/// Returns the laws of those pair types that occur. \throws InputError for a law without a tangent.
PairLaws pair_laws(const ContactNetwork& network, const LawTable& laws);

class ContactIncrements {
 public:
  ContactIncrements(const ContactNetwork& network, const LawTable& laws);

  /// Prepares an increment from the accepted state. `dt`: its duration for the law of each pair type [s]; `drag`:
  /// WallIncrement::drag.
  void begin(const LawTimes& dt, double drag = 0);
  /// Computes forces and stiffnesses for the relative displacements `u` of each contact in the increment.
  void evaluate(const std::vector<Six>& u);
  const Six& force(std::size_t c) const { return force_[c]; }
  const SixBySix& stiffness(std::size_t c) const { return stiffness_[c]; }
  /// Returns the forces of the accepted state.
  Six accepted_force(std::size_t c) const;

  /// Mean increase of the openings of the points that grew in the last accepted increment, weighted by their areas, and
  /// its derivatives with respect to `u` (per contact; zero for most contacts). evaluate() with a tangent sets them if
  /// begin() was called with points that grew.
  double opening() const { return opening_; }
  const Six& opening_rate(std::size_t c) const { return opening_rate_[c]; }
  bool has_growing_points() const { return growing_area_ > 0; }
  /// Part of the area of points with a crack law that grows at the last evaluation.
  double growing_part() const;

  /// Takes over the last evaluation. Energies of the increment (viscous, crack_work) or at its end (others).
  ContactEnergies accept(const std::vector<Six>& u);

  std::vector<laws::PointCrack> point_cracks() const;
  std::vector<Break> point_breaks() const;
  bool has_cracks() const { return has_cracks_; }
  /// States as in ContactState::chain.
  const std::vector<double>& states() const { return states_; }
  const std::vector<std::size_t>& state_begin() const { return begin_; }
  const std::vector<char>& grew() const { return grew_; }
  void set_states(std::vector<double> states, std::vector<char> grew);
  std::int64_t bytes() const;

 private:
  using Chain = laws::GeneralisedKelvin;
  using CrackedChain = laws::Cracked<Chain>;

  void prepare(std::size_t c);
  void evaluate_linear(std::size_t c, const Six& u);
  void evaluate_points(std::size_t c, const Six& u);
  ContactEnergies accept_contact(std::size_t c, const Six& u);
  /// Returns the area of the points with a mark that is not 0.
  double area_of(const std::vector<char>& points) const;
  const kernels::IncrementLaw& law(const Contact& c) const { return increment_[static_cast<std::size_t>(c.pair)]; }
  const CrackedChain& cracked(const Contact& c) const { return *laws_[static_cast<std::size_t>(c.pair)].cracked; }

  const ContactNetwork& network_;
  PairLaws laws_;
  std::array<kernels::IncrementLaw, pair_types> increment_;  ///< of the present lengths
  bool has_cracks_ = false;
  std::vector<double> states_;
  std::vector<std::size_t> begin_;       ///< of each contact in states_
  std::vector<double> base_;             ///< f (linear) or stresses (points) without motion
  std::vector<std::size_t> base_begin_;  ///< of each contact in base_
  std::vector<Six> force_;
  std::vector<SixBySix> stiffness_;
  /// Stresses of the drag on each point at the end of the accepted increment, three numbers; empty: none [Pa].
  std::vector<double> drag_;
  std::vector<char> grew_, grows_;  ///< per point: grew in the last accepted increment; grows in the evaluation
  double growing_area_ = 0;         ///< of the points with grew_
  double crackable_area_ = 0;
  double opening_ = 0;
  std::vector<double> opening_of_;  ///< per contact
  std::vector<Six> opening_rate_;
};

/// Returns the relative displacements of a contact whose ends move by `a` and `b` (three displacements, three
/// rotations).
Six relative(const Contact& c, const double* a, const double* b);
/// Returns area moments over length, as kernels::LinearContact::moments.
std::array<double, 6> moments_over_length(const Contact& c);
/// Returns the load on an end (0: A, 1: B) that does the work of the forces `f`; the contact exerts its negative.
Six load_on(const Contact& c, const Six& f, int end);
/// Returns the derivatives of the relative displacements with respect to the motion of an end, [6][6] row by row.
SixBySix motion_matrix(const Contact& c, int end);

}  // namespace macadam::quasi_static
