// SPDX-License-Identifier: GPL-3.0-or-later
/// \file macadam.hpp  Includes all public headers, in the order in which data flows.
///
///   scene ─► Specimen ─► Tessellation ─► ContactNetwork ─┬─► Stepper ─► Observation ─► Results
///                                                        └─► Harmonic (frequency domain) ─► Results
///
/// A newcomer should read the headers in this order. Each header is implemented in the folder or file of host/ or
/// kernels/ that has the same name, and its tests have this name in tests/. docs/model.md describes the whole model and
/// names the source that "[1]" and "Eq. 13" in comments refer to.
#pragma once

#include "macadam/version.hpp"
#include "macadam/numeric.hpp"
#include "macadam/error.hpp"
#include "macadam/lengths.hpp"
#include "macadam/thread_limit.hpp"
#include "macadam/backend.hpp"
#include "macadam/shape.hpp"
#include "macadam/ct.hpp"
#include "macadam/domains/domain.hpp"
#include "macadam/specimen.hpp"
#include "macadam/recipe.hpp"
#include "macadam/tessellation.hpp"
#include "macadam/cross_section.hpp"
#include "macadam/notch.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/laws/prony_series.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/laws/shift.hpp"
#include "macadam/fit.hpp"
#include "macadam/fit_report.hpp"
#include "macadam/fields.hpp"
#include "macadam/spectrum.hpp"
#include "macadam/experiments/all.hpp"
#include "macadam/scene.hpp"
#include "macadam/overrides.hpp"
#include "macadam/phantom.hpp"
#include "macadam/twin.hpp"
#include "macadam/drives/all.hpp"
#include "macadam/ranks.hpp"
#include "macadam/stepper.hpp"
#include "macadam/piecewise_stepper.hpp"
#include "macadam/temperature.hpp"
#include "macadam/quasi_static.hpp"
#include "macadam/results.hpp"
#include "macadam/sensitivity.hpp"
#include "macadam/wall_motion.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/simulation.hpp"
#include "macadam/run_many.hpp"
#include "macadam/calibration.hpp"
