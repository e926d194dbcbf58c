// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_composition.cpp  Draws sizes and templates of shaped aggregates such that the volumes sum to those of
/// their classes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/specimen/composition.hpp"
#include "host/specimen/packing/shape_placement.hpp"
#include "host/spheres/specimen_check.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

// A draw with an error below this fraction of the class's volume is accepted at once.
constexpr double close_enough = 1e-3;
constexpr double tolerance = 0.005;  // an error above this fraction of the class's volume is refused
constexpr int most_draws = 200;      // attempts to draw the templates of one class
constexpr int size_shares = 64;      // number of sizes at which a size law is sampled to compute a mean

/// Number of the random stream of the first class. The streams of single spheres start at 100 (composition.cpp).
constexpr std::uint64_t first_stream = 10'000;

/// Draws the aggregates of one recipe.
class Composer {
 public:
  Composer(const std::vector<ShapeTemplate>& shapes, const std::function<bool(int, double)>& is_sphere)
      : shapes_(shapes), is_sphere_(is_sphere) {}

  bool sphere(int shape, double size) const { return is_sphere_ && is_sphere_(shape, size); }
  double volume(int shape, double size) const { return aggregate_volume(shapes_[shape], size, sphere(shape, size)); }

  /// Returns the mean volume of the copies of all templates, divided by the mean volume of spheres of the same sizes.
  double form(const SizeRange& range) const {
    double bodies = 0, spheres = 0;
    for (int k = 0; k < size_shares; ++k) {
      const double size = range.quantile((k + 0.5) / size_shares);
      spheres += static_cast<double>(shapes_.size()) * sphere_volume(size);
      for (int shape = 0; shape < static_cast<int>(shapes_.size()); ++shape) bodies += volume(shape, size);
    }
    return bodies / spheres;
  }

  /// Draws templates at random, then sizes such that the class has its volume. With few bodies this may be impossible
  /// for some templates. In that case templates are drawn again. If the recipe does not give the number of bodies, two
  /// of three such attempts have one body more or one body fewer.
  std::vector<AggregateRequest> draw(const ClassRequest& request, int size_class, std::int64_t count,
                                     RandomStream random) const {
    std::vector<AggregateRequest> best;
    double best_miss = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_draws && best_miss > close_enough * request.volume; ++k) {
      const std::int64_t n = request.count ? count : std::max<std::int64_t>(0, count + (k + 1) % 3 - 1);
      std::vector<AggregateRequest> drawn(static_cast<std::size_t>(n));
      for (AggregateRequest& r : drawn) r = {size_class, static_cast<int>(random.index(shapes_.size())), 0, false};
      const std::vector<double> size = draw_sizes(request.range, n, request.volume, random,
                                                  [&](std::size_t i, double d) { return volume(drawn[i].shape, d); });
      double sum = 0;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        drawn[i].size = size[i], drawn[i].sphere = sphere(drawn[i].shape, size[i]);
        sum += volume(drawn[i].shape, size[i]);
      }
      if (std::abs(sum - request.volume) >= best_miss) continue;
      best_miss = std::abs(sum - request.volume);
      best = std::move(drawn);
    }
    return best;
  }

 private:
  const std::vector<ShapeTemplate>& shapes_;
  const std::function<bool(int, double)>& is_sphere_;
};

}  // namespace

double aggregate_volume(const ShapeTemplate& shape, double size, bool sphere) {
  const double scale = size / shape.d_intermediate;
  return sphere ? sphere_volume(size * shape.sphere_size) : scale * scale * scale * shape.volume;
}

ShapeComposition compose_shapes(const SpecimenSpec& spec, const std::vector<ShapeTemplate>& shapes,
                                const std::function<bool(int shape, double size)>& is_sphere) {
  if (shapes.empty()) throw InputError(spec.source, spec.line, "shapes of the aggregates", "none", "at least one");
  const Composer composer(shapes, is_sphere);
  const Recipe recipe = solve_recipe(spec, [&](const SizeRange& range) { return composer.form(range); });
  const double box = spec.box.volume();
  ShapeComposition result;
  for (std::size_t k = 0; k < recipe.aggregate.size(); ++k) {
    const ClassRequest& request = recipe.aggregate[k];
    const auto drawn =
        composer.draw(request, static_cast<int>(k), request.number(box), RandomStream(spec.seed, first_stream + k));
    const auto count = static_cast<std::int64_t>(drawn.size());
    CompositionRow row{request.name, count, count, request.volume / box, 0};
    for (const AggregateRequest& r : drawn) row.fraction += composer.volume(r.shape, r.size) / box;
    if (!request.count && std::abs(row.fraction - row.fraction_asked) > tolerance * row.fraction_asked)
      throw InputError(
          request.origin.source, request.origin.line, request.name + ": fraction of the box", shown(row.fraction_asked),
          shown(row.fraction) +
              ", the nearest fraction found with these shapes; wider sieves or a larger box allow more fractions");
    if (!drawn.empty()) require_fit(request.origin, request.name, drawn.front().size, spec.box);
    result.row.push_back(row);
    result.aggregate.insert(result.aggregate.end(), drawn.begin(), drawn.end());
  }
  std::stable_sort(result.aggregate.begin(), result.aggregate.end(),
                   [](const AggregateRequest& a, const AggregateRequest& b) { return a.size > b.size; });
  return result;
}

}  // namespace macadam
