// SPDX-License-Identifier: GPL-3.0-or-later
/// \file rock_classes.hpp  Replaces the compliances of rock in series with contact laws (Contact::series) by a limited
/// number of values, so that the stiffness of a network is again a sum of few matrices.
///
/// A contact with the compliance r has the stiffness 1/(r + z) times a constant matrix, with z = 1/k* in normal and
/// z = 1/(α·k*) in shear direction. The contact is divided between two classes of neighbouring compliances r₁ ≤ r ≤ r₂:
/// the fraction w belongs to r₁, the fraction 1 − w to r₂. So both fractions are at least 0, and the classes are again
/// a network of springs and dashpots. w is chosen so that the sum has the stiffness of the contact at z = z₀, the
/// instantaneous compliance of the law, and for z → ∞. For real z ≥ z₀ the stiffness is then too small by at most the
/// fraction tanh²(δ/4), if r₁ + z₀ and r₂ + z₀ differ by the factor e^δ.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"

namespace macadam::harmonic {

/// How the classes are chosen.
struct RockClassing {
  LawTable laws = {};     ///< for the instantaneous compliances z₀
  double spacing = 0.01;  ///< δ, see the top of this file
  /// Factor on the instantaneous stiffnesses, at least 1: the stiffnesses of other laws for which the error is still
  /// bounded.
  double reserve = 1;
};

/// Matrices vᵢᵀ·N·vⱼ and vᵢᵀ·S·vⱼ of the contacts of a class, for motions vⱼ.
struct RockForms {
  Eigen::MatrixXd normal, shear;
};

/// The classes of the contacts of one network. Contacts without rock in series belong to no class.
class RockClasses {
 public:
  /// The network must outlive this object, but its lengths and compliances may change. \throws InputError if a pair
  /// with rock in series has no law.
  RockClasses(const ContactNetwork& network, const RockClassing& classing);

  struct Class {
    std::size_t pair;
    double series;  ///< compliance of the rock [1/Pa]
  };
  const std::vector<Class>& classes() const { return classes_; }

  /// Returns the largest relative error of the stiffness of a contact, and of E*(s) for real s > 0; 0 if the classes
  /// have the compliances of all contacts.
  double error() const { return error_; }

  /// Returns the columns `from`, `from` + 1, … of the matrices of every class. `basis`: the motions,
  /// [6·particles][motions].
  std::vector<RockForms> columns(const Eigen::MatrixXd& basis, Eigen::Index from) const;

 private:
  /// A contact and its classes; they are the same class if `low` has the compliance of the contact.
  struct Divided {
    std::uint32_t contact, low, high;
    double normal, shear;  ///< fractions that belong to `low`, in normal and in shear direction
  };

  void add_pair(std::size_t pair, const std::vector<std::uint32_t>& contacts, const RockClassing& classing);

  const ContactNetwork& network_;
  std::vector<Class> classes_;
  std::vector<Divided> contacts_;  ///< contacts of the same two classes are neighbours
  double error_ = 0;
};

}  // namespace macadam::harmonic
