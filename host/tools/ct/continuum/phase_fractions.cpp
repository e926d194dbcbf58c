// SPDX-License-Identifier: GPL-3.0-or-later
// phase_fractions.cpp  Sums the fractions of all voxels.
#include "host/tools/ct/continuum/phase_fractions.hpp"

#include <algorithm>
#include <numeric>

namespace macadam::continuum {

double PhaseFractions::mean_rock() const { return std::accumulate(rock.begin(), rock.end(), 0.0) / (area * size.z); }

double PhaseFractions::mean_voids() const {  // the specimen's volume without rock and mastic
  return 1 - (double(size.elements()) - std::accumulate(voids.begin(), voids.end(), 0.0)) / (area * size.z);
}

bool PhaseFractions::has_mixed_voxels() const {
  const auto is_part = [](float fraction) { return fraction > 0 && fraction < 1; };
  return std::any_of(rock.begin(), rock.end(), is_part) || std::any_of(voids.begin(), voids.end(), is_part);
}

}  // namespace macadam::continuum
