// SPDX-License-Identifier: GPL-3.0-or-later
// check_design.cpp  Checks the gradation curve, cut, envelope, contents and densities of a mix design.
#include "host/recipe/check_design.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "macadam/error.hpp"

namespace macadam {
namespace {

// Range of accepted densities. It contains the densities of every road stone, slag, filler and binder. A value outside
// of it has the wrong unit, such as 2.65 in place of 2650.
constexpr double lightest = 200, heaviest = 10'000;  // [kg/m³]
// Largest accepted mass of binder per mass of aggregate. Even a thin mastic has only 3 kg of binder per kg of
// aggregate. A larger value is probably a percentage without its sign, such as 5.2 in place of 5.2 %.
constexpr double most_binder = 3;

bool is_share(double v) { return v >= 0 && v <= 1; }  // false for NaN

void check_curve(const MixDesign& design) {
  const auto& curve = design.gradation;
  if (curve.size() < 2) refuse(design, "gradation", fmt::format("{} sieves", curve.size()), "two or more");
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const auto wrong = [&](const std::string& found, const std::string& expected) {
      refuse(design, "gradation", found, expected, curve[k].line);
    };
    const std::string passing = in_percent(curve[k].passing) + " passing " + in_millimetres(curve[k].size);
    if (!(std::isfinite(curve[k].size) && curve[k].size > 0)) wrong(in_millimetres(curve[k].size), "a size above 0");
    if (!is_share(curve[k].passing)) wrong(passing, "0 % to 100 %");
    if (k == 0) {
      if (curve[0].passing != 1)
        wrong(passing + ", the coarsest sieve",
              "100 % passing the coarsest sieve, because sizes above this sieve are unknown");
      continue;
    }
    const SievePassing& above = curve[k - 1];
    if (!(curve[k].size < above.size))
      wrong(in_millimetres(curve[k].size) + " after " + in_millimetres(above.size), "sieves from coarse to fine");
    if (curve[k].passing > above.passing)
      wrong(
          passing + " after " + in_percent(above.passing) + " passing " + in_millimetres(above.size),
          "at most " + in_percent(above.passing) + ", because what passes a sieve has also passed every coarser sieve");
  }
  const auto is_cut = [&](const SievePassing& s) { return s.size == design.cut; };
  if (std::none_of(curve.begin(), curve.end(), is_cut)) {
    std::string sieves;
    for (const SievePassing& s : curve) sieves += (sieves.empty() ? "" : ", ") + fmt::format("{:.6g}", 1e3 * s.size);
    const bool outside = !(design.cut <= curve.front().size && design.cut >= curve.back().size);
    refuse(design, "cut", in_millimetres(design.cut) + (outside ? ", outside of the curve" : ", between its sieves"),
           "a sieve of the curve: " + sieves + " mm");
  }
}

void check_envelope(const MixDesign& design) {
  std::set<double> sizes;
  for (const EnvelopePoint& p : design.envelope) {
    const auto wrong = [&](const std::string& found, const std::string& expected) {
      refuse(design, "envelope", found, expected, p.line);
    };
    if (!(std::isfinite(p.size) && p.size > 0)) wrong(in_millimetres(p.size), "a size above 0");
    if (!sizes.insert(p.size).second) wrong(in_millimetres(p.size) + " twice", "each sieve once");
    if (!(is_share(p.least) && is_share(p.most) && p.least <= p.most))
      wrong(in_percent(p.least) + " to " + in_percent(p.most) + " passing " + in_millimetres(p.size),
            "the lower limit before the upper limit, both from 0 % to 100 %");
  }
}

void check_density(const MixDesign& design, const std::string& key, double density) {
  if (!(density >= lightest && density <= heaviest))
    refuse(design, key, in_kg_m3(density),
           fmt::format("{} to {} kg/m3; densities in g/cm3 are text with the unit", lightest, heaviest));
}

void check_densities(const MixDesign& design) {
  const std::size_t fractions = design.gradation.size() - 1, given = design.aggregate_density.size();
  if (given != 1 && given != fractions)
    refuse(design, "aggregate_density", fmt::format("{} densities", given),
           fmt::format("1 density, or {} densities, one for each interval between two of the {} sieves", fractions,
                       fractions + 1));
  for (const double density : design.aggregate_density) check_density(design, "aggregate_density", density);
  if (design.filler_density) check_density(design, "filler_density", *design.filler_density);
  check_density(design, "binder_density", design.binder_density);
  if (design.maximum_density) check_density(design, "maximum_density", *design.maximum_density);
  if (design.bulk_density) check_density(design, "bulk_density", *design.bulk_density);
}

void check_contents(const MixDesign& design) {
  const bool of_mix = design.binder_of == BinderOf::mix;
  if (of_mix && design.binder >= 1)
    refuse(design, "binder",
           fmt::format("{} of the mix, which leaves {} of aggregate", in_percent(design.binder),
                       in_percent(1 - design.binder)),
           "below 100 %");
  const double of_aggregate = of_mix ? design.binder / (1 - design.binder) : design.binder;
  if (!(design.binder > 0 && of_aggregate <= most_binder))
    refuse(design, "binder", in_percent(design.binder),
           of_mix ? "above 0 and at most 75 % of the mix" : "above 0 and at most 300 % of the aggregate");
  if (design.absorbed_binder && design.maximum_density)
    refuse(design, "absorbed_binder", "absorbed_binder and maximum_density",
           "only one of them, because each follows from the other");
  if (design.absorbed_binder && !is_share(*design.absorbed_binder))
    refuse(design, "absorbed_binder", in_percent(*design.absorbed_binder) + " of the aggregate's mass", "0 % to 100 %");
  if (design.air_voids.has_value() == design.bulk_density.has_value())
    refuse(design, design.bulk_density ? "bulk_density" : "air_voids",
           design.bulk_density ? "air_voids and bulk_density" : "neither air_voids nor bulk_density",
           "exactly one of the two");
  if (design.air_voids && !(*design.air_voids >= 0 && *design.air_voids < 1))
    refuse(design, "air_voids", in_percent(*design.air_voids), "0 % to below 100 % of the bulk volume");
}

}  // namespace

std::string in_millimetres(double metres) { return fmt::format("{:.6g} mm", 1e3 * metres); }
std::string in_percent(double share) { return fmt::format("{:.6g} %", 100 * share); }
std::string in_kg_m3(double density) { return fmt::format("{:.6g} kg/m3", density); }

void refuse(const MixDesign& design, const std::string& key, const std::string& found, const std::string& expected,
            int line) {
  if (line == 0) {
    const auto known = design.lines.find(key);
    line = known == design.lines.end() ? design.line : known->second;
  }
  throw InputError(design.source, line, "[specimen.recipe] " + key, found, expected);
}

void check(const MixDesign& design) {
  check_curve(design);
  check_envelope(design);
  check_contents(design);
  check_densities(design);
}

}  // namespace macadam
