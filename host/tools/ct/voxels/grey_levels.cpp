// SPDX-License-Identifier: GPL-3.0-or-later
// grey_levels.cpp  Fits mixtures to histograms by expectation maximisation.
#include "host/tools/ct/voxels/grey_levels.hpp"

#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

constexpr double pi = std::numbers::pi;

/// Density of a normal distribution at x.
double normal(double x, double mean, double deviation) {
  const double t = (x - mean) / deviation;
  return std::exp(-0.5 * t * t) / (deviation * std::sqrt(2 * pi));
}

/// Fraction of a normal distribution below x.
double below(double x, double mean, double deviation) {
  return 0.5 * std::erfc((mean - x) / (deviation * std::sqrt(2.0)));
}

/// Density of voxels that hold two phases in fractions evenly distributed between 0 and 1, with noise.
double partial(double x, double low, double high, double deviation) {
  return (below(x, low, deviation) - below(x, high, deviation)) / (high - low);
}

/// Mixture of n pure phases, and of n − 1 kinds of partly filled voxels between neighbouring phases. `weights` has the
/// pure phases first.
struct Mixture {
  std::vector<double> means, weights;
  double deviation = 0;
  std::size_t phases() const { return means.size(); }
};

/// Does one iteration of expectation maximisation. \returns the largest change of a mean.
double improve(Mixture& mixture, const Histogram& h) {
  const std::size_t n = mixture.phases(), all = 2 * n - 1;
  std::vector<double> share(all), density(all), sum(n), square(n);
  double total = 0;
  for (std::size_t b = 0; b < h.counts.size(); ++b) {
    if (h.counts[b] == 0) continue;
    const double x = h.centre(b), count = static_cast<double>(h.counts[b]);
    double whole = 1e-300;
    for (std::size_t k = 0; k < all; ++k) {
      density[k] =
          mixture.weights[k] * (k < n ? normal(x, mixture.means[k], mixture.deviation)
                                      : partial(x, mixture.means[k - n], mixture.means[k - n + 1], mixture.deviation));
      whole += density[k];
    }
    for (std::size_t k = 0; k < all; ++k) {
      const double part = count * density[k] / whole;
      share[k] += part;
      if (k >= n) continue;
      sum[k] += part * x;
      square[k] += part * x * x;
    }
    total += count;
  }
  double moved = 0, spread = 0, pure = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double mean = share[k] > 1e-9 * total ? sum[k] / share[k] : mixture.means[k];
    moved = std::max(moved, std::abs(mean - mixture.means[k]));
    spread += square[k] - share[k] * mean * mean;
    pure += share[k];
    mixture.means[k] = mean;
  }
  mixture.deviation = std::sqrt(std::max(spread / pure, h.width * h.width / 12));
  for (std::size_t k = 0; k < all; ++k) mixture.weights[k] = share[k] / total;
  return moved;
}

/// Fits a mixture, starting from the given means, which must rise. Stops if the means are no longer in rising order.
Mixture fitted(const Histogram& h, std::vector<double> means) {
  Mixture mixture;
  const std::size_t n = means.size();
  mixture.deviation = (means.back() - means.front()) / (4.0 * static_cast<double>(n));
  mixture.means = std::move(means);
  mixture.weights.assign(2 * n - 1, 1.0 / static_cast<double>(2 * n - 1));
  for (int round = 0; round < 500; ++round) {
    if (improve(mixture, h) < 1e-3 * h.width) break;
    if (!std::is_sorted(mixture.means.begin(), mixture.means.end())) break;
  }
  return mixture;
}

/// Returns the mean grey value of bins [from, to); the middle of the range if the bins are empty.
double mean_of(const Histogram& h, std::size_t from, std::size_t to) {
  double sum = 0, count = 0;
  for (std::size_t b = from; b < to; ++b) {
    sum += static_cast<double>(h.counts[b]) * h.centre(b);
    count += static_cast<double>(h.counts[b]);
  }
  return count > 0 ? sum / count : h.low + 0.5 * h.width * static_cast<double>(from + to);
}

