// SPDX-License-Identifier: GPL-3.0-or-later
// grains.cpp  Measures neck, solidity and grey value between two touching pieces, and joins pieces.
#include "host/tools/ct/grains/grains.hpp"

#include "kernels/base/parallel.hpp"
#include "host/shapes/surface/convex_hull.hpp"
#include "host/shapes/files/surface_numbers.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Sets the hull of a piece to the convex hull of the points, and computes its volume.
void take_hull(Piece& piece, const std::vector<Vec3d>& points) {
  const auto facets = convex_hull(points);
  std::vector<std::int32_t> corners;
  piece.hull_volume = 0;
  for (const auto& [a, b, c] : facets) {
    const auto point = [&](std::int32_t n) { return points[static_cast<std::size_t>(n)] - points.front(); };
    piece.hull_volume += dot(point(a), cross(point(b), point(c))) / 6;
    corners.insert(corners.end(), {a, b, c});
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Vec3d> kept;
  for (const std::int32_t c : corners) kept.push_back(points[static_cast<std::size_t>(c)]);
  piece.hull = std::move(kept);
}

/// The first and last voxel of a piece in each row along x of one slice: row j extends from low[j − first] to high[j −
/// first].
struct Rows {
  std::int64_t first = 0;
  std::vector<std::int32_t> low, high;  ///< low > high: no voxel in this row
};

/// Appends the corners of the voxels at the ends of the rows. Ends that do not lie outside the straight line between
/// the ends of the two neighbouring rows are skipped, because they cannot be corners of the convex hull.
void add_corners(const Rows& rows, std::int64_t k, const Image<std::uint32_t>& grid, std::vector<Vec3d>& points) {
  const auto n = static_cast<std::int64_t>(rows.low.size());
  const auto there = [&](std::int64_t r) {
    return r >= 0 && r < n && rows.low[static_cast<std::size_t>(r)] <= rows.high[static_cast<std::size_t>(r)];
  };
  const auto end = [&](const std::vector<std::int32_t>& ends, std::int64_t r) {
    return ends[static_cast<std::size_t>(r)];
  };
  const auto add = [&](double i, std::int64_t j) {
    for (const double dj : {-0.5, 0.5}) {
      for (const double dk : {-0.5, 0.5}) {
        points.push_back({grid.origin.x + grid.spacing.x * i,
                          grid.origin.y + grid.spacing.y * (static_cast<double>(j) + dj),
                          grid.origin.z + grid.spacing.z * (static_cast<double>(k) + dk)});
      }
    }
  };
  for (std::int64_t r = 0; r < n; ++r) {
    if (!there(r)) continue;
    const bool between = there(r - 1) && there(r + 1);
    if (!between || 2 * end(rows.low, r) < end(rows.low, r - 1) + end(rows.low, r + 1))
      add(end(rows.low, r) - 0.5, rows.first + r);
    if (!between || 2 * end(rows.high, r) > end(rows.high, r - 1) + end(rows.high, r + 1))
      add(end(rows.high, r) + 0.5, rows.first + r);
  }
}

/// Returns volume, radius and convex hull of each fragment.
std::vector<Piece> pieces_of(const Fragments& fragments) {
  const Image<std::uint32_t>& labels = fragments.labels;
  std::vector<Piece> pieces(fragments.radius.size());
  std::vector<std::vector<Vec3d>> points(pieces.size());
  std::vector<std::int64_t> voxels(pieces.size());
  std::map<std::uint32_t, Rows> slice;
  for (std::int64_t k = 0; k < labels.size[2]; ++k) {
    slice.clear();
    for (std::int64_t j = 0; j < labels.size[1]; ++j) {
      Rows* rows = nullptr;
      std::uint32_t last = 0;
      for (std::int64_t i = 0; i < labels.size[0]; ++i) {
        const std::uint32_t label = labels.at(i, j, k);
        if (label == 0) continue;
        ++voxels[label];
        if (label != last || !rows) {
          rows = &slice.try_emplace(label, Rows{j, {}, {}}).first->second;
          last = label;
          const auto row = static_cast<std::size_t>(j - rows->first);
          if (rows->low.size() <= row) rows->low.resize(row + 1, 1), rows->high.resize(row + 1, 0);
          if (rows->low[row] > rows->high[row]) rows->low[row] = static_cast<std::int32_t>(i);
        }
        rows->high[static_cast<std::size_t>(j - rows->first)] = static_cast<std::int32_t>(i);
      }
    }
    for (const auto& [label, rows] : slice) add_corners(rows, k, labels, points[label]);
  }
  for_each_in_parallel(pieces.size(), [&](std::size_t p) {
    pieces[p].volume = static_cast<double>(voxels[p]) * labels.voxel_volume();
    pieces[p].radius = fragments.radius[p];
    if (voxels[p] > 0) take_hull(pieces[p], points[p]);
  });
  return pieces;
}

/// Returns the geometry of two pieces together.
Piece joined(const Piece& a, const Piece& b) {
  Piece both{a.volume + b.volume, std::max(a.radius, b.radius), {}, 0};
  std::vector<Vec3d> points = a.hull;
  points.insert(points.end(), b.hull.begin(), b.hull.end());
  take_hull(both, points);
  return both;
}

/// Measures a face between two pieces and decides whether it is a cut.
GrainCut judged(const Face& face, const Piece& a, const Piece& b) {
  GrainCut cut{face.a, face.b, (1 / face.area) * face.middle};
  cut.neck = face.neck / std::min(a.radius, b.radius);
  cut.solidity =
      (a.volume + b.volume) / joined(a, b).hull_volume / ((a.volume + b.volume) / (a.hull_volume + b.hull_volume));
  cut.valley = face.grey / face.area;
  cut.margin = margin_of(cut.neck, cut.solidity, cut.valley);
  cut.cut = cut.margin > 0;
  return cut;
}

/// Union-find of fragments that form one grain.
class Groups {
 public:
  explicit Groups(std::size_t fragments) : parent_(fragments) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t n) const {
    while (parent_[n] != n) n = parent_[n];
    return n;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t x = root(a), y = root(b);
    parent_[std::max(x, y)] = std::min(x, y);
  }
  /// Returns the number of each fragment's grain, from 1 in the order of the grains' first fragments.
  std::vector<std::uint32_t> numbers() const {
    std::vector<std::uint32_t> out(parent_.size());
    std::uint32_t next = 1;
    for (std::uint32_t f = 1; f < parent_.size(); ++f) out[f] = root(f) == f ? next++ : out[root(f)];
    return out;
  }

 private:
  std::vector<std::uint32_t> parent_;  ///< never larger than the index of the fragment itself
};

}  // namespace

