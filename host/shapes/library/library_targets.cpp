// SPDX-License-Identifier: GPL-3.0-or-later
// library_targets.cpp  Takes target values from the strata of distributions and combines these values to shapes.
// Exchanges values between shapes until the statistics of the library match the published ones.
#include "host/shapes/library/library_targets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "host/shapes/library/statistics.hpp"
#include "host/spheres/random_stream.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// A distribution, given as a piecewise linear quantile function. At each of its knots, `shapes` of the 82 shapes in
/// reference [1] lie below `value`.
struct Knot {
  double shapes, value;
};
using Quantiles = std::vector<Knot>;
constexpr double paper_shapes = 82;

/// Distribution of D^I [mm]. The sieve classes hold 1, 6, 17, 27, 14, 12, 4 and 1 shapes. In each of the larger classes
/// a further knot between the two sieves has half of the shapes above it. The first and the last value are chosen such
/// that the midpoints of the first and the last stratum are the smallest and the largest D^I of Table 1 of [1].
const Quantiles sizes_mm{{0, 0.46}, {1, 0.5},  {7, 1},    {15.5, 1.4}, {24, 2},    {37.5, 2.6}, {51, 4},
                         {58, 5},   {65, 6.3}, {71, 7.9}, {77, 10},    {79, 11.2}, {81, 12.5},  {82, 12.68}};
/// Distribution of the elongation E. There are 2 very elongated and 15 moderately elongated shapes. The other knots are
/// chosen such that the average is 0.70.
const Quantiles elongations{{0, 0.38}, {2, 0.4}, {17, 0.6}, {61, 0.8}, {82, 0.978}};
/// Distribution of the flatness F. There are 3 very flat and 19 moderately flat shapes. The other knots are chosen such
/// that the average is 0.64.
const Quantiles flatnesses{{0, 0.358}, {3, 0.4}, {22, 0.6}, {60, 0.7}, {79, 0.8}, {82, 0.94}};
/// Distribution of the true sphericity ψ^w. The minimum, average and maximum are those of Table 1 of [1].
const Quantiles sphericities{{0, 0.718}, {8, 0.79}, {41, 0.865}, {74, 0.92}, {82, 0.968}};
/// Distribution of the number of points. The minimum, average and maximum are those of Table 1 of [1], and nine shapes
/// have fewer than 100 facets.
const Quantiles points{{0, 24.5}, {9, 51}, {41, 145}, {70, 270}, {82, 411.5}};

/// Returns the value below which `shapes` of the 82 shapes lie.
double quantile(const Quantiles& knots, double shapes) {
  auto upper = std::next(knots.begin());
  while (std::next(upper) != knots.end() && upper->shapes <= shapes) ++upper;
  const auto lower = std::prev(upper);
  return lower->value + (upper->value - lower->value) * (shapes - lower->shapes) / (upper->shapes - lower->shapes);
}

/// Divides the distribution into `shapes` strata of equal probability and returns their midpoints.
std::vector<double> strata(const Quantiles& knots, int shapes) {
  std::vector<double> values;
  for (int i = 0; i < shapes; ++i) values.push_back(quantile(knots, (i + 0.5) * paper_shapes / shapes));
  return values;
}

enum class Statistic { least, average, greatest, correlation };

/// A target statistic that depends on which values are combined in one shape. Deviations within the tolerance do not
/// count.
struct Wish {
  Statistic statistic;
  std::size_t property, other;  ///< index in shape_properties()
  double value, tolerance;      ///< in SI units
};

std::size_t number_of(std::string_view name) {
  const auto& all = shape_properties();
  return std::find_if(all.begin(), all.end(), [&](const ShapeProperty& p) { return p.name == name; }) - all.begin();
}

/// Correlations of Table 2 of [1] that the five distributions do not determine. The last correlation in this list is
/// not from [1]: larger stones are scanned with more voxels, so they have more points.
struct Correlation {
  const char *property, *other;
  double value;
};
constexpr Correlation correlations[] = {{"SI", "D^L", -0.24},    {"SI", "D^I", -0.28},    {"SI", "D^S", -0.71},
                                        {"F", "D^L", 0.15},      {"F", "D^I", 0.05},      {"F", "D^S", 0.38},
                                        {"Fl", "D^L", 0.25},     {"Fl", "D^I", 0.02},     {"Fl", "D^S", 0.62},
                                        {"E", "D^L", -0.31},     {"E", "D^I", -0.07},     {"E", "D^S", -0.17},
                                        {"E", "SI", -0.16},      {"E", "F", -0.32},       {"E", "Fl", -0.39},
                                        {"psi^A", "D^L", -0.07}, {"psi^A", "D^I", -0.03}, {"psi^A", "D^S", 0.24},
                                        {"psi^A", "F", 0.76},    {"psi^A", "E", 0.33},    {"points", "D^I", 0.6}};

/// Returns the statistics of Tables 1 and 2 of [1] that depend on which values are combined in one shape. The targets
/// for the extremes lie 2 % outside the range of [1], so that the library covers that range.
std::vector<Wish> published_targets() {
  using enum Statistic;
  std::vector<Wish> wishes;
  for (const char* name : {"D^L", "D^S", "V", "SI", "Fl", "psi^A"}) {
    const std::size_t p = number_of(name);
    const auto [low, mean, high] = shape_properties()[p].paper;
    const double unit = shape_properties()[p].per_unit;
    wishes.push_back({least, p, p, 0.98 * low / unit, 0.01 * low / unit});
    wishes.push_back({average, p, p, mean / unit, 0.03 * mean / unit});
    wishes.push_back({greatest, p, p, 1.02 * high / unit, 0.01 * high / unit});
  }
  for (const auto& [a, b, r] : correlations) wishes.push_back({correlation, number_of(a), number_of(b), r, 0.1});
  return wishes;
}