/// Returns the two thresholds (bins) that split a histogram into three classes with the smallest variance within the
/// classes.
std::array<std::size_t, 2> otsu3(const Histogram& h) {
  const std::size_t n = h.counts.size(), step = std::max<std::size_t>(1, n / 128);
  std::vector<double> count(n + 1), sum(n + 1);
  for (std::size_t b = 0; b < n; ++b) {
    count[b + 1] = count[b] + static_cast<double>(h.counts[b]);
    sum[b + 1] = sum[b] + static_cast<double>(h.counts[b]) * h.centre(b);
  }
  const auto between = [&](std::size_t from, std::size_t to) {
    const double c = count[to] - count[from], s = sum[to] - sum[from];
    return c > 0 ? s * s / c : 0;
  };
  double best = -1;
  std::array<std::size_t, 2> at{};
  for (std::size_t i = step; i < n; i += step) {
    for (std::size_t j = i + step; j < n; j += step) {
      const double value = between(0, i) + between(i, j) + between(j, n);
      if (value > best) best = value, at = {i, j};
    }
  }
  return at;
}

}  // namespace

std::int64_t Histogram::total() const { return std::accumulate(counts.begin(), counts.end(), std::int64_t{0}); }

Histogram bins_of(const Image<float>& image, const Image<std::uint8_t>& region, std::size_t bins) {
  std::vector<float> some;  // a sample of a million voxels is enough
  const std::size_t step = image.count() / 1'000'000 + 1;
  for (std::size_t i = 0; i < image.count(); i += step) {
    if (region.voxels[i]) some.push_back(image.voxels[i]);
  }
  if (some.empty()) throw InputError("the scan: no voxel lies within the specimen");
  std::sort(some.begin(), some.end());
  const std::size_t rare = some.size() / 10'000;
  const double low = some[rare], high = some[some.size() - 1 - rare];
  if (!(high > low)) {
    throw InputError("the scan", 0, "grey values", fmt::format("{} everywhere", low), "phases of different grey");
  }
  Histogram h;
  h.counts.assign(bins, 0);
  h.width = (high - low) / static_cast<double>(bins - 2);
  h.low = low - h.width;
  return h;
}

Histogram histogram_of(const Image<float>& image, const Image<std::uint8_t>& region, std::size_t bins) {
  const Histogram empty = bins_of(image, region, bins);
  const auto slices = static_cast<std::size_t>(image.size[2]);
  const std::size_t slice = image.count() / slices;
  std::vector<Histogram> each(slices, empty);
  for_each_in_parallel(slices, [&](std::size_t k) {
    for (std::size_t i = k * slice; i < (k + 1) * slice; ++i) {
      if (region.voxels[i]) each[k].add(image.voxels[i]);
    }
  });
  Histogram all = empty;
  for (const Histogram& h : each) {
    for (std::size_t b = 0; b < bins; ++b) all.counts[b] += h.counts[b];
  }
  return all;
}

double otsu(const Histogram& h, std::size_t from, std::size_t to) {
  double whole = 0, sum = 0;
  for (std::size_t b = from; b < to; ++b) {
    whole += static_cast<double>(h.counts[b]);
    sum += static_cast<double>(h.counts[b]) * h.centre(b);
  }
  double below = 0, sum_below = 0, best = -1, at = h.centre(from);
  for (std::size_t b = from; b + 1 < to; ++b) {
    below += static_cast<double>(h.counts[b]);
    sum_below += static_cast<double>(h.counts[b]) * h.centre(b);
    if (below <= 0 || below >= whole) continue;
    const double apart = sum_below / below - (sum - sum_below) / (whole - below);
    const double value = below * (whole - below) * apart * apart;
    if (value > best) best = value, at = h.centre(b) + 0.5 * h.width;
  }
  return at;
}