// The measures neck, solidity and valley are compared with 0.8, 0.93 and 0.85. At these values the measures favour
// neither a cut nor a join.
double margin_of(double neck, double solidity, double valley) {
  const double score = 4 * (0.8 - neck) + 20 * (0.93 - solidity) + 6 * (0.85 - valley);
  return std::tanh(0.5 * score);
}

// Joins greedily: first the pair that most certainly belongs together. After each joining only the faces of the new
// piece are measured again.
Decision decide(const Fragments& fragments) {
  std::vector<Piece> pieces = pieces_of(fragments);
  Groups groups(pieces.size());
  // The faces between pieces; updated after each joining of two pieces. A piece consists of one or more fragments, so
  // several faces between fragments may lie between the same two pieces.
  std::vector<Face> faces = fragments.faces;
  std::vector<GrainCut> judgement(faces.size());
  for_each_in_parallel(faces.size(),
                       [&](std::size_t f) { judgement[f] = judged(faces[f], pieces[faces[f].a], pieces[faces[f].b]); });
  std::vector<GrainCut> cuts = judgement;
  std::vector<std::size_t> alive(faces.size());
  std::iota(alive.begin(), alive.end(), std::size_t{0});
  while (!alive.empty()) {
    const std::size_t best = *std::min_element(alive.begin(), alive.end(), [&](std::size_t x, std::size_t y) {
      return judgement[x].margin < judgement[y].margin;
    });
    if (judgement[best].margin >= 0) break;
    const std::uint32_t a = std::min(faces[best].a, faces[best].b), b = std::max(faces[best].a, faces[best].b);
    pieces[a] = joined(pieces[a], pieces[b]);
    pieces[b] = {};
    groups.join(a, b);
    // the faces of b become faces of a; faces to the same neighbour are merged
    std::map<std::uint32_t, std::size_t> to;
    std::vector<std::size_t> left, changed;
    for (const std::size_t f : alive) {
      Face& face = faces[f];
      if (f == best) continue;
      if (face.a != a && face.b != a && face.a != b && face.b != b) {
        left.push_back(f);
        continue;
      }
      const std::uint32_t other = face.a == a || face.a == b ? face.b : face.a;
      face.a = a, face.b = other;
      if (const auto [at, fresh] = to.try_emplace(other, f); !fresh) {
        Face& first = faces[at->second];
        first.neck = std::max(first.neck, face.neck);
        first.grey += face.grey, first.area += face.area, first.middle += face.middle;
      } else {
        left.push_back(f), changed.push_back(f);
      }
    }
    alive = std::move(left);
    for_each_in_parallel(changed.size(), [&](std::size_t c) {
      const Face& face = faces[changed[c]];
      judgement[changed[c]] = judged(face, pieces[face.a], pieces[face.b]);
    });
  }
  // Reports for each face between fragments the measures from the last time its two sides were compared.
  std::map<std::pair<std::uint32_t, std::uint32_t>, GrainCut> last;
  for (const std::size_t f : alive) {
    last[std::minmax(groups.root(faces[f].a), groups.root(faces[f].b))] = judgement[f];
  }
  for (std::size_t f = 0; f < cuts.size(); ++f) {
    const std::uint32_t a = groups.root(cuts[f].a), b = groups.root(cuts[f].b);
    cuts[f].cut = a != b;
    const GrainCut& seen = a == b ? judgement[f] : last.at(std::minmax(a, b));
    cuts[f].neck = seen.neck, cuts[f].solidity = seen.solidity, cuts[f].valley = seen.valley,
    cuts[f].margin = seen.margin;
  }
  return {groups.numbers(), cuts};
}

