// SPDX-License-Identifier: GPL-3.0-or-later
// notched_facets.cpp  Cuts the facets between particles on opposite sides of a notch, and checks that no part of the
// specimen is cut off.
#include "host/network/notched_facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "host/base/disjoint_sets.hpp"
#include "host/tessellation/facets.hpp"
#include "host/tessellation/notches.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Particles that a notch separates from all others count as a severed part if they are at least this fraction of all
/// particles. Fewer particles are loose particles, as without a notch.
constexpr double smallest_part = 0.01;

/// Returns the area of polygons in the plane of a facet, projected along an axis.
double projected(std::span<const Polygon> parts, const Vec3d& normal, int axis) {
  double sum = 0;
  for (const Polygon& part : parts) sum += measure(part, normal).area;
  return sum * std::abs(along(normal, axis));
}

}  // namespace

NotchedFacets::NotchedFacets(const Specimen& specimen, const Tessellation& tessellation, std::span<const Notch> notches)
    : specimen_(specimen),
      tessellation_(tessellation),
      notches_(checked_notches(specimen.box, notches)),
      tolerance_(rounding_bound(specimen.box.size)) {
  for (const Notch& notch : notches) cuts_.push_back({notch, 0, 0, 0, 0});
  meets_facet_.assign(notches_.size(), false);
}

bool NotchedFacets::keep(std::uint32_t facet) {
  const Facet& f = tessellation_.facets[facet];
  const auto is_separated = [&](const Notch& n) { return separates(n, specimen_.centre[f.a], specimen_.centre[f.b]); };
  if (std::ranges::none_of(notches_, is_separated)) return true;
  const std::span<const Vec3d> polygon = tessellation_.polygon(f);
  std::vector<Polygon> parts{{polygon.begin(), polygon.end()}};
  std::vector<std::size_t> shortening;  // the notches that removed a part
  for (std::size_t k = 0; k < notches_.size(); ++k) {
    if (!is_separated(notches_[k])) continue;
    meets_facet_[k] = true;
    std::vector<Polygon> left = outside_of(notches_[k], parts, tolerance_);
    std::erase_if(left, [&](const Polygon& p) {
      const PolygonMeasure m = measure(p, f.normal);
      return m.area <= tolerance_ * m.extent;  // only rounding makes such a part
    });
    const int axis = notches_[k].axis;
    const double cut = projected(parts, f.normal, axis) - projected(left, f.normal, axis);
    // A notch that only touches the facet removes no area but rounding; such a facet stays whole.
    if (!(cut > 1e-12 * f.area * std::abs(along(f.normal, axis)))) continue;
    cuts_[k].cut_area += cut;
    if (left.empty()) {
      ++cuts_[k].removed;
      removed_.push_back({f.a, f.b, k});
      return false;
    }
    shortening.push_back(k);
    parts = std::move(left);
  }
  for (std::size_t k = 0; k < notches_.size(); ++k)
    if (is_separated(notches_[k])) cuts_[k].ligament += projected(parts, f.normal, notches_[k].axis);
  if (shortening.empty()) return true;
  for (const std::size_t k : shortening) ++cuts_[k].shortened;
  const std::size_t begin = pieces_.size();
  std::ranges::move(parts, std::back_inserter(pieces_));
  shortened_.push_back({facet, begin, pieces_.size()});
  return true;
}

const NotchedFacets::Shortened* NotchedFacets::find(std::uint32_t facet) const {
  const auto place = std::ranges::lower_bound(shortened_, facet, {}, &Shortened::facet);
  return place != shortened_.end() && place->facet == facet ? &*place : nullptr;
}

std::vector<FacetPart> NotchedFacets::parts(std::uint32_t facet) const {
  const Facet& f = tessellation_.facets[facet];
  const Shortened* cut = find(facet);
  std::vector<FacetPart> out;
  if (!cut) return out;
  for (std::size_t k = cut->begin; k < cut->end; ++k) {
    const PolygonMeasure m = measure(pieces_[k], f.normal);
    out.push_back({m.area, m.centroid, pieces_[k]});
  }
  return out;
}

std::pair<std::size_t, std::size_t> NotchedFacets::sizes(std::uint32_t facet) const {
  const Shortened* cut = find(facet);
  if (!cut) return {tessellation_.polygon(tessellation_.facets[facet]).size(), 1};
  std::size_t vertices = 0;
  for (std::size_t k = cut->begin; k < cut->end; ++k) vertices += pieces_[k].size();
  return {vertices, cut->end - cut->begin};
}

void NotchedFacets::finish(ContactNetwork& network) const {
  for (std::size_t k = 0; k < notches_.size(); ++k) {
    if (meets_facet_[k]) continue;
    throw InputError(notches_[k].source, notches_[k].line, "[[specimen.notch]]",
                     words_of(notches_[k]) + " that meets no contact", "a notch between centres of particles");
  }
  network.notches = cuts_;
  if (!removed_.empty()) require_one_piece(network);
}

void NotchedFacets::require_one_piece(const ContactNetwork& network) const {
  const auto n = static_cast<std::int32_t>(specimen_.size());
  DisjointSets before(specimen_.size()), after(specimen_.size());
  for (const Contact& c : network.contacts)
    if (c.b >= 0) before.join(c.a, c.b), after.join(c.a, c.b);
  for (const Removed& r : removed_) before.join(r.a, r.b);
  std::map<std::int32_t, std::int64_t> size_after;
  for (std::int32_t i = 0; i < n; ++i) ++size_after[after.find(i)];
  // for each set of particles that were joined: the sizes of its large parts
  std::map<std::int32_t, std::vector<std::int64_t>> large;
  for (const auto& [root, size] : size_after)
    if (static_cast<double>(size) >= smallest_part * n) large[before.find(root)].push_back(size);
  for (const Removed& r : removed_) {
    const std::vector<std::int64_t>& parts = large[before.find(r.a)];
    if (parts.size() < 2 || after.find(r.a) == after.find(r.b)) continue;
    throw InputError(notches_[r.notch].source, notches_[r.notch].line, "[[specimen.notch]]",
                     fmt::format("{} that severs the specimen into parts of {} particles", words_of(notches_[r.notch]),
                                 fmt::join(parts, " and ")),
                     "notches that leave a ligament");
  }
}

}  // namespace macadam