/// Returns the value of a statistic for the shapes; `columns` has the values of each property.
double found(const Wish& wish, const std::vector<ShapeMeasure>& shapes,
             const std::vector<std::vector<double>>& columns) {
  if (wish.statistic == Statistic::correlation) return pearson(columns[wish.property], columns[wish.other]);
  const Spread spread = spread_of(shape_properties()[wish.property], shapes);
  if (wish.statistic == Statistic::average) return spread.average;
  return wish.statistic == Statistic::least ? spread.min : spread.max;
}

/// The ratio V/(D^L·D^I·D^S) by which V is predicted; shapes are not fitted to V. The extremes of Table 1 of [1] give
/// 0.45 for the smallest and 0.41 for the largest stone, provided that all extremes belong to the same stone. An
/// ellipsoid has 0.52.
constexpr double fullness = 0.43;

/// The strata of D^I, E, F and number of points, and how they are combined to shapes.
class Pairing {
 public:
  Pairing(RandomStream& random, int shapes)
      : random_(random),
        size_(strata(sizes_mm, shapes)),
        columns_{strata(elongations, shapes), strata(flatnesses, shapes), strata(points, shapes)} {
    for (std::vector<double>& column : columns_) {
      for (std::size_t i = column.size(); i > 1; --i) std::swap(column[i - 1], column[random_.index(i)]);
    }
  }

  /// Exchanges the values of one column between two random shapes, and undoes the exchange if the cost has not
  /// decreased.
  void improve(int exchanges) {
    double best = cost();
    for (int n = 0; n < exchanges && best > 0; ++n) {
      std::vector<double>& column = columns_[random_.index(columns_.size())];
      const std::size_t i = random_.index(column.size()), k = random_.index(column.size());
      std::swap(column[i], column[k]);
      const double now = cost();
      if (now < best) {
        best = now;
      } else {
        std::swap(column[i], column[k]);
      }
    }
  }

  /// Returns the measures of all shapes for the present combination.
  std::vector<ShapeMeasure> targets() const {
    std::vector<ShapeMeasure> all(size_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& [elongation, flatness, count] = columns_;
      ShapeMeasure& m = all[i];
      m.points = std::lround(count[i]);
      m.facets = 2 * m.points - 4;  // Euler's formula for a closed triangulated surface without handles
      m.d_intermediate = 1e-3 * size_[i];
      m.d_long = m.d_intermediate / elongation[i];
      m.d_short = m.d_intermediate * flatness[i];
      m.volume = fullness * m.d_long * m.d_intermediate * m.d_short;
    }
    return all;
  }

 private:
  /// Returns the sum of squares of the deviations beyond the tolerances, each in units of its tolerance. Deviations
  /// within the tolerance cost nothing, so that shapes are not more ordered than the tables require. Statistics that
  /// are undefined (NaN) for a small number of shapes do not count.
  double cost() const {
    const std::vector<ShapeMeasure> shapes = targets();
    std::vector<std::vector<double>> values;
    for (const ShapeProperty& property : shape_properties()) {
      auto& column = values.emplace_back();
      for (const ShapeMeasure& m : shapes) column.push_back(tabulated(property, m));
    }
    double sum = 0;
    for (const Wish& wish : wishes_) {
      const double miss = std::abs(found(wish, shapes, values) - wish.value) / wish.tolerance - 1;
      if (miss > 0) sum += miss * miss;
    }
    return sum;
  }

  RandomStream& random_;
  std::vector<Wish> wishes_ = published_targets();
  std::vector<double> size_;                    ///< D^I [mm]
  std::array<std::vector<double>, 3> columns_;  ///< E, F, points
};

/// Assigns the strata of ψ^w in ascending order of ψ^A, with two corrections and a random part. In Table 2, the
/// correlation of ψ^w with ψ^A is 0.89, and its correlation with the sizes is -0.06 to -0.34. The random part
/// `disorder` and the correction `fineness`, which gives larger values to smaller stones, reproduce these correlations.
/// The correction `lack` is for the number of points: a convex surface with few points has a lower sphericity than the
/// smooth body through its points, by about 0.8 divided by the number of points. For a sphere the difference is 0.06
/// with 12 points (an icosahedron) and 0.02 with 42 points.
void add_sphericities(std::vector<ShapeMeasure>& shapes, RandomStream& random) {
  constexpr double disorder = 0.02, fineness = 0.04, lack = 0.8;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double lacking = lack / static_cast<double>(shapes[i].points);
    const double coarser = fineness * static_cast<double>(i) / static_cast<double>(shapes.size());
    order.emplace_back(shapes[i].sphericity_working() - lacking - coarser + random.uniform(-disorder, disorder), i);
  }
  std::sort(order.begin(), order.end());
  const std::vector<double> values = strata(sphericities, static_cast<int>(shapes.size()));
  for (std::size_t k = 0; k < values.size(); ++k) shapes[order[k].second].sphericity_true = values[k];
}

}  // namespace

std::vector<ShapeMeasure> draw_library_targets(RandomStream& random, int shapes) {
  constexpr int exchanges = 20'000;  // after this number, only one exchange in thousands lowers the cost
  Pairing pairing(random, shapes);
  pairing.improve(exchanges);
  std::vector<ShapeMeasure> targets = pairing.targets();
  add_sphericities(targets, random);
  return targets;
}

}  // namespace macadam
