// SPDX-License-Identifier: GPL-3.0-or-later
// surface_check.cpp  Finds every fault of a surface and the facets where it occurs.
#include <fmt/format.h>

#include <algorithm>

#include "host/shapes/surface/self_intersection.hpp"
#include "host/base/disjoint_sets.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "host/shapes/surface/surface_pieces.hpp"

namespace macadam {
namespace {

using Facets = std::vector<std::int32_t>;

/// One side of a facet: from its corner number `corner` (0, 1, 2) to the next corner.
struct Side {
  std::int32_t low, high, facet, corner;  // points of the edge, low < high
  bool up;                                // the side runs from low to high
};

/// One check of one surface.
class Check {
 public:
  explicit Check(const Surface& surface) : surface_(surface), degenerate_(surface.facets.size()) {
    verdict_.stray = find_stray();
    verdict_.degenerate = find_degenerate();
    collect_sides();
  }

  SurfaceVerdict operator()() {
    faulty_edges();
    pinched_points();
    misoriented();
    verdict_.self_intersecting = self_intersecting_facets(surface_, degenerate_);
    pieces();
    verdict_.inside_out = verdict_.open.empty() && verdict_.non_manifold.empty() && verdict_.misoriented.empty() &&
                          signed_volume(surface_) < 0;
    for (Facets* facets : {&verdict_.non_manifold, &verdict_.open, &verdict_.misoriented}) {
      std::sort(facets->begin(), facets->end());
      facets->erase(std::unique(facets->begin(), facets->end()), facets->end());
    }
    return verdict_;
  }

 private:
  /// Returns the points that no facet uses.
  std::vector<std::int32_t> find_stray() const {
    std::vector<bool> named(surface_.points.size());
    for (const auto& facet : surface_.facets) {
      for (const std::int32_t p : facet) named[p] = true;
    }
    std::vector<std::int32_t> found;
    for (std::size_t p = 0; p < named.size(); ++p) {
      if (!named[p]) found.push_back(static_cast<std::int32_t>(p));
    }
    return found;
  }

  /// Returns the facets without area and marks them in degenerate_.
  Facets find_degenerate() {
    Facets found;
    const double rounding = coordinate_rounding(surface_.points);
    for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
      const auto [a, b, c] = surface_.facets[f];
      const Vec3d &p = surface_.points[a], &q = surface_.points[b], &r = surface_.points[c];
      const double longest = std::max({norm(q - p), norm(r - q), norm(p - r)});
      // The facet counts as degenerate if its height is within the rounding of its corners' coordinates.
      degenerate_[f] = a == b || b == c || c == a || norm(cross(q - p, r - p)) <= longest * rounding;
      if (degenerate_[f]) found.push_back(static_cast<std::int32_t>(f));
    }
    return found;
  }