Decision decide(const Fragments& fragments, const std::vector<GrainCut>& cuts) {
  const double near = 2 * std::cbrt(fragments.labels.voxel_volume());
  const auto name = [](std::uint32_t a, std::uint32_t b) { return fmt::format("fragments {} and {}", a, b); };
  if (cuts.size() != fragments.faces.size()) {
    throw InputError("cuts", 0, "rows", std::to_string(cuts.size()),
                     fmt::format("{}, the number of cuts of this scan with these options", fragments.faces.size()));
  }
  Groups groups(fragments.radius.size());
  for (std::size_t f = 0; f < cuts.size(); ++f) {
    const Face& face = fragments.faces[f];
    const Vec3d place = (1 / face.area) * face.middle;
    if (cuts[f].a != face.a || cuts[f].b != face.b || norm(cuts[f].place - place) > near) {
      throw InputError(
          "cuts", 0, fmt::format("row {}", f + 1), name(cuts[f].a, cuts[f].b),
          fmt::format("{} at ({:.6g}, {:.6g}, {:.6g}) m; the cuts in the file are of another scan or of other options",
                      name(face.a, face.b), place.x, place.y, place.z));
    }
    if (!cuts[f].cut) groups.join(face.a, face.b);
  }
  for (const GrainCut& cut : cuts) {
    if (cut.cut && groups.root(cut.a) == groups.root(cut.b)) {
      throw InputError("cuts", 0, name(cut.a, cut.b),
                       "cut 1, although rows with cut 0 join these two fragments through other fragments",
                       "cut 0 in this row too; or, to separate two grains, cut 1 in every row that names one fragment "
                       "of each grain");
    }
  }
  return {groups.numbers(), cuts};
}

std::vector<double> certainty(const Decision& decision, const std::vector<std::uint32_t>& number) {
  std::vector<double> sure(number.size(), 1);
  for (const GrainCut& cut : decision.cuts) {
    const std::uint32_t a = decision.grain[cut.a], b = decision.grain[cut.b];
    if (number[a] == 0 || number[b] == 0 || cut.cut != (cut.margin > 0)) continue;
    for (const std::uint32_t grain : {a, b}) sure[grain] = std::min(sure[grain], 0.5 * (1 + std::abs(cut.margin)));
  }
  return sure;
}

}  // namespace macadam::ct
