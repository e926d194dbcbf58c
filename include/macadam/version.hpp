// SPDX-License-Identifier: GPL-3.0-or-later
/// \file version.hpp  Returns the version of Macadam.
#pragma once

namespace macadam {

/// Returns "0.1.0"; between releases for example "0.1.0+3.gHASH", which is three commits after 0.1.0.
const char* version();

}  // namespace macadam
