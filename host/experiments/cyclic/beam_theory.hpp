// SPDX-License-Identifier: GPL-3.0-or-later
/// \file beam_theory.hpp  Computes the deflection line of a Timoshenko beam on two supports.
#pragma once

namespace macadam {

/// The deflection line of a beam with a rectangular section on two supports under a unit force along z between them, by
/// Timoshenko's theory with Cowper's shear coefficient k = 10·(1 + ν)/(12 + 11·ν). All values are multiplied by the
/// modulus. By Betti's theorem they are also the influence of a load on the deflection at the place of the unit force:
/// forces P_i along z at x_i and couples C_i about y at x_i cause there E·δ = Σ P_i·deflection(x_i) − C_i·slope(x_i),
/// if they are in equilibrium.
class UnitDeflection {
 public:
  /// `left` and `right` are the places of the supports, `loaded` is the place of the force between them, along x [m].
  /// `width` and `height` are the edges of the section along y and z [m].
  UnitDeflection(double left, double right, double loaded, double width, double height, double poisson_ratio);

  /// Returns the deflection times the modulus at x [1/m]. It is zero at the supports. The beam is straight beyond the
  /// supports.
  double deflection(double x) const;
  /// Returns the slope of the neutral axis by bending alone times the modulus at x [1/m²]. It is the turn of the
  /// section about −y.
  double slope(double x) const;

 private:
  /// The part of the beam between a support and the force, seen from the support.
  struct Part {
    double to_force, other;  ///< distances of the support and of the other support from the force [m]
  };
  double bending(const Part& part, double from_support) const;
  double bending_slope(const Part& part, double from_support) const;
  double shear(const Part& part, double from_support) const;
  /// Returns the part of the beam that contains x, and the distance of x from its support, negative beyond it [m].
  Part part_at(double x, double& from_support) const;

  double left_, right_, loaded_;
  double second_moment_;  ///< I = width·height³/12 [m⁴]
  double shear_;          ///< E/(k·G·A) [1/m²]
};

}  // namespace macadam
