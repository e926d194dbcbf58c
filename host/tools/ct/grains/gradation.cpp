// SPDX-License-Identifier: GPL-3.0-or-later
// gradation.cpp  Computes the fractions that pass sieves, for scanned grains and for a laboratory's sample.
#include "host/tools/ct/grains/gradation.hpp"

#include <charconv>
#include <fstream>

#include "host/tools/ct/voxels/scan_checks.hpp"
#include "host/base/in_quotes.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Returns the number in a text. \throws InputError if it is not a finite number.
double number(const std::string& text, const std::string& file, int line) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value))
    throw InputError(file, line, "field", in_quotes(text), "a number");
  return value;
}

/// Returns the fraction of the grains' volume with a sieve size below `size` [m].
double share_below(double size, const std::vector<ScannedGrain>& grains, double ScannedGrain::*sieve) {
  double below = 0, all = 0;
  for (const ScannedGrain& g : grains) {
    all += g.measure.volume;
    if (g.*sieve < size) below += g.measure.volume;
  }
  return all > 0 ? below / all : 0;
}

}  // namespace

std::vector<SievePassing> read_gradation(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::ifstream in(path);
  if (!in) throw InputError(file + ": cannot be read");
  std::vector<SievePassing> out;
  std::string line;
  double metre = 0, whole = 0;
  for (int at = 1; std::getline(in, line); ++at) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    if (metre == 0) {
      if (line != "sieve_m,passing" && line != "sieve_mm,passing_percent")
        throw InputError(file, at, "header", in_quotes(line), "sieve_m,passing or sieve_mm,passing_percent");
      metre = line == "sieve_m,passing" ? 1 : 1e-3, whole = line == "sieve_m,passing" ? 1 : 100;
      continue;
    }
    const std::size_t comma = line.find(',');
    if (comma == std::string::npos || line.find(',', comma + 1) != std::string::npos)
      throw InputError(file, at, "row", in_quotes(line), "two numbers: the size of the sieve and the passing");
    const double sieve = number(line.substr(0, comma), file, at), passing = number(line.substr(comma + 1), file, at);
    if (!(sieve > 0)) throw InputError(file, at, "sieve", fmt::format("{}", sieve), "a size above 0");
    if (!(passing >= 0 && passing <= whole))
      throw InputError(file, at, "passing", fmt::format("{}", passing), fmt::format("0 to {}", whole));
    out.push_back({sieve * metre, passing / whole, at});
  }
  std::sort(out.begin(), out.end(), [](const SievePassing& a, const SievePassing& b) { return a.size < b.size; });
  if (out.size() < 2) throw InputError(file, 0, "sieves", std::to_string(out.size()), "at least two");
  for (std::size_t i = 1; i < out.size(); ++i) {
    const std::string sieve = fmt::format("passing the sieve of {:.6g} mm", 1e3 * out[i].size);
    if (!(out[i].size > out[i - 1].size))
      throw InputError(file, out[i].line, sieve, "a second row for this sieve", "one row per sieve");
    if (out[i].passing < out[i - 1].passing) {
      throw InputError(file, out[i].line, sieve, fmt::format("{:.6g} %", 100 * out[i].passing),
                       fmt::format("at least the {:.6g} % that pass the next smaller sieve", 100 * out[i - 1].passing));
    }
  }
  if (out.back().passing < 0.999) {
    throw InputError(file, out.back().line, "passing the largest sieve",
                     fmt::format("{:.6g} %", 100 * out.back().passing),
                     "100 %, because the size of the largest grains must be known");
  }
  return out;
}

double passing_at(const std::vector<SievePassing>& gradation, double size, double from) {
  const auto below = [&](double d) {
    if (d >= gradation.back().size) return gradation.back().passing;
    if (d <= gradation.front().size) return gradation.front().passing * d / gradation.front().size;
    const auto upper = std::upper_bound(gradation.begin(), gradation.end(), d,
                                        [](double x, const SievePassing& p) { return x < p.size; });
    const SievePassing &a = *std::prev(upper), &b = *upper;
    return a.passing + (b.passing - a.passing) * std::log(d / a.size) / std::log(b.size / a.size);
  };
  const double unseen = below(from);
  return unseen < 1 ? std::max(0.0, (below(size) - unseen) / (1 - unseen)) : 1;
}

