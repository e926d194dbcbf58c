// SPDX-License-Identifier: GPL-3.0-or-later
/// \file notched_facets.hpp  Removes the parts of facets that lie in notches.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/tessellation/polygon.hpp"
#include "macadam/contact_network.hpp"

namespace macadam {

/// A convex part of a facet.
struct FacetPart {
  double area = 0;                 ///< [m²]
  Vec3d centroid{};                ///< [m]
  std::span<const Vec3d> polygon;  ///< vertices, counter-clockwise about the normal of the facet [m]
};

/// Cuts facets by notches, one facet after the other.
class NotchedFacets {
 public:
  /// \throws InputError if a notch lies outside the specimen, or covers a whole section.
  NotchedFacets(const Specimen& specimen, const Tessellation& tessellation, std::span<const Notch> notches);

  /// Cuts the facet with this number, which lies between two particles. Returns whether a part of it remains. Facets
  /// must come in rising order.
  bool keep(std::uint32_t facet);

  /// Returns the parts of a kept facet that a notch shortened; none if the facet is whole. The spans remain valid as
  /// long as this object.
  std::vector<FacetPart> parts(std::uint32_t facet) const;

  /// Returns the number of vertices of all parts of a kept facet, and the number of parts.
  std::pair<std::size_t, std::size_t> sizes(std::uint32_t facet) const;

  /// Stores in `network` what the notches did. \throws InputError if the notches separate at least 1 % of the
  /// particles from the others, or if all centres are on one side of a notch.
  void finish(ContactNetwork& network) const;

 private:
  /// A facet of which a notch removed a part: its parts are pieces_[begin … end).
  struct Shortened {
    std::uint32_t facet;
    std::size_t begin, end;
  };
  /// A facet that a notch removed completely.
  struct Removed {
    std::int32_t a, b;
    std::size_t notch;
  };
  const Shortened* find(std::uint32_t facet) const;
  void require_one_piece(const ContactNetwork& network) const;

  const Specimen& specimen_;
  const Tessellation& tessellation_;
  std::vector<Notch> notches_;
  std::vector<NotchCut> cuts_;
  std::vector<char> meets_facet_;  ///< whether the notch lies between two particles that have a facet
  double tolerance_;
  std::vector<Shortened> shortened_;
  std::vector<Removed> removed_;
  std::vector<Polygon> pieces_;
};

}  // namespace macadam
