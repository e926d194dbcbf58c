// SPDX-License-Identifier: GPL-3.0-or-later
/// \file hostile_scenes.hpp  Declares functions that make elastic networks on which a solver may fail.
#pragma once

#include "tests/support/test_scenes.hpp"

namespace macadam::stability {

/// Returns a random specimen whose A–A, inner and A–W contacts are `ratio` times as stiff as M–M and M–W; M–A contacts
/// are √ratio times as stiff.
test::TestScene stiff_aggregates(double ratio);
/// Returns clusters whose inner contacts are `ratio` times as stiff as all other contacts.
test::TestScene stiff_clusters(double ratio);
/// Returns large spheres with small ones of 1/ratio the radius in their gaps.
test::TestScene two_sizes(double ratio);
/// Returns a cubic lattice whose spheres are moved by up to `jitter` of its edge, which gives very narrow facets
/// (slivers).
test::TestScene nearly_cubic(double jitter);

}  // namespace macadam::stability
