// SPDX-License-Identifier: GPL-3.0-or-later
/// \file macadam.hpp  Everything, in the order in which data flows.
///
///     scene ─► Specimen ─► Tessellation ─► ContactNetwork ─┬─► Stepper ─► Observation ─► Results
///                                                          └─► Harmonic (frequency domain) ─► Results
///
/// A newcomer reads the headers in this order; each noun is made in the folder of host/ or kernels/ with the same stem
/// and tested in tests/ under the same stem. docs/model.md has the whole model; where a comment says "Eq. 13" or [1],
/// it means the source that is named there.
#pragma once

#include "macadam/version.hpp"
#include "macadam/numeric.hpp"
#include "macadam/error.hpp"
#include "macadam/backend.hpp"
#include "macadam/shape.hpp"
#include "macadam/ct.hpp"
#include "macadam/specimen.hpp"
#include "macadam/recipe.hpp"
#include "macadam/tessellation.hpp"
#include "macadam/cross_section.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/laws/shift.hpp"
#include "macadam/fit.hpp"
#include "macadam/fields.hpp"
#include "macadam/spectrum.hpp"
#include "macadam/experiments/all.hpp"
#include "macadam/scene.hpp"
#include "macadam/phantom.hpp"
#include "macadam/twin.hpp"
#include "macadam/drives/all.hpp"
#include "macadam/ranks.hpp"
#include "macadam/stepper.hpp"
#include "macadam/results.hpp"
#include "macadam/sensitivity.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/simulation.hpp"
#include "macadam/run_many.hpp"
#include "macadam/calibration.hpp"
