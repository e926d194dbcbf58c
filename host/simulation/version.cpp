// SPDX-License-Identifier: GPL-3.0-or-later
// version.cpp  The version is the source tree's, of which scripts/version tells.
#include "macadam/version.hpp"

namespace macadam {

const char* version() { return MACADAM_VERSION; }

}  // namespace macadam
