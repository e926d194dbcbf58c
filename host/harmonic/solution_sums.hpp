// SPDX-License-Identifier: GPL-3.0-or-later
/// \file solution_sums.hpp  Sums over particles and contacts that the check of solutions computes.
#pragma once

#include <array>

#include "host/harmonic/particle_contacts.hpp"
#include "kernels/contact/contact_kinematics.hpp"
#include "macadam/sensitivity.hpp"

namespace macadam::harmonic {

/// Sums over some particles for one solution u: the squares of the residual, uᵀ·M·u, and the contributions of the pair
/// types to E*.
struct SolutionSums {
  /// Sums of squares [N²]: of the residual, and of the part of the residual that rounding does not explain.
  double residual = 0, beyond = 0;
  std::complex<double> inertia = 0;
  ModulusParts parts;

  void add(const SolutionSums& o) {
    residual += o.residual, beyond += o.beyond, inertia += o.inertia;
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      parts.normal[pair] += o.parts.normal[pair];
      parts.shear[pair] += o.parts.shear[pair];
      parts.normal_rock[pair] += o.parts.normal_rock[pair];
      parts.shear_rock[pair] += o.parts.shear_rock[pair];
    }
  }
};
using AllSums = std::array<SolutionSums, at_once>;  ///< of the solutions that are checked together

/// Sums of load times relative displacement over the contacts of one pair type. `share` is the fraction of a contact
/// that is added.
struct PairProducts {
  Products<at_once> normal, shear, normal_rock, shear_rock;
  /// Adds the parts of these products that the rock in series causes: the fraction series·k of a contact with the
  /// stiffness k, of which α is a factor in shear.
  void add_rock(const kernels::FacetLoad<FourNumbers>& load, const FourNumbers (&u)[6], FourNumbers share,
                const Factor<at_once>& in_normal, const Factor<at_once>& in_shear) {
    normal_rock.add(in_normal(load.n * share), u[0]), normal_rock.add(in_normal(-load.moment_t * share), u[1]);
    normal_rock.add(in_normal(load.moment_s * share), u[2]);
    shear_rock.add(in_shear(load.s * share), u[3]), shear_rock.add(in_shear(load.t * share), u[4]);
    shear_rock.add(in_shear(load.moment_n * share), u[5]);
  }
  void add(const kernels::FacetLoad<FourNumbers>& load, const FourNumbers (&u)[6], FourNumbers share) {
    normal.add(load.n * share, u[0]), normal.add(-load.moment_t * share, u[1]);
    normal.add(load.moment_s * share, u[2]);
    shear.add(load.s * share, u[3]), shear.add(load.t * share, u[4]), shear.add(load.moment_n * share, u[5]);
  }
};

}  // namespace macadam::harmonic