  /// Sorts the sides of all facets by edge; edges_[k] is the index of the first side of edge k.
  void collect_sides() {
    for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
      const auto [a, b, c] = surface_.facets[f];
      if (a == b || b == c || c == a) continue;  // an edge, not a facet; its neighbours share that edge
      for (int k = 0; k < 3; ++k) {
        const std::int32_t from = surface_.facets[f][k], to = surface_.facets[f][(k + 1) % 3];
        sides_.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(f), k, from < to});
      }
    }
    const auto edge_of = [](const Side& s) { return std::pair(s.low, s.high); };
    std::stable_sort(sides_.begin(), sides_.end(),
                     [&](const Side& a, const Side& b) { return edge_of(a) < edge_of(b); });
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (i == 0 || edge_of(sides_[i]) != edge_of(sides_[i - 1])) edges_.push_back(i);
    }
    edges_.push_back(sides_.size());
  }

  /// Calls visit(first side, one past the last side) for each edge.
  template <class Visit>
  void each_edge(Visit&& visit) const {
    for (std::size_t e = 0; e + 1 < edges_.size(); ++e) visit(&sides_[edges_[e]], sides_.data() + edges_[e + 1]);
  }

  /// Records the facets at faulty edges. An edge with one side is open; an edge with more than two sides is
  /// non-manifold.
  void faulty_edges() {
    each_edge([&](const Side* first, const Side* last) {
      if (last - first == 1) verdict_.open.push_back(first->facet);
      for (const Side* s = first; last - first > 2 && s != last; ++s) verdict_.non_manifold.push_back(s->facet);
    });
  }

  /// Finds pinched points. Around a regular point all facets are connected through shared edges. Around a pinched point
  /// they form two or more separate fans.
  void pinched_points() {
    DisjointSets corners(3 * surface_.facets.size());
    each_edge([&](const Side* first, const Side* last) {
      for (const Side* s = first + 1; s < last; ++s) {
        for (const bool low : {true, false}) corners.join(corner_at(*first, low), corner_at(*s, low));
      }
    });
    Facets fan(surface_.points.size(), -1);
    std::vector<bool> pinched(surface_.points.size(), false);
    const auto each_corner = [&](auto&& visit) {
      for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
        for (int k = 0; k < 3 && !degenerate_[f]; ++k) visit(static_cast<std::int32_t>(f), k, surface_.facets[f][k]);
      }
    };
    each_corner([&](std::int32_t f, int k, std::int32_t point) {
      const std::int32_t root = corners.find(3 * f + k);
      if (fan[point] < 0) fan[point] = root;
      if (fan[point] != root) pinched[point] = true;
    });
    each_corner([&](std::int32_t f, int, std::int32_t point) {
      if (pinched[point]) verdict_.non_manifold.push_back(f);
    });
  }

  /// Returns the index (3·facet + corner) of the corner of this side that lies at the lower or the higher point of the
  /// edge.
  static std::int32_t corner_at(const Side& s, bool low) {
    return 3 * s.facet + (s.up == low ? s.corner : (s.corner + 1) % 3);
  }

  /// Finds misoriented facets. In each connected patch the facets are divided into two classes such that neighbours of
  /// the same class have consistent orientations. The facets of the smaller class are reported.
  void misoriented() {
    struct Neighbour {
      std::int32_t facet;
      bool agrees;
    };
    std::vector<std::vector<Neighbour>> neighbours(surface_.facets.size());
    each_edge([&](const Side* first, const Side* last) {
      if (last - first != 2) return;
      const bool agrees = first[0].up != first[1].up;
      neighbours[first[0].facet].push_back({first[1].facet, agrees});
      neighbours[first[1].facet].push_back({first[0].facet, agrees});
    });
    std::vector<int> side_of(surface_.facets.size(), -1);
    for (std::size_t start = 0; start < side_of.size(); ++start) {
      if (side_of[start] >= 0) continue;
      Facets patch{static_cast<std::int32_t>(start)}, one_sided;
      side_of[start] = 0;
      std::array<std::int64_t, 2> count{};
      for (std::size_t i = 0; i < patch.size(); ++i) {  // patch grows in the loop
        const std::int32_t f = patch[i];
        ++count[side_of[f]];
        for (const auto& [g, agrees] : neighbours[f]) {
          const int expected = agrees ? side_of[f] : 1 - side_of[f];
          if (side_of[g] < 0) side_of[g] = expected, patch.push_back(g);
          if (side_of[g] != expected) one_sided.push_back(f);  // no consistent orientation exists, as on a Möbius strip
        }
      }
      const int minority = count[1] <= count[0] ? 1 : 0;
      std::copy_if(patch.begin(), patch.end(), std::back_inserter(verdict_.misoriented),
                   [&](std::int32_t f) { return side_of[f] == minority; });
      std::copy(one_sided.begin(), one_sided.end(), std::back_inserter(verdict_.misoriented));
    }
  }

  void pieces() {
    const SurfacePieces pieces(surface_);
    verdict_.pieces = pieces.count();
    const std::vector<bool> inner = pieces.find_inner(verdict_);
    verdict_.inner = std::count(inner.begin(), inner.end(), true);
  }

  const Surface& surface_;
  std::vector<bool> degenerate_;
  std::vector<Side> sides_;
  std::vector<std::size_t> edges_;
  SurfaceVerdict verdict_;
};

}  // namespace

SurfaceVerdict check_surface(const Surface& surface) {
  require_sound_numbers(surface);
  return Check(surface)();
}

bool SurfaceVerdict::good() const {
  return stray.empty() && degenerate.empty() && non_manifold.empty() && open.empty() && misoriented.empty() &&
         self_intersecting.empty() && pieces == 1 && !inside_out;
}

std::string SurfaceVerdict::text() const {
  if (good()) return "closed";
  std::string text;
  const auto add = [&](const std::string& fault) { text += (text.empty() ? "" : "; ") + fault; };
  const auto add_all = [&](const char* fault, const char* of, const std::vector<std::int32_t>& numbers) {
    if (numbers.empty()) return;
    constexpr std::size_t shown = 8;
    const auto end = numbers.begin() + std::min(numbers.size(), shown);
    add(fmt::format("{} {} {}{} ({}{})", fault, numbers.size(), of, numbers.size() == 1 ? "" : "s",
                    fmt::join(numbers.begin(), end, ", "), numbers.size() > shown ? ", …" : ""));
  };
  const auto add_facets = [&](const char* fault, const Facets& facets) { add_all(fault, "facet", facets); };
  add_all("no facet at", "point", stray);
  add_facets("degenerate at", degenerate);
  add_facets("non-manifold at", non_manifold);
  add_facets("open at", open);
  add_facets("misoriented at", misoriented);
  add_facets("self-intersecting at", self_intersecting);
  if (pieces != 1)
    add(fmt::format("{} pieces{}", pieces,
                    inner > 0 ? fmt::format(", {} inside the largest (closed pores)", inner) : ""));
  if (inside_out) add("inside out");
  return text;
}

}  // namespace macadam
