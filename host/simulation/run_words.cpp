// SPDX-License-Identifier: GPL-3.0-or-later
// run_words.cpp  Words what a run reports about its specimen and its laws.
#include "host/simulation/run_words.hpp"

#include <fmt/format.h>

namespace macadam {

std::string words_of(const RockReport& rock, const Specimen& specimen, ContactRule rule) {
  std::string out =
      fmt::format("rule \"{}\": cells of aggregates fill {:.2f} % of the box", to_string(rule), 100 * rock.rock_cells);
  out += rock.rock_nominal ? fmt::format(" and the aggregates {:.2f} %", 100 * *rock.rock_nominal)
                           : " (the aggregates' own volume is unknown)";
  if (!specimen.voids.empty())
    out += fmt::format("; cells of voids fill {:.2f} % and the voids {:.2f} %", 100 * rock.void_cells,
                       100 * rock.void_nominal);
  return out + fmt::format("; the centres of {} mastic spheres lie in aggregates", rock.mastic_centres_in_rock);
}

std::string words_of_air_voids(const Scene& scene) {
  if (!scene.recipe || !scene.specimen.mastic || scene.specimen.file) return {};
  const double porosity = scene.specimen.mastic->porosity.value_or(0);  // fraction of the volume outside the voids
  if (porosity < 1e-9) return {};
  return fmt::format(
      "air voids: the recipe's air, {:.3g} % of the volume, is only space between spheres; the cells of the spheres "
      "cover "
      "this space, so that the air reduces the mass but does not weaken the specimen (a section [specimen.voids] makes "
      "voids of it)",
      100 * porosity);
}

std::string words_of(const MasticSource& source) {
  const MasticSource::Computed& c = source.computed.value();
  return fmt::format(
      "mastic: the specimen of {}, solved from {:g} to {:g} Hz; a chain of {} Kelvin units stands for it and differs "
      "by at "
      "most {:.2g} % of E*; {}",
      source.file.string(), c.lowest_hz, c.highest_hz, c.units, 100 * c.largest_difference,
      c.folder.empty() ? "the result could not be kept beside that scene"
      : c.kept_before  ? "taken from " + c.folder.string()
                       : "kept in " + c.folder.string());
}

}  // namespace macadam
