// SPDX-License-Identifier: GPL-3.0-or-later
// gradation.cpp  Computes the gradation curve that a generated specimen reached, and compares the requested curve with
// its envelope.
#include <fmt/format.h>

#include <iterator>

#include "host/recipe/check_design.hpp"
#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {

std::vector<GradationRow> gradation_of(const MixDesign& design, const std::vector<CompositionRow>& composition) {
  const MixVolumes volumes = volumes_of(design);
  if (composition.size() < volumes.classes.size() + 1)
    throw InputError(design.source, design.line, "composition", fmt::format("{} classes", composition.size()),
                     fmt::format("the {} classes of the recipe and the mastic", volumes.classes.size()));
  // Mass of the dry fine aggregate and the filler per 1 m³ of the box [kg]. The mastic contains them in the proportions
  // of the design.
  const double fines = (volumes.mastic_fine_mass + volumes.mastic_filler_mass) * volumes.bulk_density /
                       volumes.mastic_volume * composition[volumes.classes.size()].fraction;
  double all = fines;
  // After this loop, `all` is the mass of all dry aggregate per 1 m³ of the box [kg].
  for (std::size_t k = 0; k < volumes.classes.size(); ++k) all += composition[k].fraction * volumes.classes[k].density;

  std::vector<GradationRow> rows;
  double passing_cut = 0;
  for (const SievePassing& s : design.gradation) {
    if (s.size == design.cut) passing_cut = s.passing;
  }
  for (const SievePassing& s : design.gradation) {
    double passing = passing_cut > 0 ? fines * std::min(1.0, s.passing / passing_cut) : 0;
    for (std::size_t k = 0; k < volumes.classes.size(); ++k) {
      if (volumes.classes[k].sieve_max <= s.size) passing += composition[k].fraction * volumes.classes[k].density;
    }
    rows.push_back({s.size, s.passing, passing / all});
  }
  return rows;
}

std::vector<SievePassing> outside_of_envelope(const MixDesign& design) {
  std::vector<SievePassing> out;
  for (const EnvelopePoint& p : design.envelope) {
    for (const SievePassing& s : design.gradation) {
      if (s.size == p.size && (s.passing < p.least || s.passing > p.most)) out.push_back(s);
    }
  }
  return out;
}

void write_gradation_csv(const std::filesystem::path& file, const std::vector<GradationRow>& rows) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to, "sieve,asked,reached\n");
  for (const GradationRow& row : rows) fmt::format_to(to, "{},{},{}\n", row.size, row.asked, row.reached);
  write_whole(file, fmt::to_string(text));
}

}  // namespace macadam
