// SPDX-License-Identifier: GPL-3.0-or-later
/// \file pickles.hpp  Makes scenes and specimens picklable, so that they can be sent to other processes and copied.
#pragma once

#include "python/src/bindings.hpp"

namespace macadam::python {

/// Adds __getstate__ and __setstate__ to the class. The state of a scene is its file's name, its text and its options.
/// Unpickling reads the text again, so files that the text names must still exist.
void pickle_scenes(nanobind::class_<GivenScene>& c);

/// Adds __getstate__ and __setstate__ to the class. The state of a specimen is its scene, its spheres and, if it was
/// generated, its composition and aggregates. Unpickling computes cells and contacts again, with the same bits.
void pickle_specimens(nanobind::class_<Prepared>& c);

}  // namespace macadam::python
