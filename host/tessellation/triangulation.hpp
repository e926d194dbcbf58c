// SPDX-License-Identifier: GPL-3.0-or-later
/// \file triangulation.hpp  The regular triangulation of some particles as plain arrays (no CGAL types).
#pragma once

#include <memory>
#include <vector>

#include "host/tessellation/weighted_sites.hpp"

namespace macadam {

/// One cell of a regular triangulation.
struct Tetrahedron {
  SiteNumbers site;                       ///< in the order of comes_before()
  std::array<std::int32_t, 4> neighbour;  ///< tetrahedron across the face opposite to site k; −1: none that matters
};

/// The bounding sites, and the particles inserted so far. Exact: where no two centres are the same, what it holds does
/// not depend on the order of insertion, cospherical sites included.
class Triangulation {
 public:
  /// Of sites that outlive it.
  explicit Triangulation(const WeightedSites& sites);
  Triangulation(const Triangulation&) = delete;
  ~Triangulation();

  void insert(const std::vector<std::int32_t>& particles);
  /// All finite tetrahedra, in an order of CGAL's.
  std::vector<Tetrahedron> tetrahedra();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace macadam