std::string gradation_csv(const std::vector<ScannedGrain>& grains, const std::vector<SievePassing>& laboratory,
                          double smallest) {
  std::vector<ScannedGrain> by_side(grains.size());  // copies without surfaces; `sieve` holds D^I
  for (std::size_t i = 0; i < grains.size(); ++i) {
    by_side[i].measure.volume = grains[i].measure.volume;
    by_side[i].sieve = grains[i].measure.d_intermediate;
  }
  std::vector<double> sieves = standard_sieves();
  for (const SievePassing& p : laboratory) {
    const bool known =
        std::any_of(sieves.begin(), sieves.end(), [&](double s) { return std::abs(s - p.size) < 1e-6 * p.size; });
    if (!known) sieves.push_back(p.size);
  }
  std::sort(sieves.begin(), sieves.end());
  std::string text = "sieve_m,passing_d_intermediate,passing_square_mesh";
  text += laboratory.empty() ? "\n" : ",passing_laboratory,passing_laboratory_seen\n";
  for (const double size : sieves) {
    text += fmt::format("{},{:.6f},{:.6f}", size, share_below(size, by_side, &ScannedGrain::sieve),
                        share_below(size, grains, &ScannedGrain::sieve));
    if (!laboratory.empty()) {
      text += fmt::format(",{:.6f},{:.6f}", passing_at(laboratory, size), passing_at(laboratory, size, 0.5 * smallest));
    }
    text += '\n';
  }
  return text;
}

double trust_in_sizes(const std::vector<ScannedGrain>& grains, const std::vector<SievePassing>& laboratory,
                      double smallest, std::vector<std::string>& warnings) {
  if (laboratory.empty() || grains.empty()) return 1;
  double low = 0.5 * smallest, high = laboratory.back().size;
  if (!(high > low)) {
    warnings.push_back(fmt::format(
        "the laboratory's gradation has no grain above {:.4g} mm, but the scan shows only grains above this size",
        1e3 * low));
    return doubtful;
  }
  while (high - low > 1e-4 * high) {
    const double middle = 0.5 * (low + high);
    (passing_at(laboratory, middle, 0.5 * smallest) < 0.5 ? low : high) = middle;
  }
  // the size below which half of the grains' volume lies
  std::vector<const ScannedGrain*> by_size;
  double volume = 0, below = 0, middle = 0;
  for (const ScannedGrain& g : grains) by_size.push_back(&g), volume += g.measure.volume;
  std::sort(by_size.begin(), by_size.end(), [](const auto* a, const auto* b) { return a->sieve < b->sieve; });
  for (const ScannedGrain* g : by_size) {
    if (below < 0.5 * volume) middle = g->sieve;
    below += g->measure.volume;
  }
  const double largest = by_size.back()->sieve;
  // With a few dozen grains the median may differ by a fifth by chance. Grains somewhat larger than the mesh of a sieve
  // may also pass, because they are long or the wires are worn.
  if (middle > 0.7 * high && middle < 1.4 * high && largest < 1.25 * laboratory.back().size) return 1;
  warnings.push_back(fmt::format(
      "the grains of the scan and of the laboratory's gradation differ in size, so the edge of a voxel may be "
      "wrong; please check it. Half of the grains' volume is below {:.3g} mm in the scan and below {:.3g} mm "
      "in the laboratory's gradation, without the sizes that are too small for the scan. The largest grain "
      "passes a sieve of {:.3g} mm in the scan and of {:.3g} mm in the laboratory",
      1e3 * middle, 1e3 * high, 1e3 * largest, 1e3 * laboratory.back().size));
  return doubtful;
}

}  // namespace macadam::ct
