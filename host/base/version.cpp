// SPDX-License-Identifier: GPL-3.0-or-later
// version.cpp  Returns the version of the source tree, as scripts/version prints it.
#include "macadam/version.hpp"

namespace macadam {

const char* version() { return MACADAM_VERSION; }

}  // namespace macadam
