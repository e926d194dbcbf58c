// SPDX-License-Identifier: GPL-3.0-or-later
/// \file pickles.hpp  Scenes and specimens as bytes, for other processes and for copies.
#pragma once

#include "python/src/bindings.hpp"

namespace macadam::python {

/// Adds __getstate__ and __setstate__: a scene is its file's name, its text and the options given beside it. The text
/// is read anew, so a file that it names must still be there.
void pickle_scenes(nanobind::class_<GivenScene>& c);

/// Adds __getstate__ and __setstate__: a specimen is its scene and its spheres. Cells and contacts are computed anew,
/// to the same bits.
void pickle_specimens(nanobind::class_<Prepared>& c);

}  // namespace macadam::python
