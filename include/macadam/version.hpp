// SPDX-License-Identifier: GPL-3.0-or-later
/// \file version.hpp  Which Macadam this is.
#pragma once

namespace macadam {

/// "0.1.0"; between releases "0.1.0+3.gHASH", three commits after 0.1.0
const char* version();

}  // namespace macadam