// Starts a mixture of three phases from Otsu's two thresholds. If its levels are not plausible as air, mastic and
// aggregate, fits two phases instead.
GreyLevels fit_levels(const Histogram& h) {
  const auto [i, j] = otsu3(h);
  const Mixture three = fitted(h, {mean_of(h, 0, i), mean_of(h, i, j), mean_of(h, j, h.counts.size())});
  const bool ordered = std::is_sorted(three.means.begin(), three.means.end());
  // Air and mastic differ more in density, and so in grey value, than mastic and aggregate. If the lowest of three
  // levels is too near to the middle one (0.6 of the contrast), the scan has two phases, one of which was split.
  const double gap = three.means[1] - three.means[0], contrast = three.means[2] - three.means[1];
  GreyLevels levels;
  const GreyLevels all{three.means[0], three.means[1], three.means[2], three.deviation, true};
  if (ordered && gap > 0.6 * contrast && three.weights[0] > 1e-4 && three.weights[0] < 0.5 && contrast > 2 * h.width &&
      has_valley(h, all)) {
    levels = all;
  } else {
    const double middle = otsu(h, 0, h.counts.size());
    const std::size_t cut = h.bin(middle);
    const Mixture two = fitted(h, {mean_of(h, 0, cut + 1), mean_of(h, cut + 1, h.counts.size())});
    levels = {0, two.means[0], two.means[1], two.deviation, false};
  }
  return levels;
}

// Repeats two steps: first one iteration of expectation maximisation, in which each mean moves freely. Then the means
// are replaced by the levels of the whole scan, shifted by the brightness with which the shifted levels fit the means
// best (least squares).
PartLevel level_of_part(const Histogram& h, const GreyLevels& whole) {
  const auto total = static_cast<double>(h.total());
  if (total < 200) return {};
  Mixture mixture;
  std::vector<double> levels, change;  // grey levels of the phases, and their change per unit of brightness
  if (whole.has_air) levels.push_back(whole.air), change.push_back(0);
  for (const double level : {whole.mastic, whole.aggregate}) {
    levels.push_back(level);
    change.push_back(whole.has_air ? level - whole.air : whole.contrast());
  }
  const std::size_t n = levels.size();
  mixture.means = levels;
  mixture.weights.assign(2 * n - 1, 1.0 / static_cast<double>(2 * n - 1));
  double brighter = 0, known = 0;
  for (int round = 0; round < 100; ++round) {
    // wide at first, so that a pure phase of a much brighter part is not taken for partly filled voxels
    mixture.deviation = std::max(whole.deviation, 0.3 * whole.contrast() * std::pow(0.85, round));
    const bool narrow = mixture.deviation == whole.deviation;  // the noise is the same everywhere
    improve(mixture, h);
    double sum = 0, norm = 0;
    known = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (change[k] == 0) continue;
      sum += mixture.weights[k] * change[k] * (mixture.means[k] - levels[k]);
      norm += mixture.weights[k] * change[k] * change[k];
      known += mixture.weights[k];
    }
    const double before = brighter;
    brighter = norm > 0 ? sum / norm : 0;
    for (std::size_t k = 0; k < n; ++k) mixture.means[k] = levels[k] + brighter * change[k];
    if (narrow && std::abs(brighter - before) < 1e-5) break;
  }
  // The brightness of a part is known only if at least an eighth of its voxels hold a single phase. A shift of more
  // than 0.8 of the contrast cannot be brightness.
  if (known < 0.125 || std::abs(brighter) * change.back() > 0.8 * whole.contrast()) return {};
  return {brighter, known * total};
}

bool has_valley(const Histogram& h, const GreyLevels& levels) {
  const auto density = [&](double grey) {  // mean count over a twelfth of the contrast
    const std::size_t from = h.bin(grey - levels.contrast() / 24), to = h.bin(grey + levels.contrast() / 24);
    double sum = 0;
    for (std::size_t b = from; b <= to; ++b) sum += static_cast<double>(h.counts[b]);
    return sum / static_cast<double>(to - from + 1);
  };
  double least = std::numeric_limits<double>::infinity();
  for (const double share : {0.3, 0.4, 0.5, 0.6, 0.7})
    least = std::min(least, density(levels.mastic + share * levels.contrast()));
  return least < 0.7 * std::min(density(levels.mastic), density(levels.aggregate));
}

}  // namespace macadam::ct
