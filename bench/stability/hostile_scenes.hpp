// SPDX-License-Identifier: GPL-3.0-or-later
/// \file hostile_scenes.hpp  Networks on which a solver may fail; all elastic.
#pragma once

#include "tests/test_scenes.hpp"

namespace macadam::stability {

/// A random specimen whose A–A, inner and A–W contacts are `ratio` times as stiff as M–M and M–W, M–A the root of that.
test::TestScene stiff_aggregates(double ratio);
/// Clusters whose inner contacts are `ratio` times as stiff as all others.
test::TestScene stiff_clusters(double ratio);
/// Large spheres with small ones of 1/ratio the radius in their gaps.
test::TestScene two_sizes(double ratio);
/// A cubic lattice off by `jitter` of its edge: slivers of facets.
test::TestScene nearly_cubic(double jitter);

}  // namespace macadam::stability
