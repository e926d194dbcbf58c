// SPDX-License-Identifier: GPL-3.0-or-later
/// \file packing_scene.hpp  Makes a scene to start from for a packing of another program.
#pragma once

#include <string>

#include "macadam/contact_network.hpp"
#include "macadam/domains/domain.hpp"

namespace macadam::scene {

/// Returns the text of a new scene whose specimen of one material, the mastic, is the specimen file `file` with this
/// domain. The other arguments and errors are those of new_scene().
std::string packing_scene(const std::string& file, const Domain& domain, const std::string& test, ContactRule rule,
                          bool cracks);

}  // namespace macadam::scene
