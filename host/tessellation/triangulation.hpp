// SPDX-License-Identifier: GPL-3.0-or-later
/// \file triangulation.hpp  Computes the regular triangulation of particles as plain arrays, without CGAL types.
#pragma once

#include <memory>
#include <vector>

#include "host/tessellation/weighted_sites.hpp"

namespace macadam {

/// One cell of a regular triangulation, made of four sites.
struct Tetrahedron {
  SiteNumbers site;  ///< in the order of comes_before()
  /// Number of the tetrahedron across the face opposite to site k; −1 if it is infinite or not part of the result.
  std::array<std::int32_t, 4> neighbour;
};

/// A regular triangulation of the bounding sites and of the particles inserted so far. The triangulation is exact: if
/// no two centres coincide, it does not depend on the order of insertion, even for cospherical sites.
class Triangulation {
 public:
  /// `sites` must outlive the triangulation.
  explicit Triangulation(const WeightedSites& sites);
  Triangulation(const Triangulation&) = delete;
  ~Triangulation();

  /// Inserts particles by their numbers.
  void insert(const std::vector<std::int32_t>& particles);
  /// Returns all finite tetrahedra, in CGAL's order.
  std::vector<Tetrahedron> tetrahedra();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace macadam
