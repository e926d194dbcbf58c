// SPDX-License-Identifier: GPL-3.0-or-later
// sparse_box.cpp  Compares the sum of the sphere volumes with the volume of the box.
#include "host/spheres/sparse_box.hpp"

#include <fmt/format.h>

#include <numbers>

namespace macadam {

std::string sparse_box(const Specimen& specimen) {
  constexpr double least = 0.1;  // touching spheres fill at least half of a box, spheres of porous asphalt a third
  double filled = 0;
  for (const double r : specimen.radius) filled += 4 * std::numbers::pi / 3 * r * r * r / specimen.box.volume();
  if (filled >= least) return {};
  return fmt::format(
      "spheres fill {:.2g} % of the {}, expected {:g} % or more; check that the lengths of the spheres and of the {} "
      "are in metres",
      100 * filled, specimen.box.dimensions(), 100 * least, specimen.box.name());
}

}  // namespace macadam
